#include <gtest/gtest.h>

#include <cmath>

#include "lib/plant/built_in_machines.hpp"
#include "lib/plant/dynamics.hpp"
#include "lib/plant/integrators.hpp"

namespace morepro {
namespace {

PlantInput<double> cutting_input(const MachineParameters& machine) {
  return {.armature_voltage_v = 48.0,
          .feed_force_n = 26.0,
          .contact = 1.0,
          .engagement = machine.feed.engagement,
          .chip_load_mm = machine.tool.chip_load_mm,
          .tool_temperature_degc = machine.thermal.tool_degc};
}

PlantState<double> settled(const MachineParameters& machine, const PlantInput<double>& input) {
  const ExponentialIntegrator<double> integrator(machine, 1.0e-4);
  PlantState<double> x;
  for (int k = 0; k < 10000; ++k) x = integrator.step(x, input);
  return x;
}

struct OperatingPoint {
  double speed_rad_s;
  double current_a;
};

void expect_settled(const MachineParameters& machine, double contact, const OperatingPoint& expected) {
  PlantInput<double> input = cutting_input(machine);
  input.contact = contact;
  const PlantState<double> x = settled(machine, input);
  EXPECT_NEAR(x.speed_rad_s, expected.speed_rad_s, 0.05);
  EXPECT_NEAR(x.current_a, expected.current_a, 0.05);
}

TEST(Plant, SettlesAtTheKnownOperatingPoints) {
  expect_settled(reference_machine(), 0.0, {592.6, 0.74});
  expect_settled(reference_machine(), 1.0, {577.7, 2.226});
  expect_settled(thesis_machine(), 0.0, {150.0, 30.0});
  expect_settled(thesis_machine(), 1.0, {93.6, 48.8});
}

/// Powers at one instant in W.
struct Powers {
  double supply;
  double lost;  ///< heat in the winding, friction and cut
};

Powers powers(const MachineParameters& machine, const PlantState<double>& x, const PlantInput<double>& u) {
  const double w = x.speed_rad_s;
  const double cut =
      ContactLaw<double>(machine)(w, u.chip_load_mm, u.tool_temperature_degc).torque_nm * u.contact;
  const double heat = machine.spindle.resistance_ohm * x.current_a * x.current_a;
  return {u.armature_voltage_v * x.current_a,
          heat + machine.spindle.viscous_friction_nms_rad * w * w + cut * w};
}

double stored_energy(const MachineParameters& machine, const PlantState<double>& x) {
  return 0.5 * machine.spindle.inductance_h * x.current_a * x.current_a +
         0.5 * machine.spindle.inertia_kgm2 * x.speed_rad_s * x.speed_rad_s;
}

/// (supplied - lost - stored) / supplied over 0.1 s from rest.
double energy_defect(const MachineParameters& machine) {
  constexpr double kStep = 1.0e-6;
  const Rk4Integrator<double> integrator(machine, kStep);
  const PlantInput<double> u = cutting_input(machine);
  PlantState<double> x;
  double supplied = 0.0;
  double lost = 0.0;
  for (int k = 0; k < 100000; ++k) {
    const Powers before = powers(machine, x, u);
    x = integrator.step(x, u);
    const Powers after = powers(machine, x, u);
    supplied += 0.5 * kStep * (before.supply + after.supply);
    lost += 0.5 * kStep * (before.lost + after.lost);
  }
  return (supplied - lost - stored_energy(machine, x)) / supplied;
}

// The trapezoid of the powers is off by h^2/12 times their curvature: 1e-12/12 * (1530/s)^2 = 2e-7.
TEST(Plant, EnergyClosesOnTheReferenceMachine) {
  EXPECT_NEAR(energy_defect(reference_machine()), 0.0, 2.0e-7);
}

TEST(Plant, EnergyDoesNotCloseOnTheThesisMachine) {
  const MachineParameters machine = thesis_machine();
  const PlantState<double> x = settled(machine, cutting_input(machine));
  EXPECT_NEAR(machine.spindle.torque_constant_nm_a * x.current_a * x.speed_rad_s, 6852.0, 5.0);
  EXPECT_NEAR(machine.spindle.back_emf_constant_vs_rad * x.current_a * x.speed_rad_s, 914.0, 1.0);
  EXPECT_LT(energy_defect(machine), -1.0);
}

TEST(Plant, FeedAxisKnowsNothingOfTheSpindle) {
  const Plant<double> plant(reference_machine());
  const PlantInput<double> u = cutting_input(reference_machine());
  const auto slow = plant.derivative({10.0, 0.02, 1.0}, u);
  const auto fast = plant.derivative({600.0, 0.02, 9.0}, u);
  EXPECT_EQ(slow.feed_acceleration_m_s2, fast.feed_acceleration_m_s2);
  EXPECT_NEAR(slow.feed_acceleration_m_s2, (26.0 - 200.0 * 0.02 - 22.0) / 3.0, 1.0e-12);
}

TEST(Plant, WithoutContactTheCutIsNotEvaluated) {
  PlantInput<double> u = cutting_input(reference_machine());
  u.contact = 0.0;
  u.chip_load_mm = std::nan("");
  const Plant<double> plant(reference_machine());
  EXPECT_TRUE(std::isfinite(plant.derivative({100.0, 0.0, 1.0}, u).acceleration_rad_s2));
  EXPECT_EQ(plant.linearise({1.0, 0.0, 1.0}, u).contact_flags, 0);
}

TEST(Plant, PassesTheContactLawsFlagsOn) {
  const Plant<double> plant(reference_machine());
  const PlantInput<double> u = cutting_input(reference_machine());
  EXPECT_EQ(plant.linearise({10.0, 0.0, 1.0}, u).contact_flags, bits_of(ContactFlag::kCuttingSpeedLow));
  EXPECT_EQ(plant.linearise({577.0, 0.0, 1.0}, u).contact_flags, 0);
}

TEST(Plant, IsFiniteOverExtremeStates) {
  for (const MachineParameters& machine : {reference_machine(), thesis_machine()}) {
    const Plant<float> plant(machine);
    for (const float w : {-2.0e4F, -1.0e-30F, 0.0F, 1.0e-30F, 0.99F, 1.01F, 2.0e4F}) {
      for (const float temperature : {-100.0F, 400.0F, 3000.0F}) {
        for (const float chip : {0.0F, 0.05F, 10.0F}) {
          const PlantInput<float> u{.armature_voltage_v = 1000.0F,
                                    .feed_force_n = -1.0e6F,
                                    .contact = 1.0F,
                                    .engagement = 10.0F,
                                    .chip_load_mm = chip,
                                    .tool_temperature_degc = temperature};
          EXPECT_TRUE(plant.state_jacobian({w, 100.0F, -2000.0F}, u).allFinite());
          EXPECT_TRUE(plant.parameter_jacobian({w, 100.0F, -2000.0F}, u).allFinite());
        }
      }
    }
  }
}

}  // namespace
}  // namespace morepro
