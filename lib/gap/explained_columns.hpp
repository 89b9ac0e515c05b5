#pragma once
#include <array>
#include <cstddef>

#include "lib/gap/square_root_statistics.hpp"

namespace morepro::gap {

inline constexpr std::size_t kMostGroup = 4;

/// What a group of columns would explain.
template <class Real>
struct GroupGain {
  Real gain = 0;         ///< taken from the residual sum of squares
  Real coefficient = 0;  ///< of the group's first column; of a group of one
};

/// What statistics say of the columns when the first `active` of them are explained already, and some of the
/// others, one after another (Gram-Schmidt).
template <class Real, std::size_t kColumns>
class ExplainedColumns {
 public:
  using Statistics = SquareRootStatistics<Real, kColumns>;
  static constexpr std::size_t kMost = 6;
  static constexpr std::size_t kY = Statistics::kY;

  explicit ExplainedColumns(std::size_t active) : active_(active) {}

  void clear() { count_ = 0; }
  [[nodiscard]] bool has_room(std::size_t columns) const { return count_ + columns <= kMost; }

  /// Product of what is left of two columns.
  [[nodiscard]] [[gnu::noinline]] Real left(const Statistics& statistics, std::size_t a,
                                            std::size_t b) const {
    Real sum = statistics.left(a, b, active_);
    for (std::size_t i = 0; i < count_; ++i) sum -= share_[i][a] * share_[i][b];
    return sum;
  }

  /// Explains one more column; has_room(1). One that is a combination of others changes nothing.
  void explain(const Statistics& statistics, std::size_t column) {
    for (std::size_t step = 0; !explain(statistics, column, step); ++step) {
    }
  }
  /// A step of it, from 0 on, for each of the other columns; true where it was the last one.
  bool explain(const Statistics& statistics, std::size_t column, std::size_t step) {
    if (step == 0) {
      const Real square = left(statistics, column, column);
      const bool is_new = square > kLeastNew * statistics.left(column, column, 0);
      scale_ = is_new ? Real(1) / math::sqrt(square) : Real(0);
    }
    if (!(scale_ > Real(0))) return true;
    const std::size_t other = active_ + step;
    share_[count_][other] = scale_ * left(statistics, column, other);
    if (other < kY) return false;
    ++count_;
    return true;
  }

  /// Gain of the columns [first, first + count), count <= kMostGroup; 0 where they are a combination of what
  /// is explained.
  [[nodiscard]] GroupGain<Real> gain_of(const Statistics& statistics, std::size_t first,
                                        std::size_t count) const {
    std::array<std::array<Real, kMostGroup + 1>, kMostGroup + 1> m{};
    for (std::size_t a = 0; a < count; ++a) {
      for (std::size_t b = a; b < count; ++b) m[a][b] = left(statistics, first + a, first + b);
      m[a][count] = left(statistics, first + a, kY);
    }
    GroupGain<Real> result;
    for (std::size_t a = 0; a < count; ++a) {
      const Real pivot = m[a][a];
      if (!(pivot > kLeastNew * statistics.left(first + a, first + a, 0))) return {};
      const Real share = m[a][count] / pivot;
      if (a == 0) result.coefficient = share;
      result.gain += share * m[a][count];
      for (std::size_t i = a + 1; i < count; ++i)
        for (std::size_t b = i; b <= count; ++b) m[i][b] -= m[a][i] / pivot * m[a][b];
    }
    return result;
  }

 private:
  static constexpr Real kLeastNew = Real(1.0e-6);

  std::size_t active_;
  std::size_t count_ = 0;
  Real scale_ = 0;                                             ///< of the column that is being explained
  std::array<std::array<Real, kColumns + 1>, kMost> share_{};  ///< of each column along what was explained
};

}  // namespace morepro::gap
