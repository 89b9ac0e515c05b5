#include <gtest/gtest.h>

#include <array>
#include <string>

#include "lib/plant/dynamics.hpp"
#include "tests/support/golden.hpp"

namespace morepro {
namespace {

using test::golden_csv;
using test::golden_input;
using test::golden_machine;
using test::golden_state;
using test::GoldenRow;
using test::relative_error;

constexpr std::array<const char*, kParameterCount> kParameterColumns{"Kt", "In", "m", "F2", "L", "R", "Kv"};

// Double: the sums cancel to no less than 1/100 of their largest summand in these rows.
constexpr double kDoubleTolerance = 1.0e-12;

template <class Real>
std::array<double, 3> derivative_of(const GoldenRow& row) {
  const Plant<Real> plant(golden_machine(row.text("set")));
  const auto f = plant.derivative(golden_state<Real>(row), golden_input<Real>(row));
  return {double(f.acceleration_rad_s2), double(f.feed_acceleration_m_s2), double(f.current_rate_a_s)};
}

/// The largest summand of each balance: what the rounding of a derivative is relative to.
std::array<double, 3> summand_of(const GoldenRow& row) {
  const MachineParameters p = golden_machine(row.text("set"));
  return {std::abs(row["i"]) * p.spindle.torque_constant_nm_a / p.spindle.inertia_kgm2,
          (std::abs(row["F1"]) + p.feed.contact_force_n) / p.feed.mass_kg,
          (std::abs(row["V"]) + std::abs(row["i"]) * p.spindle.resistance_ohm) / p.spindle.inductance_h};
}

TEST(PlantDerivativeGolden, DerivativesMatchInDouble) {
  for (const GoldenRow& row : golden_csv("plant_deriv.csv")) {
    const auto f = derivative_of<double>(row);
    EXPECT_LE(relative_error(f[0], row["dw"]), kDoubleTolerance);
    EXPECT_LE(relative_error(f[1], row["dv"]), kDoubleTolerance);
    EXPECT_LE(relative_error(f[2], row["di"]), kDoubleTolerance);
  }
}

TEST(PlantDerivativeGolden, DerivativesMatchInFloat) {
  // Inputs, parameters and each of about ten operations are rounded to 6e-8: 1e-6 of the largest summand.
  constexpr double kFloatTolerance = 1.0e-6;
  for (const GoldenRow& row : golden_csv("plant_deriv.csv")) {
    const auto f = derivative_of<float>(row);
    const auto scale = summand_of(row);
    EXPECT_NEAR(f[0], row["dw"], kFloatTolerance * (scale[0] + std::abs(row["dw"])));
    EXPECT_NEAR(f[1], row["dv"], kFloatTolerance * (scale[1] + std::abs(row["dv"])));
    EXPECT_NEAR(f[2], row["di"], kFloatTolerance * (scale[2] + std::abs(row["di"])));
  }
}

TEST(PlantDerivativeGolden, StateJacobianMatchesInDouble) {
  for (const GoldenRow& row : golden_csv("plant_deriv.csv")) {
    const Plant<double> plant(golden_machine(row.text("set")));
    const auto a = plant.state_jacobian(golden_state<double>(row), golden_input<double>(row));
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const std::string column = std::string("A").append(std::to_string(i)).append(std::to_string(j));
        EXPECT_LE(relative_error(a(i, j), row[column]), kDoubleTolerance) << column;
      }
    }
  }
}

double golden_slope(const GoldenRow& row, int balance, int parameter) {
  const char* name = kParameterColumns[static_cast<std::size_t>(parameter)];
  return row[std::string("C").append(std::to_string(balance)).append("_").append(name)];
}

TEST(PlantDerivativeGolden, ParameterJacobianMatchesInDouble) {
  for (const GoldenRow& row : golden_csv("plant_deriv.csv")) {
    const Plant<double> plant(golden_machine(row.text("set")));
    const auto c = plant.parameter_jacobian(golden_state<double>(row), golden_input<double>(row));
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < static_cast<int>(kParameterCount); ++j) {
        EXPECT_LE(relative_error(c(i, j), golden_slope(row, i, j)), kDoubleTolerance) << i << " " << j;
      }
    }
  }
}

TEST(PlantDerivativeGolden, JacobiansMatchInFloat) {
  // As the derivatives; a quotient is within some roundings of its own value, the contact slope sums three
  // terms.
  constexpr double kFloatTolerance = 3.0e-6;
  for (const GoldenRow& row : golden_csv("plant_deriv.csv")) {
    const MachineParameters machine = golden_machine(row.text("set"));
    const Plant<double> exact(machine);
    const Plant<float> rounded(machine);
    const auto x = golden_state<double>(row);
    const auto u = golden_input<double>(row);
    const auto xf = golden_state<float>(row);
    const auto uf = golden_input<float>(row);
    const auto a = exact.state_jacobian(x, u);
    EXPECT_LE((rounded.state_jacobian(xf, uf).cast<double>() - a).cwiseAbs().maxCoeff(),
              kFloatTolerance * a.cwiseAbs().maxCoeff());
    // A slope by inertia, mass or inductance is a derivative divided by it: as right as that balance's
    // largest summand.
    const auto found = rounded.parameter_jacobian(xf, uf);
    const auto summand = summand_of(row);
    const std::array<double, 3> divisor{machine.spindle.inertia_kgm2, machine.feed.mass_kg,
                                        machine.spindle.inductance_h};
    for (int i = 0; i < 3; ++i) {
      const auto balance = static_cast<std::size_t>(i);
      for (int j = 0; j < static_cast<int>(kParameterCount); ++j) {
        const bool is_divisor = j == std::array{1, 2, 4}[balance];
        const double scale = is_divisor ? summand[balance] / divisor[balance] : 0.0;
        const double expected = golden_slope(row, i, j);
        EXPECT_NEAR(double(found(i, j)), expected, kFloatTolerance * (std::abs(expected) + scale))
            << i << " " << j;
      }
    }
  }
}

}  // namespace
}  // namespace morepro
