#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "lib/plant/built_in_machines.hpp"
#include "lib/plant/contact_law.hpp"

namespace morepro {
namespace {

constexpr std::array<double, 4> kExtremes{0.0, 1.0e-30, 1.0e6, 3.0e38};

TEST(ContactLaw, FlagsEveryBoundOfItsRange) {
  struct Case {
    double cutting_speed;
    double feed;
    int flags;
  };
  const MachineParameters machine = reference_machine();
  const ContactLaw<double> law(machine);
  for (const Case& c : {Case{69.9, 0.2, 1},
                        {230.1, 0.2, 2},
                        {100.0, 0.079, 4},
                        {100.0, 0.471, 8},
                        {69.9, 0.079, 5},
                        {230.1, 0.471, 10},
                        {70.1, 0.081, 0},
                        {229.9, 0.469, 0}}) {
    const double speed = c.cutting_speed / (0.03 * machine.tool.diameter_mm);
    EXPECT_EQ(law(speed, c.feed / machine.tool.teeth, 500.0).flags, c.flags)
        << c.cutting_speed << ' ' << c.feed;
  }
}

TEST(ContactLaw, HoldsItsValueOutsideOfTheRange) {
  const ContactLaw<double> law(reference_machine());
  EXPECT_EQ(law(800.0, 0.05, 500.0).beta, law(5000.0, 0.05, 500.0).beta);
  EXPECT_EQ(law(10.0, 0.05, 500.0).beta, law(0.0, 0.05, 500.0).beta);
  EXPECT_EQ(law(500.0, 0.001, 500.0).beta, law(500.0, 0.0, 500.0).beta);
}

TEST(ContactLaw, HasNoSlopeInClampedDirections) {
  const ContactLaw<double> law(reference_machine());
  EXPECT_EQ(law.friction(800.0, 0.05, 0.7).per_speed, 0.0);
  EXPECT_EQ(law.friction(10.0, 0.05, 0.7).per_speed, 0.0);
  EXPECT_EQ(law.friction(500.0, 0.2, 0.7).per_chip_load, 0.0);
  EXPECT_LT(law.friction(500.0, 0.05, 0.7).per_speed, 0.0);
  EXPECT_LT(law.friction(500.0, 0.05, 0.7).per_chip_load, 0.0);
}

TEST(ContactLaw, ThesisFormStopsAtZeroFriction) {
  const ContactLaw<double> law(thesis_machine());
  EXPECT_GT(law(540.0, 0.5, 400.0).beta, 0.0);
  const auto beyond = law(550.0, 0.5, 400.0);
  EXPECT_EQ(beyond.beta, 0.0);
  EXPECT_EQ(beyond.torque_nm, 0.0);
  EXPECT_EQ(beyond.per_speed, 0.0);
  EXPECT_EQ(beyond.per_chip_load, 0.0);
}

TEST(ContactLaw, TorqueOpposesTheRotationInEitherDirection) {
  for (const MachineParameters& machine : {reference_machine(), thesis_machine()}) {
    const ContactLaw<double> law(machine);
    for (const double speed : {0.3, 5.0, 90.0, 250.0}) {
      const auto forward = law(speed, machine.tool.chip_load_mm, 500.0);
      const auto backward = law(-speed, machine.tool.chip_load_mm, 500.0);
      EXPECT_GT(forward.torque_nm, 0.0);
      EXPECT_EQ(backward.torque_nm, -forward.torque_nm);
      EXPECT_EQ(backward.per_speed, forward.per_speed);
    }
  }
}

TEST(ContactLaw, MoreChipLoadMeansMoreTorqueOnlyWithANormalForce) {
  EXPECT_NEAR(ContactLaw<double>(reference_machine())(577.7, 0.05, 500.0).per_chip_load, 1.19, 0.01);
  EXPECT_LT(ContactLaw<double>(thesis_machine())(93.6, 0.5, 500.0).per_chip_load, 0.0);
}

TEST(ContactLaw, ThermalFactorIsClippedAtBothEnds) {
  const ContactLaw<double> law(reference_machine());
  EXPECT_EQ(law.thermal_factor(-273.0), 1.0);
  EXPECT_EQ(law.thermal_factor(400.0), 1.0);
  EXPECT_EQ(law.thermal_factor(1400.0), 0.0);
  EXPECT_EQ(law.thermal_factor(1.0e30), 0.0);
}

template <class Real>
void expect_finite(const MachineParameters& machine, Real speed, Real chip, Real temperature) {
  const auto torque = ContactLaw<Real>(machine)(speed, chip, temperature);
  for (const Real value : {torque.torque_nm, torque.per_speed, torque.per_chip_load, torque.beta}) {
    EXPECT_TRUE(std::isfinite(value)) << speed << ' ' << chip << ' ' << temperature;
  }
  EXPECT_GE(torque.beta, Real(0));
}

TEST(ContactLaw, IsFiniteForEveryFiniteArgument) {
  MachineParameters steep = reference_machine();
  steep.contact.viscous_gain_nms = 100.0;
  for (const MachineParameters& machine : {reference_machine(), thesis_machine(), steep}) {
    for (const double speed : kExtremes) {
      for (const double chip : kExtremes) {
        for (const double temperature : {-3.0e38, 0.0, 400.0, 400.000001, 1400.0, 3.0e38}) {
          for (const double sign : {-1.0, 1.0}) {
            expect_finite<double>(machine, sign * speed, chip, temperature);
            expect_finite<double>(machine, speed, sign * chip, temperature);
            expect_finite<float>(machine, static_cast<float>(sign * speed), static_cast<float>(chip),
                                 static_cast<float>(temperature));
          }
        }
      }
    }
  }
}

TEST(ContactLaw, ShowsNanInsteadOfHidingIt) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const ContactLaw<double> law(reference_machine());
  EXPECT_TRUE(std::isnan(law(nan, 0.05, 500.0).torque_nm));
  EXPECT_TRUE(std::isnan(law(500.0, nan, 500.0).torque_nm));
  EXPECT_TRUE(std::isnan(law(500.0, 0.05, nan).torque_nm));
}

TEST(ContactLaw, SharedThermalFactorGivesTheSameTorque) {
  const ContactLaw<float> law(reference_machine());
  const auto direct = law(577.0F, 0.05F, 480.0F);
  const auto shared = law.at_thermal_factor(577.0F, 0.05F, law.thermal_factor(480.0F));
  EXPECT_EQ(direct.torque_nm, shared.torque_nm);
  EXPECT_EQ(direct.per_speed, shared.per_speed);
}

TEST(ContactLaw, KnowsWhichChipLoadsAreInsideItsRange) {
  const MachineParameters machine = reference_machine();
  for (const double chip : {0.02, 0.05, 0.11, 0.47 / 4.0})
    EXPECT_TRUE(is_inside_contact_range(machine, chip));
  for (const double chip : {0.0199, 0.118, 0.5, 0.0, -0.05, std::nan("")}) {
    EXPECT_FALSE(is_inside_contact_range(machine, chip)) << chip;
  }
  EXPECT_TRUE(is_inside_contact_range(thesis_machine(), 1.1));
}

}  // namespace
}  // namespace morepro
