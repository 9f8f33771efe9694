#include "smoothers/patches/patch_sweep.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "mesh/csr.hpp"
#include "smoothers/line_search.hpp"
#include "smoothers/patches/newton_system.hpp"

namespace hexmend {
namespace {

// How often a Hessian's eigenvalues are raised, to what share of its largest entry first, and by what factor then.
constexpr int MAX_SHIFTS = 10;
constexpr double INITIAL_SHIFT = 0.001, SHIFT_FACTOR = 4;

// How often a sweep has asked hexes for their energy alone, and for its derivatives.
struct EvaluationCount {
    std::int64_t energies = 0, derivatives = 0;
};

// A patch while it is visited: its hexes in blocks, and what is known of their energy.
class MultiNodePatch {
  public:
    MultiNodePatch(std::span<Point> points, Hexes hexes, Hexes slots, Indices nodes, const PatchStep &how)
        : points_(points), hexes_(hexes), slots_(slots), nodes_(nodes), how_(how), x_(blocks()), step_(nodes.size()) {}

    template <bool soft> EvaluationCount visit() {
        EvaluationCount evaluations;
        double scale = load();
        NewtonSystem system(slots_, nodes_.size());
        double value = evaluate<soft>(system);
        evaluations.derivatives += hexes_.size();
        double noise = std::numeric_limits<double>::epsilon();
        if (scale == 0 || value <= hexes_.size() * noise * noise || !(value < INF)) return evaluations;
        choose_direction(system, value);
        double slope = std::inner_product(step().begin(), step().end(), system.gradient.begin(), 0.0);
        double alpha = slope < 0 ? line_search<soft>(value, slope, evaluations) : 0.0;
        if (alpha > 0)
            for (std::size_t k = 0; k < nodes_.size(); ++k)
                for (int j = 0; j < 3; ++j) points_[nodes_[k]][j] += alpha * step_[k][j] / scale;
        return evaluations;
    }

  private:
    std::span<Point> points_;
    Hexes hexes_, slots_;
    Indices nodes_;
    const PatchStep &how_;
    std::vector<Corners<Lanes>> x_;
    std::vector<Point> step_;

    std::int64_t blocks() const { return (static_cast<std::int64_t>(hexes_.size()) + LANES - 1) / LANES; }
    int count(std::int64_t b) const { return std::min<std::int64_t>(LANES, hexes_.size() - b * LANES); }
    std::span<double> step() { return {step_.data()->data(), 3 * step_.size()}; }

    // Take the hexes in lengths so that their mean edge is 1 (each edge counted once a hex), as seen from the first
    // node. Returns by what lengths were multiplied; 0 if the patch has no extent.
    double load() {
        const Point &o = points_[nodes_[0]];
        V3<Lanes> origin{broadcast<Lanes>(o[0]), broadcast<Lanes>(o[1]), broadcast<Lanes>(o[2])};
        double total = 0;
        for (std::int64_t b = 0; b < blocks(); ++b) {
            x_[b] = gather_corners<Lanes>(points_, hexes_, b * LANES, count(b));
            Lanes lengths{};
            for (auto &corner : x_[b].at) corner = corner - origin;
            for (auto &[from, to] : EDGES) lengths += length(x_[b].at[to] - x_[b].at[from]);
            for (int i = 0; i < count(b); ++i) total += lengths[i];
        }
        double factor = total > 0 ? 12 * static_cast<double>(hexes_.size()) / total : 0.0;
        for (auto &x : x_)
            for (auto &corner : x.at) corner = broadcast<Lanes>(factor) * corner;
        return factor;
    }

    double sum_of_powers(Lanes sum_of_eta, int count) const {
        Lanes energy = hex_energy(sum_of_eta, how_.power.offset);
        double total = 0;
        for (int i = 0; i < count; ++i)
            total += how_.power.p == 2 ? energy[i] * energy[i] : std::pow(energy[i], how_.power.p);
        return total;
    }

