// A model and what it leaves of a recording.
#include <gtest/gtest.h>

#include "sim_host/diagnose/axis_fit.hpp"
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

/// Whoever looks for the best value holds it while the model is asked how likely it is.
TEST_F(Innovations, LikelihoodIsThatOfTheModelAsItStands) {
  double& mass_kg = fit_.change_model().machine.feed.mass_kg;
  const double right = fit_.unlikeliness_as_it_is();
  static_cast<void>(fit_.innovations());
  mass_kg *= 1.5;
  EXPECT_GT(fit_.unlikeliness_as_it_is(), right + 100.0);
}

}  // namespace
}  // namespace morepro::diagnose_test
