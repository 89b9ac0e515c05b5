#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

#include "lib/monitor/monitor.hpp"
#include "tests/support/gap_runs.hpp"
#include "tests/support/health_bytes.hpp"

namespace morepro {
namespace {

using gap::Effect;
using gap::GapVerdict;
using host::ProfileKind;
using test::GapRun;

using Change = std::function<void(std::size_t index, SensorFrame& frame)>;

/// Shows a run to the monitor, frame by frame, each as `change` leaves it.
const Health& show(BoardMonitor& monitor, const GapRun& run, const Change& change = {}) {
  host::SimulationOptions options;
  options.profile = run.profile;
  options.duration_s = run.duration_s;
  options.seed = run.seed;
  options.effects = run.effects;
  options.process_noise = run.process_noise;
  host::Simulation simulation(test::gap_configuration(), options);
  SensorFrame frame;
  for (std::size_t i = 0; simulation.next(frame); ++i) {
    if (change) change(i, frame);
    (void)monitor.step(frame);
  }
  return monitor.health();
}

std::unique_ptr<BoardMonitor> new_monitor() {
  auto monitor = std::make_unique<BoardMonitor>();
  EXPECT_TRUE(monitor->configure(test::gap_configuration()).ok());
  return monitor;
}

Health after(const GapRun& run, const Change& change = {}) { return show(*new_monitor(), run, change); }

bool is_named(const gap::GapFinding& finding, Effect effect) {
  const auto end = finding.alias.begin() + finding.alias_count;
  return finding.effect == effect || std::find(finding.alias.begin(), end, effect) != end;
}

const GapRun kBiased{.effects = {test::gap_effect(Effect::kFeedForceOffset, 3.0)}, .duration_s = 10.0};

TEST(MonitorGap, NamesTheEffectOfAMachine) {
  for (const auto& [effect, size] : {std::pair{Effect::kFeedCoulombFriction, 3.0},
                                     {Effect::kFeedForceOffset, 3.0},
                                     {Effect::kSupplyVoltageOffset, 2.0},
                                     {Effect::kCurrentBias, 0.5}}) {
    const Health health = after({.effects = {test::gap_effect(effect, size)}, .duration_s = 16.0});
    EXPECT_EQ(health.gap.verdict, GapVerdict::kEffect) << gap::index_of(effect);
    EXPECT_TRUE(is_named(health.gap, effect)) << gap::index_of(effect) << gap::index_of(health.gap.effect);
    EXPECT_EQ(health.gap.where, gap::group_of(health.gap.effect));
    EXPECT_GT(health.gap.confidence, 0.9F);
    EXPECT_EQ(health.state, HealthState::kModelGap) << gap::index_of(effect);
  }
}

TEST(MonitorGap, SaysWhyTheStateIsAGap) {
  const Health health = after(kBiased);
  EXPECT_EQ(health.state, HealthState::kModelGap);
  EXPECT_EQ(health.reason, static_cast<std::uint16_t>(ReasonCode::kModelEffect));
}

TEST(MonitorGap, SaysNothingOfAMachineThatIsAsDescribed) {
  for (const ProfileKind profile : {ProfileKind::kRich, ProfileKind::kProduction, ProfileKind::kCutting}) {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      const Health health = after({.profile = profile, .duration_s = 8.0, .seed = seed});
      EXPECT_NE(health.gap.verdict, GapVerdict::kEffect) << static_cast<int>(profile) << ", " << seed;
      EXPECT_NE(health.gap.verdict, GapVerdict::kUnexplained) << static_cast<int>(profile) << ", " << seed;
      EXPECT_NE(health.state, HealthState::kModelGap) << static_cast<int>(profile) << ", " << seed;
    }
  }
}

/// Of 100,000 frames, every `one_of` is lost, at random.
Health after_losing(std::uint32_t one_of) {
  auto monitor = new_monitor();
  host::SimulationOptions options{.profile = ProfileKind::kRich, .duration_s = 10.0};
  host::Simulation simulation(test::gap_configuration(), options);
  SensorFrame frame;
  std::uint32_t random = 1;
  while (simulation.next(frame)) {
    random = random * 1664525U + 1013904223U;
    if (random / 65536U % one_of != 0) (void)monitor->step(frame);
  }
  return monitor->health();
}

TEST(MonitorGap, FewLostFramesAreNoEffect) {
  const Health health = after_losing(3000);
  EXPECT_GT(health.frames_missing, 20U);
  EXPECT_EQ(health.gap.verdict, GapVerdict::kNoGap);
}

TEST(MonitorGap, ManyLostFramesAreOnlyThat) {
  const Health health = after_losing(500);
  EXPECT_GT(health.frames_missing, 100U);
  EXPECT_EQ(health.gap.verdict, GapVerdict::kEffect);
  EXPECT_EQ(health.gap.effect, Effect::kSampleDropout);
}

TEST(MonitorGap, NamesCoarseSteps) {
  const Health health =
      after({.effects = {test::gap_effect(Effect::kSensorQuantization, 4.0)}, .duration_s = 10.0});
  EXPECT_EQ(health.gap.verdict, GapVerdict::kEffect);
  EXPECT_EQ(health.gap.effect, Effect::kSensorQuantization);
}

std::unique_ptr<BoardMonitor> monitor_that_knows(const std::function<void(GapTuning&)>& know) {
  MonitorConfiguration configuration = test::gap_configuration();
  know(configuration.gap);
  auto monitor = std::make_unique<BoardMonitor>();
  EXPECT_TRUE(monitor->configure(configuration).ok());
  return monitor;
}

const GapRun kJittering{.effects = {test::gap_effect(Effect::kClockJitter, 2.0e-5)}, .duration_s = 20.0};

TEST(MonitorGap, NamesAClockThatJitters) {
  const Health health = after(kJittering);
  EXPECT_EQ(health.gap.verdict, GapVerdict::kEffect);
  EXPECT_EQ(health.gap.effect, Effect::kClockJitter);
  EXPECT_EQ(health.gap.where, gap::EffectGroup::kSampling);
}

TEST(MonitorGap, AKnownJitterIsNoise) {
  const auto monitor = monitor_that_knows([](GapTuning& gap) { gap.clock_jitter_s = 2.0e-5; });
  EXPECT_EQ(show(*monitor, kJittering).gap.verdict, GapVerdict::kNoGap);
}

TEST(MonitorGap, AKnownShareOfLostFramesIsNoEffect) {
  const GapRun losing{.effects = {test::gap_effect(Effect::kSampleDropout, 0.02)}, .duration_s = 10.0};
  EXPECT_EQ(after(losing).gap.effect, Effect::kSampleDropout);
  const auto monitor = monitor_that_knows([](GapTuning& gap) { gap.lost_share = 0.03; });
  EXPECT_NE(show(*monitor, losing).gap.verdict, GapVerdict::kEffect);
}

/// A sensor that fails again and again, for 20 ms out of each 120 ms, so that many stretches of the watch see
/// the beginning of a fault that is not known yet.
void expect_no_effect_of(Channel sensor, const std::function<void(SensorFrame&)>& fail) {
  auto monitor = new_monitor();
  bool was_a_fault = false;
  const Health health = show(*monitor, {.duration_s = 14.0}, [&](std::size_t i, SensorFrame& frame) {
    if (i % 1200 > 1000) fail(frame);
    was_a_fault |= monitor->health().state == HealthState::kSensorFault;
  });
  EXPECT_TRUE(was_a_fault) << info_of(sensor).column;
  EXPECT_NE(health.gap.verdict, GapVerdict::kEffect) << info_of(sensor).column;
  EXPECT_NE(health.gap.verdict, GapVerdict::kUnexplained) << info_of(sensor).column;
}

TEST(MonitorGap, ASensorThatFallsSilentIsNoEffect) {
  for (const Channel sensor :
       {Channel::kSpindleSpeed, Channel::kArmatureCurrent, Channel::kFeedSpeed, Channel::kArmatureVoltage})
    expect_no_effect_of(sensor, [sensor](SensorFrame& frame) { frame.clear(sensor); });
}

TEST(MonitorGap, ASensorThatFreezesIsNoEffect) {
  for (const Channel sensor : {Channel::kSpindleSpeed, Channel::kArmatureCurrent, Channel::kFeedSpeed})
    expect_no_effect_of(sensor, [sensor](SensorFrame& frame) { frame.set(sensor, 0.0013F); });
}

TEST(MonitorGap, SpikesAreNoEffect) {
  const Health health = after({.duration_s = 10.0}, [](std::size_t i, SensorFrame& frame) {
    if (i % 37 == 0) frame.set(Channel::kArmatureCurrent, frame.get(Channel::kArmatureCurrent) + 30.0F);
    if (i % 41 == 0) frame.set(Channel::kFeedSpeed, frame.get(Channel::kFeedSpeed) + 1.0F);
  });
  EXPECT_EQ(health.gap.verdict, GapVerdict::kNoGap);
}

TEST(MonitorGap, AWildFirstFrameIsNoEffect) {
  const Health health = after({.duration_s = 10.0}, [](std::size_t i, SensorFrame& frame) {
    if (i == 0) frame.set(Channel::kFeedSpeed, 1.0F);
  });
  EXPECT_EQ(health.gap.verdict, GapVerdict::kNoGap);
}

TEST(MonitorGap, AnInputThatIsMissingIsNotTheOneThatHeldLast) {
  const Health health = after({.duration_s = 6.0}, [](std::size_t i, SensorFrame& frame) {
    if (i % 100 == 0) frame.clear(Channel::kArmatureVoltage);
  });
  EXPECT_EQ(health.gap.verdict, GapVerdict::kNotEnoughData);
}

/// In the cut the tool takes twice of the nominal chip load; whether that was commanded is not known.
TEST(MonitorGap, DoesNotJudgeACutOfUnknownChipLoad) {
  MonitorConfiguration configuration = test::gap_configuration();
  configuration.machine.tool.chip_load_mm *= 0.5;
  auto monitor = std::make_unique<BoardMonitor>();
  ASSERT_TRUE(monitor->configure(configuration).ok());
  const auto forget = [](std::size_t, SensorFrame& frame) { frame.clear(Channel::kChipLoad); };
  const Health& health = show(*monitor, {.duration_s = 12.0}, forget);
  EXPECT_NE(health.gap.verdict, GapVerdict::kNotEnoughData);
  EXPECT_NE(health.gap.verdict, GapVerdict::kParameterError);
  EXPECT_NE(health.gap.verdict, GapVerdict::kUnexplained);
  EXPECT_NE(health.gap.verdict, GapVerdict::kEffect);
}

/// The tool needs the torque of a chip that is thicker than the command, on an axis with an effect.
std::size_t frames_of_state_beside_an_effect(HealthState state, float commanded_share) {
  MonitorConfiguration configuration = test::gap_configuration();
  configuration.wear.hold_s = 0.02;
  auto monitor = std::make_unique<BoardMonitor>();
  EXPECT_TRUE(monitor->configure(configuration).ok());
  std::size_t frames = 0;
  (void)show(*monitor, kBiased, [&](std::size_t, SensorFrame& frame) {
    frame.set(Channel::kChipLoad, commanded_share * frame.get(Channel::kChipLoad));
    const Health& before = monitor->health();
    frames += before.state == state && before.gap.verdict == GapVerdict::kEffect ? 1U : 0U;
  });
  return frames;
}

TEST(MonitorGap, AWornToolComesFirst) {
  EXPECT_GT(frames_of_state_beside_an_effect(HealthState::kWatch, 0.7F), 100U);
  EXPECT_GT(frames_of_state_beside_an_effect(HealthState::kReplace, 0.3F), 100U);
}

TEST(MonitorGap, AFaultComesFirst) {
  auto monitor = new_monitor();
  (void)show(*monitor, kBiased);
  ASSERT_EQ(monitor->health().state, HealthState::kModelGap);
  SensorFrame frame;
  frame.sequence = monitor->health().sequence;
  frame.time_us = monitor->health().time_us;
  for (int i = 0; i < 40; ++i) {
    ++frame.sequence;
    frame.time_us += 100;
    (void)monitor->step(frame);
  }
  EXPECT_EQ(monitor->health().state, HealthState::kSensorFault);
  EXPECT_EQ(monitor->health().gap.verdict, GapVerdict::kEffect) << "what was found stays found";
}

TEST(MonitorGap, ResetAndConfigureForget) {
  auto monitor = new_monitor();
  const auto first = test::bytes_of(show(*monitor, kBiased));
  ASSERT_EQ(monitor->health().gap.verdict, GapVerdict::kEffect);
  monitor->reset();
  EXPECT_EQ(monitor->health().gap.verdict, GapVerdict::kNotEnoughData);
  EXPECT_EQ(test::bytes_of(show(*monitor, kBiased)), first);
  ASSERT_TRUE(monitor->configure(test::gap_configuration()).ok());
  EXPECT_EQ(test::bytes_of(show(*monitor, kBiased)), first);
}

TEST(MonitorGap, TheStoredThresholdIsTheOneThatCounts) {
  MonitorConfiguration configuration = test::gap_configuration();
  configuration.gap.feed.evidence = 1.0e7;
  auto monitor = std::make_unique<BoardMonitor>();
  ASSERT_TRUE(monitor->configure(configuration).ok());
  EXPECT_NE(show(*monitor, kBiased).gap.verdict, GapVerdict::kEffect);
}

TEST(MonitorGap, RefusesImpossibleSettings) {
  const auto refusal = [](const std::function<void(GapTuning&)>& spoil) {
    MonitorConfiguration configuration = reference_configuration();
    spoil(configuration.gap);
    const ConfigurationResult result = std::make_unique<BoardMonitor>()->configure(configuration);
    EXPECT_FALSE(result.ok());
    return result.key;
  };
  EXPECT_EQ(refusal([](GapTuning& g) { g.speed_process_noise_rad_s = -1.0; }),
            "gap.speed_process_noise_rad_s");
  EXPECT_EQ(refusal([](GapTuning& g) { g.current_process_noise_a = -1.0; }), "gap.current_process_noise_a");
  EXPECT_EQ(refusal([](GapTuning& g) { g.feed_process_noise_m_s = -1.0; }), "gap.feed_process_noise_m_s");
  EXPECT_EQ(refusal([](GapTuning& g) { g.lost_share = -0.1; }), "gap.lost_share");
  EXPECT_EQ(refusal([](GapTuning& g) { g.lost_share = 1.1; }), "gap.lost_share");
  EXPECT_EQ(refusal([](GapTuning& g) { g.clock_jitter_s = -1.0e-6; }), "gap.clock_jitter_s");
  EXPECT_EQ(refusal([](GapTuning& g) { g.spindle.evidence = 0.0; }), "gap.spindle_evidence");
  EXPECT_EQ(refusal([](GapTuning& g) { g.spindle.temperature = 0.5; }), "gap.spindle_temperature");
  EXPECT_EQ(refusal([](GapTuning& g) { g.spindle.excitation = 0.0; }), "gap.spindle_excitation");
  EXPECT_EQ(refusal([](GapTuning& g) { g.feed.evidence = 0.0; }), "gap.feed_evidence");
  EXPECT_EQ(refusal([](GapTuning& g) { g.feed.temperature = 0.5; }), "gap.feed_temperature");
  EXPECT_EQ(refusal([](GapTuning& g) { g.feed.excitation = 0.0; }), "gap.feed_excitation");
  EXPECT_EQ(refusal([](GapTuning& g) { g.spindle.noise_ratio = 0.0; }), "gap.spindle_noise_ratio");
  EXPECT_EQ(refusal([](GapTuning& g) { g.feed.noise_ratio = -1.0; }), "gap.feed_noise_ratio");
  EXPECT_EQ(refusal([](GapTuning& g) { g.spindle.parameter_spread = 0.0; }), "gap.spindle_parameter_spread");
  EXPECT_EQ(refusal([](GapTuning& g) { g.feed.parameter_spread = -0.5; }), "gap.feed_parameter_spread");
  const auto refusal_of = [&refusal](gap::EffectForm form, std::uint32_t count = 1) {
    return refusal([&](GapTuning& g) {
      g.feed.forms.form.fill(form);
      g.feed.forms.count = count;
    });
  };
  using enum gap::Effect;
  EXPECT_EQ(refusal_of({.effect = kFeedCoulombFriction, .shape = 0.0F}), "gap.forms");
  EXPECT_EQ(refusal_of({.effect = kFeedSpeedDelay, .shape = 0.01F}), "gap.forms");
  EXPECT_EQ(refusal_of({.effect = kFeedSpring}, 5), "gap.forms");
  EXPECT_EQ(refusal_of({.effect = kFeedScrewPeriodic, .parts = 2}, 3), "gap.forms");
}

}  // namespace
}  // namespace morepro
