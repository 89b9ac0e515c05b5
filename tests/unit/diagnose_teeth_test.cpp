// A cutter whose teeth do not run on one circle.
#include <gtest/gtest.h>

#include "tests/unit/driven_spindle.hpp"

namespace morepro::host {
namespace {

using diagnose_test::datasheet;
using diagnose_test::diagnosed;
using diagnose_test::effect;
using diagnose_test::record;
using diagnose_test::said;
using gap::Effect;

/// Tooth passing, and its run-out: once per turn.
std::vector<gap::AppliedEffect> with_run_out(Effect teeth, double size, double run_out) {
  gap::AppliedEffect once = effect(teeth, run_out);
  once.form.kind = 1;
  return {effect(teeth, size), once};
}

// Once per turn in the cut alone: cogging would be there in the air, too.
TEST(RunOut, IsPartOfToothPassing) {
  for (const auto& [teeth, size] :
       {std::pair{Effect::kToothPassingTorque, 0.1}, std::pair{Effect::kFeedToothPassingForce, 6.0}}) {
    const auto run = with_run_out(teeth, size, 0.15 * size);
    DiagnosisOptions options;
    options.bootstrap_runs = 0;
    MachineDescription with_effects;
    const auto result =
        diagnose(record({.effects = run, .duration_s = 5.0}), datasheet(0.1), options, with_effects);
    ASSERT_EQ(result.which.size(), 1U) << said(result);
    EXPECT_EQ(result.which.front().effect, teeth) << said(result);
    EXPECT_NEAR(result.which.front().magnitude, size, 4.0 * result.which.front().standard_error);
    ASSERT_EQ(with_effects.effects.size(), 2U) << "the machine file has both";
    EXPECT_EQ(with_effects.effects.back().form.kind, 1);
    EXPECT_NEAR(with_effects.effects.back().coefficient[0], 0.15 * size, 0.03 * size);
  }
}

TEST(RunOut, IsNotWhatCoggingIs) {
  auto effects = std::vector{effect(Effect::kToothPassingTorque, 0.1)};
  effects.push_back(effect(Effect::kSpindleCogging, 0.02));
  effects.back().form.shape = 1.0F;
  const auto result = diagnosed(record({.effects = effects, .duration_s = 5.0}), datasheet(0.1));
  ASSERT_EQ(result.which.size(), 2U) << said(result);
  EXPECT_EQ(result.which.back().effect, Effect::kSpindleCogging) << said(result);
}

// A tooth that cuts brakes whichever way the spindle turns: over both ways the same sine of the angle is
// nothing on average, and was 0.4 of its size and "unexplained".
TEST(ToothPassing, BrakesEitherWay) {
  constexpr double kSizeNm = 0.02;
  diagnose_test::DrivenSpindle spindle;
  spindle.brake_at = [](const diagnose_test::SpindleState& x, double contact) {
    const double teeth = reference_machine().tool.teeth;
    return contact * kSizeNm * std::tanh(x.speed_rad_s) * std::sin(teeth * x.angle_rad + 0.7);
  };
  const auto result = diagnosed(record(spindle), datasheet(0.1));
  EXPECT_EQ(result.verdict, Verdict::kEffect) << said(result);
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_EQ(result.which.front().effect, Effect::kToothPassingTorque) << said(result);
  EXPECT_NEAR(result.which.front().magnitude, kSizeNm, 0.03 * kSizeNm);
  EXPECT_TRUE(result.board_agrees);
}

}  // namespace
}  // namespace morepro::host
