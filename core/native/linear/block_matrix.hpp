// Symmetric matrix of 3 x 3 blocks, such as an assembled Hessian, and loops over its rows.
#pragma once

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "linear/block_rows.hpp"
#include "linear/symmetric.hpp"
#include "mesh/array_views.hpp"
#include "simd/threads.hpp"

namespace hexmend {

// A symmetric block by its columns: its product with a vector needs no horizontal sum.
template <class Real> struct Block {
    Vec4<Real> x, y, z;

    Vec4<Real> operator*(const Vec4<Real> &v) const { return x * v[0] + y * v[1] + z * v[2]; }
};

// A symmetric block as xx xy xz 0 and yy yz zz 0.
template <class Real> struct HalfBlock {
    Vec4<Real> first, second;

    static HalfBlock of(const std::array<Real, 6> &a) {
        return {__builtin_shufflevector(load(a.data()), Vec4<Real>{}, 0, 1, 2, 4),
                __builtin_shufflevector(load(a.data() + 2), Vec4<Real>{}, 1, 2, 3, 4)};
    }

    Block<Real> whole() const {
        return {first, __builtin_shufflevector(first, second, 1, 4, 5, 7),
                __builtin_shufflevector(first, second, 2, 5, 6, 7)};
    }
    Vec4<Real> operator*(const Vec4<Real> &v) const { return whole() * v; }
};

template <class Real> HalfBlock<Real> half_block(const SymmetricMatrix &a) {
    auto four = [](double x, double y, double z) {
        return Vec4<Real>{static_cast<Real>(x), static_cast<Real>(y), static_cast<Real>(z), 0};
    };
    return {four(a.xx, a.xy, a.xz), four(a.yy, a.yz, a.zz)};
}

template <class Real> std::array<Real, 6> narrowed(const SymmetricMatrix &a) {
    auto number = [](double x) { return static_cast<Real>(x); };
    return {number(a.xx), number(a.xy), number(a.xz), number(a.yy), number(a.yz), number(a.zz)};
}

template <class Real> SymmetricMatrix widened(const std::array<Real, 6> &a) {
    return {a[0], a[1], a[2], a[3], a[4], a[5]};
}

// Blocks above the diagonal, by rows, and an unused one, (blocks + 1, 9), or packed, (blocks + 1, 12); those on the
// diagonal, xx xy xz yy yz zz, (k, 6); vectors (k, 4).
template <class Block> using UpperBlocks = std::span<const Block>;
template <class Real> using DiagonalBlocks = std::span<const std::array<Real, 6>>;
template <class Real> using Vectors = std::span<const std::array<Real, 4>>;

// Pattern of a matrix: bounds (2 parts,) of the parts of slots and then of the separators, see sparsity.hpp; row_start
// (k + 1,) and columns of the blocks above the diagonal. Columns from k on belong to ghosts, slots of another process.
struct BlockPattern {
    Indices bounds, row_start, columns;

    void check() const {
        expect(!bounds.empty() && bounds.size() % 2 == 0, "bounds: two for each part are expected");
        expect(std::cmp_equal(row_start.size(), std::int64_t{bounds.back()} + 1),
               "row_start: one more than the last of bounds is expected");
        expect(are_csr(row_start, columns.size()), "columns: as many as the last of row_start are expected");
    }

    std::int64_t slots() const { return bounds.back(); }
    std::int32_t first_separator() const { return bounds[bounds.size() / 2]; }

