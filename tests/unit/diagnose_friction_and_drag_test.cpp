// Friction and the drag of the air, which every spindle has, are not one curve.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

const host::ParameterResult& viscous_friction(const DiagnosisResult& result) {
  return *std::ranges::find(result.parameters, "viscous_friction_nms_rad", &host::ParameterResult::name);
}

// They were a Stribeck curve alone, at 0.98, beside a viscous friction of 1.34e-4 +- 1.5e-7 N m s/rad: of
// nine such spindles of another simulator all nine.
TEST(FrictionAndDrag, AreNoStribeckCurve) {
  const auto result = diagnosed(record({.effects = {effect(Effect::kSpindleCoulombFriction, 0.0106),
                                                    effect(Effect::kSpindleWindage, 2.95e-8)},
                                        .duration_s = 8.0,
                                        .rate_hz = 5000.0,
                                        .seed = 1}),
                                datasheet(0.1));
  ASSERT_EQ(result.which.size(), 2U) << said(result);
  for (const Effect wanted : {Effect::kSpindleCoulombFriction, Effect::kSpindleWindage}) {
    const auto found = std::ranges::find(result.which, wanted, &host::EffectResult::effect);
    ASSERT_NE(found, result.which.end()) << said(result);
    const double size = wanted == Effect::kSpindleWindage ? 2.95e-8 : 0.0106;
    // A drag of two parts is extrapolated.
    EXPECT_NEAR(found->magnitude, size, 0.2 * size) << gap::name_of(wanted);
  }
  EXPECT_TRUE(result.board_agrees);
  const auto& viscous = viscous_friction(result);
  EXPECT_NEAR(viscous.refit, 1.0e-4, 3.0 * viscous.standard_error);
}

TEST(FrictionAndDrag, LeaveACurveThatIsOneAlone) {
  const auto result = diagnosed(record({.effects = {effect(Effect::kSpindleStribeckFriction, 0.02)},
                                        .duration_s = 8.0,
                                        .rate_hz = 5000.0,
                                        .seed = 4}),
                                datasheet(0.2));
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_EQ(result.which.front().effect, Effect::kSpindleStribeckFriction);
  const auto& viscous = viscous_friction(result);
  EXPECT_NEAR(viscous.refit, 1.0e-4, 3.0 * viscous.standard_error);
}

// Beside a drag of its own a curve costs more than friction and drag do, which then need no viscous friction
// at all: 1.5e-6 +- 1.0e-6 N m s/rad for 1e-4.
TEST(FrictionAndDrag, LeaveACurveBesideADrag) {
  const auto result = diagnosed(record({.effects = {effect(Effect::kSpindleStribeckFriction, 0.02),
                                                    effect(Effect::kSpindleWindage, 1.0e-7)},
                                        .duration_s = 6.0,
                                        .rate_hz = 5000.0,
                                        .seed = 7}),
                                datasheet(0.0));
  EXPECT_TRUE(std::ranges::any_of(result.which, [](const host::EffectResult& one) {
    return one.effect == Effect::kSpindleStribeckFriction;
  })) << said(result);
  EXPECT_NEAR(viscous_friction(result).refit, 1.0e-4, 0.9e-4);
}

// Drag that was found first, and beside a curve had to be less than none.
TEST(FrictionAndDrag, AreNoCurveBesideADragThatWasFound) {
  const auto result = diagnosed(record({.effects = {effect(Effect::kSpindleCoulombFriction, 0.0106),
                                                    effect(Effect::kSpindleWindage, 1.0e-7)},
                                        .duration_s = 8.0,
                                        .rate_hz = 5000.0,
                                        .seed = 5}),
                                datasheet(0.1));
  ASSERT_EQ(result.which.size(), 2U) << said(result);
  for (const Effect wanted : {Effect::kSpindleCoulombFriction, Effect::kSpindleWindage})
    EXPECT_TRUE(std::ranges::any_of(result.which, [wanted](const auto& one) { return one.effect == wanted; }))
        << said(result);
}

// A load that follows the speed, which was to be found yet, made a curve of the friction.
TEST(FrictionAndDrag, AreFrictionAloneWhereNothingDrags) {
  const auto result = diagnosed(record({.effects = {effect(Effect::kSpindleCoulombFriction, 0.02),
                                                    effect(Effect::kContactSpeedDependence, 0.06)},
                                        .duration_s = 8.0,
                                        .rate_hz = 5000.0,
                                        .seed = 1}),
                                datasheet(0.1));
  ASSERT_EQ(result.which.size(), 2U) << said(result);
  for (const Effect wanted : {Effect::kSpindleCoulombFriction, Effect::kContactSpeedDependence})
    EXPECT_TRUE(std::ranges::any_of(result.which, [wanted](const auto& one) { return one.effect == wanted; }))
        << said(result);
}

}  // namespace
}  // namespace morepro::diagnose_test
