// Sizes and values beside a shape that is not the machine's are as far off as is stated.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "lib/gap/gap_watch_finding.hpp"
#include "sim_host/diagnose/fit/shape_freedom.hpp"
#include "sim_host/diagnose/outcome/shape_doubt.hpp"
#include "sim_host/diagnose/outcome/verdict.hpp"
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

// What disturbs a sensor acts in no balance, and shows in those of its axis.
TEST_F(DoubtOfSizes, IsTheRootOfWhatIsLeftOfTheGap) {
  for (const Effect effect : {Effect::kFeedCoulombFriction, Effect::kFeedSpeedDelay}) {
    diagnosis.found.clear();
    which.clear();
    find(effect, 500.0);
    doubt(101.0, 2.0);
    EXPECT_NEAR(which[0].standard_error, 0.1 * which[0].magnitude, 1.0e-12) << gap::name_of(effect);
  }
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

// A name beside a stronger one that two standard errors tell is seldom there; the strongest mostly is.
TEST_F(DoubtOfSizes, IsInTheConfidenceOfAWeakName) {
  find(Effect::kFeedBacklash, 9000.0);
  find(Effect::kFeedSpeedDelay, 100.0);
  for (EffectResult& named : which) named.confidence = 0.98;
  doubt(5.0, 2.0);  // what is left is a half of a size
  EXPECT_EQ(which[0].confidence, 0.98);
  EXPECT_EQ(which[1].confidence, 0.2);
  which[1].confidence = 0.1;
  doubt(5.0, 2.0);
  EXPECT_EQ(which[1].confidence, 0.1) << "what is doubted already is not doubted twice";
}

// Friction that takes longer to reach its size than any of the catalogue: a fifth of it is missing, and with
// noise alone in its error it was missing for sure.
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
  EXPECT_FALSE(mass.is_identifiable);
  EXPECT_NE(mass.reason.find("may have bent it"), std::string::npos) << mass.reason;
  EXPECT_NE(result.explanation.find("more than noise remains in feed_force"), std::string::npos)
      << result.explanation;
}

// Friction that nothing in the catalogue is left for: 8.9 +- 0.6 kg for 3 kg.
TEST(ShapeDoubt, IsInTheValuesBesideWhatHasNoName) {
  const RecordingSignals signals =
      record({.effects = {effect(Effect::kFeedCoulombFriction, 20.0)}, .rate_hz = 5000.0});
  const DiagnosisResult result =
      diagnosed(signals, datasheet(0.1),
                {Effect::kFeedCoulombFriction, Effect::kFeedStribeckFriction, Effect::kFeedPresliding});
  ASSERT_EQ(result.verdict, host::Verdict::kUnexplained) << said(result);
  const auto mass = std::ranges::find(result.parameters, "mass_kg", &host::ParameterResult::name);
  ASSERT_NE(mass, result.parameters.end());
  EXPECT_NEAR(mass->refit, reference_machine().feed.mass_kg, 2.0 * mass->standard_error);
  EXPECT_FALSE(mass->is_identifiable);
}

struct ErrorsByShape : testing::Test {
  static constexpr Effect kEffect = Effect::kFeedCoulombFriction;
  static constexpr std::size_t kMass = 0, kViscosity = 1;
  const RecordingSignals signals = record({.effects = {effect(kEffect, 8.0)}});
  const host::GapModel model = gap_model(datasheet(0.0), signals);
  host::AxisFit fit{host::Axis::kFeed, signals, model};

  ErrorsByShape() {
    fit.change_model().effects.push_back(effect(kEffect, 8.0));
    fit.refit();
  }

  [[nodiscard]] host::ParameterResult told(std::size_t index, double of_size, double of_noise) const {
    return host::parameters_of(fit, {.of_effect = {{kEffect, of_size, of_noise}}})[index];
  }
};

