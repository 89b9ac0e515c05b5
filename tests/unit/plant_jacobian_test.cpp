#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "lib/plant/built_in_machines.hpp"
#include "lib/plant/dynamics.hpp"

namespace morepro {
namespace {

using Vector3 = Eigen::Matrix<double, 3, 1>;

/// Both machines with both contact laws.
std::array<MachineParameters, 4> machines() {
  std::array<MachineParameters, 4> all{reference_machine(), reference_machine(), thesis_machine(),
                                       thesis_machine()};
  all[1].contact.form = ContactForm::kThesis;
  all[1].contact.viscous_gain_nms = 1.0e-4;
  all[3].contact.form = ContactForm::kConsistent;
  all[3].contact.edge_force_n = 40.0;
  all[3].contact.radius_m = 0.05;
  return all;
}

struct Point {
  PlantState<double> state;
  PlantInput<double> input;
};

Point random_point(const MachineParameters& machine, std::mt19937& generator) {
  const auto between = [&generator](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator);
  };
  const double direction = between(-1.0, 3.0) < 0.0 ? -1.0 : 1.0;
  const double speed = direction * std::pow(10.0, between(-1.0, 2.9));
  return {.state = {speed, between(-0.2, 0.2), between(-5.0, 60.0)},
          .input = {.armature_voltage_v = between(-60.0, 60.0),
                    .feed_force_n = between(-10.0, 40.0),
                    .contact = between(0.0, 1.0) < 0.8 ? 1.0 : 0.0,
                    .engagement = between(0.5, 2.0),
                    .chip_load_mm = machine.tool.chip_load_mm * between(0.1, 3.0),
                    .tool_temperature_degc = between(300.0, 1500.0)}};
}

Vector3 derivative_at(const Plant<double>& plant, const Point& p) {
  const auto f = plant.derivative(p.state, p.input);
  return {f.acceleration_rad_s2, f.feed_acceleration_m_s2, f.current_rate_a_s};
}

/// A corner of the law between the two sides of a difference has no derivative.
bool has_corner_within(const Plant<double>& plant, const Point& p, double step) {
  const auto& law = plant.contact_law();
  const auto slope = [&](double w) { return law.friction(w, p.input.chip_load_mm, 1.0).per_speed; };
  const double left = slope(p.state.speed_rad_s - step);
  const double right = slope(p.state.speed_rad_s + step);
  return std::abs(left - right) > 1.0e-2 * std::max(std::abs(left), std::abs(right));
}

// Central differences of fourth order with h = 1e-4 of an argument: h^4/30 of the fifth derivative is below
// 1e-11, rounding 1e-16 f/(h f') below 1e-9 of the row's largest entry.
constexpr double kRelative = 1.0e-7;
constexpr double kRounding = 1.0e-9;

/// d f / d offset at 0.
template <class F>
auto central_difference(F f, double h) {
  return ((8.0 * (f(h) - f(-h)) - (f(2.0 * h) - f(-2.0 * h))) / (12.0 * h)).eval();
}

/// In which rows of a column the sign of the entry matters to the check: `true` somewhere for every entry
/// that is not zero by structure, so that a flipped sign anywhere turns the test red.
using Entries = Eigen::Array<bool, 3, Eigen::Dynamic>;

void expect_column(const Vector3& analytic, const Vector3& difference, const Vector3& row_scale,
                   const char* what, Entries::ColXpr sign_matters) {
  for (int i = 0; i < 3; ++i) {
    const double tolerance = kRelative * std::abs(analytic(i)) + kRounding * row_scale(i);
    EXPECT_NEAR(analytic(i), difference(i), tolerance) << what << ", row " << i;
    sign_matters(i) = sign_matters(i) || std::abs(-analytic(i) - difference(i)) > tolerance;
  }
}

/// What depends on what: w' on w, i; v' on v; i' on w, i. The first torques stand in w', and so on.
bool state_acts(int row, int column) { return (row == kFeedSpeedIndex) == (column == kFeedSpeedIndex); }
bool parameter_acts(int row, int column) { return row == (column < 2 ? 0 : column < 4 ? 1 : 2); }

template <class Acts>
void expect_all_signs_checked(const Entries& sign_matters, Acts acts) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < sign_matters.cols(); ++j)
      EXPECT_EQ(sign_matters(i, j), acts(i, j)) << "row " << i << ", column " << j;
}

