#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <vector>

#include "lib/gap/angle_multiples.hpp"
#include "lib/gap/column_set.hpp"
#include "lib/gap/reference_point.hpp"
#include "lib/gap/unnamed_laws.hpp"
#include "lib/plant/built_in_machines.hpp"
#include "sim_host/simulate/random_numbers.hpp"

namespace morepro::gap::column_set_test {
namespace {

constexpr double kStepS = 1.0e-4;
constexpr double kOnsetS = 0.05;
using Many = ColumnSet<double, 160, 16, 254>;  // as a search on a PC has it
using Few = ColumnSet<double, 16, 4, 254>;

EffectScales<double> reference_scales() {
  const MachineParameters machine = reference_machine();
  return {machine, reference_point_of(machine)};
}

/// Signals of a machine that does everything, and whose spindle has turned for long.
EffectSignals<double> signals_at(int row) {
  host::NormalNumbers random(static_cast<std::uint64_t>(row) + 1);
  EffectSignals<double> s;
  s.time_s = kStepS * row;
  s.contact = row % 3 == 0 ? 0.0 : 1.0;
  s.speed_rad_s = 300.0 * random.next();
  s.angle_rad = 1.0e4 + 0.05 * row;
  s.current_a = 5.0 * random.next();
  s.feed_speed_m_s = 0.05 * random.next();
  s.feed_position_m = 0.1 * random.next();
  s.feed_force_n = 100.0 * random.next();
  s.tool_degc = 40.0 + random.next();
  s.winding_degc = 60.0 + random.next();
  s.acceleration_rad_s2 = 1000.0 * random.next();
  return s;
}

std::vector<double> as_numbers(const Contribution<double>& c) {
  return {c.torque_nm, c.force_n, c.voltage_v, c.speed_rad_s, c.current_a, c.feed_speed_m_s};
}

/// What all forms together add over some rows, against each in a set of its own, where nothing is shared.
void expect_as_alone(const std::vector<EffectForm>& forms, double tolerance) {
  const auto together = std::make_unique<Many>(reference_scales(), kStepS);
  std::vector<std::unique_ptr<Few>> alone;
  for (const EffectForm& form : forms) {
    ASSERT_TRUE(together->add(form, 0.0));
    alone.push_back(std::make_unique<Few>(reference_scales(), kStepS));
    ASSERT_TRUE(alone.back()->add(form, 0.0));
  }
  for (int row = 0; row < 300; ++row) {
    const EffectSignals<double> signals = signals_at(row);
    std::vector<Contribution<double>> expected;
    for (const auto& one : alone)
      one->for_each(signals, false, [&](std::size_t, const auto& c) { expected.push_back(c); });
    ASSERT_EQ(expected.size(), together->size());
    together->for_each(signals, false, [&](std::size_t j, const auto& c) {
      const auto seen = as_numbers(c), wanted = as_numbers(expected[j]);
      for (std::size_t i = 0; i < seen.size(); ++i)
        EXPECT_NEAR(seen[i], wanted[i], tolerance) << row << ", " << j;
    });
  }
}

TEST(ColumnSet, CoggingAndTeethThatShareAnAngleAreWhatEachIsAlone) {
  std::vector<EffectForm> forms;
  for (const float periods : {1.0F, 2.0F, 7.0F, 8.0F, 12.0F, 24.0F, 30.0F, 2.5F})
    forms.push_back({.effect = Effect::kSpindleCogging, .parts = 2, .shape = periods});
  forms.push_back({.effect = Effect::kToothPassingTorque, .parts = 4});
  forms.push_back({.effect = Effect::kToothPassingTorque, .kind = 1, .parts = 4});
  // 30 times 1e4 rad, rounded to a double, is 3e-11 off.
  expect_as_alone(forms, 1.0e-10);
}

TEST(ColumnSet, FunctionsWithoutANameAreTogetherWhatEachIsAlone) {
  std::vector<EffectForm> of_spindle;
  std::vector<EffectForm> of_feed;
  for (const float time_constant_s : {0.0F, 0.01F}) {
    for (std::uint8_t law = 0; law < laws::kUnnamedSpindleLaws; ++law)
      for (const Effect effect : {Effect::kUnnamedTorque, Effect::kUnnamedVoltage})
        of_spindle.push_back({.effect = effect, .kind = law, .parts = 1, .shape = time_constant_s});
    for (std::uint8_t law = 0; law < laws::kUnnamedFeedLaws; ++law)
      of_feed.push_back({.effect = Effect::kUnnamedForce, .kind = law, .parts = 1, .shape = time_constant_s});
  }
  expect_as_alone(of_spindle, 0.0);
  expect_as_alone(of_feed, 0.0);
}

TEST(ColumnSet, AFunctionThatSetsInLateIsNothingBefore) {
  const auto set = std::make_unique<Many>(reference_scales(), kStepS);
  for (std::uint8_t law = 0; law < 20; ++law) {
    const EffectForm form{.effect = Effect::kUnnamedTorque, .kind = law, .parts = 1, .shape = 0.0F};
    ASSERT_TRUE(set->add(form, law == 1 ? kOnsetS : 0.0));
  }
  for (int row = 0; row < 1000; ++row) {
    const EffectSignals<double> signals = signals_at(row);
    set->for_each(signals, false, [&](std::size_t j, const auto& c) {
      const bool is_on = j != 1 || signals.time_s >= kOnsetS;
      if (j < 2) {
        EXPECT_EQ(c.torque_nm != 0.0, is_on) << row << ", " << j;
      }
    });
  }
}

/// A constant voltage is one volt at once, and seen through a time constant from its first value on; the
/// speed's is its share of the reference speed.
TEST(ColumnSet, FunctionsWithoutANameActOnTheirBalance) {
  const auto set = std::make_unique<Many>(reference_scales(), kStepS);
  for (int i = 0; i < 20; ++i) {
    const Effect effect = i % 2 == 0 ? Effect::kUnnamedVoltage : Effect::kUnnamedTorque;
    ASSERT_TRUE(set->add({.effect = effect, .kind = 1, .parts = 1, .shape = i < 2 ? 0.0F : 0.01F}, 0.0));
  }
  EffectSignals<double> signals;
  Contribution<double> plain;
  Contribution<double> lagging;
  for (int row = 0; row < 3; ++row) {
    signals.speed_rad_s = row == 0 ? 0.0 : reference_scales().speed_rad_s;
    set->for_each(signals, false, [&](std::size_t j, const auto& c) {
      if (j == 0) plain = c;
      if (j == 3) lagging = c;
    });
  }
  EXPECT_EQ(plain.voltage_v, 1.0);
  EXPECT_EQ(plain.torque_nm, 0.0);
  EXPECT_EQ(lagging.voltage_v, 0.0);
  // One and a half steps of 0.1 ms after a ramp of one step: 1 - exp(-1.5e-4 / 0.01), to first order.
  EXPECT_NEAR(lagging.torque_nm, 0.0149, 1.0e-4);
}

TEST(ColumnSet, VisitsTermsOfOneSortOnly) {
  const auto set = std::make_unique<Few>(reference_scales(), kStepS);
  for (const Effect effect : {Effect::kSpindleWindage, Effect::kCurrentBias, Effect::kSupplyVoltageOffset})
    ASSERT_TRUE(set->add({.effect = effect, .parts = 1}, 0.0));
  const auto visited = [&](bool in_sensor) {
    std::vector<std::size_t> terms;
    set->for_each(signals_at(1), in_sensor, [&](std::size_t j, const auto&) { terms.push_back(j); });
    return terms;
  };
  EXPECT_EQ(visited(true), (std::vector<std::size_t>{1}));
  EXPECT_EQ(visited(false), (std::vector<std::size_t>{0, 2}));
}

TEST(AngleMultiples, AreThoseOfTheStandardLibraryToAFewRoundings) {
  AngleMultiples<double> multiples;
  for (double angle_rad = -2.0e4; angle_rad < 2.0e4; angle_rad += 37.3) {
    multiples.follow(angle_rad);
    for (int k = 1; k <= static_cast<int>(AngleMultiples<double>::kMost); ++k) {
      const auto* turn = multiples.of(k);
      ASSERT_NE(turn, nullptr);
      const long double angle = static_cast<long double>(k) * static_cast<long double>(angle_rad);
      EXPECT_NEAR(turn->sin, static_cast<double>(std::sin(angle)), 8.0e-15) << k;
      EXPECT_NEAR(turn->cos, static_cast<double>(std::cos(angle)), 8.0e-15) << k;
    }
  }
}

TEST(AngleMultiples, OthersAreNone) {
  AngleMultiples<double> multiples;
  multiples.follow(1.0);
  for (const double other : {0.0, 0.5, 2.5, -1.0, 25.0, 1.0e30, std::nan("")})
    EXPECT_EQ(multiples.of(other), nullptr) << other;
}

}  // namespace
}  // namespace morepro::gap::column_set_test
