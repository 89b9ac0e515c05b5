#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "lib/gap/effect_catalogue.hpp"
#include "lib/gap/effect_size.hpp"
#include "sim_host/simulate/operating_point.hpp"
#include "sim_host/simulate/simulation.hpp"
#include "tests/support/effect_sizes.hpp"
#include "tests/support/reference_effect.hpp"

namespace morepro::host {
namespace {

using gap::Effect;
using gap::EffectGroup;
using test::effect;

using Frames = std::vector<SensorFrame>;

Frames run(const SimulationOptions& options) {
  Simulation simulation(reference_configuration(), options);
  Frames frames;
  for (SensorFrame frame; simulation.next(frame);) frames.push_back(frame);
  return frames;
}

/// Forward with contact and steps of chip load and engagement, through a reversal, backward.
SimulationOptions rich(std::vector<gap::AppliedEffect> effects) {
  return {.profile = ProfileKind::kRich, .duration_s = 1.2, .effects = std::move(effects)};
}

double rms_difference(const Frames& a, const Frames& b, Channel channel, std::size_t first = 0,
                      std::size_t last = ~std::size_t{0}) {
  double sum = 0.0;
  const std::size_t end = std::min({a.size(), b.size(), last});
  for (std::size_t k = first; k < end; ++k)
    sum += std::pow(static_cast<double>(a[k].get(channel)) - static_cast<double>(b[k].get(channel)), 2);
  return std::sqrt(sum / static_cast<double>(end - first));
}

const Frames& nominal() {
  static const Frames frames = run(rich({}));
  return frames;
}

/// Does a channel differ by more than what a float's last bit makes of another sub-step?
bool differs(const Frames& frames, Channel channel) {
  const double scale = channel == Channel::kSpindleSpeed      ? 500.0
                       : channel == Channel::kArmatureCurrent ? 10.0
                                                              : 0.02;
  return rms_difference(frames, nominal(), channel) > 1.0e-6 * scale;
}

bool concerns_spindle(Effect name) {
  const EffectGroup group = gap::info_of(name).group;
  return group == EffectGroup::kSpindleTorque || group == EffectGroup::kArmatureVoltage;
}

TEST(SimulatedEffect, OfTheSpindleLeavesTheFeedAloneAndTheOtherWayRound) {
  for (const gap::EffectInfo& info : gap::kEffects) {
    if (info.group == EffectGroup::kSensor || info.group == EffectGroup::kSampling) continue;
    const Frames frames = run(rich({effect(info.effect, gap::visible_size(info.effect))}));
    const bool is_spindle = concerns_spindle(info.effect);
    EXPECT_EQ(differs(frames, Channel::kSpindleSpeed), is_spindle) << info.name;
    EXPECT_EQ(differs(frames, Channel::kArmatureCurrent), is_spindle) << info.name;
    EXPECT_EQ(differs(frames, Channel::kFeedSpeed), !is_spindle) << info.name;
  }
}

TEST(SimulatedEffect, OfASensorIsSeenInThatSensorOnly) {
  for (const gap::EffectInfo& info : gap::kEffects) {
    if (info.group != EffectGroup::kSensor || info.effect == Effect::kSensorQuantization) continue;
    const Frames frames = run(rich({effect(info.effect, gap::visible_size(info.effect))}));
    const bool is_speed = info.name.starts_with("spindle") || info.effect == Effect::kEncoderEccentricity;
    const bool is_feed = info.name.starts_with("feed");
    EXPECT_EQ(differs(frames, Channel::kSpindleSpeed), is_speed) << info.name;
    EXPECT_EQ(differs(frames, Channel::kArmatureCurrent), !is_speed && !is_feed) << info.name;
    EXPECT_EQ(differs(frames, Channel::kFeedSpeed), is_feed) << info.name;
  }
}

TEST(SimulatedEffect, OfSizeZeroIsNotThere) {
  for (const gap::EffectInfo& info : gap::kEffects) {
    const Frames frames = run(rich({effect(info.effect, 0.0)}));
    ASSERT_EQ(frames.size(), nominal().size()) << info.name;
    for (std::size_t k = 0; k < frames.size(); ++k)
      ASSERT_EQ(frames[k].value, nominal()[k].value) << info.name << " at row " << k;
  }
}

TEST(SimulatedEffect, BeginsAtItsOnset) {
  constexpr std::size_t kOnset = 3500;
  for (const gap::EffectInfo& info : gap::kEffects) {
    if (info.effect == Effect::kSampleDropout) continue;
    const Frames frames = run(rich({effect(info.effect, gap::visible_size(info.effect), 0.35)}));
    double before = 0.0, after = 0.0;
    for (const Channel channel : {Channel::kSpindleSpeed, Channel::kFeedSpeed, Channel::kArmatureCurrent}) {
      before += rms_difference(frames, nominal(), channel, 0, kOnset);
      after += rms_difference(frames, nominal(), channel, kOnset);
    }
    // Another number of sub-steps moves the last bits of the speed, some 500 rad/s.
    EXPECT_LT(before, 1.0e-3) << info.name;
    EXPECT_GT(after, std::max(1.0e-5, 10.0 * before)) << info.name;
  }
}

TEST(SimulatedEffect, StaysFiniteOnBothMachinesInEveryProfile) {
  for (const bool is_thesis : {false, true}) {
    const MonitorConfiguration configuration = is_thesis ? thesis_configuration() : reference_configuration();
    const gap::EffectScales<double> scales(configuration.machine, reference_point_of(configuration.machine));
    for (const gap::EffectInfo& info : gap::kEffects) {
      for (const ProfileKind kind : {ProfileKind::kRich, ProfileKind::kProduction}) {
        // The thesis machine takes 100 A and more: a tenth of what the reference machine shows is enough.
        const double size = (is_thesis ? 0.1 : 1.0) * gap::visible_size(info.effect);
        const auto one = gap::applied(info.effect, size, scales);
        Simulation simulation(configuration, {.profile = kind, .duration_s = 0.2, .effects = {one}});
        int rows = 0;
        for (SensorFrame frame; simulation.next(frame); ++rows) {
          for (const float value : frame.value) ASSERT_TRUE(std::isfinite(value)) << info.name;
          ASSERT_LT(std::fabs(frame.get(Channel::kSpindleSpeed)), 3000.0F) << info.name;
        }
        EXPECT_GT(rows, 1000) << info.name;
      }
    }
  }
}

TEST(SimulatedEffect, AllAtOnceStayFinite) {
  std::vector<gap::AppliedEffect> all;
  for (const gap::EffectInfo& info : gap::kEffects)
    all.push_back(effect(info.effect, 0.3 * gap::visible_size(info.effect)));
  for (const SensorFrame& frame : run(rich(all))) {
    for (const float value : frame.value) ASSERT_TRUE(std::isfinite(value));
  }
}

TEST(SimulatedEffect, QuantisesToTheStatedStep) {
  // The reference machine's sensors have no last bit: 4 standard deviations of 1 rad/s and of 0.05 A.
  for (const SensorFrame& frame : run(rich({effect(Effect::kSensorQuantization, 4.0)}))) {
    EXPECT_EQ(std::remainder(frame.get(Channel::kSpindleSpeed), 4.0F), 0.0F);
    EXPECT_NEAR(std::remainder(frame.get(Channel::kArmatureCurrent), 0.2F), 0.0F, 1e-5F);
  }
}

TEST(SimulatedEffect, LosesTheStatedFractionOfTheRowsAndKeepsTheOthers) {
  const Frames frames = run(rich({effect(Effect::kSampleDropout, 0.1)}));
  // 12000 rows: five standard errors of a count with a mean of 1200.
  EXPECT_NEAR(static_cast<double>(frames.size()), 10800.0, 5.0 * std::sqrt(1080.0));
  for (const SensorFrame& frame : frames) EXPECT_EQ(frame.value, nominal()[frame.sequence].value);
}

TEST(SimulatedEffect, NeverLosesTheFirstRow) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    SimulationOptions options = rich({effect(Effect::kSampleDropout, 0.999)});
    options.seed = seed;
    EXPECT_EQ(run(options).front().sequence, 0U);
  }
}

