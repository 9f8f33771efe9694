// The energy of a node's patch as a function of that node alone.
//
// Each attached hex has four corner tetrahedra that hold the node: the one whose apex it is, and those of its three
// edge neighbours. The other four do not change as the node moves. At the node's displacement y,
//
//     sigma = sigma_0 + g . y          |S|^2 = s_0 + b . y + k |y|^2,   k = 3 at the apex, else 1,
//
// because a determinant is linear in each of its columns. A patch is therefore a table of coefficients for each
// tetrahedron, computed once per step, from which value, gradient and trial values of the line search follow cheaply.
//
// With a target, S is S W^-1: g and b are scaled, and k is the sum of the squared scales of the columns that hold y.
//
// Every hex is rotated so that the node is its corner 0: all lanes then compute the same formulas. Unused lanes of the
// last block repeat the last hex and are excluded from sums.
//
// Parts of a step are never inlined: the compiler would contract other products where several nodes are stepped at a
// time, and a sweep has the same bits as the step of one node.
#pragma once

#include <vector>

#include "energy/tetrahedron.hpp"
#include "linear/symmetric.hpp"
#include "mesh/hex_mesh.hpp"
#include "simd/simd_hexes.hpp"

namespace hexmend {

// The nodes of a hex rotated so that `corner` becomes its corner 0.
inline Hex rotated(const Hex &hex, int corner) {
    Hex there;
#if defined(__AVX2__)
    auto from = _mm256_loadu_si256(reinterpret_cast<const __m256i *>(hex.data()));
    auto order = _mm256_load_si256(reinterpret_cast<const __m256i *>(ROTATIONS[corner].data()));
    _mm256_storeu_si256(reinterpret_cast<__m256i *>(there.data()), _mm256_permutevar8x32_epi32(from, order));
#else
    for (int c = 0; c < 8; ++c) there[c] = hex[ROTATIONS[corner][c]];
#endif
    return there;
}

// Value of a patch's energy and its gradient by the node.
struct ValueAndGradient {
    double value;
    V3<double> gradient;
};

// The hexes at one node in blocks of lanes. The methods with parameter `soft` are for delta > 0 if it is true.
template <class T, class Target = Cubes> class NodePatch {
  public:
    // Allocate for at most `most` hexes.
    NodePatch(std::int64_t most, const Target &target) : target_(target), blocks_((most + width<T> - 1) / width<T>) {}

    // Number of hexes.
    int size() const { return size_; }

    // Load the hexes at a node relative to it, scaled by `factor` or, if that is 0, to mean edge length 1 (each edge
    // counted once per hex), with a target to unit root mean square of the inverse lengths: the shortest ones decide
    // how far a node can move. Returns the factor; 0 if the patch has no extent.
    __attribute__((noinline)) double load(Points points, Hexes hexes, Star star, double factor = 0) {
        size_ = static_cast<int>(star.size());
        const Point &node = points[hexes[star[0] / 8][star[0] % 8]];
        V3<T> origin{broadcast<T>(node[0]), broadcast<T>(node[1]), broadcast<T>(node[2])};
        double total = 0;
        for (int b = 0; b < blocks(); ++b) {
            Hex hex[width<T>];
            for (int i = 0; i < width<T>; ++i) {
                int s = b * width<T> + i;
                std::int32_t corner = star[s < size_ ? s : size_ - 1];
                hex[i] = rotated(hexes[corner / 8], corner % 8);
            }
            if constexpr (scaled) total += load_scales(star, b);
            auto &x = blocks_[b].x;
            for (int c = 0; c < 8; ++c)
                x.at[c] = load_lanes<T>([&](int i) -> const Point & { return points[hex[i][c]]; }) - origin;
            if (!scaled && factor == 0) total += sum(edge_lengths(x), b);
        }
        if (scaled && factor == 0) factor = has_extent() ? std::sqrt(total / (3 * size_)) : 0.0;
        else if (factor == 0) factor = total > 0 ? 12 * size_ / total : 0.0;
        for (int b = 0; b < blocks(); ++b) {
            for (auto &corner : blocks_[b].x.at) corner = broadcast<T>(factor) * corner;
            if constexpr (scaled) blocks_[b].scales.inverse = broadcast<T>(1 / factor) * blocks_[b].scales.inverse;
        }
        return factor;
    }

    // Compute the table; delta is in units of the scaled patch.
    template <bool soft> __attribute__((noinline)) void tabulate(double delta) {
        for (int b = 0; b < blocks(); ++b) {
            auto &block = blocks_[b];
            const auto &x = block.x.at;
            // Corner tetrahedra as in CORNER_TETRAHEDRA; those of neighbours are rotated to begin with the node.
            add_own_tetrahedron(block, x[3], x[4], x[1]);
            add_neighbour_tetrahedron<1, 0, 5, 2>(block, block.incident[1]);
            add_neighbour_tetrahedron<3, 0, 2, 7>(block, block.incident[2]);
            add_neighbour_tetrahedron<4, 0, 7, 5>(block, block.incident[3]);
            block.constant = constant_eta<soft, 2>(block, delta) + constant_eta<soft, 5>(block, delta) +
                             constant_eta<soft, 6>(block, delta) + constant_eta<soft, 7>(block, delta);
        }
    }

    // Set the direction of `value_along`.
    __attribute__((noinline)) void set_direction(const V3<double> &direction) {
        V3<T> d{broadcast<T>(direction.x), broadcast<T>(direction.y), broadcast<T>(direction.z)};
        squared_length_ = dot(direction, direction);
        for (int b = 0; b < blocks(); ++b)
            for (auto &t : blocks_[b].incident) t.along_g = dot(t.g, d), t.along_b = dot(t.b, d);
    }

    // Sum of eta(H)^p with the node displaced by alpha times the direction: (3.3) without its root, (B.20).
    template <bool soft>
    __attribute__((noinline)) double value_along(double alpha, double delta, ObjectiveNorm norm) const {
        double far = alpha * alpha * squared_length_, total = 0;
        for (int b = 0; b < blocks(); ++b) {
            const auto &block = blocks_[b];
            T eta = block.constant;
            for (int j = 0; j < 4; ++j) {
                const auto &t = block.incident[j];
                T sigma = t.sigma + alpha * t.along_g, squared = (t.square + t.k(j) * far) + alpha * t.along_b;
                eta += energy_at<soft>(sigma, squared, delta).eta();
                if constexpr (scaled) eta += size_term<soft>(sigma, delta, block.scales.size_weight).value;
            }
            total += sum_of_powers(eta, norm, b);
        }
        return total;
    }

    // Value and gradient at the node's position: (B.3), (B.21), (C.1). Stores the terms that `hessian` needs.
    template <bool soft>
    __attribute__((noinline)) ValueAndGradient value_and_gradient(double delta, ObjectiveNorm norm) {
        ValueAndGradient answer{};
        for (int b = 0; b < blocks(); ++b) {
            auto &block = blocks_[b];
            T eta = block.constant;
            V3<T> g{};
            for (auto &t : block.incident) {
                t.energy = energy_at<soft>(t.sigma, t.square, delta);
                eta += t.energy.eta();
                // d eta = 2 eta [ (dS, S)/|S|^2 - d sigma/(3 r) ], the first of which is f b . y
                g += t.energy.f * t.b - t.energy.eta() * (2.0 / 3.0) / t.energy.r * t.g;
                if constexpr (scaled) {
                    t.size = size_term<soft>(t.sigma, delta, block.scales.size_weight);
                    eta += t.size.value;
                    g += t.size.slope * t.g;
                }
            }
            block.eta = eta * 0.125 - norm.offset;
            block.gradient = broadcast<T>(0.125) * g;
            answer.value += sum_of_powers(eta, norm, b);
            block.weights = LanePowerDerivatives<T>(block.eta, norm.p);
            V3<T> weighted = block.weights.first * block.gradient;
            answer.gradient += V3<double>{sum(weighted.x, b), sum(weighted.y, b), sum(weighted.z, b)};
        }
        return answer;
    }

    // Second derivatives at the node's position, (B.19) corrected, (B.22). Call value_and_gradient first.
    // d2 sigma vanishes, a determinant being linear in the place of one node (B.1).
    __attribute__((noinline)) SymmetricMatrix hessian() const {
        SymmetricMatrix answer{};
        for (int b = 0; b < blocks(); ++b) {
            const auto &block = blocks_[b];
            T xx{}, xy{}, xz{}, yy{}, yz{}, zz{};
            for (int j = 0; j < 4; ++j) {
                const auto &t = block.incident[j];
                T over_r = 1.0 / t.energy.r;
                T a = (4.0 / 3.0) * t.energy.f * over_r, k = (2.0 * t.k(j)) * t.energy.f;
                T c = (2.0 / 3.0) * t.energy.eta() * over_r * over_r * (2.0 / 3.0 + t.sigma * over_r);
                if constexpr (scaled) c += t.size.curvature;
                V3<T> s = broadcast<T>(0.5) * t.b, g = t.g;
                xx += k - 2.0 * a * s.x * g.x + c * g.x * g.x;
                yy += k - 2.0 * a * s.y * g.y + c * g.y * g.y;
                zz += k - 2.0 * a * s.z * g.z + c * g.z * g.z;
                xy += c * g.x * g.y - a * (s.x * g.y + s.y * g.x);
                xz += c * g.x * g.z - a * (s.x * g.z + s.z * g.x);
                yz += c * g.y * g.z - a * (s.y * g.z + s.z * g.y);
            }
            T first = 0.125 * block.weights.first, second = block.weights.second;
            const V3<T> &e = block.gradient;
            answer.xx += sum(first * xx + second * e.x * e.x, b);
            answer.xy += sum(first * xy + second * e.x * e.y, b);
            answer.xz += sum(first * xz + second * e.x * e.z, b);
            answer.yy += sum(first * yy + second * e.y * e.y, b);
            answer.yz += sum(first * yz + second * e.y * e.z, b);
            answer.zz += sum(first * zz + second * e.z * e.z, b);
        }
        return answer;
    }

  private:
    static constexpr bool scaled = !std::is_same_v<Target, Cubes>;

    // Terms of a tetrahedron that a target adds: k, and the size's share at the node's position.
    struct Additional {
        T squared_scales;
        SizeTerm<T> size;
    };
    struct Nothing {};

    struct TetTerms : std::conditional_t<scaled, Additional, Nothing> {
        T sigma, square;
        V3<T> g, b;
        T along_g, along_b;
        Energy<T> energy;

        // Of tetrahedron j: 3 at the apex, else 1, without a target.
        auto k(int j) const {
            if constexpr (scaled) return this->squared_scales;
            else return j ? 1.0 : 3.0;
        }
    };

    struct Block {
        Corners<T> x;
        [[no_unique_address]] ScalesOf<T, Target> scales;
        TetTerms incident[4];
        T constant, eta;
        V3<T> gradient;
        LanePowerDerivatives<T> weights;
    };

    [[no_unique_address]] Target target_;
    std::vector<Block> blocks_;
    int size_ = 0;
    double squared_length_ = 0;

    int blocks() const { return (size_ + width<T> - 1) / width<T>; }

    // Sum over the hexes of block b.
    double sum(const T &x, int b) const {
        int count = size_ - b * width<T>;
        if constexpr (width<T> > 1) {
            if (count >= width<T>) return sum_of_lanes(x);
        }
        double total = 0;
        for (int i = 0; i < width<T> && i < count; ++i) total += lane(x, i);
        return total;
    }

    // Sum of eta(H)^p over the hexes of block b, from their sums of eta(T).
    double sum_of_powers(T sum_of_eta, ObjectiveNorm norm, int b) const {
        T energy = hex_energy(sum_of_eta, norm.offset);
        if (norm.p == 2) return sum(energy * energy, b);
        double total = 0;
        for (int i = 0; i < width<T> && b * width<T> + i < size_; ++i) total += std::pow(lane(energy, i), norm.p);
        return total;
    }

    template <bool soft> static Energy<T> energy_at(T sigma, T squared, double delta) {
        auto [h, r] = barrier<soft>(sigma, delta);
        return {power_minus_two_thirds(h) * (1.0 / 3.0), squared, sigma, r};
    }

    // Load the scales of block b, rotated as its hexes are; returns the sum of their squares.
    double load_scales(Star star, int b) {
        Point inverse[width<T>];
        for (int i = 0; i < width<T>; ++i) {
            int s = b * width<T> + i;
            std::int32_t corner = star[s < size_ ? s : size_ - 1];
            const auto &row = target_.inverse_lengths[corner / 8];
            for (int k = 0; k < 3; ++k) inverse[i][k] = row[ROTATED_DIRECTIONS[corner % 8][k]];
        }
        auto &scales = blocks_[b].scales;
        scales = {load_lanes<T>([&](int i) -> const Point & { return inverse[i]; }), target_.size_weight};
        return sum(hexmend::square(scales.inverse), b);
    }

    // True if not all corners are at the node.
    bool has_extent() const {
        for (int b = 0; b < blocks(); ++b)
            if (sum(edge_lengths(blocks_[b].x), b) > 0) return true;
        return false;
    }

    // The node's own tetrahedron: S = [u - y, v - y, w - y].
    static void add_own_tetrahedron(Block &block, const V3<T> &u, const V3<T> &v, const V3<T> &w) {
        auto &t = block.incident[0];
        M3<T> edges{u, v, w};
        if constexpr (scaled) {
            auto by = block.scales.template columns<0>();
            M3<T> s = scale(edges, by), of_node = scale(s, by), cof = scale(cofactors(s), by);
            t.sigma = scale(determinant(edges), by);
            t.g = -(cof.u + cof.v + cof.w);
            t.square = square(s);
            t.b = broadcast<T>(-2.0) * (of_node.u + of_node.v + of_node.w);
            t.squared_scales = by.u * by.u + by.v * by.v + by.w * by.w;
        } else {
            t.sigma = determinant(edges);
            t.g = -(cross(v, w) + cross(w, u) + cross(u, v));
            t.square = square(edges);
            t.b = broadcast<T>(-2.0) * (u + v + w);
        }
    }

    // The tetrahedron of the neighbour at corner `apex`: S = [y - a, b - a, c - a], from the node to the corners b, c.
    template <int apex, int node, int b_corner, int c_corner>
    static void add_neighbour_tetrahedron(Block &block, TetTerms &t) {
        const auto &x = block.x.at;
        const V3<T> &a = x[apex];
        V3<T> u = x[b_corner] - a, v = x[c_corner] - a;
        if constexpr (scaled) {
            const auto &by = block.scales;
            T d = by.template along<direction_of(apex, node)>();
            u = by.template along<direction_of(apex, b_corner)>() * u;
            v = by.template along<direction_of(apex, c_corner)>() * v;
            t.g = d * cross(u, v);
            t.sigma = -dot(a, t.g);
            t.square = d * d * square(a) + square(u) + square(v);
            t.b = (-2.0 * d * d) * a;
            t.squared_scales = d * d;
        } else {
            t.g = cross(u, v);
            t.sigma = -dot(a, t.g);
            t.square = square(a) + square(u) + square(v);
            t.b = broadcast<T>(-2.0) * a;
        }
    }

    // eta of corner tetrahedron t, one without the node.
    template <bool soft, int t> static T constant_eta(const Block &block, double delta) {
        return hexmend::eta<soft>(block.x.template edges<t>(), block.scales.template columns<t>(), delta,
                                  std::true_type{});
    }
};

}  // namespace hexmend
