#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/plant/built_in_machines.hpp"
#include "lib/plant/integrators.hpp"

namespace morepro {
namespace {

constexpr double kDuration = 0.1;
constexpr int kIntegratedSamples = 100;

template <class Real>
PlantInput<Real> input_of(const MachineParameters& machine, double contact) {
  return {.armature_voltage_v = Real(48),
          .feed_force_n = Real(26),
          .contact = static_cast<Real>(contact),
          .engagement = static_cast<Real>(machine.feed.engagement),
          .chip_load_mm = static_cast<Real>(machine.tool.chip_load_mm),
          .tool_temperature_degc = static_cast<Real>(machine.thermal.tool_degc)};
}

/// Every millisecond of a start at 48 V with contact from the middle on.
template <class Integrator, class Real>
std::vector<PlantState<double>> response(const MachineParameters& machine, int steps_per_sample,
                                         bool has_contact) {
  const Integrator integrator(machine, kDuration / kIntegratedSamples / steps_per_sample);
  PlantState<Real> x;
  std::vector<PlantState<double>> samples;
  for (int k = 0; k < kIntegratedSamples * steps_per_sample; ++k) {
    const bool is_second_half = 2 * k >= kIntegratedSamples * steps_per_sample;
    x = integrator.step(x, input_of<Real>(machine, has_contact && is_second_half ? 1.0 : 0.0));
    if ((k + 1) % steps_per_sample == 0) {
      samples.push_back({double(x.speed_rad_s), double(x.feed_speed_m_s), double(x.current_a)});
    }
  }
  return samples;
}

/// Largest differences between two responses, each by the largest value of its signal.
struct StateDifference {
  double speed = 0.0;
  double feed = 0.0;
  double current = 0.0;
};

StateDifference difference(const std::vector<PlantState<double>>& a,
                           const std::vector<PlantState<double>>& b) {
  StateDifference largest;
  StateDifference peak;
  for (std::size_t k = 0; k < a.size(); ++k) {
    largest.speed = std::max(largest.speed, std::abs(a[k].speed_rad_s - b[k].speed_rad_s));
    largest.feed = std::max(largest.feed, std::abs(a[k].feed_speed_m_s - b[k].feed_speed_m_s));
    largest.current = std::max(largest.current, std::abs(a[k].current_a - b[k].current_a));
    peak.speed = std::max(peak.speed, std::abs(b[k].speed_rad_s));
    peak.feed = std::max(peak.feed, std::abs(b[k].feed_speed_m_s));
    peak.current = std::max(peak.current, std::abs(b[k].current_a));
  }
  return {largest.speed / peak.speed, largest.feed / peak.feed, largest.current / peak.current};
}

std::vector<PlantState<double>> exact_response(const MachineParameters& machine, bool has_contact = true) {
  return response<Rk4Integrator<double>, double>(machine, 1000, has_contact);
}

StateDifference exponential_error(const MachineParameters& machine, int steps_per_sample) {
  return difference(response<ExponentialIntegrator<double>, double>(machine, steps_per_sample, true),
                    exact_response(machine));
}

// Two-sided, by the errors of the specification: 2.5e-3 at 1 kHz, 7e-5 at 5 kHz, 2e-5 at 10 kHz on the thesis
// machine, whose contact law bends most; 1.5e-10 on the reference machine at 1 kHz.
TEST(ExponentialIntegrator, HasTheSpecifiedErrors) {
  struct Case {
    MachineParameters machine;
    int steps_per_sample;
    double error;
  };
  for (const Case& c : {Case{thesis_machine(), 1, 2.5e-3}, Case{thesis_machine(), 5, 7.1e-5},
                        Case{thesis_machine(), 10, 1.7e-5}, Case{reference_machine(), 1, 1.5e-10}}) {
    const StateDifference error = exponential_error(c.machine, c.steps_per_sample);
    EXPECT_LT(error.speed, 1.2 * c.error);
    EXPECT_GT(error.speed, 0.8 * c.error);
    EXPECT_LT(error.current, 1.2 * c.error);
  }
}

TEST(ExponentialIntegrator, IsOfSecondOrderInContact) {
  const double coarse = exponential_error(thesis_machine(), 10).speed;
  const double fine = exponential_error(thesis_machine(), 20).speed;
  EXPECT_NEAR(coarse / fine, 4.0, 0.3);
}

// Exact for a linear system: what is left are the roundings of both integrators, 1e-16 each over 1e5 steps.
TEST(ExponentialIntegrator, IsExactWithoutContactForLongSteps) {
  for (const MachineParameters& machine : {thesis_machine(), reference_machine()}) {
    const auto long_steps = response<ExponentialIntegrator<double>, double>(machine, 1, false);
    const StateDifference error = difference(long_steps, exact_response(machine, false));
    EXPECT_LT(error.speed, 1.0e-11);
    EXPECT_LT(error.feed, 1.0e-11);
    EXPECT_LT(error.current, 1.0e-11);
  }
}

TEST(ExponentialIntegrator, StaysBoundedForAnyStep) {
  for (const double step_s : {1.0e-3, 0.1, 10.0}) {
    const ExponentialIntegrator<float> integrator(thesis_machine(), step_s);
    PlantState<float> x;
    for (int k = 0; k < 100; ++k) x = integrator.step(x, input_of<float>(thesis_machine(), 0.0));
    EXPECT_NEAR(double{x.speed_rad_s}, 150.0, 0.01) << step_s;
  }
}

// Each step rounds a state to 6e-8; the spindle forgets within about 30 steps of 0.1 ms: 30 * 6e-8. The
// thesis's feed axis has no friction and forgets nothing: 1000 * 3e-8.
TEST(ExponentialIntegrator, FloatFollowsDouble) {
  for (const MachineParameters& machine : {thesis_machine(), reference_machine()}) {
    const StateDifference rounding =
        difference(response<ExponentialIntegrator<float>, float>(machine, 10, true),
                   response<ExponentialIntegrator<double>, double>(machine, 10, true));
    EXPECT_LT(rounding.speed, 2.0e-6);
    EXPECT_LT(rounding.feed, 3.0e-5);
    EXPECT_LT(rounding.current, 2.0e-6);
  }
}

TEST(Rk4Integrator, IsOfFourthOrder) {
  const auto exact = exact_response(reference_machine());
  const auto error = [&](int steps) {
    return difference(response<Rk4Integrator<double>, double>(reference_machine(), steps, true), exact).speed;
  };
  EXPECT_NEAR(error(10) / error(20), 16.0, 2.0);
}

TEST(Rk4Integrator, RefusesStepsBeyondItsLimit) {
  struct Case {
    MachineParameters machine;
    double step_s;
    StepStatus status;
  };
  for (const Case& c :
       {Case{thesis_machine(), 1.0e-4, StepStatus::kOk}, Case{thesis_machine(), 4.5e-4, StepStatus::kOk},
        Case{thesis_machine(), 4.7e-4, StepStatus::kUnstable},
        Case{thesis_machine(), 1.0e-3, StepStatus::kUnstable},
        Case{reference_machine(), 1.0e-3, StepStatus::kOk},
        Case{reference_machine(), 1.7e-3, StepStatus::kUnstable}}) {
    EXPECT_EQ(Rk4Integrator<float>::check(c.machine, c.step_s), c.status) << c.step_s;
  }
}

TEST(Rk4Integrator, RefusesWhatIsNoStep) {
  for (const double step_s : {0.0, -1.0e-4, std::nan(""), 1.0e9}) {
    EXPECT_EQ(check_rk4_step(reference_machine(), step_s), StepStatus::kNotPositive) << step_s;
  }
  MachineParameters machine = reference_machine();
  machine.spindle.inertia_kgm2 = std::nan("");
  EXPECT_EQ(check_rk4_step(machine, 1.0e-4), StepStatus::kUnstable);
}

TEST(Rk4Integrator, DivergesWhereTheCheckSaysSo) {
  const Rk4Integrator<double> integrator(thesis_machine(), 1.0e-3);
  PlantState<double> x;
  for (int k = 0; k < 50; ++k) x = integrator.step(x, input_of<double>(thesis_machine(), 0.0));
  EXPECT_FALSE(std::abs(x.speed_rad_s) < 1.0e6);
}

TEST(Rk4Integrator, RefusesAFeedAxisThatIsTooFast) {
  MachineParameters machine = reference_machine();
  machine.feed.viscous_friction_ns_m = 1.0e5;
  EXPECT_EQ(check_rk4_step(machine, 1.0e-4), StepStatus::kUnstable);
}

TEST(SpectralRadius, IsBelowExactlyWhenBothEigenvaluesAre) {
  EXPECT_TRUE(is_spectral_radius_below(math::Matrix2{-3.0, 0.0, 0.0, 2.0}, 3.001));
  EXPECT_FALSE(is_spectral_radius_below(math::Matrix2{-3.0, 0.0, 0.0, 2.0}, 2.999));
  EXPECT_TRUE(is_spectral_radius_below(math::Matrix2{0.0, -2.0, 2.0, 0.0}, 2.001));
  EXPECT_FALSE(is_spectral_radius_below(math::Matrix2{0.0, -2.0, 2.0, 0.0}, 1.999));
  EXPECT_FALSE(is_spectral_radius_below(math::Matrix2{std::nan(""), 0.0, 0.0, 0.0}, 1.0));
}

}  // namespace
}  // namespace morepro
