#include "lib/monitor/monitor.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <set>
#include <vector>

#include "tests/support/health_bytes.hpp"
#include "tests/support/spindle_frames.hpp"

namespace morepro {
namespace {

const MonitorConfiguration kReference = reference_configuration();

Health run(BoardMonitor& monitor, const std::vector<SensorFrame>& frames) {
  for (const auto& frame : frames) (void)monitor.step(frame);
  return monitor.health();
}

Health run(const std::vector<SensorFrame>& frames) {
  auto monitor = std::make_unique<BoardMonitor>();
  return run(*monitor, frames);
}

bool is_finite(const Health& h) {
  float sum = h.chip_load_mm + h.chip_load_standard_error_mm + h.selected_probability +
              h.spindle_speed_rad_s + h.feed_speed_m_s + h.armature_current_a + h.innovation_ratio;
  for (const auto& p : h.parameters) sum += p.value + p.standard_error;
  return std::isfinite(sum);
}

TEST(Monitor, SaysUndeterminedWithoutContact) {
  auto monitor = std::make_unique<BoardMonitor>();
  for (const auto& frame : test::frames_of(kReference, {.frames = 3000, .contact_frame = 3000})) {
    const Health& health = monitor->step(frame);
    ASSERT_EQ(health.chip_load_state, ChipLoadState::kUndetermined);
    ASSERT_EQ(health.state, HealthState::kNotEnoughData);
  }
  EXPECT_EQ(monitor->health().reason, static_cast<std::uint16_t>(ReasonCode::kWearNoContact));
}

TEST(Monitor, FindsTheChipLoadAndCallsASharpToolHealthy) {
  const Health health = run(test::frames_of(kReference, {}));
  EXPECT_EQ(health.state, HealthState::kHealthy);
  EXPECT_EQ(health.chip_load_state, ChipLoadState::kValid);
  EXPECT_EQ(health.selected_hypothesis, 3U);
  EXPECT_NEAR(health.chip_load_mm, 0.05F, 4.0F * health.chip_load_standard_error_mm);
  EXPECT_NEAR(health.innovation_ratio, 1.0F, 0.2F);
}

TEST(Monitor, CallsAToolWornThatCutsLikeAThickerChipAndKeepsSayingSo) {
  auto monitor = std::make_unique<BoardMonitor>();
  (void)run(*monitor,
            test::frames_of(kReference, {.frames = 6000, .chip_load_mm = 0.1, .commanded_mm = 0.05}));
  EXPECT_EQ(monitor->health().state, HealthState::kReplace);
  const auto later =
      test::frames_of(kReference, {.contact_frame = 100, .first_sequence = 6000, .first_time_us = 600000});
  EXPECT_EQ(run(*monitor, later).state, HealthState::kReplace) << "wear does not heal";
  monitor->tool_changed();
  (void)monitor->step(later.back());
  const auto more =
      test::frames_of(kReference, {.contact_frame = 100, .first_sequence = 12000, .first_time_us = 1200000});
  EXPECT_EQ(run(*monitor, more).state, HealthState::kHealthy);
}

TEST(Monitor, WatchesAToolWhoseLoadIsRaised) {
  const Health health = run(test::frames_of(kReference, {.chip_load_mm = 0.068, .commanded_mm = 0.05}));
  EXPECT_EQ(health.state, HealthState::kWatch);
  EXPECT_EQ(health.reason, static_cast<std::uint16_t>(ReasonCode::kWearLoadRaised));
}

TEST(Monitor, WatchesAToolThatCutsTooLittle) {
  const Health health = run(test::frames_of(kReference, {.chip_load_mm = 0.021, .commanded_mm = 0.05}));
  EXPECT_EQ(health.state, HealthState::kWatch);
  EXPECT_EQ(health.reason, static_cast<std::uint16_t>(ReasonCode::kWearLoadLow));
}

TEST(Monitor, NeverSaysReplaceWithoutTheCommandedChipLoad) {
  auto frames = test::frames_of(kReference, {.chip_load_mm = 0.1});
  for (auto& frame : frames) frame.clear(Channel::kChipLoad);
  const Health health = run(frames);
  EXPECT_EQ(health.state, HealthState::kWatch);
  EXPECT_EQ(health.reason, static_cast<std::uint16_t>(ReasonCode::kWearNoReference));
}

TEST(Monitor, SaysNotEnoughDataWhenASensorWasNeverThere) {
  for (Channel missing : {Channel::kArmatureVoltage, Channel::kSpindleSpeed, Channel::kArmatureCurrent}) {
    auto frames = test::frames_of(kReference, {});
    for (auto& frame : frames) frame.clear(missing);
    const Health health = run(frames);
    EXPECT_EQ(health.state, HealthState::kNotEnoughData) << info_of(missing).column;
    EXPECT_EQ(health.chip_load_state, ChipLoadState::kUndetermined) << info_of(missing).column;
  }
}

TEST(Monitor, DoesNotCallAToolIdleWhoseContactNobodyRecords) {
  auto frames = test::frames_of(kReference, {.frames = 3000, .contact_frame = 3000});
  for (auto& frame : frames) frame.clear(Channel::kContact);
  EXPECT_EQ(run(frames).reason, static_cast<std::uint16_t>(ReasonCode::kSensorMissing));
}

TEST(Monitor, NoValueOfAnyFieldMakesAnOutputNotANumber) {
  const auto frames = test::frames_of(kReference, {.frames = 3000});
  const float bad_values[] = {
      std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::signaling_NaN(),
      std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()};
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    for (float bad : bad_values) {
      auto damaged = frames;
      for (std::size_t k = 2200; k < 2230; ++k) damaged[k].set(static_cast<Channel>(i), bad);
      auto monitor = std::make_unique<BoardMonitor>();
      for (std::size_t k = 0; k < damaged.size(); ++k) {
        const Health& health = monitor->step(damaged[k]);
        ASSERT_TRUE(is_finite(health)) << kChannels[i].column << " frame " << k;
        if (k == 2280) {
          ASSERT_NEAR(health.spindle_speed_rad_s, frames[k].get(Channel::kSpindleSpeed), 5.0F)
              << "back within 50 frames";
        }
      }
      EXPECT_EQ(monitor->health().frames_accepted, frames.size());
    }
  }
}

/// A cut with a feed axis at rest that stands somewhere else every `jump_frames`, as no model explains it.
std::vector<SensorFrame> frames_with_a_jumping_feed(int frames, int jump_frames) {
  const auto& feed = kReference.machine.feed;
  const auto cutting_n = static_cast<float>(feed.contact_force_n + feed.contact_offset_n);
  auto cut = test::frames_of(kReference, {.frames = frames});
  for (std::size_t k = 0; k < cut.size(); ++k) {
    const auto jumps = static_cast<int>(k) / jump_frames;
    cut[k].clear(Channel::kFeedSpeed);
    cut[k].set(Channel::kFeedForce, cut[k].get(Channel::kContact) * cutting_n);
    cut[k].set(Channel::kFeedPosition, static_cast<float>(jumps % 2));
  }
  return cut;
}

TEST(Monitor, AFeedAxisThatIsLostAgainAndAgainIsNoFaultOfTheSpindle) {
  const Health health = run(frames_with_a_jumping_feed(6000, 900));
  EXPECT_EQ(health.state, HealthState::kModelGap);
  EXPECT_EQ(health.reason, static_cast<std::uint16_t>(ReasonCode::kModelFeedResidual));
  EXPECT_EQ(health.chip_load_state, ChipLoadState::kValid) << "the feed is no part of it";
}

TEST(Monitor, AFeedAxisWithoutASpindleIsNotAnsweredAsASpindle) {
  auto frames = frames_with_a_jumping_feed(6000, 900);
  for (auto& frame : frames) {
    frame.clear(Channel::kArmatureVoltage);
    frame.clear(Channel::kSpindleSpeed);
    frame.clear(Channel::kArmatureCurrent);
  }
  EXPECT_EQ(run(frames).reason, static_cast<std::uint16_t>(ReasonCode::kModelFeedResidual));
}

TEST(Monitor, RemembersTheRestartsOfAnAxisForItsOwnFrames) {
  const auto kGap = static_cast<std::uint16_t>(ReasonCode::kModelFeedResidual);
  EXPECT_EQ(run(frames_with_a_jumping_feed(18000, 4000)).reason, kGap);
  EXPECT_NE(run(frames_with_a_jumping_feed(24500, 5500)).reason, kGap) << "each an accident";
}

TEST(Monitor, RejectsAnInRangeSpike) {
  auto frames = test::frames_of(kReference, {});
  const Health clean = run(frames);
  frames[4000].set(Channel::kArmatureCurrent, 60.0F);
  frames[4100].set(Channel::kSpindleSpeed, -300.0F);
  auto monitor = std::make_unique<BoardMonitor>();
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const Health& health = monitor->step(frames[k]);
    if (k == 4000) {
      EXPECT_EQ(health.rejected_channels, bit_of(Channel::kArmatureCurrent));
    }
    if (k == 4100) {
      EXPECT_EQ(health.rejected_channels, bit_of(Channel::kSpindleSpeed));
    }
    if (k >= 4000) {
      ASSERT_EQ(health.state, HealthState::kHealthy) << k;
    }
  }
  EXPECT_NEAR(monitor->health().chip_load_mm, clean.chip_load_mm, clean.chip_load_standard_error_mm);
}

