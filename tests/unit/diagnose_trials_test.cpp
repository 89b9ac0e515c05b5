// Which causes are put into the model and weighed there, whatever a linearisation promises for them.
#include <gtest/gtest.h>

#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

using host::ProfileKind;

void expect_alone(Effect cause, double size, double tolerance, std::uint64_t seed) {
  const auto result = diagnosed(record({.effects = {effect(cause, size)},
                                        .duration_s = 8.0,
                                        .seed = seed,
                                        .profile = ProfileKind::kProduction}),
                                wrong_datasheet(seed));
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_EQ(result.which.front().effect, cause) << said(result);
  EXPECT_NEAR(result.which.front().magnitude, size, tolerance * size) << said(result);
  EXPECT_GT(result.which.front().confidence, 0.9) << said(result);
}

// At a constant speed a memory of what was left predicts what comes back with every turn: the cause was
// promised less than a resonant shaft, and there was "structure without a name". A hundredth: of nine seeds
// none was off by more.
TEST(Trials, AreGivenToWhatComesBackWithEveryTurn) {
  for (const std::uint64_t seed : {31U, 42U}) expect_alone(Effect::kEncoderEccentricity, 0.02, 0.01, seed);
}

// A cutting speed of four times the load had promised most, and the lag too little beside it: there was a
// force of 0.2 N. A hundredth: of five seeds none was off by more.
TEST(Trials, AreGivenToWhatPromisesLessThanAnAbsurdCause) {
  for (const std::uint64_t seed : {31U, 32U}) expect_alone(Effect::kFeedDriveLag, 4.0e-3, 0.01, seed);
}

}  // namespace
}  // namespace morepro::diagnose_test