    // Sum of eta(H)^p where the nodes are; gradient and Hessian go to `system`.
    template <bool soft> double evaluate(NewtonSystem &system) const {
        double value = 0;
        auto sums = std::make_unique<HessianSums>();
        auto rows = std::make_unique<double[][HEX_STRIDE]>(LANES);
        for (std::int64_t b = 0; b < blocks(); ++b) {
            *sums = HessianSums{};
            unroll<8>([&](auto t) { add_tetrahedron<soft, t>(x_[b], how_.delta, ~Bits{}, *sums); });
            value += sum_of_powers(sums->eta, count(b));
            Lanes first = LanePowerDerivatives<Lanes>(sums->eta * 0.125 - how_.power.offset, how_.power.p).first;
            weigh_hessian<double>(*sums, how_.power, rows.get());
            for (auto &g : sums->g.at) g = first * g;
            for (int i = 0; i < count(b); ++i) system.add(b * LANES + i, sums->g, i, rows[i]);
        }
        return value;
    }

    // Algorithm A.3, with the eigenvalues raised where the Hessian is indefinite: a direction of descent.
    void choose_direction(NewtonSystem &system, double value) {
        double shift = 0, largest = system.largest();
        for (int raise = 0; raise <= MAX_SHIFTS && largest < INF; ++raise) {
            if (system.solve(shift, step())) return;
            shift = raise == 0 ? INITIAL_SHIFT * largest : SHIFT_FACTOR * shift;
        }
        double factor = -std::pow(value, 1 / how_.power.p - 1) / how_.power.p;  // A.2, (C.2)
        std::transform(system.gradient.begin(), system.gradient.end(), step().begin(),
                       [&](double g) { return factor * g; });
    }

    // Sum of eta(H)^p with the nodes displaced by alpha times the step.
    template <bool soft> double value_along(double alpha) const {
        double total = 0;
        for (std::int64_t b = 0; b < blocks(); ++b) {
            auto x = gather_corners_or_zero<Lanes>(step_, slots_, b * LANES, count(b));
            for (int c = 0; c < 8; ++c) x.at[c] = x_[b].at[c] + broadcast<Lanes>(alpha) * x.at[c];
            Lanes eta{};
            unroll<8>([&](auto t) { eta += energy<soft>(x.template edges<t>(), how_.delta, std::true_type{}).eta(); });
            total += sum_of_powers(eta, count(b));
        }
        return total;
    }

