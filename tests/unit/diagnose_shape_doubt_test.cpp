// Sizes and values beside a shape that is not the machine's are as far off as is stated.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "sim_host/diagnose/outcome/shape_doubt.hpp"
#include "tests/unit/driven_axis.hpp"

namespace morepro::diagnose_test {
namespace {

using host::BalanceResult;
using host::EffectResult;

struct DoubtOfSizes : testing::Test {
  const RecordingSignals signals = record(SimulatedRun{.duration_s = 0.1});
  const host::GapModel model = gap_model(host::built_in_machine("reference"), signals);
  const host::AxisFit fit{host::Axis::kFeed, signals, model};
  host::AxisDiagnosis diagnosis{fit, fit};
  std::vector<EffectResult> which;

  void find(Effect effect, double evidence) {
    diagnosis.found.push_back(
        {.effect = gap::applied(effect, 1.0, gap::EffectScales<double>(model.machine, model.point)),
         .evidence = evidence,
         .rivals = {}});
    which.push_back({.effect = effect, .magnitude = 2.0, .standard_error = 0.0, .alias_set = {}});
  }

  void doubt(double residual_ratio, double residual_ratio_after) {
    const std::vector<BalanceResult> where{// Another axis's is no matter.
                                           {.balance = gap::Balance::kSpindleTorque,
                                            .is_evaluated = true,
                                            .residual_ratio = 9.0,
                                            .residual_ratio_after = 9.0},
                                           {.balance = gap::Balance::kFeedForce,
                                            .is_evaluated = true,
                                            .residual_ratio = residual_ratio,
                                            .residual_ratio_after = residual_ratio_after}};
    doubt_sizes(diagnosis, where, which);
  }
};

TEST_F(DoubtOfSizes, IsTheRootOfWhatIsLeftOfTheGap) {
  find(Effect::kFeedCoulombFriction, 500.0);
  doubt(101.0, 2.0);
  EXPECT_NEAR(which[0].standard_error, 0.1 * which[0].magnitude, 1.0e-12);
}

TEST_F(DoubtOfSizes, IsLargerOfThatWhichIsWorthLess) {
  find(Effect::kFeedCoulombFriction, 300.0);
  find(Effect::kFeedForceOffset, 100.0);
  doubt(101.0, 2.0);
  EXPECT_NEAR(which[0].standard_error, 0.1 / std::sqrt(0.75) * 2.0, 1.0e-12);
  EXPECT_NEAR(which[1].standard_error, 0.1 / std::sqrt(0.25) * 2.0, 1.0e-12);
}

TEST_F(DoubtOfSizes, IsNoneWhereNothingIsLeftAndNeverMoreThanTheSize) {
  find(Effect::kFeedCoulombFriction, 500.0);
  doubt(101.0, 1.0);
  EXPECT_EQ(which[0].standard_error, 0.0);
  doubt(2.0, 3.0);
  EXPECT_EQ(which[0].standard_error, which[0].magnitude);
}

// Friction that takes up to its size for longer than any of the catalogue: 16.3 +- 0.2 N, and a mass of 3.22
// kg to a thousandth.
TEST(ShapeDoubt, IsInTheErrorsOfTheSizeAndOfTheMass) {
  constexpr double kFrictionN = 20.0;
  constexpr double kSlipM_s = 0.003;
  const DrivenAxis axis{.brake_at = [](double speed_m_s) {
    return kFrictionN * 2.0 / std::numbers::pi * std::atan(speed_m_s / kSlipM_s);
  }};
  const DiagnosisResult result = diagnosed(record(axis), datasheet(0.1));
  ASSERT_FALSE(result.which.empty()) << said(result);
  const EffectResult& friction = result.which.front();
  ASSERT_EQ(friction.effect, Effect::kFeedCoulombFriction) << said(result);
  EXPECT_NEAR(friction.magnitude, kFrictionN, 2.0 * friction.standard_error);
  EXPECT_LT(friction.standard_error, 0.3 * kFrictionN);
  const host::ParameterResult& mass = result.parameters.front();
  const double true_mass_kg = axis.configuration.machine.feed.mass_kg;
  EXPECT_NEAR(mass.refit, true_mass_kg, 2.0 * mass.standard_error);
  EXPECT_LT(mass.standard_error, 0.3 * true_mass_kg);
  EXPECT_TRUE(mass.is_identifiable);
  EXPECT_NE(result.explanation.find("has another shape"), std::string::npos) << result.explanation;
}

}  // namespace
}  // namespace morepro::diagnose_test
