// Newton's system of a patch with several free nodes: H s = -g.
//
// Up to MAX_DIRECT_UNKNOWNS it is solved by an envelope Cholesky decomposition, larger ones by matrix-free conjugate
// gradients. In a header, because a sweep takes a tenth longer if it is a translation unit of its own.
#pragma once

#include <memory>

#include "energy/hex_hessian.hpp"
#include "linear/symmetric.hpp"

namespace hexmend {

// Largest number of unknowns for the decomposition; residual of conjugate gradients relative to the gradient; and the
// smallest pivot or curvature, relative to the largest entry, that counts as positive.
constexpr int MAX_DIRECT_UNKNOWNS = 600;
constexpr double CG_TOLERANCE = 0.03, MIN_PIVOT = 1e-12;

// The system of a patch: slots (k, 8) are the numbers of the corners of its hexes among its nodes, -1 if fixed.
class NewtonSystem {
  public:
    std::vector<double> gradient;

    NewtonSystem(Hexes slots, std::int64_t nodes)
        : gradient(3 * nodes), slots_(slots), values_(slots.size()), diagonal_(nodes) {}

    // Add lane i of the gradient, and the values of the Hessian (see `weigh_hessian`), of hex h.
    void add(std::int64_t h, const Corners<Lanes> &g, int i, const double (&values)[HEX_STRIDE]) {
        std::copy(values, values + HEX_STRIDE, values_[h].begin());
        for (int a = 0; a < 8; ++a) {
            const auto slot = slots_[h][a];
            if (slot < 0) continue;
            gradient[3 * slot] += g.at[a].x[i];
            gradient[3 * slot + 1] += g.at[a].y[i];
            gradient[3 * slot + 2] += g.at[a].z[i];
            const double *own = values + DIAGONAL_OFFSET + 6 * a;
            auto &d = diagonal_[slot];
            d.xx += own[0], d.xy += own[1], d.xz += own[2], d.yy += own[3], d.yz += own[4], d.zz += own[5];
        }
    }

    // Largest absolute diagonal entry; INF if one is not finite.
    double largest() const {
        double most = 0;
        for (auto &d : diagonal_)
            for (double entry : {d.xx, d.yy, d.zz}) {
                if (!(std::abs(entry) < INF)) return INF;
                most = std::max(most, std::abs(entry));
            }
        return most;
    }

    // Solve (H + shift I) s = -g; false where that matrix is not positive definite.
    bool solve(double shift, std::span<double> s) {
        return unknowns() <= MAX_DIRECT_UNKNOWNS ? solve_by_cholesky(shift, s) : solve_by_conjugate_gradients(shift, s);
    }

  private:
    Hexes slots_;
    std::vector<std::array<double, HEX_STRIDE>> values_;
    std::vector<SymmetricMatrix> diagonal_;
    std::vector<double> lower_;
    std::vector<std::int32_t> first_;

    std::int64_t unknowns() const { return gradient.size(); }

    static double product(const double *a, const double *b, std::int64_t count) {
        Lanes sum{};
        std::int64_t k = 0;
        for (; k + LANES <= count; k += LANES) {
            Lanes x, y;
            std::memcpy(&x, a + k, sizeof x);
            std::memcpy(&y, b + k, sizeof y);
            sum += x * y;
        }
        double total = sum_of_lanes(sum);
        for (; k < count; ++k) total += a[k] * b[k];
        return total;
    }

    // body(block, i, j) for each pair of corners of a hex in the slots i and j; the block's rows are those of i.
    template <class Body> void for_each_pair(std::int64_t h, const Body &body) const {
        const double *block = values_[h].data();
        for (int a = 0; a < 8; ++a)
            for (int b = a + 1; b < 8; ++b, block += 9) {
                const auto i = slots_[h][a], j = slots_[h][b];
                if (i >= 0 && j >= 0) body(block, i, j);
            }
    }

    // Write the lower half of H + shift I, row by row, and where the envelope of each row begins.
    void assemble(double shift) {
        const auto n = unknowns();
        lower_.assign(n * n, 0.0);
        first_.resize(n);
        for (std::int64_t r = 0; r < n; ++r) first_[r] = r - r % 3;
        auto at = [&](std::int64_t row, std::int64_t column) -> double & { return lower_[row * n + column]; };
        for (std::size_t h = 0; h < slots_.size(); ++h)
            for_each_pair(h, [&](const double *block, std::int32_t i, std::int32_t j) {
                for (int r = 0; r < 3; ++r)
                    for (int c = 0; c < 3; ++c) {
                        double entry = block[3 * r + c];
                        if (i == j) at(3 * i + r, 3 * i + c) += entry, at(3 * i + c, 3 * i + r) += entry;
                        else if (i > j) at(3 * i + r, 3 * j + c) += entry;
                        else at(3 * j + c, 3 * i + r) += entry;
                    }
                const auto high = std::max(i, j), low = std::min(i, j);
                for (int r = 0; r < 3; ++r) first_[3 * high + r] = std::min(first_[3 * high + r], 3 * low);
            });
        for (std::size_t k = 0; k < diagonal_.size(); ++k) {
            const auto &d = diagonal_[k];
            const double rows[3][3] = {{d.xx, d.xy, d.xz}, {d.xy, d.yy, d.yz}, {d.xz, d.yz, d.zz}};
            for (int r = 0; r < 3; ++r) {
                for (int c = 0; c < 3; ++c) at(3 * k + r, 3 * k + c) += rows[r][c];
                at(3 * k + r, 3 * k + r) += shift;
            }
        }
    }

