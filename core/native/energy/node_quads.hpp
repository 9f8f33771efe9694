// The energy of the boundary quads at a node as a function of that node alone: a term of a sliding node's objective.
//
// Of the four corners of a quad three hold the node: its own, and those of its two neighbours. At a corner with the
// edges e1 to the next and e2 to the previous corner, T = [e1, e2], and with the outward unit normal n of the surface
// at the quad, sigma = n . (e1 x e2). h and r are those of hexes. With f = 1/(2 h) and eta = f |T|^2,
//
//     d eta(V)    = 2 f [ (V, T) - |T|^2/(2 r) d sigma(V) ]
//     d2 eta(V,W) = 2 f [ (V, W) - 1/r ((V, T) d sigma(W) + d sigma(V) (W, T))
//                         + |T|^2/(2 r^2) (1 + sigma/r) d sigma(V) d sigma(W) ]
//
// where d2 sigma vanishes: at the node's displacement y, sigma = sigma_0 + g . y and |T|^2 = s_0 + b . y + k |y|^2. The
// normals stay as given. eta(Q) is the mean of the four minus the offset, and a corner that is not counted has eta = 1.
#pragma once

#include <vector>

#include "boundary/sliding_surface.hpp"
#include "boundary/surface_term.hpp"
#include "energy/node_patch.hpp"

namespace hexmend {

// Quads at one node after another; see SurfaceTerm.
class NodeQuads {
  public:
    // Load the quads at the sliding node in a slot; lengths are multiplied by `factor`.
    void load(Points points, const BoundaryQuads &quads, Node slot, const SurfaceTerm &term, double factor) {
        term_ = &term;
        quads_.clear();
        for (auto r = quads.start[slot]; r < quads.start[slot + 1]; ++r)
            quads_.push_back(quad_at(points_of(points, quads.quads[quads.corners[r] / 4]), quads.corners[r] / 4,
                                     quads.corners[r] % 4, factor));
    }

    // The term with the node displaced by y.
    double value_at(const V3<double> &y, ObjectiveNorm norm) const {
        double total = 0;
        for (const auto &quad : quads_) {
            double eta = quad.constant;
            for (const auto &corner : quad.corners)
                if (corner.counted)
                    eta += energy_at(corner.sigma + dot(corner.g, y),
                                     corner.square + dot(corner.b, y) + corner.k * square(y))
                               .eta();
            total += power(0.25 * eta - norm.offset, norm.p);
        }
        return term_->weight * total;
    }

    // Add value and gradient of the term at the node's position.
    void add_to(ValueAndGradient &at, ObjectiveNorm norm) const {
        for (const auto &quad : quads_) {
            auto [eta, gradient] = slope_of(quad, norm.offset);
            at.value += term_->weight * power(eta, norm.p);
            at.gradient += (term_->weight * power_derivatives(eta, norm.p).first) * gradient;
        }
    }

    // Add the second derivatives of the term at the node's position.
    void add_to(SymmetricMatrix &h, ObjectiveNorm norm) const {
        for (const auto &quad : quads_) {
            auto [eta, gradient] = slope_of(quad, norm.offset);
            auto derivatives = power_derivatives(eta, norm.p);
            double first = 0.25 * term_->weight * derivatives.first;
            add_outer(h, term_->weight * derivatives.second, gradient, gradient);
            for (const auto &corner : quad.corners) {
                if (!corner.counted) continue;
                auto e = energy_at(corner.sigma, corner.square);
                double scale = 2 * first * e.f, over_r = 1 / e.r;
                h.add_to_diagonal(scale * corner.k);
                add_outer(h, -scale * over_r, corner.b, corner.g);  // (V, T) = b . V/2, twice by symmetry
                add_outer(h, scale * 0.5 * e.square * over_r * over_r * (1 + corner.sigma * over_r), corner.g,
                          corner.g);
            }
        }
    }

  private:
    struct Corner {
        bool counted;
        double sigma, square, k;
        V3<double> g, b;
    };

    struct QuadAtNode {
        Corner corners[3];
        double constant;  // eta of the corners that do not move, or are not counted
    };

