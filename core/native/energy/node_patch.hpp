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
// last block repeat the last hex and are excluded from sums. In a block with a cell of another kind the tetrahedra of
// each lane are told by a table: with R from the edges that leave the node to those that leave the apex, S is E R.
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

// The corner tetrahedra of a kind of cells that hold one of its nodes: the three other nodes, and R W^-1, so that
// S W^-1 = E R W^-1 with the edges E to these; bit t of `others` is set for each of the other corner tetrahedra.
struct TetrahedraAtNode {
    int count = 0, others = 0, ends[4][3] = {};
    double shape[4][3][3] = {};
};

constexpr auto TETRAHEDRA_AT_NODE = [] {
    std::array<std::array<TetrahedraAtNode, 8>, CELL_KINDS> all{};
    for (int kind = 0; kind < CELL_KINDS; ++kind) {
        auto &table = CELL_TABLES[kind];
        for (int node = 0; node < table.nodes; ++node)
            for (int t = 0; t < table.corners; ++t) {
                auto &n = table.corner_tetrahedra[t];
                auto &to = all[kind][node];
                int at = 0;
                while (at < 4 && n[at] != node) ++at;
                if (at == 4) {
                    to.others |= 1 << t;
                    continue;
                }
                auto &ends = to.ends[to.count];
                int size = 0;
                for (int k = 0; k < 4; ++k)
                    if (k != at) ends[size++] = n[k];
                // Row i of R: what the edge to end i adds to the edges of the tetrahedron.
                double rows[3][3] = {};
                for (int i = 0; i < 3; ++i)
                    for (int k = 1; k < 4; ++k) rows[i][k - 1] = (n[k] == ends[i]) - (n[0] == ends[i]);
                for (int i = 0; i < 3; ++i)
                    for (int j = 0; j < 3; ++j)
                        for (int k = 0; k < 3; ++k) to.shape[to.count][i][j] += rows[i][k] * table.inverse[k][j];
                ++to.count;
            }
    }
    return all;
}();

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
        double total = 0, edges = 0;
        for (int b = 0; b < blocks(); ++b) {
            Hex hex[width<T>];
            blocks_[b].mixed = false;
            for (int i = 0; i < width<T>; ++i) {
                std::int32_t corner = corner_in(star, b, i);
                blocks_[b].mixed |= kind_of(hexes[corner / 8]) != HEXAHEDRON;
                hex[i] = rotated(hexes[corner / 8], corner % 8);
            }
            if (blocks_[b].mixed) [[unlikely]]
                for (int i = 0; i < width<T>; ++i) {
                    std::int32_t corner = corner_in(star, b, i);
                    hex[i] = hexes[corner / 8];
                    blocks_[b].at[i] = &TETRAHEDRA_AT_NODE[kind_of(hex[i])][corner % 8];
                    blocks_[b].table[i] = &table_of(hex[i]);
                }
            if constexpr (scaled) total += load_scales(star, b);
            auto &x = blocks_[b].x;
            for (int c = 0; c < 8; ++c)
                x.at[c] = load_lanes<T>([&](int i) -> const Point & { return points[hex[i][c]]; }) - origin;
            if (!scaled && factor == 0) total += lengths_of(blocks_[b], b, edges);
        }
        if (scaled && factor == 0) factor = has_extent() ? std::sqrt(total / (3 * size_)) : 0.0;
        else if (factor == 0) factor = total > 0 ? edges / total : 0.0;
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
            if (block.mixed) [[unlikely]] {
                for (int i = 0; i < width<T>; ++i) tabulate_lane<soft>(block, i, delta);
                continue;
            }
            block.share = broadcast<T>(0.125);
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
                T sigma = t.sigma + alpha * t.along_g,
                  squared = (t.square + t.squared_scales * far) + alpha * t.along_b;
                eta += energy_at<soft>(sigma, squared, delta).eta();
                if constexpr (scaled) eta += size_term<soft>(sigma, delta, block.scales.size_weight).value;
            }
            total += sum_of_powers(eta, block.share, norm, b);
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
            block.eta = eta * block.share - norm.offset;
            block.gradient = block.share * g;
            answer.value += sum_of_powers(eta, block.share, norm, b);
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
                T a = (4.0 / 3.0) * t.energy.f * over_r, k = (2.0 * t.squared_scales) * t.energy.f;
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
            T first = block.share * block.weights.first, second = block.weights.second;
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

    // Addition of a target to the terms of a tetrahedron: the size's share at the node's position.
    struct Additional {
        SizeTerm<T> size;
    };
    struct Nothing {};

    struct TetTerms : std::conditional_t<scaled, Additional, Nothing> {
        T sigma, square, squared_scales;
        V3<T> g, b;
        T along_g, along_b;
        Energy<T> energy;
    };

    struct Block {
        Corners<T> x;
        [[no_unique_address]] ScalesOf<T, Target> scales;
        TetTerms incident[4];
        T constant, eta, share;  // share of each corner in the mean
        V3<T> gradient;
        LanePowerDerivatives<T> weights;
        bool mixed;  // some lane has a cell that is no hex: then all lanes have these tables
        const TetrahedraAtNode *at[width<T>];
        const CellTable *table[width<T>];
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
    double sum_of_powers(T sum_of_eta, T share, ObjectiveNorm norm, int b) const {
        T energy = cell_energy(sum_of_eta, share, norm.offset);
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
            std::int32_t corner = corner_in(star, b, i);
            const auto &row = target_.inverse_lengths[corner / 8];
            for (int k = 0; k < 3; ++k) inverse[i][k] = row[blocks_[b].mixed ? k : ROTATED_DIRECTIONS[corner % 8][k]];
        }
        auto &scales = blocks_[b].scales;
        scales = {load_lanes<T>([&](int i) -> const Point & { return inverse[i]; }), target_.size_weight};
        return sum(hexmend::square(scales.inverse), b);
    }

    // True if not all corners are at the node.
    bool has_extent() const {
        double edges = 0;
        for (int b = 0; b < blocks(); ++b)
            if (lengths_of(blocks_[b], b, edges) > 0) return true;
        return false;
    }

    // The node's own tetrahedron: S = [u - y, v - y, w - y].
    static void add_own_tetrahedron(Block &block, const V3<T> &u, const V3<T> &v, const V3<T> &w) {
        auto &t = block.incident[0];
        M3<T> edges{u, v, w};
        if constexpr (scaled) {
            auto by = block.scales.template columns<Hexahedron, 0>();
            M3<T> s = scale(edges, by), of_node = scale(s, by), cof = scale(cofactors(s), by);
            t.sigma = scale(determinant(edges), by);
            t.g = -(cof.u + cof.v + cof.w);
            t.square = square(s);
            t.b = broadcast<T>(-2.0) * (of_node.u + of_node.v + of_node.w);
            t.squared_scales = by.u * by.u + by.v * by.v + by.w * by.w;
        } else {
            t.squared_scales = broadcast<T>(3.0);
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
            t.squared_scales = broadcast<T>(1.0);
            t.g = cross(u, v);
            t.sigma = -dot(a, t.g);
            t.square = square(a) + square(u) + square(v);
            t.b = broadcast<T>(-2.0) * a;
        }
    }

    // eta of corner tetrahedron t, one without the node.
    template <bool soft, int t> static T constant_eta(const Block &block, double delta) {
        return hexmend::eta<soft>(block.x.template edges<t>(), block.scales.template columns<Hexahedron, t>(), delta,
                                  std::true_type{});
    }

    // The corner of the star in lane i of block b; the last one beyond.
    std::int32_t corner_in(Star star, int b, int i) const {
        int s = b * width<T> + i;
        return star[s < size_ ? s : size_ - 1];
    }

    // Sum of the lengths of the edges of block b; adds their number to `edges`.
    double lengths_of(const Block &block, int b, double &edges) const {
        int count = std::min(width<T>, size_ - b * width<T>);
        if (!block.mixed) [[likely]] {
            edges += 12 * count;
            return sum(edge_lengths(block.x), b);
        }
        double total = 0;
        for (int i = 0; i < count; ++i) {
            edges += block.table[i]->edges;
            for (int e = 0; e < block.table[i]->edges; ++e) {
                auto [from, to] = block.table[i]->edge_ends[e];
                total += length(in_lane(block.x.at[to], i) - in_lane(block.x.at[from], i));
            }
        }
        return total;
    }

    static V3<double> in_lane(const V3<T> &v, int i) { return {lane(v.x, i), lane(v.y, i), lane(v.z, i)}; }
    static void set_in_lane(V3<T> &to, int i, const V3<double> &v) {
        set_lane(to.x, i, v.x), set_lane(to.y, i, v.y), set_lane(to.z, i, v.z);
    }

    // Inverse target lengths of the cell in lane i along the columns of S W^-1 at corner t; of a hex, by its
    // directions.
    static std::array<double, 3> lengths_in_lane(const Block &block, int i, int t) {
        if constexpr (!scaled) return {1, 1, 1};
        else {
            V3<double> v = in_lane(block.scales.inverse, i);
            const double own[3] = {v.x, v.y, v.z};
            if (block.table[i]->corners < 8) return {v.x, v.y, v.z};
            auto &d = COLUMN_DIRECTIONS[t];
            return {own[d[0]], own[d[1]], own[d[2]]};
        }
    }

    // The table of a cell of any kind, that in lane i. What is missing of four tetrahedra is perfect and does not
    // change.
    template <bool soft> static void tabulate_lane(Block &block, int i, double delta) {
        const TetrahedraAtNode &at = *block.at[i];
        const CellTable &table = *block.table[i];
        double constant = 0;
        int j = 0;
        for (int t = 0; t < table.corners; ++t) {
            const auto by = lengths_in_lane(block, i, t);
            if (at.others >> t & 1) {
                auto &n = table.corner_tetrahedra[t];
                V3<double> apex = in_lane(block.x.at[n[0]], i), edges[3];
                for (int k = 0; k < 3; ++k) edges[k] = in_lane(block.x.at[n[k + 1]], i) - apex;
                constant += eta_of<soft>(block, combined(edges, table.inverse, by), delta);
                continue;
            }
            V3<double> ends[3];
            for (int k = 0; k < 3; ++k) ends[k] = in_lane(block.x.at[at.ends[j][k]], i);
            auto s = combined(ends, at.shape[j], by), cof = cofactors(s);
            // Column k of S moves by -sums[k] times the node.
            double sums[3] = {};
            for (int k = 0; k < 3; ++k)
                for (int l = 0; l < 3; ++l) sums[k] += at.shape[j][l][k] * by[k];
            put(block.incident[j++], i, determinant(s), square(s),
                -(sums[0] * cof.u + sums[1] * cof.v + sums[2] * cof.w),
                -2.0 * (sums[0] * s.u + sums[1] * s.v + sums[2] * s.w),
                sums[0] * sums[0] + sums[1] * sums[1] + sums[2] * sums[2]);
        }
        for (; j < 4; ++j) {
            put(block.incident[j], i, 1, 3, {}, {}, 0);
            constant -= perfect_eta<soft>(block, delta);
        }
        set_lane(block.constant, i, constant);
        set_lane(block.share, i, 1.0 / table.corners);
    }

    // Columns of E A D: edges, a matrix, factors of its columns.
    static M3<double> combined(const V3<double> (&edges)[3], const double (&a)[3][3], const std::array<double, 3> &by) {
        auto column = [&](int k) { return by[k] * (a[0][k] * edges[0] + a[1][k] * edges[1] + a[2][k] * edges[2]); };
        return {column(0), column(1), column(2)};
    }

    static void put(TetTerms &t, int i, double sigma, double square, const V3<double> &g, const V3<double> &b,
                    double k) {
        set_lane(t.sigma, i, sigma), set_lane(t.square, i, square), set_lane(t.squared_scales, i, k);
        set_in_lane(t.g, i, g), set_in_lane(t.b, i, b);
    }

    template <bool soft> static double eta_of(const Block &block, const M3<double> &s, double delta) {
        double sigma = determinant(s), value = energy_of<soft>(s, sigma, delta, std::true_type{}).eta();
        if constexpr (scaled) value += size_term<soft>(sigma, delta, block.scales.size_weight).value;
        return value;
    }
    template <bool soft> static double perfect_eta(const Block &block, double delta) {
        return eta_of<soft>(block, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, delta);
    }
};

}  // namespace hexmend
