#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "lib/c/morepro_monitor.h"
#include "lib/monitor/monitor.hpp"
#include "tests/support/spindle_frames.hpp"

namespace morepro {
namespace {

using CMonitor = std::unique_ptr<morepro_monitor>;

CMonitor made(const morepro_configuration& configuration = morepro_reference_configuration()) {
  auto monitor = std::make_unique<morepro_monitor>();
  EXPECT_EQ(morepro_monitor_create(monitor.get(), &configuration, nullptr), MOREPRO_OK);
  return monitor;
}

morepro_frame frame_of(const SensorFrame& frame) {
  morepro_frame c{};
  c.sequence = frame.sequence;
  c.time_us = frame.time_us;
  for (int i = 0; i < MOREPRO_CHANNELS; ++i)
    if (frame.has(static_cast<Channel>(i)))
      morepro_frame_set(&c, i, frame.value[static_cast<std::size_t>(i)]);
  return c;
}

morepro_health step(morepro_monitor& monitor, const SensorFrame& frame) {
  const morepro_frame c = frame_of(frame);
  morepro_health health{};
  EXPECT_EQ(morepro_monitor_step(&monitor, &c, &health), MOREPRO_OK);
  return health;
}

/// A worn tool, with the faults that frames can have.
std::vector<SensorFrame> eventful_frames(const MonitorConfiguration& configuration, double chip_load_mm) {
  auto frames =
      test::frames_of(configuration, {.chip_load_mm = 1.3 * chip_load_mm, .commanded_mm = chip_load_mm});
  frames[2500] = frames[2499];  // double
  frames[3000].set(Channel::kSpindleSpeed, std::numeric_limits<float>::quiet_NaN());
  frames[3100].set(Channel::kArmatureCurrent, 500.0F);  // a spike
  frames[3200].clear(Channel::kFeedSpeed);
  frames.erase(frames.begin() + 3500, frames.begin() + 3504);  // missing
  return frames;
}

using Words = std::vector<std::uint32_t>;

Words bits(std::initializer_list<float> values) {
  Words words;
  for (const float value : values) words.push_back(std::bit_cast<std::uint32_t>(value));
  return words;
}

void expect_same_scalars(const morepro_health& c, const Health& cpp) {
  ASSERT_EQ((Words{c.sequence, c.time_us, c.state, c.reason, c.frame_flags, c.rejected_channels}),
            (Words{cpp.sequence, cpp.time_us, static_cast<std::uint32_t>(cpp.state), cpp.reason,
                   cpp.frame_flags, cpp.rejected_channels}));
  ASSERT_EQ((Words{c.frames_accepted, c.frames_rejected, c.frames_missing, c.chip_load_is_valid,
                   c.hypothesis_count, c.selected_hypothesis}),
            (Words{cpp.frames_accepted, cpp.frames_rejected, cpp.frames_missing,
                   static_cast<std::uint32_t>(cpp.chip_load_state), cpp.hypothesis_count,
                   cpp.selected_hypothesis}));
  ASSERT_EQ(
      bits({c.chip_load_mm, c.chip_load_standard_error_mm, c.selected_probability, c.spindle_speed_rad_s,
            c.feed_speed_m_s, c.armature_current_a, c.innovation_ratio}),
      bits({cpp.chip_load_mm, cpp.chip_load_standard_error_mm, cpp.selected_probability,
            cpp.spindle_speed_rad_s, cpp.feed_speed_m_s, cpp.armature_current_a, cpp.innovation_ratio}));
}

void expect_same_estimates(const morepro_health& c, const BoardMonitor& monitor) {
  const Health& cpp = monitor.health();
  for (std::size_t i = 0; i < kParameterCount; ++i) {
    const auto& ours = c.parameters[i];
    const auto& theirs = cpp.parameters[i];
    ASSERT_EQ(bits({ours.value, ours.standard_error}), bits({theirs.value, theirs.standard_error}));
    ASSERT_EQ(ours.status, static_cast<std::uint8_t>(theirs.status));
    ASSERT_EQ(ours.partner, static_cast<std::uint8_t>(theirs.partner));
    ASSERT_EQ(ours.is_identifiable != 0, theirs.status == ParameterStatus::kIdentifiable);
  }
  for (std::size_t i = 0; i < kMonitorHypotheses; ++i)
    ASSERT_EQ(c.probability[i], i < monitor.hypothesis_count() ? monitor.probability(i) : 0.0F);
  ASSERT_EQ(c.gap.verdict, static_cast<std::uint8_t>(cpp.gap.verdict));
  ASSERT_EQ(bits({c.gap.confidence, c.gap.evidence}), bits({cpp.gap.confidence, cpp.gap.evidence}));
}

void expect_same_run(const morepro_configuration& c, const MonitorConfiguration& cpp, double chip_load_mm) {
  const auto monitor = made(c);
  const auto wanted = std::make_unique<BoardMonitor>();
  ASSERT_TRUE(wanted->configure(cpp).ok());
  std::uint32_t seen_flags = 0;
  for (const auto& frame : eventful_frames(cpp, chip_load_mm)) {
    (void)wanted->step(frame);
    const morepro_health health = step(*monitor, frame);
    ASSERT_NO_FATAL_FAILURE(expect_same_scalars(health, wanted->health())) << frame.sequence;
    ASSERT_NO_FATAL_FAILURE(expect_same_estimates(health, *wanted)) << frame.sequence;
    seen_flags |= health.frame_flags;
  }
  EXPECT_TRUE((seen_flags & MOREPRO_FRAME_DUPLICATE) && (seen_flags & MOREPRO_FRAME_MISSING_BEFORE) &&
              (seen_flags & MOREPRO_FRAME_NOT_FINITE) && (seen_flags & MOREPRO_FRAME_INNOVATION_GATE));
}

TEST(CMonitor, GivesTheBitsOfTheCppMonitor) {
  expect_same_run(morepro_reference_configuration(), reference_configuration(), 0.05);
  expect_same_run(morepro_thesis_configuration(), thesis_configuration(), 0.5);
}

TEST(CMonitor, TakesEffectsOutOfItsFrames) {
  MonitorConfiguration cpp = reference_configuration();
  cpp.effects.count = 1;
  cpp.effects.effect[0].form = {.effect = gap::Effect::kFeedCoulombFriction, .shape = 1.0e-3F};
  cpp.effects.effect[0].coefficient[0] = 6.0;
  morepro_configuration c = morepro_reference_configuration();
  c.effects.count = 1;
  c.effects.effect[0].effect = static_cast<std::uint8_t>(morepro_effect_named("feed_coulomb_friction"));
  c.effects.effect[0].parts = 1;
  c.effects.effect[0].shape = 1.0e-3F;
  c.effects.effect[0].coefficient[0] = 6.0;
  expect_same_run(c, cpp, 0.05);
}

TEST(CMonitor, ACopyIsAMonitorThatGoesOnAlone) {
  const auto frames = test::frames_of(reference_configuration(), {.frames = 3000});
  const auto monitor = made();
  for (std::size_t i = 0; i < 2500; ++i) (void)step(*monitor, frames[i]);
  const auto copy = std::make_unique<morepro_monitor>(*monitor);
  for (std::size_t i = 2500; i < 3000; ++i) (void)step(*monitor, frames[i]);
  morepro_health last{};
  for (std::size_t i = 2500; i < 3000; ++i) last = step(*copy, frames[i]);
  EXPECT_EQ(std::memcmp(monitor.get(), copy.get(), sizeof(morepro_monitor)), 0);
  morepro_health again{};
  ASSERT_EQ(morepro_monitor_health(copy.get(), &again), MOREPRO_OK);
  EXPECT_EQ(again.sequence, last.sequence);
  EXPECT_EQ(again.chip_load_mm, last.chip_load_mm);
}

TEST(CMonitor, ResetForgetsAndKeepsTheConfiguration) {
  const auto frames = test::frames_of(thesis_configuration(), {.frames = 500, .contact_frame = 100});
  const auto fresh = made(morepro_thesis_configuration());
  const auto used = made(morepro_thesis_configuration());
  for (const auto& frame : frames) (void)step(*used, frame);
  ASSERT_EQ(morepro_monitor_reset(used.get()), MOREPRO_OK);
  for (const auto& frame : frames) {
    (void)step(*fresh, frame);
    (void)step(*used, frame);
  }
  EXPECT_EQ(step(*used, frames.back()).chip_load_mm, step(*fresh, frames.back()).chip_load_mm);
  ASSERT_EQ(morepro_monitor_count_corrupt(used.get()), MOREPRO_OK);
  EXPECT_EQ(step(*used, frames.back()).frames_rejected, 3U) << "two double frames and what was no frame";
}

TEST(CMonitor, AToolThatIsChangedIsWornNoMore) {
  const auto monitor = made();
  const test::Cut worn{.chip_load_mm = 0.1, .commanded_mm = 0.05};
  morepro_health health{};
  for (const auto& frame : test::frames_of(reference_configuration(), worn)) health = step(*monitor, frame);
  EXPECT_EQ(health.state, MOREPRO_REPLACE);
  EXPECT_STREQ(morepro_reason_of(health.reason).name, "WEAR_LOAD_HIGH");
  ASSERT_EQ(morepro_monitor_tool_changed(monitor.get()), MOREPRO_OK);
  const test::Cut sharp{.contact_frame = 100, .first_sequence = 6000, .first_time_us = 600000};
  for (const auto& frame : test::frames_of(reference_configuration(), sharp)) health = step(*monitor, frame);
  EXPECT_EQ(health.state, MOREPRO_HEALTHY);
}

TEST(CMonitor, RefusesAConfigurationWithItsKeyAndStaysAsItWas) {
  const auto monitor = made();
  const auto before = std::make_unique<morepro_monitor>(*monitor);
  const auto refusal = [&](auto change, morepro_error error, const std::string& key) {
    morepro_configuration c = morepro_reference_configuration();
    change(c);
    const char* refused = nullptr;
    EXPECT_EQ(morepro_monitor_create(monitor.get(), &c, &refused), error);
    EXPECT_EQ(refused, key);
  };
  using C = morepro_configuration;
  refusal([](C& c) { c.machine.spindle.inertia_kgm2 = 0; }, MOREPRO_ERROR_NOT_POSITIVE,
          "spindle.inertia_kgm2");
  refusal([](C& c) { c.rate_hz = 50; }, MOREPRO_ERROR_SAMPLING_RATE, "sampling.rate_hz");
  refusal([](C& c) { c.grid.count = 12; }, MOREPRO_ERROR_HYPOTHESIS_COUNT, "grid.count");
  refusal([](C& c) { c.sensors[MOREPRO_FEED_SPEED_M_S].noise = -1; }, MOREPRO_ERROR_NEGATIVE,
          "feed_speed_m_s");
  refusal([](C& c) { c.effects.count = 5; }, MOREPRO_ERROR_EFFECT_COUNT, "effects");
  refusal([](C& c) { c.machine.contact.form = 2; }, MOREPRO_ERROR_UNKNOWN_CHOICE, "contact.form");
  refusal([](C& c) { c.rule = 3; }, MOREPRO_ERROR_UNKNOWN_CHOICE, "rule");
  EXPECT_EQ(std::memcmp(monitor.get(), before.get(), sizeof *before), 0);
}

TEST(CMonitor, AnswersNullPointersAndForeignMemoryWithAnError) {
  const morepro_configuration configuration = morepro_reference_configuration();
  const auto monitor = made();
  const morepro_frame frame{};
  morepro_health health{};
  EXPECT_EQ(morepro_monitor_create(nullptr, &configuration, nullptr), MOREPRO_ERROR_NULL_POINTER);
  EXPECT_EQ(morepro_monitor_create(monitor.get(), nullptr, nullptr), MOREPRO_ERROR_NULL_POINTER);
  EXPECT_EQ(morepro_monitor_step(monitor.get(), nullptr, &health), MOREPRO_ERROR_NULL_POINTER);
  EXPECT_EQ(morepro_monitor_step(monitor.get(), &frame, nullptr), MOREPRO_ERROR_NULL_POINTER);
  EXPECT_EQ(morepro_monitor_health(monitor.get(), nullptr), MOREPRO_ERROR_NULL_POINTER);

  std::vector<std::uint64_t> memory(sizeof(morepro_monitor) / sizeof(std::uint64_t) + 1);
  auto* const foreign = reinterpret_cast<morepro_monitor*>(memory.data());
  auto* const odd = reinterpret_cast<morepro_monitor*>(reinterpret_cast<std::uintptr_t>(foreign) + 4);
  const auto expect_all = [&](morepro_monitor* m, morepro_error error) {
    EXPECT_EQ(morepro_monitor_step(m, &frame, &health), error);
    EXPECT_EQ(morepro_monitor_health(m, &health), error);
    EXPECT_EQ(morepro_monitor_reset(m), error);
    EXPECT_EQ(morepro_monitor_tool_changed(m), error);
    EXPECT_EQ(morepro_monitor_count_corrupt(m), error);
  };
  expect_all(nullptr, MOREPRO_ERROR_NULL_POINTER);
  expect_all(odd, MOREPRO_ERROR_MISALIGNED);
  EXPECT_EQ(morepro_monitor_create(odd, &configuration, nullptr), MOREPRO_ERROR_MISALIGNED);
  for (const unsigned pattern : {0x00U, 0xFFU, 0xA5U, 0xCDU}) {
    std::memset(memory.data(), static_cast<int>(pattern), sizeof(morepro_monitor));
    expect_all(foreign, MOREPRO_ERROR_NOT_CREATED);
  }
}

}  // namespace
}  // namespace morepro
