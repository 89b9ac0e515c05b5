#pragma once
#include <array>
#include <cstddef>

namespace morepro::math {

/// Sum in one fixed order, whatever the vector width of the machine: eight interleaved partial sums, then a
/// tree. The order of a reduction is part of the result, so this is the only way in which lanes are added up.
template <class Real, std::size_t kN>
constexpr Real fixed_order_sum(const std::array<Real, kN>& values) {
  std::array<Real, 8> partial{};
  for (std::size_t i = 0; i < kN; ++i) partial[i % 8] += values[i];
  return ((partial[0] + partial[4]) + (partial[2] + partial[6])) +
         ((partial[1] + partial[5]) + (partial[3] + partial[7]));
}

}  // namespace morepro::math