TEST(SimulatedEffect, JitterIsTheSlopeTimesTheStatedTime) {
  constexpr double kJitterS = 1.0e-5;
  const Frames frames = run(rich({effect(Effect::kClockJitter, kJitterS)}));
  double slope2 = 0.0;
  for (std::size_t k = 1; k < frames.size(); ++k) {
    EXPECT_EQ(frames[k].time_us, nominal()[k].time_us);
    const double step = static_cast<double>(nominal()[k].get(Channel::kSpindleSpeed)) -
                        static_cast<double>(nominal()[k - 1].get(Channel::kSpindleSpeed));
    // Noise of 1 rad/s in each of the two samples.
    slope2 += (step * step - 2.0) / 1.0e-8;
  }
  const double expected = kJitterS * std::sqrt(slope2 / static_cast<double>(frames.size()));
  // 12000 draws give 1 %; the noise makes the slope's power uncertain by some 5 %.
  EXPECT_NEAR(rms_difference(frames, nominal(), Channel::kSpindleSpeed), expected, 0.1 * expected);
}

TEST(SimulatedEffect, ControllersSeeWhatTheSensorsShow) {
  // The speed controller removes a bias of its own sensor: the true speed is wrong by it, the shown one is
  // not.
  const SimulationOptions options{.profile = ProfileKind::kProduction,
                                  .duration_s = 2.0,
                                  .effects = {effect(Effect::kSpindleSpeedBias, 10.0)}};
  const Frames frames = run(options);
  double shown = 0.0, voltage = 0.0;
  for (std::size_t k = 15000; k < 20000; ++k) {
    shown += static_cast<double>(frames[k].get(Channel::kSpindleSpeed)) / 5000.0;
    voltage += static_cast<double>(frames[k].get(Channel::kArmatureVoltage)) / 5000.0;
  }
  EXPECT_NEAR(shown, 577.7, 0.5);
  // Back-EMF of the 10 rad/s that are missing, 0.8 V, less what the lower friction and cut change.
  EXPECT_NEAR(voltage, 48.0 - 0.8, 0.1);
}