double& coordinate(PlantState<double>& x, int index) {
  if (index == kSpeedIndex) return x.speed_rad_s;
  return index == kFeedSpeedIndex ? x.feed_speed_m_s : x.current_a;
}

TEST(PlantJacobian, StateColumnsAreCentralDifferences) {
  std::mt19937 generator(11);
  for (const MachineParameters& machine : machines()) {
    const Plant<double> plant(machine);
    Entries sign_matters = Entries::Constant(3, 3, false);
    for (int k = 0; k < 500; ++k) {
      const Point p = random_point(machine, generator);
      Point at = p;
      const auto a = plant.state_jacobian(p.state, p.input);
      for (int j = 0; j < 3; ++j) {
        const double h = 1.0e-4 * std::max(10.0, std::abs(coordinate(at.state, j)));
        if (j == kSpeedIndex && has_corner_within(plant, p, 2.0 * h)) continue;
        const auto shifted = [&](double offset) {
          Point moved = p;
          coordinate(moved.state, j) += offset;
          return derivative_at(plant, moved);
        };
        const Vector3 difference = central_difference(shifted, h);
        expect_column(a.col(j), difference, a.cwiseAbs().rowwise().maxCoeff(), "state", sign_matters.col(j));
      }
    }
    expect_all_signs_checked(sign_matters, [&](int i, int j) {
      return state_acts(i, j) && (i != kFeedSpeedIndex || machine.feed.viscous_friction_ns_m > 0.0);
    });
  }
}

TEST(PlantJacobian, ParameterColumnsAreCentralDifferences) {
  std::mt19937 generator(12);
  for (const MachineParameters& machine : machines()) {
    const Plant<double> nominal(machine);
    Entries sign_matters = Entries::Constant(3, static_cast<int>(kParameterCount), false);
    for (int k = 0; k < 500; ++k) {
      const Point p = random_point(machine, generator);
      const auto c = nominal.parameter_jacobian(p.state, p.input);
      for (std::size_t j = 0; j < kParameterCount; ++j) {
        const auto shifted = [&](double offset) {
          Plant<double> moved = nominal;
          auto theta = nominal.theta();
          theta[j] += offset;
          moved.set_theta(theta);
          return derivative_at(moved, p);
        };
        const Vector3 difference = central_difference(shifted, 1.0e-4 * nominal.theta()[j]);
        const Vector3 rounding = derivative_at(nominal, p).cwiseAbs() / nominal.theta()[j];
        const int column = static_cast<int>(j);
        expect_column(c.col(column), difference, rounding, "parameter", sign_matters.col(column));
      }
    }
    expect_all_signs_checked(sign_matters, parameter_acts);
  }
}

TEST(PlantJacobian, ChipLoadSlopeIsACentralDifference) {
  std::mt19937 generator(13);
  for (const MachineParameters& machine : machines()) {
    const ContactLaw<double> law(machine);
    for (int k = 0; k < 500; ++k) {
      const Point p = random_point(machine, generator);
      const double w = p.state.speed_rad_s;
      const double chip = p.input.chip_load_mm;
      const double h = 1.0e-5 * chip;
      const auto torque = [&](double x) { return law(w, x, p.input.tool_temperature_degc); };
      if (torque(chip - h).flags != torque(chip + h).flags) continue;
      if ((torque(chip - h).beta == 0.0) != (torque(chip + h).beta == 0.0)) continue;
      const double difference = (torque(chip + h).torque_nm - torque(chip - h).torque_nm) / (2.0 * h);
      const auto at = torque(chip);
      EXPECT_NEAR(at.per_chip_load, difference,
                  kRelative * std::abs(difference) + 1.0e-10 * std::abs(at.torque_nm) / chip);
    }
  }
}

TEST(PlantJacobian, LinearisationIsBothPartsAtOnce) {
  std::mt19937 generator(14);
  const Plant<double> plant(reference_machine());
  for (int k = 0; k < 100; ++k) {
    const Point p = random_point(reference_machine(), generator);
    const auto both = plant.linearise(p.state, p.input);
    const auto a = plant.state_jacobian(p.state, p.input);
    EXPECT_EQ(both.derivative.acceleration_rad_s2, derivative_at(plant, p)(kSpeedIndex));
    EXPECT_EQ(both.spindle_jacobian.a00, a(kSpeedIndex, kSpeedIndex));
    EXPECT_EQ(both.spindle_jacobian.a10, a(kCurrentIndex, kSpeedIndex));
  }
}

}  // namespace
}  // namespace morepro
