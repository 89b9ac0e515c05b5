#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "lib/plant/cutting_force.hpp"

namespace morepro {
namespace {

constexpr double kPi = std::numbers::pi;

/// Mean over one turn, by the midpoint rule.
CuttingForce<double> mean_over_a_turn(const MillingCut& cut, int samples = 3600) {
  const CuttingForceModel<double> model(cut);
  CuttingForce<double> mean;
  for (int k = 0; k < samples; ++k) {
    const auto force = model.at(2.0 * kPi * (k + 0.5) / samples);
    mean.x_n += force.x_n / samples;
    mean.y_n += force.y_n / samples;
    mean.tangential_n += force.tangential_n / samples;
    mean.torque_nm += force.torque_nm / samples;
  }
  return mean;
}

/// What a cut of entry .. exit costs on average: N ap Kt fz times the mean of the trigonometric factors.
TEST(CuttingForce, MeanIsTheIntegralOverTheImmersion) {
  for (const double exit : {kPi, 0.5 * kPi, 1.0}) {
    for (const int teeth : {1, 2, 4, 7}) {
      MillingCut cut{.teeth = teeth, .exit_rad = exit};
      const double size = cut.teeth * cut.depth_mm * cut.pressure_n_mm2 * cut.chip_load_mm / (2.0 * kPi);
      const double sine2 = 0.5 * exit - 0.25 * std::sin(2.0 * exit),
                   sine_cosine = 0.5 * std::pow(std::sin(exit), 2);
      const auto mean = mean_over_a_turn(cut);
      // The midpoint rule misses a step at the exit by at most one sample of 3600.
      const double tolerance = 2.0e-3 * size;
      EXPECT_NEAR(mean.tangential_n, size * (1.0 - std::cos(exit)), tolerance) << teeth;
      EXPECT_NEAR(mean.x_n, size * (sine_cosine + cut.radial_ratio * sine2), tolerance) << teeth;
      EXPECT_NEAR(mean.y_n, size * (sine2 - cut.radial_ratio * sine_cosine), tolerance) << teeth;
      EXPECT_NEAR(mean.torque_nm, mean.tangential_n * cut.diameter_mm / 2000.0, 1.0e-12);
    }
  }
}

TEST(CuttingForce, FrictionFollowsFromTheRatioAndTheRakeOnly) {
  for (const double ratio : {0.1, 0.35, 0.8}) {
    for (const double rake : {-0.05, 0.0, 0.2}) {
      const double expected = (ratio + std::tan(rake)) / (1.0 - ratio * std::tan(rake));
      for (const double pressure : {500.0, 3000.0}) {
        const MillingCut cut{.pressure_n_mm2 = pressure, .radial_ratio = ratio, .rake_rad = rake};
        EXPECT_NEAR(CuttingForceModel<double>(cut).friction_coefficient(), expected, 1.0e-14);
        EXPECT_NEAR(CuttingForceModel<float>(cut).friction_coefficient(), expected, 1.0e-6);
      }
    }
  }
}

TEST(CuttingForce, ThePrintedCoefficientIsATurnedFrameWithAPole) {
  const MillingCut cut;
  const CuttingForceModel<double> model(cut);
  const double pole = 0.5 * kPi + std::atan(cut.radial_ratio) - cut.rake_rad;
  EXPECT_NEAR(pole * 180.0 / kPi, 103.3, 0.05);
  EXPECT_FALSE(model.literal_coefficient(pole).is_defined);
  EXPECT_GT(model.literal_coefficient(pole - 0.01).value, 90.0);
  EXPECT_LT(model.literal_coefficient(pole + 0.01).value, -90.0);
}

TEST(CuttingForce, IsFiniteAtEveryAngle) {
  const CuttingForceModel<float> model{MillingCut{.teeth = 3, .entry_rad = 0.3, .exit_rad = 2.0}};
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float angle : {0.0F, -0.0F, 1.0e-30F, -7.5F, 1.0e5F, 3.0e38F, -3.0e38F}) {
    const auto force = model.at(angle);
    EXPECT_TRUE(std::isfinite(force.x_n + force.y_n + force.axial_n + force.torque_nm)) << angle;
    EXPECT_TRUE(std::isfinite(model.literal_coefficient(angle).value)) << angle;
  }
  for (const float angle : {infinity, -infinity, std::nanf("")}) {
    EXPECT_EQ(model.at(angle).tangential_n, 0.0F);
    EXPECT_FALSE(model.literal_coefficient(angle).is_defined);
  }
}

TEST(CuttingForce, RefusesWhatNoCutterIs) {
  const double nan = std::nan("");
  EXPECT_EQ(MillingCut{}.validate(), CutError::kNone);
  for (const double wrong : {0.0, -1.0, nan}) {
    EXPECT_EQ(MillingCut{.pressure_n_mm2 = wrong}.validate(), CutError::kPressure);
    EXPECT_EQ(MillingCut{.chip_load_mm = wrong}.validate(), CutError::kGeometry);
    EXPECT_EQ(MillingCut{.depth_mm = wrong}.validate(), CutError::kGeometry);
    EXPECT_EQ(MillingCut{.diameter_mm = wrong}.validate(), CutError::kGeometry);
    EXPECT_EQ(MillingCut{.exit_rad = wrong}.validate(), CutError::kImmersion);
  }
  EXPECT_EQ(MillingCut{.radial_ratio = nan}.validate(), CutError::kPressure);
  EXPECT_EQ(MillingCut{.teeth = 0}.validate(), CutError::kTeeth);
  EXPECT_EQ(MillingCut{.teeth = 33}.validate(), CutError::kTeeth);
  EXPECT_EQ(MillingCut{.helix_rad = 1.55}.validate(), CutError::kHelix);
  EXPECT_EQ((MillingCut{.entry_rad = 2.0, .exit_rad = 1.0}.validate()), CutError::kImmersion);
  EXPECT_EQ(MillingCut{.rake_rad = 1.4}.validate(), CutError::kRake);
  EXPECT_EQ(MillingCut{.rake_rad = -0.5}.validate(), CutError::kRake);
}

}  // namespace
}  // namespace morepro
