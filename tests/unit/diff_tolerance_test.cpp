#include <gtest/gtest.h>

#include <cmath>

#include "sim_host/diff/tolerances.hpp"
#include "sim_host/support/user_error.hpp"
#include "tests/support/not_finite.hpp"

namespace morepro::host {
namespace {

struct ToleranceCase {
  double a, b;
  Tolerance tolerance;
  bool is_within;
};

TEST(DiffTolerance, IsTheGreaterOfAbsoluteAndRelativeToTheBaseline) {
  for (const auto& [a, b, tolerance, expected] : {
           ToleranceCase{1.0, 1.0, {}, true},
           ToleranceCase{1.0, std::nextafter(1.0, 2.0), {}, false},
           ToleranceCase{8.0, 8.5, {0.5, 0.0}, true},
           ToleranceCase{8.0, 7.5, {0.5, 0.0}, true},
           ToleranceCase{8.0, 8.5625, {0.5, 0.0}, false},
           ToleranceCase{-8.0, -10.0, {0.0, 0.25}, true},
           ToleranceCase{-8.0, -10.125, {0.0, 0.25}, false},
           ToleranceCase{8.0, 10.0, {0.5, 0.25}, true},     // 2 by the share
           ToleranceCase{1.0, 1.5, {0.5, 0.25}, true},      // 0.5 absolute
           ToleranceCase{1.0, 1.625, {0.5, 0.25}, false},   // not their sum
           ToleranceCase{8.0, 10.125, {0.0, 0.25}, false},  // of A, which is 2, not of B
           ToleranceCase{0.0, 1.0e-300, {0.0, 1.0}, false},
           ToleranceCase{0.0, -0.0, {}, true},
       })
    EXPECT_EQ(is_within(a, b, tolerance), expected) << a << " " << b;
}

TEST(DiffTolerance, KnowsNoNearInfinity) {
  const Tolerance any{1.0e300, 1.0};
  EXPECT_TRUE(is_within(test::kInfinity<double>, test::kInfinity<double>, {}));
  EXPECT_TRUE(is_within(NAN, NAN, {}));
  EXPECT_FALSE(is_within(test::kInfinity<double>, -test::kInfinity<double>, any));
  EXPECT_FALSE(is_within(test::kInfinity<double>, 1.0, any));
  EXPECT_FALSE(is_within(1.0, test::kInfinity<double>, any));
  EXPECT_FALSE(is_within(NAN, 1.0, any));
  EXPECT_FALSE(is_within(1.0, NAN, any));
}

TEST(DiffTolerance, IsReadFromAnOption) {
  Tolerances tolerances{.common = {1.0, 0.0}, .of_signal = {}};
  take_tolerance("feed_force_n=0.5,0.01", tolerances);
  take_tolerance("parameters[a=b].estimate=2", tolerances);
  EXPECT_EQ(tolerances.of("feed_force_n").absolute, 0.5);
  EXPECT_EQ(tolerances.of("feed_force_n").relative, 0.01);
  EXPECT_EQ(tolerances.of("parameters[a=b].estimate").absolute, 2.0);
  EXPECT_EQ(tolerances.of("contact").absolute, 1.0);
  for (const char* wrong :
       {"contact", "=1", "contact=", "contact=x", "contact=-1", "contact=1,", "contact=1,nan"})
    EXPECT_THROW(take_tolerance(wrong, tolerances), UsageError) << wrong;
}

}  // namespace
}  // namespace morepro::host
