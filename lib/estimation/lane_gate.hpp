#pragma once
#include <bit>
#include <cstdint>
#include <type_traits>

namespace morepro {

/// Notices whether any lane of a loop leaves |x| <= limit, or holds no number, without a branch in the loop:
/// of every lane it keeps one bit of an integer difference.
template <class Real>
class LaneGate {
 public:
  void see(Real limit, Real x) { seen_ |= (bits_of(limit) & kMagnitude) - (bits_of(x) & kMagnitude); }
  [[nodiscard]] bool is_any_beyond() const { return (seen_ >> (8 * sizeof(Bits) - 1)) != 0; }

 private:
  using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
  static constexpr Bits kMagnitude = ~Bits(0) >> 1;
  static Bits bits_of(Real x) { return std::bit_cast<Bits>(x); }

  Bits seen_ = 0;  ///< its top bit is set where a lane was beyond
};

/// Notices whether any lane of a loop leaves low <= x < high, or holds no number: cheaper than LaneGate. 0 <
/// low, and the bounds are a power of two of floating-point numbers apart, so that the differences' bits can
/// be gathered with "or".
template <class Real>
class WindowGate {
 public:
  WindowGate(Real low, Real high) : low_(bits_of(low)), width_(bits_of(high) - low_) {}

  void see(Real x) { seen_ |= bits_of(x) - low_; }
  [[nodiscard]] bool is_any_beyond() const { return seen_ >= width_; }

 private:
  using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
  static Bits bits_of(Real x) { return std::bit_cast<Bits>(x); }

  Bits low_, width_;
  Bits seen_ = 0;
};

}  // namespace morepro
