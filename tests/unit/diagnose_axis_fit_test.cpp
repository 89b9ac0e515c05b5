// A model and what it leaves of a recording.
#include <gtest/gtest.h>

#include "sim_host/diagnose/fit/axis_fit.hpp"
#include "sim_host/diagnose/outcome/parameter_report.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

using host::Axis;
using host::AxisFit;

class Innovations : public testing::Test {
 protected:
  RecordingSignals signals_ = record({.duration_s = 1.0});
  AxisFit fit_{Axis::kFeed, signals_, gap_model(datasheet(0.0), signals_)};
};

TEST_F(Innovations, AreKeptUntilTheModelChanges) {
  const auto* const first = &fit_.innovations();
  const AxisFit copy = fit_;  // keeps them where they are, too
  EXPECT_GT(fit_.model().machine.feed.mass_kg, 0.0);
  EXPECT_EQ(&fit_.innovations(), first);
  EXPECT_EQ(&copy.innovations(), first);
  const std::vector<float> before = first->normalised[1];
  fit_.change_model().machine.feed.mass_kg *= 1.5;
  EXPECT_NE(fit_.innovations().normalised[1], before);
  EXPECT_EQ(copy.innovations().normalised[1], before);
}

TEST_F(Innovations, AreThoseOfTheFittedModel) {
  fit_.change_model().machine.feed.mass_kg *= 1.5;
  const std::vector<float> before = fit_.innovations().normalised[1];
  fit_.refit();
  EXPECT_NE(fit_.innovations().normalised[1], before);
}

/// What was promised to a neighbour in vain may be kept here.
TEST_F(Innovations, GetAStepWhateverWasInVain) {
  constexpr double kEverything = 1.0e300;
  constexpr double kOfAStep = 4.0;  // deviance for which no further one is made
  fit_.change_model().machine.feed.mass_kg *= 1.1;
  AxisFit other = fit_;
  fit_.refit();
  other.refit(kEverything);
  EXPECT_NEAR(other.unlikeliness(), fit_.unlikeliness(), kOfAStep);
  EXPECT_EQ(other.promised_in_vain(), 0.0);
}

/// A machine changes by more from day to day than a good recording leaves open; a bad one tells nothing of
/// some.
TEST(SpreadOfValues, IsTheMeanOfWhatIsOpenOfEach) {
  const auto spread_of = [](const SimulatedRun& run, double& mean) {
    const RecordingSignals signals = record(run);
    AxisFit fit(Axis::kSpindle, signals, gap_model(datasheet(0.0), signals));
    fit.refit();
    mean = 1.0;
    for (const auto& one : host::parameters_of(fit))
      mean *= std::pow(std::min(one.standard_error / one.refit, gap::kDatasheetSpread), 1.0 / 6.0);
    return host::spread_of(fit);
  };
  double mean = 0.0;
  EXPECT_EQ(spread_of({.duration_s = 3.0}, mean), 0.005);
  EXPECT_LT(mean, 0.005);
  const double steady = spread_of({.duration_s = 0.03, .profile = host::ProfileKind::kProduction}, mean);
  EXPECT_GT(mean, 0.006);
  EXPECT_LT(mean, 0.4);
  EXPECT_NEAR(steady, mean, 1.0e-9 * mean) << "rounding of six products";
  const RecordingSignals signals = record({.duration_s = 0.1});
  const AxisFit unfitted(Axis::kSpindle, signals, gap_model(datasheet(0.0), signals));
  EXPECT_NEAR(host::spread_of(unfitted), gap::kDatasheetSpread, 1.0e-9);
}

/// Whoever looks for the best value holds it while the model is asked how likely it is.
TEST_F(Innovations, LikelihoodIsThatOfTheModelAsItStands) {
  double& mass_kg = fit_.change_model().machine.feed.mass_kg;
  const double right = fit_.unlikeliness_as_it_is();
  static_cast<void>(fit_.innovations());
  mass_kg *= 1.5;
  EXPECT_GT(fit_.unlikeliness_as_it_is(), right + 100.0);
}

/// As it is found with a datasheet that was made wrong.
double farthest_factor(Axis axis, const RecordingSignals& signals, void (*spoil)(MachineParameters&)) {
  MachineDescription sheet = datasheet(0.0);
  spoil(sheet.configuration.machine);
  AxisFit fit(axis, signals, gap_model(sheet, signals));
  fit.refit();
  return fit.farthest_factor();
}

constexpr double kOfTwoSeconds = 0.05;  // what so short a recording leaves of a value

TEST(FarthestFactor, IsThatOfAMassUpOrDown) {
  const RecordingSignals signals = record({.duration_s = 2.0});
  const auto with_light = farthest_factor(Axis::kFeed, signals, [](auto& m) { m.feed.mass_kg *= 0.4; });
  const auto with_heavy = farthest_factor(Axis::kFeed, signals, [](auto& m) { m.feed.mass_kg *= 2.5; });
  EXPECT_NEAR(with_light, 2.5, kOfTwoSeconds);
  EXPECT_NEAR(with_heavy, 2.5, kOfTwoSeconds);
}

TEST(FarthestFactor, IsThatOfAMotorAndNotOfAViscousFriction) {
  const RecordingSignals signals = record({.duration_s = 2.0});
  const auto of_resistance =
      farthest_factor(Axis::kSpindle, signals, [](auto& m) { m.spindle.resistance_ohm *= 0.4; });
  EXPECT_NEAR(of_resistance, 2.5, kOfTwoSeconds);
  const auto of_frictions = [&](Axis axis) {
    return farthest_factor(axis, signals, [](auto& m) {
      m.spindle.viscous_friction_nms_rad *= 0.4;
      m.feed.viscous_friction_ns_m *= 0.4;
    });
  };
  EXPECT_NEAR(of_frictions(Axis::kSpindle), 1.0, kOfTwoSeconds);
  EXPECT_NEAR(of_frictions(Axis::kFeed), 1.0, kOfTwoSeconds);
}

TEST_F(Innovations, SayNothingOfAValueThatIsNotTold) {
  fit_.change_model().machine.feed.mass_kg *= 3.0;
  EXPECT_EQ(fit_.farthest_factor(), 1.0);
}

}  // namespace
}  // namespace morepro::diagnose_test
