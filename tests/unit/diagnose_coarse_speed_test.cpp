// Coarse steps: their noise follows the motion, and lasts where nothing moves.
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

/// There and back at 0.0202 m/s, in 9 s.
double even_m(double time_s) {
  constexpr double kEvenMS = 0.0202;
  constexpr double kThereAndBackS = 9.0;
  const double into_s = std::fmod(time_s, kThereAndBackS);
  return kEvenMS * std::min(into_s, kThereAndBackS - into_s);
}

// Of an axis that travels on and on hardly a position comes twice, and the machine file alone tells its
// steps: 20.2 of them a row had a line, and that was "unexplained".
TEST(CoarsePosition, HasLinesOfItsOwn) {
  constexpr double kStepM = 1.0e-6;
  const DrivenAxis axis{.rate_hz = 1000.0,
                        .rows = 30000,
                        .has_speed = false,
                        .position_noise_m = 0.1 * kStepM,
                        .position_step_m = kStepM,
                        .wanted_m = even_m};
  MachineDescription machine = datasheet(0.1);
  machine.configuration.sensors[Channel::kFeedPosition] = {0.1 * kStepM, kStepM};
  const DiagnosisResult result = diagnosed(record(axis), machine);
  EXPECT_EQ(result.verdict, host::Verdict::kParameterError) << said(result);
}

// Four standard deviations of the sensors: what rounding takes away while the machine turns on and on was a
// torque constant that saturates, at 98 %.
TEST(CoarseSteps, AreNoEffectOfAMachineThatTurnsOnAndOn) {
  for (const std::uint64_t seed : {1U, 2U}) {
    const SimulatedRun run{.effects = {effect(Effect::kSensorQuantization, 4.0)},
                           .duration_s = 12.0,
                           .seed = seed,
                           .profile = host::ProfileKind::kProduction};
    const DiagnosisResult result = diagnosed(record(run), datasheet(0.0));
    ASSERT_EQ(result.which.size(), 1U) << said(result);
    EXPECT_EQ(result.which[0].effect, Effect::kSensorQuantization) << said(result);
    EXPECT_TRUE(result.board_agrees);
  }
}

// A machine file that states its steps makes them no fault, and no less biased: 0.54 rad/s of 2 were a
// spindle_speed_bias at 98 %.
TEST(CoarseSteps, AreNoEffectWhereTheFileStatesThem) {
  constexpr SensorNoise kCoarse{0.2, 2.0};
  SimulatedRun run{.duration_s = 16.0, .rate_hz = 2000.0, .profile = host::ProfileKind::kCutting};
  run.configuration.sensors[Channel::kSpindleSpeed] = kCoarse;
  run.configuration.sensors[Channel::kArmatureCurrent].noise = 0.03;
  MachineDescription machine = datasheet(0.0);
  machine.configuration.sensors = run.configuration.sensors;
  const DiagnosisResult result = diagnosed(record(run), machine);
  EXPECT_EQ(result.verdict, host::Verdict::kNoGap) << said(result);
}

}  // namespace
}  // namespace morepro::diagnose_test