TEST(Monitor, FindsADeadSensorAndStopsJudging) {
  for (Channel dead : {Channel::kSpindleSpeed, Channel::kArmatureCurrent}) {
    auto frames = test::frames_of(kReference, {});
    for (std::size_t k = 4000; k < frames.size(); ++k) frames[k].set(dead, 0.0F);
    auto monitor = std::make_unique<BoardMonitor>();
    int found = -1;
    for (std::size_t k = 0; k < frames.size(); ++k) {
      const Health& health = monitor->step(frames[k]);
      if (found < 0 && health.state == HealthState::kSensorFault) found = static_cast<int>(k);
    }
    EXPECT_EQ(monitor->health().state, HealthState::kSensorFault) << info_of(dead).column;
    EXPECT_GE(found, 4000);
    EXPECT_LE(found, 4100) << info_of(dead).column;
  }
}

TEST(Monitor, NeverCallsASharpToolWornBecauseTheDatasheetIsOff) {
  using Spindle = MachineParameters::Spindle;
  for (auto key :
       {&Spindle::torque_constant_nm_a, &Spindle::back_emf_constant_vs_rad, &Spindle::resistance_ohm,
        &Spindle::viscous_friction_nms_rad, &Spindle::inertia_kgm2, &Spindle::inductance_h}) {
    for (double factor : {0.95, 1.05}) {
      for (const auto& truth : {reference_configuration(), thesis_configuration()}) {
        auto datasheet = truth;
        datasheet.machine.spindle.*key *= factor;
        const double chip_load_mm = truth.machine.tool.chip_load_mm;
        auto monitor = std::make_unique<BoardMonitor>();
        ASSERT_TRUE(monitor->configure(datasheet).ok());
        const auto cut = test::frames_of(
            truth, {.frames = 8000, .chip_load_mm = chip_load_mm, .commanded_mm = chip_load_mm});
        EXPECT_NE(run(*monitor, cut).state, HealthState::kReplace) << factor;
      }
    }
  }
}