// A friction that is held 2 % too large: viscous friction goes where the covariance says, the mass, which is
// told by other rows, nowhere. A twentieth: the step is small, not infinitely so; its own error: what bends
// less is not seen.
TEST_F(ErrorsByShape, ParametersGoAlongAsTheyDoWhereASizeIsHeld) {
  constexpr double kLarger = 0.02;
  const auto held = [&](double factor) {
    host::GapModel held_model = model;
    held_model.known.push_back(fit.model().effects.front());
    held_model.known.front().coefficient[0] *= factor;
    host::AxisFit other(host::Axis::kFeed, signals, held_model);
    other.set_whitening(fit.whitening());
    other.refit();
    return host::parameters_of(other);
  };
  const auto as_fitted = held(1.0), larger = held(1.0 + kLarger);
  const Eigen::VectorXd along = fit.parameters_along(kEffect);
  for (const std::size_t i : {kMass, kViscosity}) {
    const double moved = std::log(larger[i].refit / as_fitted[i].refit);
    const double expected = kLarger * along(static_cast<Eigen::Index>(i));
    const double noise = told(i, 0.0, 0.0).standard_error;
    EXPECT_NEAR(moved, expected, 0.05 * std::fabs(expected) + noise / as_fitted[i].refit) << i;
    EXPECT_NEAR(told(i, kLarger, 0.0).standard_error, std::hypot(noise, expected * told(i, 0.0, 0.0).refit),
                1.0e-9 * noise);
  }
}

TEST_F(ErrorsByShape, CountAsManyNoisesAsAreLeftUpToADatasheets) {
  const host::ParameterResult plain = told(kMass, 0.0, 0.0);
  EXPECT_NEAR(told(kMass, 0.0, 3.0).standard_error, std::sqrt(10.0) * plain.standard_error,
              1.0e-9 * plain.standard_error);
  EXPECT_TRUE(plain.is_identifiable);
  const host::ParameterResult worst = told(kMass, 0.0, 1.0e9);
  EXPECT_NEAR(worst.standard_error, std::hypot(plain.standard_error, gap::kDatasheetSpread * plain.refit),
              1.0e-9 * plain.refit);
  EXPECT_FALSE(worst.is_identifiable);
}

/// A drag that grows with another power of the speed than the square, `bend` of it at twice the speed of its
/// size, and the model of it that has the square.
struct Drag {
  static constexpr Eigen::Index kViscosity = 1;
  gap::AppliedEffect bent;
  RecordingSignals signals;
  host::GapModel model;
  host::AxisFit fit;

  explicit Drag(double bend)
      : bent(bent_by(bend)),
        signals(record({.effects = {bent}, .duration_s = 4.0})),
        model(gap_model(datasheet(0.0), signals)),
        fit(host::Axis::kSpindle, signals, model) {
    gap::AppliedEffect plain = bent;
    plain.form.parts = 1;
    fit.change_model().effects.push_back(plain);
    fit.settle();
  }

  static gap::AppliedEffect bent_by(double bend) {
    gap::AppliedEffect drag = effect(Effect::kSpindleWindage, 4.0e-8);
    drag.form.parts = 2;
    drag.coefficient[1] = bend * drag.coefficient[0];
    return drag;
  }
  /// Of the viscous friction, in standard errors by noise.
  [[nodiscard]] double deviation() const {
    return std::fabs(fit.deviation()(kViscosity)) / fit.standard_error()(kViscosity);
  }
};

// Viscous friction does what the square does not: 12 to 38 % of it, at 8 to 26 standard errors by noise, of
// another simulator's drags with powers of 1.7 and 2.3.
TEST(FreeShapes, AreInTheErrorsOfWhatStandsInForThem) {
  const Drag drag(-0.2);
  ASSERT_GT(drag.deviation(), 4.0) << "no test of it";
  const host::FreeShapeErrors errors = host::error_by_free_shapes(drag.fit);
  const double off = std::fabs(drag.fit.deviation()(Drag::kViscosity));
  EXPECT_GT(errors.of_parameter(Drag::kViscosity), 0.5 * off);
  EXPECT_LT(errors.of_parameter(Drag::kViscosity), 5.0 * off);
  ASSERT_EQ(errors.of_effect.size(), 1U);
  const double size_off =
      std::fabs(drag.fit.model().effects.front().coefficient[0] / drag.bent.coefficient[0] - 1.0);
  EXPECT_GT(errors.of_effect.front(), 0.3 * size_off);
  EXPECT_LT(errors.of_effect.front(), 0.5);
}