    // Solve by the decomposition H + shift I = L L'.
    bool solve_by_cholesky(double shift, std::span<double> s) {
        assemble(shift);
        const auto n = unknowns();
        const double least = MIN_PIVOT * largest();
        for (std::int64_t i = 0; i < n; ++i) {
            double *row = &lower_[i * n];
            for (std::int64_t j = first_[i]; j < i; ++j) {
                const double *other = &lower_[j * n];
                const auto from = std::max(first_[i], first_[j]);
                row[j] = (row[j] - product(row + from, other + from, j - from)) / other[j];
            }
            const double pivot = row[i] - product(row + first_[i], row + first_[i], i - first_[i]);
            if (!(pivot > least)) return false;
            row[i] = std::sqrt(pivot);
        }
        for (std::int64_t i = 0; i < n; ++i) {
            const double *row = &lower_[i * n];
            s[i] = (-gradient[i] - product(row + first_[i], &s[first_[i]], i - first_[i])) / row[i];
        }
        for (std::int64_t i = n; i-- > 0;) {
            const double *row = &lower_[i * n];
            s[i] /= row[i];
            for (std::int64_t j = first_[i]; j < i; ++j) s[j] -= row[j] * s[i];
        }
        return true;
    }

    // y = (H + shift I) x.
    void multiply(double shift, const std::vector<double> &x, std::vector<double> &y) const {
        for (std::size_t k = 0; k < diagonal_.size(); ++k) {
            SymmetricMatrix d = diagonal_[k];
            d.add_to_diagonal(shift);
            const double *v = &x[3 * k];
            y[3 * k] = d.xx * v[0] + d.xy * v[1] + d.xz * v[2];
            y[3 * k + 1] = d.xy * v[0] + d.yy * v[1] + d.yz * v[2];
            y[3 * k + 2] = d.xz * v[0] + d.yz * v[1] + d.zz * v[2];
        }
        for (std::size_t h = 0; h < slots_.size(); ++h)
            for_each_pair(h, [&](const double *block, std::int32_t i, std::int32_t j) {
                for (int r = 0; r < 3; ++r)
                    for (int c = 0; c < 3; ++c) {
                        y[3 * i + r] += block[3 * r + c] * x[3 * j + c];
                        y[3 * j + c] += block[3 * r + c] * x[3 * i + r];
                    }
            });
    }

    // Solve by conjugate gradients with block Jacobi preconditioning.
    bool solve_by_conjugate_gradients(double shift, std::span<double> s) const {
        const auto n = unknowns();
        std::vector<SymmetricMatrix> blocks(diagonal_);
        for (auto &block : blocks) {
            block.add_to_diagonal(shift);
            if (!(extreme_eigenvalues(block).smallest > 0)) return false;
        }
        std::vector<double> r(n), z(n), d(n), hd(n);
        auto precondition = [&] {
            for (std::size_t k = 0; k < blocks.size(); ++k) {
                auto [x, y, w] = hexmend::solve(blocks[k], V3<double>{r[3 * k], r[3 * k + 1], r[3 * k + 2]});
                z[3 * k] = x, z[3 * k + 1] = y, z[3 * k + 2] = w;
            }
        };
        auto dot = [&](const std::vector<double> &a, const std::vector<double> &b) {
            return product(a.data(), b.data(), n);
        };
        std::fill(s.begin(), s.end(), 0.0);
        for (std::int64_t i = 0; i < n; ++i) r[i] = -gradient[i];
        precondition();
        d = z;
        double now = dot(r, z);
        const double goal = CG_TOLERANCE * CG_TOLERANCE * now, least = MIN_PIVOT * largest();
        for (std::int64_t k = 0; k < n && now > goal; ++k) {
            multiply(shift, d, hd);
            const double curvature = dot(d, hd);
            if (!(curvature > least * dot(d, d))) return false;
            const double alpha = now / curvature;
            for (std::int64_t i = 0; i < n; ++i) s[i] += alpha * d[i], r[i] -= alpha * hd[i];
            precondition();
            const double before = std::exchange(now, dot(r, z));
            for (std::int64_t i = 0; i < n; ++i) d[i] = z[i] + now / before * d[i];
        }
        return true;
    }
};

}  // namespace hexmend
