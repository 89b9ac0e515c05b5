#pragma once
#include <limits>

namespace morepro::test {

template <class Real>
inline constexpr Real kNan = std::numeric_limits<Real>::quiet_NaN();
template <class Real>
inline constexpr Real kInfinity = std::numeric_limits<Real>::infinity();

}  // namespace morepro::test
