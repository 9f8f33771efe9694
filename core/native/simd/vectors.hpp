// Vectors and matrices of three dimensions. Each component is a double or a vector register of several hexes.
#pragma once

#include "simd/lanes.hpp"

namespace hexmend {

template <class T> struct V3 {
    T x{}, y{}, z{};

    V3 &operator+=(const V3 &b) {
        x += b.x, y += b.y, z += b.z;
        return *this;
    }
    V3 &operator-=(const V3 &b) {
        x -= b.x, y -= b.y, z -= b.z;
        return *this;
    }
};

template <class T> inline V3<T> operator+(const V3<T> &a, const V3<T> &b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
template <class T> inline V3<T> operator-(const V3<T> &a, const V3<T> &b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
template <class T> inline V3<T> operator-(const V3<T> &a) { return {-a.x, -a.y, -a.z}; }
template <class T> inline V3<T> operator*(T k, const V3<T> &a) { return {k * a.x, k * a.y, k * a.z}; }
template <class T> inline T dot(const V3<T> &a, const V3<T> &b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
template <class T> inline T square(const V3<T> &a) { return dot(a, a); }
template <class T> inline T length(const V3<T> &a) { return sqrt(dot(a, a)); }

template <class T> inline V3<T> cross(const V3<T> &a, const V3<T> &b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// A matrix of columns u, v, w, such as the edges of a corner tetrahedron from its apex, or a derivative by them.
template <class T> struct M3 {
    V3<T> u, v, w;
};

template <class T> inline T dot(const M3<T> &a, const M3<T> &b) {
    return dot(a.u, b.u) + dot(a.v, b.v) + dot(a.w, b.w);
}
template <class T> inline T square(const M3<T> &a) { return dot(a, a); }

// Cofactors, the derivative of the determinant of [u, v, w]: columns v x w, w x u, u x v.
template <class T> inline M3<T> cofactors(const M3<T> &s) {
    return {cross(s.v, s.w), cross(s.w, s.u), cross(s.u, s.v)};
}

// Products of which none is fused with a sum, so that they have the same bits in every kernel, on every processor.
template <class T> inline T exact_dot(const V3<T> &a, const V3<T> &b) {
    return uncontracted(a.x * b.x) + uncontracted(a.y * b.y) + uncontracted(a.z * b.z);
}
template <class T> inline V3<T> exact_cross(const V3<T> &a, const V3<T> &b) {
    return {uncontracted(a.y * b.z) - uncontracted(a.z * b.y), uncontracted(a.z * b.x) - uncontracted(a.x * b.z),
            uncontracted(a.x * b.y) - uncontracted(a.y * b.x)};
}

// As NumPy sums the products of short rows.
inline double numpy_dot(const V3<double> &a, const V3<double> &b) {
    double x = uncontracted(a.x * b.x), y = uncontracted(a.y * b.y);
    return x + uncontracted(a.z * b.z) + y;
}

// sigma = det [u, v, w] = u . (v x w), (2.9): the sign of a flat corner is the same everywhere.
template <class T> inline T determinant(const M3<T> &s) { return exact_dot(s.u, exact_cross(s.v, s.w)); }

}  // namespace hexmend