// What nothing stands in for is known as well as before.
TEST(FreeShapes, AreInNoOthers) {
  const Drag drag(0.0);
  const host::FreeShapeErrors errors = host::error_by_free_shapes(drag.fit);
  constexpr Eigen::Index kResistance = 3;
  EXPECT_LT(errors.of_parameter(kResistance), 0.2 * drag.fit.standard_error()(kResistance));
  host::AxisFit rigid = drag.fit;
  rigid.change_model().effects.clear();
  EXPECT_EQ(host::error_by_free_shapes(rigid).of_parameter.norm(), 0.0) << "no law, no shape";
}

// An amplitude does not depend on its phase.
TEST(FreeShapes, TellNothingOfASine) {
  const RecordingSignals signals = record({.effects = {effect(Effect::kFeedCoulombFriction, 8.0)}});
  host::AxisFit fit(host::Axis::kFeed, signals, gap_model(datasheet(0.0), signals));
  fit.change_model().effects = {
      {.form = {.effect = Effect::kFeedScrewPeriodic, .parts = 2}, .coefficient = {1.0e-6, 3.0}},
      effect(Effect::kFeedCoulombFriction, 8.0)};
  const host::FreeShapeErrors errors = host::error_by_free_shapes(fit);
  ASSERT_EQ(errors.of_effect.size(), 2U);
  EXPECT_EQ(errors.of_effect.front(), 0.0);
  EXPECT_GT(errors.of_effect.back(), 0.0);
  EXPECT_LT(errors.of_effect.back(), 0.1);
}

TEST_F(ErrorsByShape, HaveWhatFreeShapesMove) {
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(4);
  moved(static_cast<Eigen::Index>(kViscosity)) = 0.2;
  const host::ParameterResult plain = told(kViscosity, 0.0, 0.0);
  const host::ParameterResult freed = host::parameters_of(fit, {.of_value = moved})[kViscosity];
  EXPECT_NEAR(freed.standard_error, std::hypot(plain.standard_error, 0.2 * plain.refit),
              1.0e-9 * plain.refit);
  EXPECT_FALSE(freed.is_identifiable);
  EXPECT_EQ(freed.reason, "another shape of a law in the model would change it");
}

/// A result with one effect, and with this left of the feed's gap.
DiagnosisResult with_left(Effect effect, double residual_ratio_after) {
  DiagnosisResult result;
  result.which.push_back({.effect = effect, .alias_set = {}});
  result.where.push_back({.balance = gap::Balance::kFeedForce,
                          .is_evaluated = true,
                          .residual_ratio = 9.0,
                          .residual_ratio_after = residual_ratio_after});
  result.shrinkage.share_closed = 0.8;
  return result;
}

TEST(MeaningOfEffects, SaysHowMuchIsExplainedWhereSomethingIsLeft) {
  EXPECT_EQ(meaning_of_effects(with_left(Effect::kFeedSpring, 1.0)), meaning_of(host::Verdict::kEffect));
  EXPECT_EQ(meaning_of_effects(with_left(Effect::kFeedSpring, 2.5)),
            "the named effects explain 80 % of what refitted parameters leave; more than noise remains in "
            "feed_force (2.5 times): another shape than the catalogue's, or something without a name");
}

TEST(MeaningOfEffects, OfSamplesIsNoneOfTheMachine) {
  for (const Effect fault : {Effect::kClockJitter, Effect::kSensorQuantization}) {
    EXPECT_EQ(meaning_of_effects(with_left(fault, 1.0)).find("the samples have the named faults; beside"),
              0U);
    EXPECT_EQ(meaning_of_effects(with_left(fault, 2.5)),
              "the samples have the named faults; more than noise remains in feed_force (2.5 times)");
  }
}

}  // namespace
}  // namespace morepro::diagnose_test