    struct CornerEnergy {
        double f, square, r;
        double eta() const { return f * square; }
    };

    struct Slope {
        double eta;
        V3<double> gradient;
    };

    const SurfaceTerm *term_ = nullptr;
    std::vector<QuadAtNode> quads_;

    // +inf for coinciding corners.
    static double power(double eta, double p) {
        if (!(eta > 0)) return eta <= 0 ? 0 : INF;
        return p == 2 ? eta * eta : std::pow(eta, p);
    }

    // h += factor/2 (a b^T + b a^T)
    static void add_outer(SymmetricMatrix &h, double factor, const V3<double> &a, const V3<double> &b) {
        h.xx += factor * a.x * b.x, h.yy += factor * a.y * b.y, h.zz += factor * a.z * b.z;
        h.xy += 0.5 * factor * (a.x * b.y + a.y * b.x);
        h.xz += 0.5 * factor * (a.x * b.z + a.z * b.x);
        h.yz += 0.5 * factor * (a.y * b.z + a.z * b.y);
    }

    CornerEnergy energy_at(double sigma, double square) const {
        auto [h, r] = term_->delta != 0 ? barrier<true>(sigma, term_->delta) : barrier<false>(sigma, 0.0);
        return {h > 0 ? 0.5 / h : INF, square, r};
    }

    Slope slope_of(const QuadAtNode &quad, double offset) const {
        double eta = quad.constant;
        V3<double> g{};
        for (const auto &corner : quad.corners) {
            if (!corner.counted) continue;
            auto e = energy_at(corner.sigma, corner.square);
            eta += e.eta();
            g += e.f * corner.b - (e.eta() / e.r) * corner.g;
        }
        return {0.25 * eta - offset, 0.25 * g};
    }

    // Corner c of quad number f is the node.
    QuadAtNode quad_at(const QuadPoints &points, std::int32_t f, int c, double factor) const {
        V3<double> x[4], origin = vector(points[c]);
        for (int i = 0; i < 4; ++i) x[i] = factor * (vector(points[i]) - origin);
        V3<double> n = vector(term_->normals[f]);
        auto scale = [&](int i, int edge) {
            return term_->inverse_lengths ? (*term_->inverse_lengths)[f][2 * i + edge] / factor : 1.0;
        };
        int next = (c + 1) % 4, across = (c + 2) % 4, previous = (c + 3) % 4;
        const auto &counted = term_->counted[f];
        QuadAtNode quad{{own_corner(x[next], x[previous], n, scale(c, 0), scale(c, 1)),
                         // from its neighbours, the node is the previous corner, and the next
                         neighbour_corner(x[next], x[across], n, scale(next, 1), scale(next, 0)),
                         neighbour_corner(x[previous], x[across], -n, scale(previous, 0), scale(previous, 1))},
                        0};
        const int of[] = {c, next, previous};
        for (int i = 0; i < 3; ++i)
            if (!(quad.corners[i].counted = counted[of[i]])) quad.constant += 1;
        V3<double> u = scale(across, 0) * (x[previous] - x[across]), v = scale(across, 1) * (x[next] - x[across]);
        quad.constant += counted[across] ? energy_at(dot(n, cross(u, v)), square(u) + square(v)).eta() : 1;
        return quad;
    }

    // The node's own corner, with edges to u and v of inverse lengths s and t.
    static Corner own_corner(const V3<double> &u, const V3<double> &v, const V3<double> &n, double s, double t) {
        return {true,          s * t * dot(n, cross(u, v)), s * s * square(u) + t * t * square(v),
                s * s + t * t, s * t * cross(n, v - u),     (-2 * s * s) * u + (-2 * t * t) * v};
    }

    // The corner of a neighbour at a, with edges to the node, of inverse length s, and to w, of t: sigma = n . (w x e)
    // with e to the node.
    static Corner neighbour_corner(const V3<double> &a, const V3<double> &across, const V3<double> &n, double s,
                                   double t) {
        V3<double> w = across - a, g = s * t * cross(n, w);
        return {true, -dot(a, g), s * s * square(a) + t * t * square(w), s * s, g, (-2 * s * s) * a};
    }
};

}  // namespace hexmend