TEST(ProcessNoise, MovesTheSpeedsAndIsNotRecorded) {
  SimulationOptions options = rich({});
  options.process_noise = 0.2;
  const Frames frames = run(options);
  EXPECT_TRUE(differs(frames, Channel::kSpindleSpeed));
  EXPECT_TRUE(differs(frames, Channel::kArmatureCurrent));
  EXPECT_TRUE(differs(frames, Channel::kFeedSpeed));
  for (std::size_t k = 0; k < frames.size(); ++k)
    EXPECT_EQ(frames[k].get(Channel::kArmatureVoltage), nominal()[k].get(Channel::kArmatureVoltage));
}

TEST(ProcessNoise, HasTheStatedSize) {
  // One torque of 0.2 x 1 rad/s in 1 ms: 0.2 x 1000 rad/s2, Ornstein-Uhlenbeck.
  Disturbance disturbance(reference_configuration(), 0.2, 1.0e-4, 1);
  double sum2 = 0.0, lagged = 0.0, last = disturbance.next().acceleration_rad_s2;
  constexpr int kCount = 200000;
  for (int i = 0; i < kCount; ++i) {
    const double value = disturbance.next().acceleration_rad_s2;
    sum2 += value * value / kCount;
    lagged += value * last / kCount;
    last = value;
  }
  // 10000 independent values: five standard errors of the variance are 7 %.
  EXPECT_NEAR(sum2, 200.0 * 200.0, 0.07 * 200.0 * 200.0);
  EXPECT_NEAR(lagged / sum2, std::exp(-0.1), 0.01);
}

TEST(ReferencePoint, IsUsableForEveryMachine) {
  MachineParameters without_cut = reference_machine();
  without_cut.contact = {.edge_force_n = 0.0, .chip_force_n_mm = 0.0, .radius_m = 0.0};
  without_cut.spindle.viscous_friction_nms_rad = 0.0;
  without_cut.tool.chip_load_mm = 0.0;
  MachineParameters too_fast = reference_machine();
  too_fast.tool.diameter_mm = 1.0e-3;
  for (const MachineParameters& machine : {reference_machine(), thesis_machine(), without_cut, too_fast}) {
    const gap::ReferencePoint point = reference_point_of(machine);
    for (const double value :
         {point.speed_rad_s, point.current_a, point.feed_speed_m_s, point.chip_load_mm}) {
      EXPECT_GT(value, 0.0);
      EXPECT_LT(value, 1.0e5);
    }
    EXPECT_EQ(point.winding_degc, 25.0);
  }
  EXPECT_NEAR(reference_point_of(reference_machine()).current_a, 2.226, 0.01);
}

}  // namespace
}  // namespace morepro::host
