#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lib/gap/effect_size.hpp"
#include "lib/plant/built_in_machines.hpp"
#include "sim_host/simulate/operating_point.hpp"
#include "sim_host/simulate/simulated_machine.hpp"
#include "sim_host/support/user_error.hpp"
#include "tests/support/reference_effect.hpp"

namespace morepro::host {
namespace {

using gap::Effect;
using test::effect;

constexpr double kPeriodS = 1.0e-4;

PlantInput<double> driven(double voltage_v, double force_n, double contact = 0.0) {
  return {.armature_voltage_v = voltage_v,
          .feed_force_n = force_n,
          .contact = contact,
          .engagement = 1.0,
          .chip_load_mm = 0.05,
          .tool_temperature_degc = 500.0};
}

/// Forward with contact, then backward.
PlantState<double> moved(const std::vector<gap::AppliedEffect>& effects, double substep_s) {
  SimulatedMachine machine(reference_machine(), kPeriodS, effects, substep_s);
  for (int k = 0; k < 300; ++k)
    machine.step(driven(k < 200 ? 40.0 : -20.0, k < 150 ? 30.0 : -30.0, k < 100 ? 1 : 0));
  return machine.state();
}

double distance(const PlantState<double>& a, const PlantState<double>& b) {
  return std::fabs(a.speed_rad_s - b.speed_rad_s) + std::fabs(a.current_a - b.current_a) +
         1.0e3 * std::fabs(a.feed_speed_m_s - b.feed_speed_m_s);
}

TEST(SimulatedMachine, WithEffectsConvergesWithTheSquareOfItsSubstep) {
  for (const auto& [name, size] :
       {std::pair{Effect::kSpindleWindage, 2.0e-7}, std::pair{Effect::kShaftCompliance, 20.0},
        std::pair{Effect::kFeedSpring, 5.0e4}, std::pair{Effect::kFeedPresliding, 5.0},
        std::pair{Effect::kTorqueConstantSaturation, 1.0e-4}, std::pair{Effect::kSpindleCogging, 0.1}}) {
    const auto exact = moved({effect(name, size)}, 1.0e-6);
    const double coarse = distance(moved({effect(name, size)}, 2.0e-5), exact);
    const double fine = distance(moved({effect(name, size)}, 1.0e-5), exact);
    EXPECT_GT(coarse, 3.0 * fine) << static_cast<int>(name);
    EXPECT_LT(coarse, 5.0e-3) << static_cast<int>(name);
  }
}

TEST(SimulatedMachine, FollowsFrictionThatIsSteeperThanItsSubstep) {
  // 200 N over 0.2 mm/s on 3 kg: a time constant of 2.8 us.
  const auto exact = moved({effect(Effect::kFeedCoulombFriction, 20.0)}, 1.0e-6);
  EXPECT_LT(distance(moved({effect(Effect::kFeedCoulombFriction, 20.0)}, 2.0e-5), exact), 1.0e-2);
  SimulatedMachine stuck(reference_machine(), kPeriodS,
                         std::vector{effect(Effect::kFeedCoulombFriction, 200.0)});
  for (int k = 0; k < 1000; ++k) stuck.step(driven(0.0, 100.0));
  // Half of the friction holds half of the force: v = 0.01 v0 atanh(1/2), less 200 N s/m of viscous friction.
  EXPECT_NEAR(stuck.state().feed_speed_m_s, 0.01 * 0.01839 * std::atanh(0.5), 2.0e-7);
}

TEST(SimulatedMachine, RefusesWhatIsTooStiff) {
  EXPECT_THROW(SimulatedMachine(reference_machine(), kPeriodS,
                                std::vector{effect(Effect::kFeedCoulombFriction, 1.0e6)}),
               UserError);
}

TEST(SimulatedMachine, TakesTheLoadOfFrictionAsCurrent) {
  SimulatedMachine machine(reference_machine(), kPeriodS,
                           std::vector{effect(Effect::kSpindleCoulombFriction, 0.04)});
  for (int k = 0; k < 20000; ++k) machine.step(driven(24.0, 0.0));
  // Kt i = Att w + 0.04.
  const double load_nm = 1.0e-4 * machine.state().speed_rad_s + 0.04;
  EXPECT_NEAR(machine.state().current_a, load_nm / 0.08, 1e-9);
}

TEST(SimulatedMachine, IsTheSameWhetherFrictionIsAParameterOrAnEffect) {
  MachineParameters stiffer = reference_machine();
  stiffer.feed.viscous_friction_ns_m += 20.0;
  SimulatedMachine changed(stiffer, kPeriodS);
  SimulatedMachine with_effect(reference_machine(), kPeriodS,
                               std::vector{effect(Effect::kFeedViscousFriction, 20.0)});
  for (int k = 0; k < 500; ++k) {
    changed.step(driven(10.0, k < 250 ? 30.0 : -30.0));
    with_effect.step(driven(10.0, k < 250 ? 30.0 : -30.0));
    EXPECT_NEAR(with_effect.state().feed_speed_m_s, changed.state().feed_speed_m_s, 1e-8);
    // What an acceleration sensor shows, too.
    const auto rate = [k](const SimulatedMachine& machine) {
      return machine.derivative(driven(10.0, k < 250 ? 30.0 : -30.0)).feed_acceleration_m_s2;
    };
    EXPECT_NEAR(rate(with_effect), rate(changed), 1e-6);
  }
}

TEST(SimulatedMachine, LagsItsDriveByTheTimeConstant) {
  // Without back-EMF in the first 0.2 ms, the current behind a 2 ms lag follows its quadratic begin.
  SimulatedMachine machine(reference_machine(), kPeriodS, std::vector{effect(Effect::kDriveLag, 2.0e-3)});
  machine.step(driven(0.0, 0.0));
  for (int k = 0; k < 50; ++k) machine.step(driven(10.0, 0.0));
  SimulatedMachine reference(reference_machine(), 1.0e-6);
  for (int k = 0; k < 5000; ++k)
    reference.step(driven(10.0 * (1.0 - std::exp(-(k + 0.5) * 1.0e-6 / 2.0e-3)), 0.0));
  EXPECT_NEAR(machine.state().current_a, reference.state().current_a, 1.0e-4 * reference.state().current_a);
  EXPECT_NEAR(machine.state().speed_rad_s, reference.state().speed_rad_s,
              1.0e-4 * reference.state().speed_rad_s);
}

/// Two equal masses on a shaft, by many small steps of Euler's symplectic rule.
struct TwoMasses {
  double motor_rad_s = 0.0, tool_rad_s = 0.0, twist_rad = 0.0;
  /// `cut_nm`: at the tool's end.
  void step(double torque_nm, double stiffness, double inertia, double damping, double step_s,
            double cut_nm = 0.0) {
    const double shaft_nm = stiffness * twist_rad + damping * (motor_rad_s - tool_rad_s);
    motor_rad_s += step_s * (torque_nm - shaft_nm) / (0.5 * inertia);
    tool_rad_s += step_s * (shaft_nm - cut_nm) / (0.5 * inertia);
    twist_rad += step_s * (motor_rad_s - tool_rad_s);
  }
};

/// How far the motor of a machine with a compliant shaft is from two masses', as a share of its largest
/// speed; from half of the time on in contact.
double deviation_from_two_masses(const gap::AppliedEffect& shaft, double stiffness, bool cuts) {
  MachineParameters parameters = reference_machine();
  parameters.spindle.viscous_friction_nms_rad = 0.0;
  const double inertia = parameters.spindle.inertia_kgm2;
  const double damping = 0.1 * std::sqrt(4.0 * stiffness / inertia) * 0.25 * inertia;
  SimulatedMachine machine(parameters, kPeriodS, std::vector{shaft}, 2.0e-6);
  const Plant<double> plant(parameters);
  TwoMasses masses;
  double worst = 0.0, largest = 0.0;
  for (int k = 0; k < 200; ++k) {
    const PlantState<double> before = machine.state();
    const double contact = cuts && k >= 100 ? 1.0 : 0.0;
    const auto free = plant.derivative(before, driven(24.0, 0.0));
    const auto cutting = plant.derivative(before, driven(24.0, 0.0, contact));
    const double cut_nm = inertia * (free.acceleration_rad_s2 - cutting.acceleration_rad_s2);
    machine.step(driven(24.0, 0.0, contact));
    for (int i = 0; i < 1000; ++i) {
      const double current_a =
          before.current_a + (machine.state().current_a - before.current_a) * (i + 0.5) / 1000.0;
      masses.step(0.08 * current_a, stiffness, inertia, damping, kPeriodS / 1000.0, cut_nm);
    }
    worst = std::max(worst, std::fabs(machine.state().speed_rad_s - masses.motor_rad_s));
    largest = std::max(largest, masses.motor_rad_s);
  }
  EXPECT_GT(largest, 100.0);
  return worst / largest;
}

// The current is taken as straight over 0.1 ms, the cut as that of its beginning.
TEST(SimulatedMachine, WithACompliantShaftMovesLikeTwoMasses) {
  constexpr double kStiffness = 20.0;
  auto shaft = effect(Effect::kShaftCompliance, kStiffness);
  EXPECT_LT(deviation_from_two_masses(shaft, kStiffness, false), 2.0e-3);
  // The cut loads the far one.
  shaft.form.parts = 2;
  shaft.coefficient[1] = 2.0;
  EXPECT_LT(deviation_from_two_masses(shaft, kStiffness, true), 2.0e-3);
}

TEST(SimulatedMachine, DelaysWhatASensorShows) {
  SimulatedMachine machine(reference_machine(), kPeriodS, std::vector{effect(Effect::kCurrentDelay, 3.0e-4)});
  std::vector<double> truth;
  double worst_a = 0.0;
  for (int k = 0; k < 100; ++k) {
    truth.push_back(machine.state().current_a);
    const double shown_a = machine.state().current_a + machine.sensor_error().current_a;
    if (k >= 3) worst_a = std::max(worst_a, std::fabs(shown_a - truth[truth.size() - 4]));
    machine.step(driven(k % 7 < 3 ? 20.0 : -10.0, 0.0));
  }
  // The delay is a float: 3e-4 s is 1.5e-11 s too long, on slopes of 4e4 A/s.
  EXPECT_LT(worst_a, 1.0e-6);
}

TEST(SimulatedMachine, ShowsSignalsBehindALowPass) {
  constexpr double kTimeS = 1.0e-3;
  SimulatedMachine machine(
      reference_machine(), kPeriodS,
      std::vector{effect(Effect::kCurrentBandwidth, kTimeS), effect(Effect::kSpindleSpeedBandwidth, kTimeS)});
  double current_a = 0.0, speed_rad_s = 0.0;
  for (int k = 0; k < 100; ++k) {
    const PlantState<double> before = machine.state();
    machine.step(driven(20.0, 0.0));
    const PlantState<double> after = machine.state();
    // The signal taken as straight over 0.1 ms, the low pass by many small steps.
    for (int i = 0; i < 1000; ++i) {
      const double part = (i + 0.5) / 1000.0;
      const double step = kPeriodS / 1000.0 / kTimeS;
      current_a += step * (before.current_a + part * (after.current_a - before.current_a) - current_a);
      speed_rad_s +=
          step * (before.speed_rad_s + part * (after.speed_rad_s - before.speed_rad_s) - speed_rad_s);
    }
    // The signal bends within 0.1 ms: a hundredth of an ampere.
    EXPECT_NEAR(after.current_a + machine.sensor_error().current_a, current_a, 0.02);
    EXPECT_NEAR(after.speed_rad_s + machine.sensor_error().speed_rad_s, speed_rad_s, 0.01);
  }
}

TEST(SimulatedMachine, HeatsItsWindingByCurrentAndItsToolByTheCut) {
  SimulatedMachine machine(reference_machine(), kPeriodS);
  const double cold_degc = machine.temperatures().winding_degc();
  EXPECT_EQ(machine.temperatures().tool_degc(), 500.0);
  for (int k = 0; k < 20000; ++k) machine.step(driven(24.0, 0.0));
  const double idle_degc = machine.temperatures().winding_degc();
  // 2 s in the air of a time constant of 40 s.
  EXPECT_NEAR(machine.temperatures().tool_degc(), 25.0 + 475.0 * std::exp(-0.05), 0.1);
  for (int k = 0; k < 20000; ++k) machine.step(driven(24.0, 0.0, 1.0));
  EXPECT_GT(idle_degc, cold_degc);
  EXPECT_GT(machine.temperatures().winding_degc() - idle_degc, idle_degc - cold_degc);
  // 2 s of a time constant of 2 s.
  EXPECT_NEAR(machine.temperatures().tool_degc(), 500.0 - 475.0 * (1.0 - std::exp(-0.05)) * std::exp(-1.0),
              0.1);
}

TEST(SimulatedMachine, LosesItsLoadInTheBacklash) {
  // Half of the mass is free until the play is crossed: twice the acceleration.
  SimulatedMachine rigid(reference_machine(), kPeriodS);
  SimulatedMachine loose(reference_machine(), kPeriodS, std::vector{effect(Effect::kFeedBacklash, 1.0e-4)});
  for (int k = 0; k < 10; ++k) {
    rigid.step(driven(0.0, 10.0));
    loose.step(driven(0.0, 10.0));
  }
  EXPECT_NEAR(loose.state().feed_speed_m_s / rigid.state().feed_speed_m_s, 2.0, 0.1);
  for (int k = 0; k < 3000; ++k) {
    rigid.step(driven(0.0, 10.0));
    loose.step(driven(0.0, 10.0));
  }
  EXPECT_NEAR(loose.state().feed_speed_m_s, rigid.state().feed_speed_m_s, 1e-6);
  // Beyond the play it is one mass again; after a reversal the drive runs alone until it has crossed the
  // play.
  const auto pushed = [](const SimulatedMachine& machine, double force_n) {
    return machine.derivative(driven(0.0, force_n)).feed_acceleration_m_s2;
  };
  EXPECT_NEAR(pushed(loose, 13.0), pushed(rigid, 13.0), 1e-3);
  for (int k = 0; k < 10; ++k) loose.step(driven(0.0, -40.0));
  EXPECT_NEAR(pushed(loose, -40.0), 2.0 * -40.0 / 3.0, 1e-6);
  for (int k = 0; k < 300; ++k) loose.step(driven(0.0, -40.0));
  EXPECT_NEAR(pushed(loose, -40.0), (-40.0 - 200.0 * loose.state().feed_speed_m_s) / 3.0, 1e-6);
}

}  // namespace
}  // namespace morepro::host
