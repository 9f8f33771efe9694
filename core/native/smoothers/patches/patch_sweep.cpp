#include "smoothers/patches/patches.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "smoothers/patches/newton_system.hpp"

namespace hexmend {
namespace {

// Shifts of the Hessian's eigenvalues that are tried: how many, the first as a share of the largest diagonal entry, and
// the factor from one to the next.
constexpr int MAX_SHIFTS = 10;
constexpr double INITIAL_SHIFT = 0.001, SHIFT_FACTOR = 4;

// Evaluations of a hex's energy in line searches, and of its energy with derivatives.
struct EvaluationCount {
    std::int64_t energies = 0, derivatives = 0;
};

// A patch during its step. The coordinates x_ of its hexes are relative to the patch's first node and scaled so that
// the mean edge, each edge counted once a hex, has length 1; with a target, so that the root mean square of the inverse
// target lengths, of which row `first` on are those of the patch, is 1.
template <class Target> class MultiNodePatch {
  public:
    MultiNodePatch(std::span<Point> points, Hexes hexes, Hexes slots, Indices nodes, const NodeStepSettings &settings,
                   const Target &target, std::int64_t first)
        : points_(points), hexes_(hexes), slots_(slots), nodes_(nodes), settings_(settings), step_(nodes.size()) {
        for (std::int64_t row = 0, end = hexes.size(); row < end; row = start_.back()) {
            int count =
                alike(std::min<std::int64_t>(LANES, end - row), [&](int i) -> const Hex & { return hexes[row + i]; });
            scales_.push_back(scales_of<Lanes>(target, first + row, count));
            start_.push_back(row + count);
        }
        x_.resize(blocks());
    }

    // Take a Newton step with line search: moves the nodes.
    template <bool soft> EvaluationCount take_step() {
        EvaluationCount count;
        double scale = load();
        NewtonSystem system(slots_, nodes_.size());
        double value = evaluate<soft>(system);
        count.derivatives += hexes_.size();
        double noise = std::numeric_limits<double>::epsilon();  // of eta(H); gradient and Hessian of a cube are noise
        if (scale == 0 || value <= hexes_.size() * noise * noise || !(value < INF)) return count;
        choose_step(system, value);
        double slope = std::inner_product(step().begin(), step().end(), system.gradient.begin(), 0.0);
        if (!(slope < 0)) return count;
        double alpha = settings_.search(value, slope, [&](double alpha, double) {
            count.energies += hexes_.size();
            return value_along<soft>(alpha);
        });
        if (alpha > 0)
            for (std::size_t k = 0; k < nodes_.size(); ++k)
                for (int j = 0; j < 3; ++j) points_[nodes_[k]][j] += alpha * step_[k][j] / scale;
        return count;
    }

  private:
    std::span<Point> points_;
    Hexes hexes_, slots_;
    Indices nodes_;
    const NodeStepSettings &settings_;
    std::vector<Corners<Lanes>> x_;
    std::vector<ScalesOf<Lanes, Target>> scales_;
    std::vector<Point> step_;
    std::vector<std::int64_t> start_{0};  // first cell of each block, and the number of cells

    std::int64_t blocks() const { return start_.size() - 1; }
    int count(std::int64_t b) const { return start_[b + 1] - start_[b]; }
    std::span<double> step() { return {step_.data()->data(), 3 * step_.size()}; }

    // Write x_; returns the factor by which lengths were multiplied, 0 if the patch has no extent.
    double load() {
        const Point &o = points_[nodes_[0]];
        V3<Lanes> origin{broadcast<Lanes>(o[0]), broadcast<Lanes>(o[1]), broadcast<Lanes>(o[2])};
        double total = 0, edges = 0;
        for (std::int64_t b = 0; b < blocks(); ++b) {
            x_[b] = gather_corners<Lanes>(points_, hexes_, start_[b], count(b));
            for (auto &corner : x_[b].at) corner = corner - origin;
            with_kind(hexes_[start_[b]], [&](auto cell) {
                Lanes lengths = edge_lengths<decltype(cell)>(x_[b]);
                for (int i = 0; i < count(b); ++i) total += lengths[i];
                edges += decltype(cell)::table.edges * count(b);
            });
        }
        double factor = total > 0 ? edges / total : 0.0;
        if constexpr (!std::is_same_v<Target, Cubes>) {
            if (factor > 0) factor = root_mean_square_of_scales();
            for (auto &scales : scales_) scales.inverse = broadcast<Lanes>(1 / factor) * scales.inverse;
        }
        for (auto &x : x_)
            for (auto &corner : x.at) corner = broadcast<Lanes>(factor) * corner;
        return factor;
    }

    double root_mean_square_of_scales() const {
        double total = 0;
        for (std::int64_t b = 0; b < blocks(); ++b) {
            Lanes squares = square(scales_[b].inverse);
            for (int i = 0; i < count(b); ++i) total += squares[i];
        }
        return std::sqrt(total / (3 * static_cast<double>(hexes_.size())));
    }

    double sum_of_powers(Lanes sum_of_eta, double share, int count) const {
        Lanes energy = cell_energy(sum_of_eta, share, settings_.norm.offset);
        double p = settings_.norm.p, total = 0;
        for (int i = 0; i < count; ++i) total += p == 2 ? energy[i] * energy[i] : std::pow(energy[i], p);
        return total;
    }

    // Return the sum of eta(H)^p; adds its gradient and Hessian to `system`.
    template <bool soft> double evaluate(NewtonSystem &system) const {
        double value = 0;
        auto sums = std::make_unique<HessianSums>();
        auto rows = std::make_unique<double[][HEX_STRIDE]>(LANES);
        for (std::int64_t b = 0; b < blocks(); ++b) {
            *sums = HessianSums{};
            with_kind(hexes_[start_[b]], [&](auto cell) {
                using Cell = decltype(cell);
                unroll<Cell::corners>([&](auto t) {
                    add_tetrahedron<Cell, soft, t>(x_[b], scales_[b], settings_.delta, ~Bits{}, *sums);
                });
                value += sum_of_powers(sums->eta, Cell::share, count(b));
                auto by = power_derivatives_of<Cell>(sums->eta, settings_.norm.offset, settings_.norm.p);
                weigh_hessian<Cell, double>(*sums, settings_.norm, rows.get());
                for (auto &g : sums->g.at) g = by.first * g;
            });
            for (int i = 0; i < count(b); ++i) system.add(start_[b] + i, sums->g, i, rows[i]);
        }
        return value;
    }

    // Write step_: Newton's direction, Algorithm A.3, with the eigenvalues shifted while the Hessian is indefinite;
    // steepest descent, Algorithm A.2, where no shift helps.
    void choose_step(NewtonSystem &system, double value) {
        double shift = 0, largest = system.largest();
        for (int trial = 0; trial <= MAX_SHIFTS && largest < INF; ++trial) {
            if (system.solve(shift, step())) return;
            shift = trial == 0 ? INITIAL_SHIFT * largest : SHIFT_FACTOR * shift;
        }
        double factor = -std::pow(value, 1 / settings_.norm.p - 1) / settings_.norm.p;  // (C.2)
        std::transform(system.gradient.begin(), system.gradient.end(), step().begin(),
                       [&](double g) { return factor * g; });
    }

    // Sum of eta(H)^p with the nodes displaced by alpha times the step.
    template <bool soft> double value_along(double alpha) const {
        double total = 0;
        for (std::int64_t b = 0; b < blocks(); ++b) {
            auto x = gather_corners_or_zero<Lanes>(step_, slots_, start_[b], count(b));
            for (int c = 0; c < 8; ++c) x.at[c] = x_[b].at[c] + broadcast<Lanes>(alpha) * x.at[c];
            with_kind(hexes_[start_[b]], [&](auto cell) {
                using Cell = decltype(cell);
                Lanes eta{};
                unroll<Cell::corners>([&](auto t) {
                    eta += hexmend::eta<soft>(x.template shape<Cell, t>(), scales_[b].template columns<Cell, t>(),
                                              settings_.delta, std::true_type{});
                });
                total += sum_of_powers(eta, Cell::share, count(b));
            });
        }
        return total;
    }
};

}  // namespace

std::pair<std::int64_t, std::int64_t> patch_sweep(std::span<Point> points, const PatchPartition &partition,
                                                  Indices groups, Indices patches, const NodeStepSettings &settings) {
    expect(are_csr(groups, patches.size()), "groups: its last number is expected to be the length of patches");
    const Indices hex_start = partition.hex_start;
    expect_rows(settings.target, partition.hexes.size());
    std::vector<EvaluationCount> counts(patches.size());
    with_cases(settings.target, settings.delta, [&](auto soft, const auto &target) {
        for (std::size_t g = 0; g + 1 < groups.size(); ++g)
            parallel(groups[g + 1] - groups[g], [&](std::int64_t i) {
                const auto at = groups[g] + i;
                const auto k = patches[at];
                const auto h = hex_start[k], count = hex_start[k + 1] - h, from = partition.node_start[k];
                MultiNodePatch patch(points, partition.hexes.subspan(h, count), partition.slots.subspan(h, count),
                                     partition.nodes.subspan(from, partition.node_start[k + 1] - from), settings,
                                     target, h);
                counts[at] = patch.template take_step<soft>();
            });
    });
    EvaluationCount total;
    for (auto &one : counts) total.energies += one.energies, total.derivatives += one.derivatives;
    return {total.energies, total.derivatives};
}

}  // namespace hexmend
