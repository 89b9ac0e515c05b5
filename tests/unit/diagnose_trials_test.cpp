// Which causes are put into the model and weighed there, whatever a linearisation promises for them.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace morepro::diagnose_test
