#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lib/plant/built_in_machines.hpp"
#include "lib/plant/friction_models.hpp"

namespace morepro {
namespace {

bool has(std::uint8_t flags, FrictionFlag flag) { return (flags & bits_of(flag)) != 0; }

TEST(FrictionModels, TheProductIsTheSpeedModelTimesTheThermalFactor) {
  for (const MachineParameters& machine : {reference_machine(), thesis_machine()}) {
    const FrictionModels<double> models(machine);
    for (const double speed : {60.0, 300.0, 600.0}) {
      for (const double degc : {300.0, 480.0, 900.0, 1500.0}) {
        const double chip = machine.tool.chip_load_mm;
        const double expected =
            models.machining_speed(speed, chip).beta * models.temperature(degc).beta * std::sqrt(3.0);
        EXPECT_NEAR(models.product(speed, chip, degc).beta, expected, 1.0e-14);
      }
    }
  }
}

TEST(FrictionModels, TemperatureSoftensBetweenItsBoundsAndFlagsBeyond) {
  const FrictionModels<float> models(thesis_machine());
  EXPECT_FLOAT_EQ(models.temperature(400.0F).beta, 0.57735027F);
  EXPECT_EQ(models.temperature(1400.0F).beta, 0.0F);
  float last = 1.0F;
  for (float degc = 400.0F; degc <= 1400.0F; degc += 50.0F) {
    const auto friction = models.temperature(degc);
    EXPECT_LT(friction.beta, last);
    EXPECT_EQ(friction.flags, 0);
    last = friction.beta;
  }
  EXPECT_TRUE(has(models.temperature(399.0F).flags, FrictionFlag::kBelowReference));
  EXPECT_TRUE(has(models.temperature(1401.0F).flags, FrictionFlag::kAboveMelting));
}

TEST(FrictionModels, FrictionThatWouldDriveIsZeroAndSaid) {
  const FrictionModels<double> literal(thesis_machine());
  // The zero crossings of equation 15: 1658, 546 and 317 rad/s.
  for (const auto& [chip, crossing] : {std::pair{0.1, 1658.0}, {0.5, 546.0}, {1.1, 317.0}}) {
    EXPECT_FALSE(has(literal.machining_speed(crossing - 1.0, chip).flags, FrictionFlag::kNegative)) << chip;
    EXPECT_TRUE(has(literal.machining_speed(crossing + 1.0, chip).flags, FrictionFlag::kNegative)) << chip;
  }
}

TEST(FrictionModels, SayWhatLeftTheRangeAndAreFiniteForEverything) {
  const float infinity = std::numeric_limits<float>::infinity(), largest = std::numeric_limits<float>::max();
  const float all[] = {0.0F,    -0.0F,    1.0e-38F, 0.05F,     500.0F,       -500.0F,
                       largest, -largest, infinity, -infinity, std::nanf("")};
  for (const MachineParameters& machine : {reference_machine(), thesis_machine()}) {
    const FrictionModels<float> models(machine);
    for (const float a : all) {
      for (const float b : all) {
        for (const float c : all) {
          const auto friction = models.product(a, b, c);
          const bool is_number = std::isfinite(a) && std::isfinite(b) && std::isfinite(c);
          EXPECT_TRUE(std::isfinite(friction.beta) && friction.beta >= 0.0F) << a << " " << b << " " << c;
          EXPECT_EQ(has(friction.flags, FrictionFlag::kNotANumber), !is_number) << a << " " << b << " " << c;
        }
      }
    }
  }
  const FrictionModels<float> consistent(reference_machine());
  EXPECT_EQ(consistent.machining_speed(10.0F, 0.001F).flags,
            bits_of(ContactFlag::kCuttingSpeedLow) | bits_of(ContactFlag::kFeedLow));
}

}  // namespace
}  // namespace morepro