TEST(Monitor, ATransientFaultDoesNotWearTheTool) {
  auto frames = test::frames_of(kReference, {.frames = 12000});
  for (std::size_t k = 4000; k < 9000; ++k)
    frames[k].set(Channel::kArmatureCurrent, 1.3F * frames[k].get(Channel::kArmatureCurrent));
  EXPECT_EQ(run(frames).state, HealthState::kHealthy);
  for (std::size_t k = 4000; k < 9000; ++k) frames[k].set(Channel::kToolTemperature, 900.0F);
  auto monitor = std::make_unique<BoardMonitor>();
  for (std::size_t k = 0; k < 8000; ++k) (void)monitor->step(frames[k]);
  EXPECT_EQ(monitor->health().state, HealthState::kSensorFault) << "a thermocouple that broke";
}

TEST(Monitor, WhatWasSeenBeforeAFaultDoesNotCountAfterIt) {
  auto frames = test::frames_of(kReference, {.frames = 8000, .chip_load_mm = 0.1, .commanded_mm = 0.05});
  auto monitor = std::make_unique<BoardMonitor>();
  std::size_t worn = 0;
  while (worn < frames.size() && monitor->step(frames[worn]).state != HealthState::kReplace) ++worn;
  ASSERT_LT(worn, 7000U);
  for (std::size_t k = worn - 100; k < worn - 60; ++k) frames[k].clear(Channel::kArmatureCurrent);
  frames.resize(worn + 500);
  EXPECT_NE(run(frames).state, HealthState::kReplace) << "less than 0.1 s on either side of the break";
}

