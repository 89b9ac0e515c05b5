#include <gtest/gtest.h>

#include <cmath>

#include "lib/gap/dry_friction.hpp"

namespace morepro::gap {
namespace {

constexpr double kWidth = 0.2;

/// dx/dt = -loss tanh(x / width) over a time of one, in small steps of fourth order.
double integrated(double x, double loss) {
  constexpr int kSteps = 20000;
  const auto rate = [loss](double value) { return -loss * std::tanh(value / kWidth); };
  const double h = 1.0 / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const double a = rate(x);
    const double b = rate(x + 0.5 * h * a);
    const double c = rate(x + 0.5 * h * b);
    x += h / 6.0 * (a + 2.0 * b + 2.0 * c + rate(x + h * c));
  }
  return x;
}

TEST(DryFriction, IsTheSolutionOfItsEquation) {
  for (const double start : {-9.0, -1.0, -0.1, 0.0, 0.05, 0.5, 3.0, 9.0})
    for (const double loss : {0.0, 0.1, 1.0, 2.9})
      EXPECT_NEAR(friction_step(start, kWidth, loss).value, integrated(start, loss), 1.0e-9)
          << start << " " << loss;
}

TEST(DryFriction, KnowsWhatIsLeftOfASmallDifference) {
  constexpr double kStep = 1.0e-5;
  for (const double start : {-1.0, -0.1, 0.02, 0.5, 3.0})
    for (const double loss : {0.1, 1.0, 2.9}) {
      const double difference =
          friction_step(start + kStep, kWidth, loss).value - friction_step(start - kStep, kWidth, loss).value;
      EXPECT_NEAR(friction_step(start, kWidth, loss).slope, difference / (2.0 * kStep), 1.0e-6)
          << start << " " << loss;
    }
}

TEST(DryFriction, StopsAndDoesNotTurnRoundWhateverItsSize) {
  for (const float loss : {1.0F, 1.0e3F, 1.0e9F}) {
    const auto stuck = friction_step(0.3F, 0.2F, loss);
    EXPECT_GE(stuck.value, 0.0F);
    EXPECT_LE(stuck.value, 0.01F);
    EXPECT_TRUE(std::isfinite(stuck.slope));
  }
}

}  // namespace
}  // namespace morepro::gap
