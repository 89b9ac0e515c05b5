// A speed in coarse steps: its noise follows the motion.
#include <gtest/gtest.h>

#include "tests/unit/driven_axis.hpp"

namespace morepro::diagnose_test {
namespace {

// Without noise that would hide its steps.
TEST(CoarseSpeed, HasLinesOfItsOwn) {
  constexpr double kStepMS = 0.02;
  RecordingSignals signals = record(DrivenAxis{.rate_hz = 2000.0, .position_noise_m = 1.0e-7});
  for (float& speed : signals.value[index_of(Channel::kFeedSpeed)])
    speed = static_cast<float>(kStepMS * std::round(static_cast<double>(speed) / kStepMS));
  MachineDescription machine = datasheet(0.0);
  machine.configuration.sensors[Channel::kFeedPosition] = {1.0e-7, 0.0};
  machine.configuration.sensors[Channel::kFeedSpeed] = {kStepMS / std::sqrt(12.0), kStepMS};
  const DiagnosisResult result = diagnosed(signals, machine);
  EXPECT_EQ(result.verdict, host::Verdict::kNoGap) << said(result);
}

}  // namespace
}  // namespace morepro::diagnose_test
