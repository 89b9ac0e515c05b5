#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "lib/plant/integrators.hpp"
#include "tests/support/golden.hpp"

namespace morepro {
namespace {

using test::golden_csv;
using test::golden_machine;
using test::GoldenRow;

struct Case {
  const char* set;
  int profile;
};

std::string file_of(const Case& c) {
  return std::string("plant_response_") + c.set + "_" + std::to_string(c.profile) + ".csv";
}

double feed_force_of(const Case& c) { return std::string(c.set) == "THESIS" ? 8.0 : 26.0; }

double random_sign(double t_s) {
  constexpr std::array<double, 10> kSigns{1, -1, -1, 1, 1, -1, 1, -1, 1, -1};
  return kSigns.at(std::min<std::size_t>(9, static_cast<std::size_t>(t_s / 0.02)));
}

/// The golden input profiles. side: a time inside the step, which decides on which side of a switch it lies.
PlantInput<double> input_at(const Case& c, double t_s, double side_s) {
  const MachineParameters machine = golden_machine(c.set);
  PlantInput<double> u{.armature_voltage_v = 48.0,
                       .feed_force_n = feed_force_of(c),
                       .contact = side_s >= 0.05 ? 1.0 : 0.0,
                       .engagement = machine.feed.engagement,
                       .chip_load_mm = machine.tool.chip_load_mm,
                       .tool_temperature_degc = machine.thermal.tool_degc};
  if (c.profile == 2) {
    u.armature_voltage_v = 48.0 + 12.0 * random_sign(side_s);
    u.contact = 1.0;
  }
  if (c.profile == 3) {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    u.armature_voltage_v = 40.0 + 200.0 * t_s + 5.0 * std::sin(kTurn * 60.0 * t_s);
    u.feed_force_n += 3.0 * std::sin(kTurn * 25.0 * t_s);
    u.contact = side_s >= 0.1 && side_s < 0.15 ? 1.0 : 0.0;
  }
  return u;
}

// RK4 with 0.5 us: (h lambda)^4/120 = 5e-13. A corner of the contact law costs h^2/8 times the jump of the
// slope, once: the thesis's corner at 1 rad/s, passed in the first millisecond, wants 0.1 us. The reference:
// 2e-12.
constexpr int steps_in(int millisecond) { return millisecond == 0 ? 10000 : 2000; }

PlantState<double> after_one_millisecond(const Case& c, PlantState<double> x, int millisecond) {
  const int steps = steps_in(millisecond);
  const double h = 1.0e-3 / steps;
  const Rk4Integrator<double> integrator(golden_machine(c.set), h);
  for (int k = 0; k < steps; ++k) {
    const double t = millisecond * 1.0e-3 + k * h;
    const double middle = t + 0.5 * h;
    x = integrator.step(x, input_at(c, t, middle), input_at(c, middle, middle), input_at(c, t + h, middle));
  }
  return x;
}

class PlantResponseGolden : public testing::TestWithParam<Case> {};

TEST_P(PlantResponseGolden, FineStepsMatchTo1e9) {
  const Case c = GetParam();
  PlantState<double> x;
  int millisecond = 0;
  for (const GoldenRow& row : golden_csv(file_of(c))) {
    ASSERT_NEAR(row["t"], millisecond * 1.0e-3, 1.0e-12);
    EXPECT_NEAR(x.speed_rad_s, row["w"], 1.0e-9 * std::abs(row["w"])) << row["t"];
    EXPECT_NEAR(x.feed_speed_m_s, row["v"], 1.0e-9 * std::abs(row["v"])) << row["t"];
    EXPECT_NEAR(x.current_a, row["i"], 1.0e-9 * std::abs(row["i"])) << row["t"];
    x = after_one_millisecond(c, x, millisecond++);
  }
  EXPECT_EQ(millisecond, 201);
}

INSTANTIATE_TEST_SUITE_P(Profiles, PlantResponseGolden,
                         testing::Values(Case{"THESIS", 1}, Case{"THESIS", 2}, Case{"THESIS", 3},
                                         Case{"REF", 1}, Case{"REF", 2}, Case{"REF", 3}),
                         [](const auto& run) { return run.param.set + std::to_string(run.param.profile); });

}  // namespace
}  // namespace morepro
