// A force that process noise takes before anybody looks for it: what a linearisation beside such a model
// promises is little, or is not kept.
#include <gtest/gtest.h>

#include "tests/unit/driven_axis.hpp"

namespace morepro::diagnose_test {
namespace {

// A constant force moves an axis that is known by its position alone as noise of one sign would.
TEST(HiddenForce, IsFoundWhereOnlyThePositionIsKnown) {
  MachineDescription machine = datasheet(0.0);
  machine.configuration.sensors[Channel::kFeedPosition] = {1.0e-7, 0.0};
  for (const std::size_t rows : {6000U, 10000U}) {
    DrivenAxis axis{.rate_hz = 1000.0, .rows = rows, .has_speed = false, .position_noise_m = 1.0e-7};
    axis.brake_at = [](double) { return -3.5; };
    const DiagnosisResult result = diagnosed(record(axis), machine);
    EXPECT_EQ(result.verdict, host::Verdict::kEffect) << said(result);
    ASSERT_EQ(result.which.size(), 1U) << said(result);
    EXPECT_EQ(result.which.front().effect, Effect::kFeedForceOffset);
    // Known to 0.1 %; a shape's usual misfit is 1 %.
    EXPECT_NEAR(result.which.front().magnitude, -3.5, 0.035);
  }
}

}  // namespace
}  // namespace morepro::diagnose_test
