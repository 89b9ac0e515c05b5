#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <random>
#include <string>

#include "lib/gap/effect_size.hpp"
#include "lib/monitor/monitor.hpp"
#include "tests/support/reference_effect.hpp"
#include "tests/support/spindle_frames.hpp"

namespace morepro {
namespace {

using test::effect;

bool is_sound(const Health& h) {
  float sum = h.chip_load_mm + h.chip_load_standard_error_mm + h.selected_probability +
              h.spindle_speed_rad_s + h.feed_speed_m_s + h.armature_current_a + h.innovation_ratio;
  for (const auto& p : h.parameters) sum += p.value + p.standard_error;
  return std::isfinite(sum) && h.chip_load_standard_error_mm >= 0.0F && h.chip_load_mm >= 0.0F &&
         h.selected_probability >= 0.0F && h.selected_probability <= 1.0F + 1.0e-5F;
}

/// Frames as no machine makes them: any bits, any value in range, any order, channels that come and go.
class WildFrames {
 public:
  explicit WildFrames(unsigned seed) : random_(seed) {}

  SensorFrame next() {
    frame_.sequence += chance(0.02) ? static_cast<std::uint32_t>(random_()) : 1U;
    frame_.time_us += chance(0.02) ? static_cast<std::uint32_t>(random_()) : 100U;
    if (chance(0.01)) calm_ = !calm_;
    for (std::size_t i = 0; i < kChannelCount; ++i) {
      if (chance(0.02)) frame_.clear(static_cast<Channel>(i));
      if (chance(calm_ ? 0.01 : 0.5)) frame_.set(static_cast<Channel>(i), value(i));
    }
    return frame_;
  }

 private:
  bool chance(double p) { return std::uniform_real_distribution<>()(random_) < p; }

  float value(std::size_t i) {
    if (chance(0.05)) return std::bit_cast<float>(static_cast<std::uint32_t>(random_()));
    if (chance(0.2)) return chance(0.5) ? kChannels[i].lowest : kChannels[i].highest;
    const float scale = chance(0.5) ? 1.0F : 1.0e-3F;
    return scale * std::uniform_real_distribution<float>(kChannels[i].lowest, kChannels[i].highest)(random_);
  }

  std::mt19937 random_;
  SensorFrame frame_;
  bool calm_ = false;
};

class Wild : public testing::TestWithParam<MonitorConfiguration> {};

TEST_P(Wild, FramesOfAnyKindLeaveTheMonitorSound) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    auto monitor = std::make_unique<BoardMonitor>();
    ASSERT_TRUE(monitor->configure(GetParam()).ok());
    WildFrames frames(seed);
    for (int k = 0; k < 100000; ++k) {
      ASSERT_TRUE(is_sound(monitor->step(frames.next()))) << "seed " << seed << " frame " << k;
    }
    const auto cut = test::frames_of(GetParam(), {.chip_load_mm = GetParam().machine.tool.chip_load_mm,
                                                  .commanded_mm = GetParam().machine.tool.chip_load_mm});
    monitor->reset();
    for (const auto& frame : cut) (void)monitor->step(frame);
    EXPECT_EQ(monitor->health().state, HealthState::kHealthy) << "after a reset it is as new";
  }
}

TEST_P(Wild, RecoversWithoutAResetWhenTheMachineComesBack) {
  const double chip_load_mm = GetParam().machine.tool.chip_load_mm;
  auto monitor = std::make_unique<BoardMonitor>();
  ASSERT_TRUE(monitor->configure(GetParam()).ok());
  const auto cut = test::frames_of(
      GetParam(), {.frames = 12000, .chip_load_mm = chip_load_mm, .commanded_mm = chip_load_mm});
  WildFrames frames(9);
  for (int k = 0; k < 5000; ++k) {
    SensorFrame frame = frames.next();
    // A channel that was there and is not in the cut would be a fault.
    frame.present = static_cast<std::uint16_t>(frame.present & cut.front().present);
    (void)monitor->step(frame);
  }
  monitor->tool_changed();
  for (const auto& frame : cut) (void)monitor->step(frame);
  EXPECT_EQ(monitor->health().chip_load_state, ChipLoadState::kValid);
  EXPECT_NEAR(static_cast<double>(monitor->health().chip_load_mm), chip_load_mm,
              4.0 * static_cast<double>(monitor->health().chip_load_standard_error_mm));
}

MonitorConfiguration with_effects(const MachineEffects& effects) {
  MonitorConfiguration configuration = reference_configuration();
  configuration.effects = effects;
  return configuration;
}

/// So small that a machine without them is sound, each with a memory or a law that wild frames drive far.
const MachineEffects kRemembering{
    .effect = {effect(gap::Effect::kShaftCompliance, 3000.0), effect(gap::Effect::kCurrentBandwidth, 2.0e-5),
               effect(gap::Effect::kFeedPresliding, 0.1), effect(gap::Effect::kSpindleSpeedDelay, 2.0e-5)},
    .count = 4};
const MachineEffects kSteep{.effect = {effect(gap::Effect::kSpindleCoulombFriction, 1.0e-4),
                                       effect(gap::Effect::kBrushVoltageDrop, 1.0e-3),
                                       effect(gap::Effect::kTorqueConstantSaturation, 1.0e-6),
                                       effect(gap::Effect::kFeedForceSaturation, 1.0e-9)},
                            .count = 4};

std::string name_of(const testing::TestParamInfo<MonitorConfiguration>& instance) {
  constexpr std::array kNames{"reference", "thesis", "remembering", "steep"};
  return kNames[instance.index];
}

INSTANTIATE_TEST_SUITE_P(Monitor, Wild,
                         testing::Values(reference_configuration(), thesis_configuration(),
                                         with_effects(kRemembering), with_effects(kSteep)),
                         name_of);

}  // namespace
}  // namespace morepro