TEST(Monitor, SilenceOfAnyChannelIsNotHealth) {
  for (Channel silent : {Channel::kArmatureVoltage, Channel::kContact, Channel::kSpindleSpeed,
                         Channel::kArmatureCurrent, Channel::kToolTemperature, Channel::kChipLoad}) {
    for (int works_every : {0, 50}) {
      auto frames = test::frames_of(kReference, {});
      for (std::size_t k = 4000; k < frames.size(); ++k)
        if (works_every == 0 || k % static_cast<std::size_t>(works_every) != 0) frames[k].clear(silent);
      auto monitor = std::make_unique<BoardMonitor>();
      for (std::size_t k = 0; k < frames.size(); ++k) {
        const Health& health = monitor->step(frames[k]);
        if (k < 4100) continue;
        ASSERT_EQ(health.state, HealthState::kSensorFault) << info_of(silent).column << " " << k;
        ASSERT_EQ(health.chip_load_state, ChipLoadState::kUndetermined) << info_of(silent).column << " " << k;
      }
    }
  }
}

TEST(Monitor, SaysNothingOfTheToolOutsideTheContactLaw) {
  auto slow = kReference;
  slow.machine.tool.diameter_mm = 3.0;
  auto monitor = std::make_unique<BoardMonitor>();
  ASSERT_TRUE(monitor->configure(slow).ok());
  const Health health = run(*monitor, test::frames_of(slow, {}));
  EXPECT_EQ(health.state, HealthState::kNotEnoughData);
  EXPECT_EQ(health.reason, static_cast<std::uint16_t>(ReasonCode::kModelOutsideLaw));
  EXPECT_EQ(health.chip_load_state, ChipLoadState::kUndetermined);
}

TEST(Monitor, CallsAWrongModelAGap) {
  auto wrong = kReference;
  wrong.machine.spindle.back_emf_constant_vs_rad *= 1.3;
  auto monitor = std::make_unique<BoardMonitor>();
  ASSERT_TRUE(monitor->configure(wrong).ok());
  EXPECT_EQ(run(*monitor, test::frames_of(kReference, {.contact_frame = 5000})).state,
            HealthState::kModelGap);
}

TEST(Monitor, DuplicatesAndStragglersChangeNoBit) {
  const auto frames = test::frames_of(kReference, {});
  std::vector<SensorFrame> untidy;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    untidy.push_back(frames[k]);
    if (k % 7 == 3) untidy.push_back(frames[k]);
    if (k % 11 == 5) untidy.push_back(frames[k - 2]);
  }
  auto monitor = std::make_unique<BoardMonitor>();
  Health health = run(*monitor, untidy);
  EXPECT_EQ(health.frames_rejected, untidy.size() - frames.size());
  health.frames_rejected = 0;
  EXPECT_EQ(test::bytes_of(health), test::bytes_of(run(frames)));
}

TEST(Monitor, TheWrapOfTheClockChangesNoBit) {
  const auto at_zero = test::frames_of(kReference, {});
  const auto at_wrap = test::frames_of(kReference, {.first_time_us = 0U - 300000U});
  Health wrapped = run(at_wrap);
  wrapped.time_us = at_zero.back().time_us;
  EXPECT_EQ(test::bytes_of(wrapped), test::bytes_of(run(at_zero)));
}

TEST(Monitor, StaysRightWhileFramesAreLost) {
  const auto frames = test::frames_of(kReference, {});
  for (double loss : {0.01, 0.1, 0.3, 0.5}) {
    std::mt19937 random(3);
    std::vector<SensorFrame> received;
    for (const auto& frame : frames)
      if (std::uniform_real_distribution<>()(random) >= loss) received.push_back(frame);
    const Health health = run(received);
    EXPECT_NEAR(health.chip_load_mm, 0.05F, 4.0F * health.chip_load_standard_error_mm) << loss;
    EXPECT_EQ(health.state, HealthState::kHealthy) << loss;
    EXPECT_NEAR(static_cast<double>(health.frames_missing), loss * 6000.0, 200.0);
  }
}

