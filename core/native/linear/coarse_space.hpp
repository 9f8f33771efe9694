// Coarse space of a matrix A, by which conjugate gradients are deflated (Nicolaides 1987; Frank and Vuik 2001).
//
// R has three columns for each aggregate of slots, its translations, E = R' A R is the coarse matrix, and
// P = I - A R E^-1 R' takes out of a residual what the coarse space can solve. R' A t = (A R)' t needs the blocks of A
// R alone, and no product with A.
#pragma once

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "linear/aggregates.hpp"
#include "linear/block_matrix.hpp"
#include "linear/envelope_cholesky.hpp"

namespace hexmend {

// Numbers of the workspace of a `CoarseSpace`.
inline std::int64_t coarse_workspace_size(const CoarsePattern &pattern) {
    return 9 * static_cast<std::int64_t>(pattern.columns.size()) + 1;
}

template <class Real> class CoarseSpace {
  public:
    using V = Vec4<Real>;

    // Compute A R and E; diagonal(i) returns the diagonal block of slot i, (9,); work: `coarse_workspace_size`.
    template <class System, class Diagonal>
    CoarseSpace(const CoarsePattern &pattern, const BlockPattern &of_matrix, System &system, const Diagonal &diagonal,
                Real *work)
        : pattern_(pattern), blocks_(work), ranges_(static_cast<int>(of_matrix.bounds.size()) - 1) {
        expect(static_cast<std::int64_t>(pattern.aggregate.size()) == system.size(),
               "coarse: an aggregate is expected for each slot of the matrix");
        for (auto a : pattern.aggregate) count_ = std::max<std::int64_t>(count_, a + 1);
        sums_.resize(ranges_ * count_), solution_.resize(3 * count_), y_.resize(4 * count_);
        multiply(of_matrix, system, diagonal);
        positive_ = factorise();
    }

    // True if E is positive definite. Where it is not, neither is A.
    bool positive() const { return positive_; }

    // Add (A R)' t of slot i to the sums of a range of slots: parts, then separators.
    void add(int range, std::int32_t i, const V &t) {
        for (auto s = pattern_.row_start[i]; s < pattern_.row_start[i + 1]; ++s)
            add_to(range, pattern_.columns[s], horizontal_sums(column(s, 0) * t, column(s, 1) * t, column(s, 2) * t));
    }

    // Add R' b of slot i, likewise.
    void restrict_to(int range, std::int32_t i, const V &b) { add_to(range, pattern_.aggregate[i], b); }

    // Compute y = E^-1 of the sums over all ranges, which are 0 afterwards.
    void solve() {
        for (std::int64_t a = 0; a < count_; ++a) {
            Vec4<double> total{};
            for (int range = 0; range < ranges_; ++range)
                total += std::exchange(sums_[range * count_ + a], Vec4<double>{});
            for (int k = 0; k < 3; ++k) solution_[3 * a + k] = total[k];
        }
        factor_.solve(solution_);
        for (std::int64_t a = 0; a < count_; ++a)
            for (int k = 0; k < 3; ++k) y_[4 * a + k] = static_cast<Real>(solution_[3 * a + k]);
    }

    // Keep y, and add it to a later one.
    void keep() { kept_ = y_; }
    void add_kept() {
        for (std::size_t k = 0; k < y_.size(); ++k) y_[k] += kept_[k];
    }

    // Row i of A R y. The fourth number may be anything.
    V row(std::int32_t i) const {
        V total{};
        for (auto s = pattern_.row_start[i]; s < pattern_.row_start[i + 1]; ++s) {
            V y = at(pattern_.columns[s]);
            total += column(s, 0) * y[0] + column(s, 1) * y[1] + column(s, 2) * y[2];
        }
        return total;
    }

    // Row i of R y.
    V prolonged(std::int32_t i) const { return at(pattern_.aggregate[i]); }

  private:
    CoarsePattern pattern_;
    Real *blocks_;  // of A R, by columns
    int ranges_;
    std::int64_t count_ = 0;
    bool positive_ = false;
    std::vector<Vec4<double>> sums_;  // of aggregates, for each range
    std::vector<double> solution_;
    std::vector<Real> y_, kept_;
    EnvelopeCholesky factor_;

    void add_to(int range, std::int32_t aggregate, const V &v) {
        sums_[range * count_ + aggregate] += __builtin_convertvector(v, Vec4<double>);
    }
    V at(std::int32_t a) const { return load(y_.data() + 4 * static_cast<std::size_t>(a)); }
    V column(std::int32_t s, int k) const { return load(blocks_ + 9 * static_cast<std::int64_t>(s) + 3 * k); }

    // The nine numbers of a block, without those beside it.
    struct Nine {
        V first{}, second{};
        Real last = 0;

        Nine() = default;
        explicit Nine(const Real *from) : first(load(from)), second(load(from + 4)), last(from[8]) {}
        Nine plus(const Real *from) const {
            Nine sum(from);
            sum.first += first, sum.second += second, sum.last += last;
            return sum;
        }
        void store(Real *to) const {
            std::memcpy(to, &first, sizeof first), std::memcpy(to + 4, &second, sizeof second);
            to[8] = last;
        }
    };

    static void add_transposed(Real *to, const Nine &block) {
        Real from[9];
        block.store(from);
        for (int k = 0; k < 3; ++k)
            for (int l = 0; l < 3; ++l) to[3 * l + k] += from[3 * k + l];
    }

    Real *block(std::int32_t i, std::int32_t a) {
        auto s = pattern_.row_start[i];
        while (pattern_.columns[s] != a) ++s;
        return blocks_ + 9 * static_cast<std::int64_t>(s);
    }

    // Compute the blocks of A R: the rows of a part meet those of the part and of separators; what they add to
    // separators follows, one row after another.
    template <class System, class Diagonal>
    void multiply(const BlockPattern &of, System &system, const Diagonal &diagonal) {
        const auto first_separator = of.bounds[of.bounds.size() / 2];
        auto add_below = [&](std::int32_t s, std::int32_t aggregate) {
            Real *to = block(of.columns[s], aggregate);  // by columns, as the transposed block is by rows
            Nine(to).plus(system.block(s).data()).store(to);
        };
        auto rows = [&](std::int32_t begin, std::int32_t end, int) {
            std::fill(blocks_ + 9 * static_cast<std::int64_t>(pattern_.row_start[begin]),
                      blocks_ + 9 * static_cast<std::int64_t>(pattern_.row_start[end]), Real{});
            for (auto i = begin; i < end; ++i) {
                const auto own = pattern_.aggregate[i];
                auto last = own;
                Nine sum(diagonal(i).data());  // of the blocks of the last aggregate, by rows
                for (auto s = of.row_start[i]; s < of.row_start[i + 1]; ++s) {
                    auto j = of.columns[s];
                    if (auto a = pattern_.aggregate[j]; a != last) {
                        add_transposed(block(i, last), sum);
                        sum = {}, last = a;
                    }
                    sum = sum.plus(system.block(s).data());
                    if (begin >= first_separator || j < first_separator) add_below(s, own);
                }
                add_transposed(block(i, last), sum);
            }
            return 0.0;
        };
        blocks_[9 * pattern_.columns.size()] = 0;  // loaded with the last block, times 0
        system.over_separators(rows);
        system.over_parts(rows);
        for (std::int32_t i = 0; i < first_separator; ++i)
            for (auto s = of.row_start[i + 1]; s-- > of.row_start[i] && of.columns[s] >= first_separator;)
                add_below(s, pattern_.aggregate[i]);
    }

    // Compute E and its Cholesky factor; returns false if it is not positive definite.
    bool factorise() {
        std::vector<std::int32_t> first(count_);
        std::iota(first.begin(), first.end(), 0);
        const auto slots = static_cast<std::int32_t>(pattern_.aggregate.size());
        for (std::int32_t i = 0; i < slots; ++i) {
            auto &least = first[pattern_.aggregate[i]];
            least = std::min(least, pattern_.columns[pattern_.row_start[i]]);
        }
        factor_ = EnvelopeCholesky(first);
        for (std::int32_t i = 0; i < slots; ++i)
            for (auto s = pattern_.row_start[i]; s < pattern_.row_start[i + 1]; ++s)
                if (pattern_.columns[s] <= pattern_.aggregate[i])
                    factor_.add(pattern_.aggregate[i], pattern_.columns[s], blocks_ + 9 * static_cast<std::int64_t>(s));
        return factor_.factorise();
    }
};

}  // namespace hexmend
