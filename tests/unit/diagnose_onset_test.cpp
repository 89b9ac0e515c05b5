// An effect that sets in during the recording is named with its size and its time.
#include <gtest/gtest.h>

#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

struct LateCase {
  Effect effect;
  double size;
  double onset_error_s = 0.02;
  // A twentieth: the forms are the simulator's own, so nothing but noise is in the way.
  double size_error = 0.05;
};

void PrintTo(const LateCase& c, std::ostream* out) { *out << gap::name_of(c.effect); }

class LateEffect : public testing::TestWithParam<LateCase> {};

TEST_P(LateEffect, IsNamedAloneWithItsSizeAndItsTime) {
  constexpr double kOnsetS = 2.37;
  const auto result =
      diagnosed(record({.effects = {effect(GetParam().effect, GetParam().size, kOnsetS)}, .duration_s = 5.0}),
                datasheet(0.05));
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_TRUE(names(result.which[0], GetParam().effect)) << said(result);
  EXPECT_NEAR(result.which[0].magnitude, GetParam().size, GetParam().size_error * GetParam().size);
  bool has_onset = false;
  for (const auto& balance : result.where) {
    if (!balance.onset_s) continue;
    has_onset = true;
    EXPECT_NEAR(*balance.onset_s, kOnsetS, GetParam().onset_error_s);
  }
  EXPECT_TRUE(has_onset);
}

// What grows from nothing is seen some time after it has begun; a bend does the work of the rest.
INSTANTIATE_TEST_SUITE_P(, LateEffect,
                         testing::Values(LateCase{Effect::kDriveLag, 1.0e-3},
                                         LateCase{Effect::kFeedSpring, 40.0},
                                         LateCase{Effect::kCurrentBias, 0.2},
                                         LateCase{Effect::kToolWearRamp, 0.1, 0.1, 0.15},
                                         LateCase{Effect::kFeedContactDrift, 40.0, 0.1, 0.15}));

// At one speed friction that sets in is a load that the parameters share until then: over all of the
// recording it drove, and was no candidate. Windage was its name at 92 to 98 %.
TEST(LateEffects, ThatBrakeMayHaveSeemedToDrive) {
  constexpr double kFrictionNm = 0.0166;
  for (const std::uint64_t seed : {1, 3}) {
    const auto result =
        diagnosed(record({.effects = {effect(Effect::kSpindleCoulombFriction, kFrictionNm, 4.18)},
                          .duration_s = 10.0,
                          .seed = seed,
                          .profile = host::ProfileKind::kProduction}),
                  datasheet(0.0));
    ASSERT_EQ(result.which.size(), 1U) << said(result);
    EXPECT_EQ(result.which[0].effect, Effect::kSpindleCoulombFriction) << said(result);
    EXPECT_TRUE(names(result.which[0], Effect::kSpindleWindage)) << said(result);
    EXPECT_NEAR(result.which[0].magnitude, kFrictionNm, 0.02 * kFrictionNm);
  }
}

TEST(LateEffects, AreWrittenForAMachineThatHasThemNow) {
  const host::DiagnosisOptions options{.bootstrap_runs = 0, .excluded = {}};
  MachineDescription with_effects;
  host::diagnose(record({.effects = {effect(Effect::kFeedSpring, 40.0, 1.5)}}), datasheet(0.05), options,
                 with_effects);
  ASSERT_EQ(with_effects.effects.size(), 1U);
  EXPECT_EQ(with_effects.effects[0].onset_s, 0.0);
}

}  // namespace
}  // namespace morepro::diagnose_test