TEST(Monitor, RefusesImpossibleConfigurationsAndKeepsTheOldOne) {
  BoardMonitor monitor;
  auto bad = kReference;
  bad.machine.spindle.inertia_kgm2 = -1.0;
  const auto result = monitor.configure(bad);
  EXPECT_EQ(result.error, ConfigurationError::kNotPositive);
  EXPECT_EQ(result.key, "spindle.inertia_kgm2");
  EXPECT_EQ(monitor.configuration().machine.spindle.inertia_kgm2, kReference.machine.spindle.inertia_kgm2);

  bad = kReference;
  bad.grid.first_mm = 0.001;
  EXPECT_EQ(monitor.configure(bad).error, ConfigurationError::kHypothesisOutsideLaw);
  bad = kReference;
  bad.grid.count = 12;
  EXPECT_EQ(monitor.configure(bad).error, ConfigurationError::kHypothesisCount);
  bad = kReference;
  bad.sampling.rate_hz = 50.0;
  EXPECT_EQ(monitor.configure(bad).error, ConfigurationError::kSamplingRate);
  bad = kReference;
  bad.machine.thermal.melting_degc = 100.0;
  EXPECT_EQ(monitor.configure(bad).error, ConfigurationError::kThermalRange);
  bad = kReference;
  bad.machine.spindle.resistance_ohm = 1.0e300;
  EXPECT_EQ(monitor.configure(bad).error, ConfigurationError::kMagnitude);
  bad = kReference;
  bad.sensors[Channel::kSpindleSpeed].noise = 1.0e30;
  EXPECT_EQ(monitor.configure(bad).error, ConfigurationError::kMagnitude);
  bad = kReference;
  bad.machine.feed.mass_kg = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(monitor.configure(bad).error, ConfigurationError::kNotFinite);
}

TEST(Monitor, EveryRuleFindsTheChipLoad) {
  for (DecisionRule rule : {DecisionRule::kMarkov, DecisionRule::kBayesian, DecisionRule::kThesis}) {
    auto configuration = thesis_configuration();
    configuration.rule = rule;
    auto monitor = std::make_unique<BoardMonitor>();
    ASSERT_TRUE(monitor->configure(configuration).ok());
    const Health health =
        run(*monitor, test::frames_of(configuration, {.chip_load_mm = 0.6, .commanded_mm = 0.6}));
    EXPECT_EQ(health.selected_hypothesis, 5U) << static_cast<int>(rule);
  }
}

TEST(Monitor, ResetForgetsEverything) {
  const auto frames = test::frames_of(kReference, {});
  auto monitor = std::make_unique<BoardMonitor>();
  const auto first = test::bytes_of(run(*monitor, frames));
  monitor->reset();
  EXPECT_EQ(test::bytes_of(run(*monitor, frames)), first);
}

TEST(Reason, EveryCodeHasItsOwnText) {
  std::set<std::string_view> names;
  for (auto code : {ReasonCode::kSensorMissing, ReasonCode::kSensorStuck, ReasonCode::kSensorNotFinite,
                    ReasonCode::kSensorOutOfRange, ReasonCode::kSensorJump, ReasonCode::kModelResidual,
                    ReasonCode::kModelFeedResidual, ReasonCode::kModelOutsideLaw, ReasonCode::kModelEffect,
                    ReasonCode::kModelUnexplained, ReasonCode::kWearNoContact, ReasonCode::kWearSettling,
                    ReasonCode::kWearAsCommanded, ReasonCode::kWearLoadRaised, ReasonCode::kWearLoadHigh,
                    ReasonCode::kWearNoReference, ReasonCode::kWearLoadLow}) {
    const auto& text = text_of(code);
    EXPECT_EQ(text.code, code);
    EXPECT_FALSE(text.sentence.empty() || text.cause.empty() || text.next_step.empty()) << text.name;
    EXPECT_TRUE(names.insert(text.name).second) << text.name;
  }
}

}  // namespace
}  // namespace morepro
