#pragma once
#include <array>
#include <cstddef>

#include "lib/math/elementary.hpp"

namespace morepro::gap {

/// Everything that least squares wants to know of rows [columns | y], in fixed memory: the upper triangle R
/// with R'R = sum of row' row, by Givens rotations. Not the products themselves: their condition is the
/// square of the rows' and too much for a float. What was collected apart merges into what would have been
/// collected together, in any order, up to rounding. Plain loops in a fixed order: the same bits on every
/// machine.
template <class Real, std::size_t kColumns>
class SquareRootStatistics {
 public:
  static constexpr std::size_t kWidth = kColumns + 1;
  static constexpr std::size_t kY = kColumns;  ///< column of y
  using Row = std::array<Real, kWidth>;

  /// A row on its way into the triangle.
  struct Insertion {
    Row row{};
    std::size_t next = kWidth;    ///< column that is turned next; kWidth: done
    std::size_t used = kColumns;  ///< columns from here on are zero, but for y
    bool is_measured = true;      ///< counts as one of rows()
    [[nodiscard]] bool is_done() const { return next == kWidth; }
  };

  /// Takes a row at once. Finite numbers below 1e18.
  void add(const Row& row) {
    Insertion insertion{.row = row, .next = 0};
    while (!advance(insertion)) {
    }
  }

  /// Turns one column of the row into the triangle; true where the row is in. Until then the rest of the row
  /// is missing from what is asked; other rows may come between.
  bool advance(Insertion& insertion) {
    turn(insertion.next++, insertion.row, insertion.used);
    if (insertion.next == insertion.used) insertion.next = kY;
    if (!insertion.is_done()) return false;
    if (insertion.is_measured) ++rows_;
    return true;
  }

  /// Takes everything that another one has collected.
  void merge(const SquareRootStatistics& other) {
    for (std::size_t j = 0; j < kWidth; ++j) {
      Row row{};
      for (std::size_t c = j; c < kWidth; ++c) row[c] = other.factor(j, c);
      for (std::size_t c = j; c < kWidth; ++c) turn(c, row, kColumns);
    }
    rows_ += other.rows_;
  }

  /// A row that is no measurement: `root_precision` times the column's coefficient is 0, give or take one.
  static Insertion expectation(std::size_t column, Real root_precision) {
    Insertion insertion{.next = column, .is_measured = false};
    insertion.row[column] = root_precision;
    return insertion;
  }
  /// Takes it at once.
  void expect_small(std::size_t column, Real root_precision) {
    Insertion insertion = expectation(column, root_precision);
    while (!advance(insertion)) {
    }
  }

  /// One row of the triangle from another one; all rows make a copy of it.
  void copy_row(std::size_t row, const SquareRootStatistics& other) {
    for (std::size_t i = start_of(row); i < start_of(row + 1); ++i) factor_[i] = other.factor_[i];
    rows_ = other.rows_;
  }

  /// Everything so far counts a quarter. Exact; before the triangle has grown so much that a float does not
  /// see a further row.
  void fade() {
    for (Real& r : factor_) r *= Real(0.5);
    rows_ /= 4;
  }

  [[nodiscard]] std::size_t rows() const { return rows_; }
  /// Element of R; row <= column.
  [[nodiscard]] Real factor(std::size_t row, std::size_t column) const {
    return factor_[start_of(row) + column - row];
  }

  /// Product of two columns less what the first `active` columns explain: an element of the Schur complement.
  /// Not inlined: a board has little flash, and time for this.
  [[nodiscard]] [[gnu::noinline]] Real left(std::size_t a, std::size_t b, std::size_t active) const {
    const std::size_t last = a < b ? a : b;
    Real sum = 0;
    for (std::size_t j = active; j <= last; ++j) sum += factor(j, a) * factor(j, b);
    return sum;
  }

  /// Residual sum of squares after the first `active` columns.
  [[nodiscard]] Real residual(std::size_t active) const { return left(kY, kY, active); }

  /// Cosine between what the first `active` columns leave of two others; 0 where they leave nothing.
  [[nodiscard]] Real correlation(std::size_t a, std::size_t b, std::size_t active) const {
    const Real square = left(a, a, active) * left(b, b, active);
    return square > Real(0) ? left(a, b, active) / math::sqrt(square) : Real(0);
  }

 private:
  static constexpr std::size_t start_of(std::size_t row) { return row * kWidth - row * (row - 1) / 2; }

  void turn(std::size_t column, Row& row, std::size_t used) {
    const Real x = row[column];
    Real* const r = &factor_[start_of(column)];
    const Real length = math::sqrt(r[0] * r[0] + x * x);
    if (x == Real(0) || !(length > Real(0))) return;
    const Real cosine = r[0] / length;
    const Real sine = x / length;
    r[0] = length;
    for (std::size_t k = column + 1; k < used; ++k) rotate(cosine, sine, r[k - column], row[k]);
    if (column < kY) rotate(cosine, sine, r[kY - column], row[kY]);
  }

  static void rotate(Real cosine, Real sine, Real& factor, Real& row) {
    const Real kept = factor;
    const Real taken = row;
    factor = cosine * kept + sine * taken;
    row = cosine * taken - sine * kept;
  }

  std::array<Real, kWidth*(kWidth + 1) / 2> factor_{};
  std::size_t rows_ = 0;
};

}  // namespace morepro::gap
