#include "linear/conjugate_gradients.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <tuple>

#include "linear/block_matrix.hpp"
#include "linear/coarse_space.hpp"

namespace hexmend {
namespace {

constexpr std::int64_t NODES_PER_CHUNK = 4096;

// D, a diagonal block with its smallest eigenvalue raised as in Algorithm A.4, and D^-1.
inline std::pair<SymmetricMatrix, SymmetricMatrix> make_positive_definite(SymmetricMatrix a) {
    {
        // Most blocks need no eigenvalues: if all are positive, none is below det/t^2, t being the trace.
        auto [adjugate, det] = adjugate_of(a);
        double t = a.xx + a.yy + a.zz;
        if (a.xx > 0 && adjugate.zz > 0 && det >= 0.001 * t * t * t && std::isfinite(t))
            return {a, (1 / det) * adjugate};
    }
    auto [smallest, largest] = extreme_eigenvalues(a);
    double size = std::max(std::abs(smallest), std::abs(largest));
    if (size == 0) size = 1;
    // Triangular solves diverge where D is too small relative to the off-diagonal blocks.
    a.add_to_diagonal(smallest < 0 ? 0.5 * size - smallest : std::max(0.001 * size - smallest, 0.0));
    auto [adjugate, det] = adjugate_of(a);
    if (det > 0) return {a, (1 / det) * adjugate};
    double one = 1 / size;  // numerically of rank 1 or 2: use its scale
    return {{size, 0, 0, size, 0, size}, {one, 0, 0, one, 0, one}};
}

template <class V> inline double dot(const V &a, const V &b) {
    auto product = a * b;
    return static_cast<double>(product[0] + product[1] + product[2]);
}

// State of the iteration, in the caller's workspace.
template <class Block> class PreconditionedCG {
  public:
    using Real = NumberOf<Block>;
    using V = Vec4<Real>;

    PreconditionedCG(const BlockPattern &pattern, BlockMatrix<Block> &system, DiagonalBlocks<Real> diagonal,
                     double damping, std::span<Real> work, const Coupling<Real> &coupling)
        : system_(system),
          own_(diagonal),
          damped_(static_cast<Real>(1 + damping)),
          share_(static_cast<Real>((2 + damping) / (1 + damping))),
          coupling_(coupling) {
        void *free = work.data();
        std::size_t left = work.size_bytes();
        free = std::align(alignof(V), left - alignof(V), free, left);
        auto take = [&](auto &array, std::int64_t size) {
            using T = std::remove_reference_t<decltype(*array)>;
            array = static_cast<T *>(free);
            free = array + size;
        };
        const auto size = system.size(), separators = size - pattern.first_separator();
        for (auto *vector : {&residual_, &v_, &w_}) take(*vector, size);
        take(odd_, separators), take(t_, size + coupling.ghosts);
        std::fill(odd_, odd_ + separators, V{}), std::fill(t_ + size, t_ + size + coupling.ghosts, V{});
        if (coupling.exchange) take(from_ghosts_, size);
        take(inverse_, size), take(increased_, size);
        sum_over_slots([&](std::int32_t i) {
            v_[i] = w_[i] = V{};
            if (from_ghosts_) from_ghosts_[i] = V{};
            const auto own = widened(diagonal[i]);
            auto [d, inverse] = make_positive_definite(own);
            increased_[i] = std::memcmp(&d, &own, sizeof d) ? 0 : AS_GIVEN;
            inverse_[i] = narrowed<Real>((1 / (1 + damping)) * inverse);
            return 0.0;
        });
        for (std::int64_t i = 0; i < size; ++i)
            if (increased_[i] != AS_GIVEN) {
                increased_[i] = static_cast<std::int32_t>(increased_blocks_.size());
                auto d = make_positive_definite(widened(diagonal[i])).first;
                increased_blocks_.push_back(half_block<Real>((1 + damping) * d));
            }
    }

    // Compute the first residual, (D + L)^-1 right; returns its square.
    double start(Vectors<Real> right) {
        return system_.forward(w_, odd_, [&](std::int32_t i, const V &below) {
            residual_[i] = inverse(i) * (load(right[i].data()) - below);
            return std::pair{residual_[i], square_of_residual(i)};
        });
    }

    // The damped diagonal block of slot i.
    std::array<Real, 9> damped_diagonal(std::int32_t i) const {
        const auto a = HalfBlock<Real>::of(own_[i]), d = positive(i);
        const Real share = 2 - share_;  // of the damped D in the damped diagonal, d / (1 + d)
        V x = a.first + share * d.first, y = a.second + share * d.second;
        return {x[0], x[1], x[2], x[1], y[0], y[1], x[2], y[1], y[2]};
    }

    // Deflate by a coarse space from here on.
    void deflate(CoarseSpace<Real> &coarse) { coarse_ = &coarse; }

    // Project the first residual by the coarse space: (D + L)^-1 (right - A R E^-1 R' right); returns its square.
    double project(Vectors<Real> right) {
        over_slots([&](std::int32_t i, int range) { coarse_->restrict_to(range, i, load(right[i].data())); });
        coarse_->solve(), coarse_->keep();
        return system_.forward(w_, odd_, [&](std::int32_t i, const V &below) {
            residual_[i] = inverse(i) * (load(right[i].data()) - coarse_->row(i) - below);
            return std::pair{residual_[i], square_of_residual(i)};
        });
    }

    // Complete x, (I - R E^-1 (A R)') x and, with `projected`, what `project` found, R E^-1 R' right.
    void complete(bool projected, std::span<std::array<Real, 4>> x) {
        over_slots([&](std::int32_t i, int range) { coarse_->add(range, i, -load(x[i].data())); });
        coarse_->solve();
        if (projected) coarse_->add_kept();
        over_slots([&](std::int32_t i, int) {
            V there = load(x[i].data()) + coarse_->prolonged(i);
            std::memcpy(x[i].data(), &there, sizeof there);
        });
    }

    // Compute the next direction, v = D residual + beta v, and solve (D + U) t = v.
    void next_direction(Real beta) {
        auto back = [&](std::int32_t begin, std::int32_t end, int range) {
            for (auto i = end - 1; i >= begin; --i) {
                V v = positive(i) * residual_[i] + beta * v_[i];
                v_[i] = v;
                t_[i] = inverse(i) * (v - system_.row_times(i, t_));
                if (coarse_) coarse_->add(range, i, t_[i]);
            }
            return 0.0;
        };
        system_.over_separators(back);
        system_.over_parts(back);
        if (coarse_) coarse_->solve();
        if (coupling_.exchange) add_ghosts();
    }

    // Compute (D + L)^-1 A t = t + (D + L)^-1 (v + R t + rest t), or that of P A, in w; returns its product with v.
    double curvature() {
        return system_.forward(w_, odd_, [&](std::int32_t i, const V &below) {
            V right = from_ghosts_ ? v_[i] + from_ghosts_[i] : v_[i];
            if (coarse_) right -= coarse_->row(i);
            V p = inverse(i) * (right + rest(i) * t_[i] - below);
            w_[i] = p + t_[i];  // no later row adds to it
            return std::pair{p, dot(v_[i], w_[i])};
        });
    }

    // Advance x, 0 at first whatever it holds, and the residual by alpha; returns the square of the residual.
    double advance(Real alpha, bool first, std::span<std::array<Real, 4>> x) {
        return sum_over_slots([&](std::int32_t i) {
            V there = (first ? V{} : load(x[i].data())) + alpha * t_[i];
            std::memcpy(x[i].data(), &there, sizeof there);
            residual_[i] -= alpha * std::exchange(w_[i], V{});
            return square_of_residual(i);
        });
    }

    // Write x for a first direction of negative curvature: that direction or, where it overflowed, block Jacobi's.
    void fall_back(bool finite, Vectors<Real> right, std::span<std::array<Real, 4>> x) {
        sum_over_slots([&](std::int32_t i) {
            V there = finite ? t_[i] : inverse(i) * load(right[i].data());
            std::memcpy(x[i].data(), &there, sizeof there);
            return 0.0;
        });
    }

  private:
    BlockMatrix<Block> &system_;
    DiagonalBlocks<Real> own_;
    Real damped_, share_;
    std::array<Real, 6> *inverse_;  // D^-1, damped
    // Of each slot the number of its damped D among increased_blocks_, or AS_GIVEN where D is the diagonal block.
    static constexpr std::int32_t AS_GIVEN = -1;
    std::int32_t *increased_;
    std::vector<HalfBlock<Real>> increased_blocks_;
    V *residual_, *v_, *t_;
    const Coupling<Real> &coupling_;
    CoarseSpace<Real> *coarse_ = nullptr;
    V *from_ghosts_ = nullptr;  // R t, if processes are coupled
    V *w_, *odd_;               // contributions of rows to later rows, see `forward`; w: the product afterwards

    HalfBlock<Real> inverse(std::int32_t i) const { return HalfBlock<Real>::of(inverse_[i]); }

    // D of slot i, damped.
    HalfBlock<Real> positive(std::int32_t i) const {
        if (increased_[i] != AS_GIVEN) return increased_blocks_[increased_[i]];
        const auto a = HalfBlock<Real>::of(own_[i]);
        return {damped_ * a.first, damped_ * a.second};
    }

    // The damped diagonal less twice the damped D: with damping d and undamped D, A_D + d D - 2 (1 + d) D.
    HalfBlock<Real> rest(std::int32_t i) const {
        const auto a = HalfBlock<Real>::of(own_[i]), d = positive(i);
        return {a.first - share_ * d.first, a.second - share_ * d.second};
    }

    // Receive t of the ghosts, and compute R t; their t is 0 again afterwards, for the next back substitution.
    void add_ghosts() {
        coupling_.exchange(reinterpret_cast<std::array<Real, 4> *>(t_));
        sum_over_slots([&](std::int32_t i) {
            from_ghosts_[i] = system_.row_times_from(system_.first_ghost(i), i, t_);
            return 0.0;
        });
        std::fill(t_ + system_.size(), t_ + system_.size() + coupling_.ghosts, V{});
    }

    double square_of_residual(std::int32_t i) { return dot(residual_[i], positive(i) * residual_[i]); }

    // Call body(i, range) for each slot i.
    template <class Body> void over_slots(const Body &body) {
        auto over = [&](std::int32_t begin, std::int32_t end, int range) {
            for (auto i = begin; i < end; ++i) body(i, range);
            return 0.0;
        };
        system_.over_parts(over), system_.over_separators(over);
    }

    template <class Body> double sum_over_slots(const Body &body) {
        auto over = [&](std::int32_t begin, std::int32_t end, int) {
            double total = 0;
            for (auto i = begin; i < end; ++i) total += body(i);
            return total;
        };
        double total = system_.over_parts(over);
        return total + system_.over_separators(over);
    }
};

}  // namespace

template <class Block, class Real>
std::pair<int, SolveStatus> solve(const BlockPattern &pattern, UpperBlocks<Block> off_diagonal,
                                  DiagonalBlocks<Real> diagonal, double damping, Vectors<Real> right, double tolerance,
                                  int max_iterations, std::span<std::array<Real, 4>> x, std::span<Real> work,
                                  const Coupling<Real> &coupling, const CoarsePattern *coarse_pattern) {
    pattern.expect_blocks(off_diagonal.size(), diagonal.size());
    expect(have_rows(pattern.slots(), right, x), "rhs and x: a row a slot is expected");
    expect(coupling.ghosts >= 0, "ghosts: a negative number cannot be used");
    BlockMatrix<Block> system(pattern, off_diagonal);
    auto size = workspace_size(pattern, coupling.ghosts, static_cast<bool>(coupling.exchange));
    if (static_cast<std::int64_t>(work.size()) < size + (coarse_pattern ? coarse_workspace_size(*coarse_pattern) : 0))
        throw std::invalid_argument("work: it is too small; see `workspace_size`");
    PreconditionedCG<Block> solver(pattern, system, diagonal, damping, work, coupling);
    std::optional<CoarseSpace<Real>> coarse;
    if (coarse_pattern)
        coarse.emplace(
            *coarse_pattern, pattern, system, [&](std::int32_t i) { return solver.damped_diagonal(i); },
            work.data() + size);
    if (coarse && !coarse->positive()) coarse.reset();
    if (coarse) solver.deflate(*coarse);
    auto total = [&](double own) { return coupling.sum ? coupling.sum(own) : own; };
    double square = total(solver.start(right));
    const double goal = tolerance * tolerance * square;
    double beta = 0;
    auto end = [&](int count, SolveStatus status) {
        if (count == 0) std::fill(x.begin(), x.end(), std::array<Real, 4>{});
        if (coarse) solver.complete(true, x);
        return std::pair{count, status};
    };
    if (square == 0) {
        coarse.reset();
        return end(0, DONE);
    }
    if (coarse && (square = solver.project(right)) <= goal) return end(0, DONE);
    for (int count = 1; count <= max_iterations; ++count) {
        solver.next_direction(static_cast<Real>(beta));
        double curvature = total(solver.curvature());
        if (!(curvature > 0)) {
            if (count > 1) return end(count, NEGATIVE_CURVATURE);
            const bool finite = std::isfinite(curvature);
            solver.fall_back(finite, right, x);
            if (coarse && finite) solver.complete(false, x);
            return {count, NEGATIVE_CURVATURE};
        }
        double before = square;
        square = total(solver.advance(static_cast<Real>(square / curvature), count == 1, x));
        if (square <= goal) return end(count, DONE);
        beta = square / before;
    }
    return end(std::max(max_iterations, 0), TOO_MANY);
}

template <class Real>
void to_slots(Points of_nodes, Indices order, double scale, std::span<std::array<Real, 4>> of_slots) {
    expect(order.size() == of_nodes.size() && of_slots.size() == of_nodes.size(),
           "of_nodes, order and of_slots have different lengths: expected a row a node");
    parallel_for(order.size(), NODES_PER_CHUNK, [&](std::int64_t k) {
        auto number = [&](int i) { return static_cast<Real>(scale * of_nodes[k][i]); };
        of_slots[order[k]] = {number(0), number(1), number(2), 0};
    });
}

template <class Real> void from_slots(Vectors<Real> of_slots, Indices order, double scale, std::span<Point> of_nodes) {
    expect(order.size() == of_nodes.size() && of_slots.size() == of_nodes.size(),
           "of_nodes, order and of_slots have different lengths: expected a row a node");
    parallel_for(order.size(), NODES_PER_CHUNK, [&](std::int64_t k) {
        const auto &there = of_slots[order[k]];
        for (int i = 0; i < 3; ++i) of_nodes[k][i] = scale * static_cast<double>(there[i]);
    });
}

template <class Block>
void product(const BlockPattern &pattern, UpperBlocks<Block> off_diagonal, DiagonalBlocks<NumberOf<Block>> diagonal,
             Indices order, Points x, std::span<Point> y) {
    pattern.expect_blocks(off_diagonal.size(), diagonal.size());
    expect(have_rows(pattern.slots(), order, x, y), "order, x and y: a row a slot is expected");
    using V = Vec4<double>;
    BlockMatrix<Block, double> system(pattern, off_diagonal);
    std::vector<V> of(x.size()), there(x.size()), w(x.size()), odd(x.size() - pattern.first_separator());
    for (std::size_t k = 0; k < x.size(); ++k) of[order[k]] = V{x[k][0], x[k][1], x[k][2], 0};
    system.forward(w.data(), odd.data(), [&](std::int32_t i, const V &left) {
        there[i] = half_block<double>(widened(diagonal[i])) * of[i] + system.row_times(i, of.data()) + left;
        return std::pair{of[i], 0.0};
    });
    for (std::size_t k = 0; k < x.size(); ++k) std::memcpy(y[k].data(), &there[order[k]], sizeof y[k]);
}

#define FOR_BLOCK(Block, Real)                                                                                         \
    template std::pair<int, SolveStatus> solve(const BlockPattern &, UpperBlocks<Block>, DiagonalBlocks<Real>, double, \
                                               Vectors<Real>, double, int, std::span<std::array<Real, 4>>,             \
                                               std::span<Real>, const Coupling<Real> &, const CoarsePattern *);        \
    template void product<Block>(const BlockPattern &, UpperBlocks<Block>, DiagonalBlocks<Real>, Indices, Points,      \
                                 std::span<Point>);
#define FOR_REAL(Real)                                                               \
    template void to_slots(Points, Indices, double, std::span<std::array<Real, 4>>); \
    template void from_slots(Vectors<Real>, Indices, double, std::span<Point>);
using Singles = std::array<float, 9>;
using Doubles = std::array<double, 9>;
FOR_BLOCK(Singles, float)
FOR_BLOCK(Doubles, double)
FOR_BLOCK(PackedBlock, float)
FOR_REAL(float)
FOR_REAL(double)

}  // namespace hexmend
