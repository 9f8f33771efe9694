// Cholesky's factor of a symmetric matrix of 3 x 3 blocks, stored from the first block of each row to the diagonal
// (Jennings 1966): what lies between is filled.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace hexmend {

class EnvelopeCholesky {
  public:
    EnvelopeCholesky() = default;

    // Zero matrix; first[a] is the column of the first block of block row a, a itself at most.
    explicit EnvelopeCholesky(std::span<const std::int32_t> first) : first_(3 * first.size()), row_(3 * first.size()) {
        std::size_t total = 0;
        for (std::size_t i = 0; i < first_.size(); ++i) {
            first_[i] = 3 * first[i / 3];
            row_[i] = static_cast<std::int64_t>(total) - first_[i];
            total += i + 1 - first_[i];
        }
        numbers_.assign(total, 0.0);
    }

    // Add a block, stored by columns, below or on the diagonal: block row a, column b <= a.
    template <class Real> void add(std::int32_t a, std::int32_t b, const Real *block) {
        for (int k = 0; k < 3; ++k)
            for (int l = 0; l < 3; ++l)
                if (3 * b + l <= 3 * a + k) row(3 * a + k)[3 * b + l] += static_cast<double>(block[3 * l + k]);
    }

    // Replace the matrix by its factor; returns false, at any factor, if it is not positive definite to rounding.
    bool factorise() {
        const auto n = std::ssize(first_);
        for (std::int64_t i = 0; i < n; ++i) {
            double *of_i = row(i);
            for (std::int64_t j = first_[i]; j < i; ++j) {
                auto from = std::max(first_[i], first_[j]);
                const double *of_j = row(j);
                of_i[j] = (of_i[j] - dot(of_i + from, of_j + from, j - from)) / of_j[j];
            }
            double before = of_i[i], pivot = before - dot(of_i + first_[i], of_i + first_[i], i - first_[i]);
            if (!(pivot > SMALLEST_PIVOT * before)) return false;
            of_i[i] = std::sqrt(pivot);
        }
        return true;
    }

    // Replace x by the solution for the right-hand side x.
    void solve(std::span<double> x) const {
        const auto n = std::ssize(first_);
        for (std::int64_t i = 0; i < n; ++i) {
            const double *of_i = row(i);
            x[i] = (x[i] - dot(of_i + first_[i], x.data() + first_[i], i - first_[i])) / of_i[i];
        }
        for (std::int64_t i = n - 1; i >= 0; --i) {
            const double *of_i = row(i);
            double there = x[i] /= of_i[i];
            for (auto j = first_[i]; j < i; ++j) x[j] -= there * of_i[j];
        }
    }

  private:
    static constexpr double SMALLEST_PIVOT = 1e-7;  // of the diagonal entry, which has the rounding errors of float

    std::vector<std::int64_t> first_, row_;  // column of the first number of each row, and where column 0 would be
    std::vector<double> numbers_;

    double *row(std::int64_t i) { return numbers_.data() + row_[i]; }
    const double *row(std::int64_t i) const { return numbers_.data() + row_[i]; }

    static double dot(const double *a, const double *b, std::int64_t count) {
        typedef double Lanes __attribute__((vector_size(64), aligned(8), may_alias));
        Lanes sums[4] = {};
        std::int64_t k = 0;
        for (; k + 32 <= count; k += 32)
            for (int u = 0; u < 4; ++u)
                sums[u] +=
                    *reinterpret_cast<const Lanes *>(a + k + 8 * u) * *reinterpret_cast<const Lanes *>(b + k + 8 * u);
        for (; k + 8 <= count; k += 8)
            sums[0] += *reinterpret_cast<const Lanes *>(a + k) * *reinterpret_cast<const Lanes *>(b + k);
        Lanes all = (sums[0] + sums[1]) + (sums[2] + sums[3]);
        double total = ((all[0] + all[1]) + (all[2] + all[3])) + ((all[4] + all[5]) + (all[6] + all[7]));
        for (; k < count; ++k) total += a[k] * b[k];
        return total;
    }
};

}  // namespace hexmend
