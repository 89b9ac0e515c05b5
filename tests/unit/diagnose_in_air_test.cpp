// A spindle that never cuts: nothing tells how strong its motor is, so that every torque is known to a common
// factor only. What brakes it has its name all the same.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <utility>

#include "tests/unit/driven_spindle.hpp"

namespace morepro::diagnose_test {
namespace {

DiagnosisResult in_the_air(std::function<double(const SpindleState&, double)> brake_at) {
  MachineDescription machine = datasheet(0.0);
  machine.has_feed = false;
  return diagnosed(record(DrivenSpindle{.brake_at = std::move(brake_at), .cuts = false}), machine);
}

void expect_sure(const DiagnosisResult& result, Effect effect) {
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_EQ(result.which.front().effect, effect) << said(result);
  EXPECT_GT(result.which.front().confidence, 0.9) << said(result);
}

// Both were right at a confidence of 0.20, because their size is known to three standard errors.
TEST(SpindleInTheAir, HasAFriction) {
  const auto brake_at = [](const SpindleState& x, double) { return 0.02 * std::tanh(x.speed_rad_s / 0.5); };
  const auto result = in_the_air(brake_at);
  expect_sure(result, Effect::kSpindleCoulombFriction);
  ASSERT_EQ(result.parameters.size(), 6U);
  // Not "it needs different speeds", of which there are six.
  for (const auto& parameter : std::span(result.parameters).first(3)) {
    EXPECT_FALSE(parameter.is_identifiable) << parameter.name;
    EXPECT_NE(parameter.reason.find("one common factor"), std::string::npos) << parameter.reason;
  }
}

TEST(SpindleInTheAir, Cogs) {
  const auto brake_at = [](const SpindleState& x, double) { return 0.02 * std::sin(7.0 * x.angle_rad); };
  expect_sure(in_the_air(brake_at), Effect::kSpindleCogging);
}

}  // namespace
}  // namespace morepro::diagnose_test