    // Throw unless a matrix of its rows, or of more, has so many blocks.
    void expect_blocks(std::size_t off_diagonal, std::size_t diagonal) const {
        expect(off_diagonal > columns.size(), "off_diagonal: a row for each of columns and one more are expected");
        expect(std::cmp_greater_equal(diagonal, slots()), "diagonal: a row a slot is expected");
    }
};

// Type of the numbers of vectors that are multiplied by blocks.
template <class Block>
using NumberOf = std::conditional_t<std::is_same_v<Block, PackedBlock>, float, typename Block::value_type>;

// A matrix with blocks std::array<float, 9>, std::array<double, 9> or PackedBlock for vectors of type Number.
template <class Stored, class Number = NumberOf<Stored>> class BlockMatrix {
  public:
    using V = Vec4<Number>;

    BlockMatrix(const BlockPattern &pattern, UpperBlocks<Stored> off_diagonal)
        : bounds_(pattern.bounds),
          row_start_(pattern.row_start),
          columns_(pattern.columns),
          off_diagonal_(off_diagonal.data()),
          parts_(static_cast<int>(bounds_.size()) / 2),
          first_separator_(pattern.first_separator()),
          size_(pattern.slots()) {}

    std::int64_t size() const { return size_; }

    // The numbers of block s, by rows.
    decltype(auto) block(std::int32_t s) const {
        if constexpr (std::is_same_v<Stored, PackedBlock>) return unpacked(off_diagonal_[s]);
        else return (off_diagonal_[s]);
    }

    // Call body(begin, end, range) for all parts, or separators, in parallel; returns the sum of its results, in order.
    template <class Body> double over_parts(const Body &body) { return over(0, parts_, body); }
    template <class Body> double over_separators(const Body &body) { return over(parts_, 2 * parts_ - 1, body); }

    // Row i above the diagonal times t. The nearest column, which a back substitution computes last, comes last.
    V row_times(std::int32_t i, const V *t) const { return row_times_from(row_start_[i], i, t); }

    // First block of row i in a column of a ghost; the end of the row if there is none. Columns ascend.
    std::int32_t first_ghost(std::int32_t i) const {
        auto first = columns_.begin() + row_start_[i], last = columns_.begin() + row_start_[i + 1];
        return static_cast<std::int32_t>(std::lower_bound(first, last, size_) - columns_.begin());
    }

    // Row i from block `first` on times t.
    V row_times_from(std::int32_t first, std::int32_t i, const V *t) const {
        RowSum<Stored, Number> sum;
        for (auto s = row_start_[i + 1] - 1; s >= first; --s) sum.add(off_diagonal_[s], t[columns_[s]]);
        return sum.total();
    }

    // Add the transposed blocks of row i times p at their columns, but for those of ghosts: to w, or to at_separators,
    // whose first vector is that of the first separator.
    void add_transposed(std::int32_t i, const V &p, V *w, V *at_separators) const {
        const Transposed<Stored, Number> times(p);
        auto s = row_start_[i], end = row_start_[i + 1];  // columns ascend
        for (; s < end && columns_[s] < first_separator_; ++s) w[columns_[s]] += times(off_diagonal_[s]);
        for (; s < end && columns_[s] < size_; ++s)
            at_separators[columns_[s] - first_separator_] += times(off_diagonal_[s]);
    }

    // Forward substitution: body(i, lower) returns p for slot i and a summand; lower is the row left of the diagonal
    // times the p of earlier slots. Returns the sum of the summands. w has a vector for each slot, and `odd` a second
    // one for each separator, because two parts add to it; both are zero before and, but for what body(i, lower) writes
    // to w[i], after.
    template <class Body> double forward(V *w, V *odd, const Body &body) {
        auto rows = [&](std::int32_t begin, std::int32_t end, int range) {
            const bool separator = range >= parts_;
            V *at_separators = separator || range % 2 == 0 ? w + first_separator_ : odd;
            double sum = 0;
            for (auto i = begin; i < end; ++i) {
                V lower = std::exchange(w[i], V{});
                if (separator) lower += std::exchange(odd[i - first_separator_], V{});
                auto [p, square] = body(i, lower);
                add_transposed(i, p, w, at_separators);
                sum += square;
            }
            return sum;
        };
        double total = over_parts(rows);
        return total + over_separators(rows);
    }

  private:
    Indices bounds_, row_start_, columns_;
    const Stored *off_diagonal_;
    int parts_;
    std::int32_t first_separator_;
    std::int64_t size_;
    std::vector<double> sums_ = std::vector<double>(2 * parts_);

    template <class Body> double over(int first, int last, const Body &body) {
        parallel(last - first, [&](std::int64_t k) {
            int range = first + static_cast<int>(k);
            sums_[range] = body(bounds_[range], bounds_[range + 1], range);
        });
        double total = 0;
        for (int range = first; range < last; ++range) total += sums_[range];
        return total;
    }
};

}  // namespace hexmend
