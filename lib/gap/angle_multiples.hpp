#pragma once
#include <array>
#include <cstddef>

#include "lib/math/elementary.hpp"

namespace morepro::gap {

/// Sine and cosine of an angle and of its whole multiples, for many columns that follow it. Each from two
/// that are half as far, so that errors and waiting grow with the logarithm of the multiple only: below
/// 1e-15.
template <class Real>
class AngleMultiples {
 public:
  static constexpr std::size_t kMost = 24;

  void follow(Real angle_rad) {
    turn_[1] = math::sin_cos(angle_rad);
    for (std::size_t k = 2; k <= kMost; ++k) {
      const math::SinCos<Real>& a = turn_[k / 2];
      const math::SinCos<Real>& b = turn_[k - k / 2];
      turn_[k] = {a.sin * b.cos + a.cos * b.sin, a.cos * b.cos - a.sin * b.sin};
    }
  }

  /// Of the angle times `multiple`; none where that is not a whole number up to kMost.
  [[nodiscard]] const math::SinCos<Real>* of(Real multiple) const {
    if (!(multiple >= Real(1) && multiple <= Real(kMost))) return nullptr;
    const auto whole = static_cast<std::size_t>(multiple);
    return static_cast<Real>(whole) == multiple ? &turn_[whole] : nullptr;
  }

 private:
  std::array<math::SinCos<Real>, kMost + 1> turn_{};
};

}  // namespace morepro::gap
