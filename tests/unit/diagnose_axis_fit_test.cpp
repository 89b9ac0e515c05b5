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
TEST_F(Innovations, TellHowFarAValueIsOffTheDatasheets) {
  EXPECT_EQ(fit_.farthest_factor(), 1.0) << "nothing is told yet";
  for (const double factor : {2.5, 0.4}) {
    MachineDescription sheet = datasheet(0.0);
    sheet.configuration.machine.feed.mass_kg /= factor;
    sheet.configuration.machine.feed.viscous_friction_ns_m /= 4.0;  // which may be anything
    AxisFit fit(Axis::kFeed, signals_, gap_model(sheet, signals_));
    fit.refit();
    EXPECT_NEAR(fit.farthest_factor(), 2.5, 0.05) << "a hundredth up or down is what 1 s tells the mass to";
  }
}

TEST_F(Innovations, LikelihoodIsThatOfTheModelAsItStands) {
  double& mass_kg = fit_.change_model().machine.feed.mass_kg;
  const double right = fit_.unlikeliness_as_it_is();
  static_cast<void>(fit_.innovations());
  mass_kg *= 1.5;
  EXPECT_GT(fit_.unlikeliness_as_it_is(), right + 100.0);
}

}  // namespace
}  // namespace morepro::diagnose_test
