#include <gtest/gtest.h>

#include <cmath>

#include "lib/estimation/lane_gate.hpp"
#include "tests/support/not_finite.hpp"

namespace morepro {
namespace {

bool lane_is_beyond(float x) {
  LaneGate<float> gate;
  for (const float lane : {0.5F, x, -0.5F}) gate.see(1.0F, lane);
  return gate.is_any_beyond();
}

template <class Real>
bool window_is_left(Real x) {
  WindowGate<Real> gate{Real(1.484375), Real(1.515625)};
  for (const Real lane : {Real(1.5), x, Real(1.49)}) gate.see(lane);
  return gate.is_any_beyond();
}

TEST(LaneGate, SeesOneLaneBeyondTheLimit) {
  for (const float inside : {0.0F, -0.0F, 1.0F, -1.0F, 1.0e-40F})
    EXPECT_FALSE(lane_is_beyond(inside)) << inside;
  for (const float beyond : {std::nextafter(1.0F, 2.0F), -1.1F, test::kInfinity<float>,
                             -test::kInfinity<float>, test::kNan<float>, -test::kNan<float>})
    EXPECT_TRUE(lane_is_beyond(beyond)) << beyond;
}

template <class Real>
void expect_window() {
  const Real low = Real(1.484375), high = Real(1.515625);
  for (const Real inside : {low, Real(1.5), std::nextafter(high, Real(0))})
    EXPECT_FALSE(window_is_left(inside)) << inside;
  for (const Real outside :
       {std::nextafter(low, Real(0)), high, Real(0), Real(3), -low, Real(test::kInfinity<float>),
        -Real(test::kInfinity<float>), Real(test::kNan<float>), -Real(test::kNan<float>)})
    EXPECT_TRUE(window_is_left(outside)) << outside;
}

TEST(WindowGate, SeesOneLaneOutside) {
  expect_window<float>();
  expect_window<double>();
}

}  // namespace
}  // namespace morepro
