#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "lib/monitor/monitor.hpp"
#include "tests/support/gap_runs.hpp"

namespace morepro {
namespace {

using gap::Effect;
using gap::GapVerdict;
using host::ProfileKind;
using test::gap_effect;

using Effects = std::vector<gap::AppliedEffect>;
using Change = std::function<void(std::size_t index, SensorFrame& frame)>;

MonitorConfiguration knowing(const Effects& effects) {
  MonitorConfiguration configuration = test::gap_configuration();
  for (const gap::AppliedEffect& one : effects)
    configuration.effects.effect[configuration.effects.count++] = one;
  return configuration;
}

/// What a monitor has made of a run: the worst of it after the first second, and its end.
struct Seen {
  Health last;
  float highest_ratio = 0.0F;  ///< of the spindle's innovations
  float chip_load_deviations =
      0.0F;                      ///< largest error of a valid chip load late in a cut, in standard errors
  double current_error_a = 0.0;  ///< mean of the answer against the measurement
  std::size_t valid = 0;
};

Seen seen_by(const MonitorConfiguration& configuration, const Effects& of_machine,
             const Change& change = {}) {
  constexpr std::size_t kFirst = 10000;
  constexpr std::size_t kLateInCut = 500;
  auto monitor = std::make_unique<BoardMonitor>();
  EXPECT_TRUE(monitor->configure(configuration).ok());
  host::Simulation simulation(test::gap_configuration(),
                              {.profile = ProfileKind::kRich, .duration_s = 8.0, .effects = of_machine});
  Seen seen;
  std::size_t frames_in_cut = 0, frames = 0;
  SensorFrame frame;
  for (std::size_t i = 0; simulation.next(frame); ++i) {
    if (change) change(i, frame);
    const Health& health = monitor->step(frame);
    if (i < kFirst) continue;
    seen.highest_ratio = std::max(seen.highest_ratio, health.innovation_ratio);
    seen.current_error_a +=
        static_cast<double>(health.armature_current_a - frame.get(Channel::kArmatureCurrent));
    ++frames;
    frames_in_cut = frame.get(Channel::kContact) > 0.5F ? frames_in_cut + 1 : 0;
    if (frames_in_cut < kLateInCut || health.chip_load_state != ChipLoadState::kValid) continue;
    ++seen.valid;
    const float error = std::fabs(health.chip_load_mm - frame.get(Channel::kChipLoad));
    seen.chip_load_deviations =
        std::max(seen.chip_load_deviations, error / health.chip_load_standard_error_mm);
  }
  seen.last = monitor->health();
  seen.current_error_a /= static_cast<double>(frames);
  return seen;
}

bool finds_the_parameters(const Health& health) {
  const MachineParameters truth = reference_machine();
  const std::array<double, kParameterCount> values{truth.spindle.torque_constant_nm_a,
                                                   truth.spindle.inertia_kgm2,
                                                   truth.feed.mass_kg,
                                                   truth.feed.contact_force_n,
                                                   truth.spindle.inductance_h,
                                                   truth.spindle.resistance_ohm,
                                                   truth.spindle.back_emf_constant_vs_rad};
  constexpr double kSlack = 0.01;
  return std::equal(values.begin(), values.end(), health.parameters.begin(),
                    [](double value, const ParameterEstimate& estimate) {
                      return estimate.status == ParameterStatus::kIdentifiable &&
                             std::fabs(static_cast<double>(estimate.value) / value - 1.0) < kSlack;
                    });
}

bool is_right(const Seen& seen) {
  constexpr float kHighestRatio = 1.5F;  // a mean of some frames, where an axis reverses too
  constexpr float kDeviations = 3.0F;
  return seen.highest_ratio < kHighestRatio && seen.valid > 5000 && seen.chip_load_deviations < kDeviations &&
         finds_the_parameters(seen.last) && seen.last.gap.verdict == GapVerdict::kNoGap &&
         seen.last.state != HealthState::kModelGap;
}

void expect_right_where_known(const Effects& effects) {
  const std::size_t name = gap::index_of(effects.front().form.effect);
  const Seen seen = seen_by(knowing(effects), effects);
  EXPECT_TRUE(is_right(seen)) << name << ": innovations " << seen.highest_ratio << ", chip load "
                              << seen.chip_load_deviations << " of " << seen.valid << ", gap "
                              << static_cast<int>(seen.last.gap.verdict) << ", parameters "
                              << finds_the_parameters(seen.last);
  EXPECT_FALSE(is_right(seen_by(knowing({}), effects))) << name << " is too small to be seen";
}

TEST(MonitorKnownEffects, ATorqueIsTakenOut) {
  expect_right_where_known({gap_effect(Effect::kSpindleCoulombFriction, 0.03)});
  expect_right_where_known({gap_effect(Effect::kSpindleWindage, 2.0e-7)});
  expect_right_where_known({gap_effect(Effect::kTorqueConstantSaturation, 1.0e-4)});
  expect_right_where_known({gap_effect(Effect::kShaftCompliance, 60.0)});
}

TEST(MonitorKnownEffects, AVoltageIsTakenOut) {
  expect_right_where_known({gap_effect(Effect::kBrushVoltageDrop, 1.5)});
  expect_right_where_known({gap_effect(Effect::kSupplyVoltageOffset, 2.0)});
  expect_right_where_known({gap_effect(Effect::kDriveLag, 1.0e-3)});
  expect_right_where_known({gap_effect(Effect::kArmatureReaction, 0.003)});
}

TEST(MonitorKnownEffects, AForceIsTakenOut) {
  expect_right_where_known({gap_effect(Effect::kFeedForceOffset, 3.0)});
  expect_right_where_known({gap_effect(Effect::kFeedCoulombFriction, 8.0)});
  expect_right_where_known({gap_effect(Effect::kFeedDriveLag, 3.0e-3)});
}

TEST(MonitorKnownEffects, WhatASensorAddsIsTakenOut) {
  expect_right_where_known({gap_effect(Effect::kCurrentBias, 0.5)});
  expect_right_where_known({gap_effect(Effect::kSpindleSpeedBias, 5.0)});
  expect_right_where_known({gap_effect(Effect::kSpindleSpeedDelay, 1.0e-3)});
  expect_right_where_known({gap_effect(Effect::kEncoderEccentricity, 0.01)});
}

TEST(MonitorKnownEffects, SeveralAreTakenOutTogether) {
  expect_right_where_known(
      {gap_effect(Effect::kSpindleCoulombFriction, 0.03), gap_effect(Effect::kCurrentBias, 0.5)});
  expect_right_where_known({gap_effect(Effect::kSpindleWindage, 2.0e-7),
                            gap_effect(Effect::kDriveLag, 1.0e-3), gap_effect(Effect::kFeedForceOffset, 3.0),
                            gap_effect(Effect::kSpindleSpeedDelay, 5.0e-4)});
}

TEST(MonitorKnownEffects, AMachineThatHasThemNotIsWrong) {
  EXPECT_FALSE(is_right(seen_by(knowing({gap_effect(Effect::kFeedForceOffset, 3.0)}), {})));
  EXPECT_FALSE(is_right(seen_by(knowing({gap_effect(Effect::kDriveLag, 1.0e-3)}), {})));
}

TEST(MonitorKnownEffects, TheCurrentOfTheAnswerIsThatOfTheMachine) {
  const Effects friction{gap_effect(Effect::kSpindleCoulombFriction, 0.05)};  // as much as 0.6 A
  EXPECT_NEAR(seen_by(knowing(friction), friction).current_error_a, 0.0, 0.002);
}

/// Of a run of which every 50th frame is lost, and three in a row now and then: with the inputs of the last
/// one a nominal machine goes wrong, too.
float mean_ratio_with_lost_frames(const Effects& effects) {
  auto monitor = std::make_unique<BoardMonitor>();
  EXPECT_TRUE(monitor->configure(knowing(effects)).ok());
  host::Simulation simulation(test::gap_configuration(),
                              {.profile = ProfileKind::kRich, .duration_s = 4.0, .effects = effects});
  SensorFrame frame;
  float sum = 0.0F;
  for (std::size_t i = 0; simulation.next(frame); ++i) {
    if (i % 50 == 0 || i % 350 < 3) continue;
    sum += monitor->step(frame).innovation_ratio;
  }
  EXPECT_GT(monitor->health().frames_missing, 1000U);
  return sum / static_cast<float>(monitor->health().frames_accepted);
}

TEST(MonitorKnownEffects, LostFramesDoNoMoreHarmThanElsewhere) {
  const float nominal = mean_ratio_with_lost_frames({});
  const float known = mean_ratio_with_lost_frames({gap_effect(Effect::kSpindleCoulombFriction, 0.03)});
  EXPECT_NEAR(known, nominal, 0.1F * nominal);
  EXPECT_LT(mean_ratio_with_lost_frames({gap_effect(Effect::kDriveLag, 1.0e-3)}), nominal);
}

TEST(MonitorKnownEffects, ACurrentThatIsNotMeasuredNeedsTheVoltageOnly) {
  const auto forget = [](std::size_t, SensorFrame& frame) { frame.clear(Channel::kArmatureCurrent); };
  const Effects effects{gap_effect(Effect::kSpindleWindage, 1.0e-6)};
  EXPECT_LT(seen_by(knowing(effects), effects, forget).highest_ratio, 1.5F);
}

TEST(MonitorKnownEffects, AnEffectSetsInWhenItIsSaidTo) {
  Effects effects{gap_effect(Effect::kCurrentBias, 0.5)};
  effects.front().onset_s = 3.0;
  EXPECT_TRUE(is_right(seen_by(knowing(effects), effects)));
  Effects earlier = effects;
  earlier.front().onset_s = 2.0;
  EXPECT_FALSE(is_right(seen_by(knowing(earlier), effects)));
}

TEST(MonitorKnownEffects, OneWithoutASizeChangesNoBit) {
  const Health without = seen_by(knowing({}), {}).last;
  const Health with = seen_by(knowing({gap_effect(Effect::kCurrentBias, 0.0)}), {}).last;
  EXPECT_EQ(with.chip_load_mm, without.chip_load_mm);
  EXPECT_EQ(with.innovation_ratio, without.innovation_ratio);
  EXPECT_EQ(with.armature_current_a, without.armature_current_a);
  EXPECT_EQ(with.gap.evidence, without.gap.evidence);
}

TEST(MonitorKnownEffects, RefusesImpossibleOnes) {
  using enum ConfigurationError;
  const auto expect_refusal = [](ConfigurationError error, std::string_view key,
                                 const std::function<void(MachineEffects&)>& spoil) {
    MonitorConfiguration configuration = knowing({gap_effect(Effect::kSpindleSpeedDelay, 1.2e-3)});
    auto monitor = std::make_unique<BoardMonitor>();
    EXPECT_TRUE(monitor->configure(configuration).ok());
    spoil(configuration.effects);
    const ConfigurationResult result = monitor->configure(configuration);
    EXPECT_EQ(result.error, error) << key;
    EXPECT_EQ(result.key, key);
    EXPECT_FALSE(text_of(result.error).empty());
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  expect_refusal(kEffectCount, "effects", [](auto& e) { e.count = 5; });
  expect_refusal(kEffectUnknown, "effects.name",
                 [](auto& e) { e.effect[0].form.effect = Effect::kUnnamedForce; });
  expect_refusal(kEffectParts, "effects.coefficients", [](auto& e) { e.effect[0].form.parts = 5; });
  expect_refusal(kEffectParts, "effects.coefficients", [](auto& e) { e.effect[0].form.parts = 0; });
  expect_refusal(kEffectDelay, "effects.shape", [](auto& e) { e.effect[0].form.shape = 1.3e-3F; });
  expect_refusal(kEffectShape, "effects.shape", [](auto& e) { e.effect[0].form.shape = 0.0F; });
  expect_refusal(kEffectShape, "effects.shape", [](auto& e) { e.effect[0].form.shape = -1.0F; });
  expect_refusal(kNotFinite, "effects.shape",
                 [](auto& e) { e.effect[0].form.shape = static_cast<float>(kNan); });
  expect_refusal(kNotFinite, "effects.coefficients", [](auto& e) { e.effect[0].coefficient[3] = kNan; });
  expect_refusal(kMagnitude, "effects.coefficients", [](auto& e) { e.effect[0].coefficient[0] = -1.0e10; });
  expect_refusal(kNotFinite, "effects.onset_s", [](auto& e) { e.effect[0].onset_s = kNan; });
  expect_refusal(kNegative, "effects.onset_s", [](auto& e) { e.effect[0].onset_s = -1.0; });
}

}  // namespace
}  // namespace morepro