    // Algorithm A.5; 0 where no step descends enough.
    template <bool soft> double line_search(double value, double slope, EvaluationCount &evaluations) const {
        double alpha = how_.first;
        for (int cut = 0; cut <= how_.cuts && !lost_in_rounding(alpha, slope, value); ++cut, alpha *= how_.shrink) {
            evaluations.energies += hexes_.size();
            if (value_along<soft>(alpha) < value + how_.c1 * alpha * slope) return alpha;
        }
        return 0;
    }
};

}  // namespace

std::tuple<OwnedArray<std::int32_t>, OwnedArray<std::int32_t>, OwnedArray<std::int32_t>, OwnedArray<std::int32_t>,
           OwnedArray<std::int32_t, 8>>
grow(Hexes hexes, Indices start, Indices corners, std::span<const bool> free, std::int64_t size, int overlap) {
    const std::int64_t n = free.size();
    std::vector<std::int32_t> node_start(1), nodes, hex_start(1), chosen;
    std::vector<std::int32_t> slots;
    std::vector<std::uint8_t> taken(n);
    std::vector<std::int32_t> slot(n, -1), used(hexes.size(), -1);
    std::vector<Node> patch;

    // body(j) for the free nodes that share a hex with node i.
    auto for_each_neighbour = [&](Node i, auto body) {
        for (auto s = start[i]; s < start[i + 1]; ++s)
            for (Node j : hexes[corners[s] / 8])
                if (free[j]) body(j);
    };
    auto include = [&](Node i) {
        if (slot[i] >= 0) return;
        slot[i] = 0;
        patch.push_back(i);
    };
    for (Node seed = 0; seed < n; ++seed) {
        if (!free[seed] || taken[seed]) continue;
        patch.clear();
        auto take = [&](Node i) {
            if (taken[i] || static_cast<std::int64_t>(patch.size()) == size) return;
            taken[i] = true;
            include(i);
        };
        take(seed);
        for (std::size_t at = 0; at < patch.size(); ++at) for_each_neighbour(patch[at], take);
        for (std::size_t ring = 0, begin = 0; ring < static_cast<std::size_t>(overlap); ++ring) {
            const std::size_t end = patch.size();
            for (; begin < end; ++begin) for_each_neighbour(Node{patch[begin]}, include);
        }
        std::sort(patch.begin(), patch.end());
        for (std::size_t k = 0; k < patch.size(); ++k) slot[patch[k]] = k;
        for (Node i : patch)
            for (auto s = start[i]; s < start[i + 1]; ++s) {
                const auto h = corners[s] / 8;
                if (used[h] == seed) continue;
                used[h] = seed;
                chosen.push_back(h);
                for (Node j : hexes[h]) slots.push_back(slot[j]);
            }
        for (Node i : patch) slot[i] = -1;
        nodes.insert(nodes.end(), patch.begin(), patch.end());
        node_start.push_back(nodes.size());
        hex_start.push_back(chosen.size());
    }
    return {
        {std::move(node_start)}, {std::move(nodes)}, {std::move(hex_start)}, {std::move(chosen)}, {std::move(slots)}};
}

CSR colours(Indices hex_start, Indices chosen, std::int64_t hexes) {
    const std::int64_t patches = hex_start.size() - 1;
    std::vector<std::int32_t> colour(patches, -1);
    std::vector<std::uint64_t> taken;  // of each hex, the colours of its patches: 64 of them at a time
    std::int32_t count = 0;
    bool more = true;
    for (int first = 0; more; first += 64) {
        more = false;
        taken.assign(hexes, 0);
        for (std::int64_t k = 0; k < patches; ++k) {
            if (colour[k] >= 0) continue;
            auto there = chosen.subspan(hex_start[k], hex_start[k + 1] - hex_start[k]);
            std::uint64_t seen = 0;
            for (auto h : there) seen |= taken[h];
            const int free = std::countr_one(seen);
            if (free == 64) {
                more = true;
                continue;
            }
            colour[k] = first + free;
            count = std::max(count, colour[k] + 1);
            for (auto h : there) taken[h] |= std::uint64_t{1} << free;
        }
    }
    return grouped(colour, count);
}

std::pair<std::int64_t, std::int64_t> sweep(std::span<Point> points, Hexes hexes, Hexes slots, Indices hex_start,
                                            Indices node_start, Indices nodes, Indices groups, Indices patches,
                                            double delta, ObjectiveNorm power, double first, double shrink, double c1,
                                            int cuts) {
    expect(hexes.size() == slots.size(), "slots: one row for each of the hexes is expected");
    const PatchStep how{delta, power, first, shrink, c1, cuts};
    std::vector<EvaluationCount> evaluations(patches.size());
    for (std::size_t g = 0; g + 1 < groups.size(); ++g)
        parallel(groups[g + 1] - groups[g], [&](std::int64_t i) {
            const auto at = groups[g] + i;
            const auto k = patches[at];
            const auto h = hex_start[k], count = hex_start[k + 1] - h;
            MultiNodePatch patch(points, hexes.subspan(h, count), slots.subspan(h, count),
                                 nodes.subspan(node_start[k], node_start[k + 1] - node_start[k]), how);
            evaluations[at] = delta != 0 ? patch.visit<true>() : patch.visit<false>();
        });
    EvaluationCount total;
    for (auto &one : evaluations) total.energies += one.energies, total.derivatives += one.derivatives;
    return {total.energies, total.derivatives};
}

}  // namespace hexmend
