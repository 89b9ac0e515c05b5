// Which causes are put into the model and weighed there, whatever a linearisation promises for them.
#include <gtest/gtest.h>

#include "sim_host/diagnose/fit/nominal_fit.hpp"
#include "sim_host/diagnose/search/axis_diagnosis.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

using host::ProfileKind;

void expect_alone(const gap::AppliedEffect& cause, double size, std::uint64_t seed) {
  constexpr double kTolerance = 0.01;  // of some seeds of each none was off by more
  const auto result = diagnosed(
      record({.effects = {cause}, .duration_s = 8.0, .seed = seed, .profile = ProfileKind::kProduction}),
      wrong_datasheet(seed));
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_EQ(result.which.front().effect, cause.form.effect) << said(result);
  EXPECT_NEAR(result.which.front().magnitude, size, kTolerance * size) << said(result);
  EXPECT_GT(result.which.front().confidence, 0.9) << said(result);
}

// At a constant speed a memory of what was left predicts what comes back with every turn: the cause was
// promised less than a resonant shaft, and there was "structure without a name". One that sets in late took
// ten times as long, as a sum of others.
TEST(Trials, AreGivenToWhatComesBackWithEveryTurn) {
  gap::AppliedEffect wobble = effect(Effect::kEncoderEccentricity, 0.02);
  expect_alone(wobble, 0.02, 31);
  wobble.onset_s = 3.0;
  expect_alone(wobble, 0.02, 42);
}

// A cutting speed of four times the load had promised most, and the lag too little beside it: there was a
// force of 0.2 N.
TEST(Trials, AreGivenToWhatPromisesLessThanAnAbsurdCause) {
  for (const std::uint64_t seed : {31U, 32U})
    expect_alone(effect(Effect::kFeedDriveLag, 4.0e-3), 4.0e-3, seed);
}

// A search from elsewhere whose two effects are no better than those of the first one leads where that one did.
TEST(FurtherSearch, EndsWhereItIsNoBetterWithTwoEffects) {
  const RecordingSignals signals = record({.effects = {effect(Effect::kFeedForceOffset, 3.0),
                                                       effect(Effect::kFeedScrewPeriodic, 3.0),
                                                       effect(Effect::kFeedDriveLag, 5.0e-4)}});
  const host::AxisFit start(host::Axis::kFeed, signals, gap_model(datasheet(0.0), signals));
  const host::AxisFit nominal = host::nominal_fits(start).front();
  const auto found = [&nominal](double to_beat) {
    return host::search_effects(nominal, nominal, {}, 40.0, to_beat);
  };
  const host::AxisDiagnosis first = found(host::AxisFit::kNone);
  ASSERT_EQ(first.found.size(), 3U);
  EXPECT_EQ(found(first.cost_of_two).found.size(), 2U);
  EXPECT_EQ(found(first.cost_of_two + 100.0).found.size(), 3U);
}

}  // namespace
}  // namespace morepro::diagnose_test
