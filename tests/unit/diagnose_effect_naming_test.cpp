#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <optional>
#include <utility>
#include <vector>

#include "lib/gap/effect_catalogue.hpp"
#include "lib/gap/effect_size.hpp"
#include "sim_host/diagnose/outcome/axis_outcome.hpp"
#include "sim_host/diagnose/outcome/causes.hpp"
#include "sim_host/diagnose/outcome/effect_naming.hpp"
#include "sim_host/diagnose/search/effect_family.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::host {
namespace {

using gap::Effect;
using Effects = std::vector<Effect>;

std::size_t causes(std::initializer_list<Effect> effects) {
  std::vector<Finding> found;
  for (const Effect effect : effects) found.emplace_back().effect.form.effect = effect;
  return causes_of(found);
}

TEST(Causes, AreCountedOneByOne) {
  EXPECT_EQ(causes({}), 0U);
  EXPECT_EQ(causes({Effect::kFeedSpring}), 1U);
  EXPECT_EQ(causes({Effect::kSpindleWindage, Effect::kDriveLag, Effect::kCurrentBias}), 3U);
}

// What a slide's friction is made of is named in parts and is one cause.
TEST(Causes, OfFrictionAreOne) {
  EXPECT_EQ(causes({Effect::kFeedCoulombFriction, Effect::kFeedForceOffset, Effect::kFeedAsymmetricFriction}),
            1U);
  EXPECT_EQ(causes({Effect::kFeedCoulombFriction, Effect::kFeedForceOffset, Effect::kFeedSpring}), 2U);
}

bool may_be_one(Effect first, double evidence, Effect second, double of_second, bool has_third = false) {
  std::vector<Finding> found(has_third ? 3 : 2);
  found[0].effect.form.effect = first;
  found[0].evidence = evidence;
  found[1].effect.form.effect = second;
  found[1].evidence = of_second;
  if (has_third) found[2].effect.form.effect = Effect::kFeedContactDrift;
  return may_be_one_cause(found);
}

// What a shape that is not quite the machine's leaves is weak and slow.
TEST(Causes, OfWhichOneIsAWeakSlowLawMayBeOne) {
  EXPECT_TRUE(may_be_one(Effect::kFeedForceOffset, 1000.0, Effect::kFeedSpring, 300.0));
  EXPECT_TRUE(may_be_one(Effect::kFeedSpring, 300.0, Effect::kFeedForceOffset, 1000.0));
  EXPECT_FALSE(may_be_one(Effect::kFeedForceOffset, 1000.0, Effect::kFeedSpring, 400.0));
  EXPECT_FALSE(may_be_one(Effect::kFeedForceOffset, 1000.0, Effect::kFeedSpring, 300.0, true)) << "three";
  EXPECT_FALSE(may_be_one(Effect::kFeedForceOffset, 1000.0, Effect::kFeedCoulombFriction, 300.0)) << "parts";
  for (const Effect unlike :
       {Effect::kFeedDriveLag, Effect::kFeedScrewPeriodic, Effect::kFeedBacklash,
        Effect::kFeedToothPassingForce, Effect::kShaftCompliance, Effect::kSpindleCogging})
    EXPECT_FALSE(may_be_one(Effect::kFeedSpring, 1000.0, unlike, 300.0)) << gap::name_of(unlike);
}

// A drop at the brushes leaves nothing of its shape in the torque.
TEST(Causes, OfWhichOneBrakesTheSpindleAreTwo) {
  EXPECT_FALSE(may_be_one(Effect::kBrushVoltageDrop, 1000.0, Effect::kSpindleCoulombFriction, 50.0));
  EXPECT_FALSE(may_be_one(Effect::kSpindleWindage, 50.0, Effect::kCurrentBias, 1000.0));
  EXPECT_TRUE(may_be_one(Effect::kSpindleStribeckFriction, 1000.0, Effect::kSpindleWindage, 50.0));
  EXPECT_TRUE(may_be_one(Effect::kMagnetTemperatureDrift, 1000.0, Effect::kResistanceTemperatureDrift, 50.0));
}

/// A finding of this size in the unit of the catalogue.
Finding found_as(Effect effect, double size) {
  Finding finding;
  finding.effect = gap::applied(effect, size, {});
  return finding;
}

/// What the second of two effects gives its shape to.
std::optional<std::size_t> shaped_by_second(Effect first, double size, Effect second, double other) {
  return shaped_by(std::vector{found_as(first, size), found_as(second, other)}, 1);
}

TEST(Causes, ADelayBesideALagIsItsSecondPole) {
  EXPECT_EQ(shaped_by_second(Effect::kCurrentBandwidth, 2.0e-4, Effect::kCurrentDelay, 1.0e-4), 0U);
  EXPECT_EQ(shaped_by_second(Effect::kDriveLag, 2.0e-4, Effect::kCurrentBandwidth, 1.0e-4), 0U);
  EXPECT_FALSE(shaped_by_second(Effect::kCurrentBandwidth, 2.0e-4, Effect::kCurrentDelay, 1.6e-4));
  EXPECT_FALSE(shaped_by_second(Effect::kCurrentBandwidth, 2.0e-4, Effect::kSpindleSpeedDelay, 1.0e-4));
}

TEST(Causes, ALagOfBothSensorsIsAPoleOfTheDrive) {
  std::vector found{found_as(Effect::kDriveLag, 4.0e-4), found_as(Effect::kCurrentBandwidth, 6.5e-4),
                    found_as(Effect::kSpindleSpeedBandwidth, 6.4e-4)};
  EXPECT_EQ(shaped_by(found, 1), 0U);
  EXPECT_EQ(shaped_by(found, 2), 1U);
  EXPECT_EQ(causes_of(found), 1U);
  found[2] = found_as(Effect::kSpindleSpeedBandwidth, 5.0e-4);
  EXPECT_EQ(causes_of(found), 3U);
  found[2] = found[0];
  found[0] = found_as(Effect::kSpindleSpeedBandwidth, 6.4e-4);
  found.pop_back();
  EXPECT_EQ(causes_of(found), 2U);
}

TEST(Causes, ALittleFrictionAtRestIsTheShapeOfFriction) {
  EXPECT_EQ(shaped_by_second(Effect::kFeedCoulombFriction, 5.0, Effect::kFeedStribeckFriction, -0.6), 0U);
  EXPECT_FALSE(shaped_by_second(Effect::kFeedCoulombFriction, 5.0, Effect::kFeedStribeckFriction, 2.0));
  EXPECT_EQ(shaped_by_second(Effect::kFeedCoulombFriction, 5.0, Effect::kFeedPresliding, 0.2), 0U);
  EXPECT_EQ(shaped_by_second(Effect::kFeedCoulombFriction, 5.0, Effect::kFeedPresliding, 2.9), 0U);
  EXPECT_FALSE(shaped_by_second(Effect::kFeedCoulombFriction, 5.0, Effect::kFeedPresliding, 3.1));
  EXPECT_FALSE(shaped_by_second(Effect::kFeedAsymmetricFriction, 5.0, Effect::kFeedForceOffset, 0.3));
}

TEST(Causes, ALittleForceBesideABentFrictionIsItsShape) {
  std::vector found{found_as(Effect::kFeedAsymmetricFriction, 5.0), found_as(Effect::kFeedForceOffset, 0.3)};
  found[0].effect.form.parts = 2;
  EXPECT_EQ(shaped_by(found, 1), 0U);
  found[1].effect.coefficient[0] = -1.0;
  EXPECT_FALSE(shaped_by(found, 1));
}

TEST(Causes, AForceOfTheSenseOfAFrictionIsItsDryPart) {
  std::vector found{found_as(Effect::kFeedAsymmetricFriction, 5.0), found_as(Effect::kFeedForceOffset, 8.0)};
  found[0].evidence = 2000.0;
  found[1].evidence = 1000.0;
  EXPECT_EQ(shaped_by(found, 1), 0U);
  found[1].effect.coefficient[0] = -8.0;
  EXPECT_FALSE(shaped_by(found, 1));
  found[1] = found_as(Effect::kFeedForceOffset, 8.0);
  found[1].evidence = 3000.0;
  EXPECT_FALSE(shaped_by(found, 1));
  found[1].evidence = 1000.0;
  found.push_back(found_as(Effect::kFeedCoulombFriction, 1.0));
  EXPECT_FALSE(shaped_by(found, 1));
}

TEST(Causes, WhatGivesAShapeIsNone) {
  const std::vector found{found_as(Effect::kSpindleSpeedBandwidth, 1.0e-3),
                          found_as(Effect::kSpindleSpeedDelay, 1.0e-4),
                          found_as(Effect::kSpindleWindage, 1.0e-6)};
  EXPECT_EQ(causes_of(found), 2U);
  EXPECT_TRUE(is_cause_of_its_own(found, 0));
  EXPECT_FALSE(is_cause_of_its_own(found, 1));
}

TEST(Causes, NeedMoreBesideOneWhoseShapeTheyMayBe) {
  const auto share = [](Effect effect, Effect beside) { return least_share(effect, beside, kLeastShare); };
  EXPECT_EQ(share(Effect::kSpindleWindage, Effect::kCurrentBias), kLeastShare);
  EXPECT_GE(share(Effect::kDriveLag, Effect::kCurrentDelay), kLeastShare);
  EXPECT_GT(least_share(Effect::kDriveLag, Effect::kCurrentDelay, 0.02), 0.02) << "beside a known one";
  EXPECT_GT(share(Effect::kContactSpeedDependence, Effect::kContactTemperatureDependence), 0.17);
  EXPECT_GT(share(Effect::kContactSpeedDependence, Effect::kToothPassingTorque), 0.17);
  EXPECT_EQ(share(Effect::kToothPassingTorque, Effect::kContactSpeedDependence), kLeastShare);
  EXPECT_EQ(share(Effect::kContactSpeedDependence, Effect::kSpindleWindage), kLeastShare);
}

TEST(Causes, LagsOneAfterTheOtherAddUp) {
  EffectResult lag{.effect = Effect::kDriveLag, .magnitude = 2.0e-4, .standard_error = 1.0e-6};
  lag.alias_set = {Effect::kDriveLag};
  take_shape({.effect = Effect::kCurrentDelay, .magnitude = 1.0e-4, .standard_error = 1.0e-6}, lag);
  EXPECT_DOUBLE_EQ(lag.magnitude, 3.0e-4);
  EXPECT_NEAR(lag.standard_error, 0.5e-4, 1.0e-6);
  EXPECT_EQ(lag.alias_set, (std::vector{Effect::kDriveLag, Effect::kCurrentDelay}));
  EffectResult asymmetric{.effect = Effect::kFeedAsymmetricFriction, .magnitude = 5.0};
  take_shape({.effect = Effect::kFeedForceOffset, .magnitude = 8.0}, asymmetric);
  EXPECT_EQ(asymmetric.magnitude, 5.0);
  EXPECT_EQ(asymmetric.alias_set, Effects{Effect::kFeedForceOffset});
  EffectResult friction{.effect = Effect::kFeedCoulombFriction, .magnitude = 5.0};
  take_shape({.effect = Effect::kFeedStribeckFriction, .magnitude = 0.6}, friction);
  EXPECT_EQ(friction.magnitude, 5.0);
}

/// A finding with rivals of this evidence, itself first.
Finding finding_of(std::initializer_list<std::pair<Effect, double>> rivals) {
  Finding finding;
  for (const auto& [effect, evidence] : rivals) {
    Candidate& rival = finding.rivals.emplace_back();
    rival.form.effect = effect;
    rival.evidence = rival.promised = evidence;
  }
  finding.effect.form = finding.rivals.front().form;
  finding.evidence = finding.rivals.front().evidence;
  return finding;
}

struct Naming : testing::Test {
  const RecordingSignals signals;
  const AxisFit fit{Axis::kFeed, signals, {}};

  [[nodiscard]] EffectResult named(std::initializer_list<std::pair<Effect, double>> rivals,
                                   double unnamed_share = 0.0, std::size_t causes = 1,
                                   double temperature = 1.0) const {
    return named_effect(
        finding_of(rivals), fit,
        {.temperature = temperature, .threshold = 40.0, .unnamed_share = unnamed_share, .causes = causes});
  }
};

TEST_F(Naming, IsSureWhereNothingSpeaksAgainstIt) {
  const EffectResult alone = named({{Effect::kFeedSpring, 4000.0}, {Effect::kFeedForceOffset, 900.0}});
  EXPECT_NEAR(alone.confidence, 0.98, 1.0e-6);
  EXPECT_EQ(alone.alias_set, Effects{Effect::kFeedSpring});
}

TEST_F(Naming, DoubtsTwoThatMayBeOne) {
  const Finding finding = finding_of({{Effect::kFeedSpring, 4000.0}});
  const auto confidence = [&](bool may_be_one, bool is_strongest) {
    return named_effect(
               finding, fit,
               {.threshold = 40.0, .causes = 2, .may_be_one = may_be_one, .is_strongest = is_strongest})
        .confidence;
  };
  EXPECT_NEAR(confidence(false, false), 0.98, 1.0e-6);
  EXPECT_NEAR(confidence(true, true), 0.7 * 0.98, 1.0e-6);
  EXPECT_NEAR(confidence(true, false), 0.25 * 0.98, 1.0e-6);
}

// Whatever is finer does as well where a friction is plain; the other way round nothing is known.
TEST_F(Naming, TakesPlainFrictionForMoreLikelyThanAFinerOneThatDoesAsWell) {
  EXPECT_NEAR(named({{Effect::kFeedCoulombFriction, 4000.0}, {Effect::kFeedPresliding, 4000.0}}).confidence,
              0.98 / 1.2, 1.0e-6);
  EXPECT_NEAR(named({{Effect::kFeedPresliding, 4000.0}, {Effect::kFeedCoulombFriction, 4000.0}}).confidence,
              0.98 / 2.0, 1.0e-6);
  EXPECT_NEAR(named({{Effect::kFeedForceOffset, 4000.0}, {Effect::kFeedSpring, 4000.0}}).confidence,
              0.98 / 2.0, 1.0e-6);
}

// What the shape of a lag left was a force of 0.009 N on an axis of 6 kN, at 98 %.
TEST_F(Naming, DoubtsWhatIsWorthLittleOfTheStrongest) {
  const Finding finding = finding_of({{Effect::kFeedSpring, 4000.0}});
  const auto confidence = [&](double share) {
    return named_effect(finding, fit, {.threshold = 40.0, .is_strongest = false, .share = share}).confidence;
  };
  EXPECT_NEAR(confidence(0.12), 0.98, 1.0e-6);
  EXPECT_NEAR(confidence(0.08), 0.2 * 0.98, 1.0e-6);
}

// The parts of a friction are one cause, whatever one of them is worth by itself.
TEST(Causes, ArePartsOfOneOrHaveAShareOfTheStrongest) {
  const RecordingSignals signals;
  const AxisFit fit{Axis::kFeed, signals, {}};
  const auto share_beside = [&](Effect strongest) {
    AxisOutcome outcome{.diagnosis = {.fit = fit, .nominal = fit}};
    outcome.diagnosis.found = {found_as(strongest, 5.0), found_as(Effect::kFeedForceOffset, 4.0)};
    outcome.diagnosis.found[0].evidence = 4000.0;
    outcome.diagnosis.found[1].evidence = 100.0;
    return outcome.context_of(outcome.diagnosis.found[1], 0.0).share;
  };
  EXPECT_DOUBLE_EQ(share_beside(Effect::kFeedSpring), 0.025);
  EXPECT_DOUBLE_EQ(share_beside(Effect::kFeedCoulombFriction), 1.0);
}

/// Evidence of four standard errors and more is a size that may be any.
TEST_F(Naming, DoubtsWhatHasNoSize) {
  EXPECT_GT(named({{Effect::kFeedSpring, 200.0}}, 0.0, 1, 1.0).confidence, 0.9);
  EXPECT_LT(named({{Effect::kFeedSpring, 200.0}}, 0.0, 1, 20.0).confidence, 0.3);
  EXPECT_GT(named({{Effect::kFeedSpring, 2000.0}}, 0.0, 1, 20.0).confidence, 0.9);
}

TEST_F(Naming, SharesItsOddsWithWhatFitsAsWell) {
  const EffectResult two = named({{Effect::kFeedSpring, 4000.0}, {Effect::kFeedForceOffset, 4000.0}});
  EXPECT_NEAR(two.confidence, 0.49, 1.0e-6);
  EXPECT_EQ(two.alias_set, (Effects{Effect::kFeedSpring, Effect::kFeedForceOffset}));
}

// What chance is worth is an estimate, too: a quarter more is not sure yet.
TEST_F(Naming, IsHalfSureWhereChanceMayBeWorthAsMuch) {
  EXPECT_NEAR(named({{Effect::kFeedSpring, 40.0}}).confidence, 0.49, 1.0e-6);
  EXPECT_NEAR(named({{Effect::kFeedSpring, 50.0}}).confidence, 0.98 / (1.0 + std::exp(-1.0)), 1.0e-6);
  EXPECT_GT(named({{Effect::kFeedSpring, 100.0}}).confidence, 0.97);
}

TEST_F(Naming, IsBelievedLessWhereWhatWandersDoesNearlyAsMuch) {
  Finding finding = finding_of({{Effect::kFeedSpring, 4000.0}});
  finding.kept = 0.2;
  EXPECT_NEAR(named_effect(finding, fit, {.threshold = 40.0, .causes = 1}).confidence, 0.9 * 0.98, 1.0e-6);
}

// It was found when other effects were still missing, and is worth more beside them.
TEST_F(Naming, IsAsSureAsTheEffectIsWorthInTheEnd) {
  Finding finding = finding_of({{Effect::kFeedSpring, 30.0}});
  finding.evidence = 400.0;
  EXPECT_GT(named_effect(finding, fit, {.threshold = 40.0, .causes = 1}).confidence, 0.97);
}

// 2 % of the evidence decides about odds, but not about what might be meant.
TEST_F(Naming, ListsWhatAnotherShapeMightMake) {
  const EffectResult close = named({{Effect::kFeedSpring, 4000.0}, {Effect::kFeedForceOffset, 3920.0}});
  EXPECT_GT(close.confidence, 0.9);
  EXPECT_EQ(close.alias_set, (Effects{Effect::kFeedSpring, Effect::kFeedForceOffset}));
}

// A bristle may be what makes dry friction, of a machine whose file knows neither.
TEST_F(Naming, ListsTheCataloguesAliasesEarlier) {
  EXPECT_EQ(named({{Effect::kFeedPresliding, 4000.0}, {Effect::kFeedCoulombFriction, 2000.0}}).alias_set,
            (Effects{Effect::kFeedPresliding, Effect::kFeedCoulombFriction}));
  EXPECT_EQ(named({{Effect::kFeedCoulombFriction, 4000.0}, {Effect::kFeedPresliding, 1200.0}}).alias_set,
            Effects{Effect::kFeedCoulombFriction});
}

/// Of a cut with two speeds, at rest before; `tool`: is its temperature recorded?
RecordingSignals cut_at(double first_rad_s, double second_rad_s, bool tool) {
  constexpr std::size_t kRows = 100;
  RecordingSignals signals;
  signals.rate_hz = 1000.0;
  signals.rows = kRows;
  for (std::size_t row = 0; row < kRows; ++row) {
    const bool cuts = row >= kRows / 2;
    const double cut_rad_s = row < 3 * kRows / 4 ? first_rad_s : second_rad_s;
    diagnose_test::show(signals, Channel::kContact, cuts ? 1.0 : 0.0);
    diagnose_test::show(signals, Channel::kSpindleSpeed, cuts ? cut_rad_s : 0.0);
    diagnose_test::show(signals, Channel::kArmatureCurrent, 1.0);
    if (tool) diagnose_test::show(signals, Channel::kToolTemperature, 20.0);
  }
  return signals;
}

// At one speed, and with the tool's temperature not recorded, five of five loads that were said to follow the
// speed at 98 % followed something else, four of them that temperature (another simulator).
TEST(NamingOfSlowLaws, ListAWarmToolWhereNobodyHasMeasuredItAndTheCutHasOneSpeed) {
  const auto named = [](Effect effect, const RecordingSignals& signals) {
    return named_effect(finding_of({{effect, 4000.0}}), AxisFit(Axis::kSpindle, signals, {}),
                        {.threshold = 40.0});
  };
  for (const Effect slow : {Effect::kContactSpeedDependence, Effect::kToolWearRamp}) {
    const EffectResult doubtful = named(slow, cut_at(300.0, 320.0, false));
    EXPECT_EQ(doubtful.alias_set, (Effects{slow, Effect::kContactTemperatureDependence}));
    EXPECT_NEAR(doubtful.confidence, 0.49, 1.0e-6);
    EXPECT_EQ(named(slow, cut_at(300.0, 320.0, true)).alias_set, Effects{slow});
    EXPECT_EQ(named(slow, cut_at(200.0, 320.0, false)).alias_set, Effects{slow});
  }
  EXPECT_EQ(named(Effect::kSpindleWindage, cut_at(300.0, 320.0, false)).alias_set,
            Effects{Effect::kSpindleWindage});
}

// A drop over the brushes of a spindle that turns one way is an offset of the supply but while it starts.
TEST(NamingOfSlowLaws, AreLessSureOfASpindleThatTurnsOneWay) {
  const auto confidence = [](Effect effect, Effect rival, double first_rad_s) {
    const RecordingSignals signals = cut_at(first_rad_s, 320.0, true);
    return named_effect(finding_of({{effect, 4000.0}, {rival, 3984.0}}), AxisFit(Axis::kSpindle, signals, {}),
                        {.threshold = 40.0})
        .confidence;
  };
  const double sure = 0.98 / (1.0 + std::exp(-4.0));
  const double unsure = 0.98 / (1.0 + std::exp(-0.5));
  EXPECT_NEAR(confidence(Effect::kSupplyVoltageOffset, Effect::kBrushVoltageDrop, 300.0), unsure, 1.0e-6);
  EXPECT_NEAR(confidence(Effect::kSupplyVoltageOffset, Effect::kBrushVoltageDrop, -300.0), sure, 1.0e-6);
  EXPECT_NEAR(confidence(Effect::kCurrentDelay, Effect::kCurrentBandwidth, 300.0), sure, 1.0e-6);
}

// A cut that never ends does not tell teeth from poles; that one of the two takes one sine more is no reason.
TEST(NamingOfTurns, KnowsNothingByTheNumberOfParts) {
  const RecordingSignals signals = cut_at(300.0, 320.0, true);
  const double price = std::log(static_cast<double>(signals.rows));
  const auto of_parts = [](Effect effect, std::uint8_t parts, double evidence) {
    Candidate candidate{.form = {.effect = effect}, .evidence = evidence, .coefficient = {}};
    candidate.form.parts = parts;
    return candidate;
  };
  const auto confidence = [&](Effect rival, double lacks) {
    Finding finding = finding_of({{Effect::kSpindleCogging, 4000.0}});
    finding.effect.form.parts = 2;
    finding.rivals = {of_parts(Effect::kSpindleCogging, 2, 4000.0), of_parts(rival, 4, 4000.0 - lacks)};
    return named_effect(finding, AxisFit(Axis::kSpindle, signals, {}), {.threshold = 40.0}).confidence;
  };
  EXPECT_NEAR(confidence(Effect::kToothPassingTorque, 2.0 * price), 0.49, 1.0e-6);
  EXPECT_NEAR(confidence(Effect::kToothPassingTorque, 2.0 * price + 16.0), 0.98 / (1.0 + std::exp(-4.0)),
              1.0e-6);
  EXPECT_NEAR(confidence(Effect::kDriveLag, 16.0), 0.98 / (1.0 + std::exp(-4.0)), 1.0e-6);
}

// A fit that needs another motor or another mass has probably found something else.
TEST_F(Naming, IsLessSureBesideValuesThatNoDatasheetHas) {
  const auto confidence = [this](double farthest_factor) {
    return named_effect(finding_of({{Effect::kFeedSpring, 4000.0}}), fit,
                        {.threshold = 40.0, .farthest_factor = farthest_factor})
        .confidence;
  };
  EXPECT_NEAR(confidence(1.9), 0.98, 1.0e-6);
  EXPECT_NEAR(confidence(2.1), 0.2 * 0.98, 1.0e-6);
}

// Whoever sees a bristle bend sees dry friction; only where hardly any of it is that of a slide it is
// another.
TEST_F(Naming, ListsCoulombFrictionBesideABristle) {
  EXPECT_EQ(named({{Effect::kFeedPresliding, 4000.0}, {Effect::kFeedCoulombFriction, 300.0}}).alias_set,
            (Effects{Effect::kFeedPresliding, Effect::kFeedCoulombFriction}));
  EXPECT_EQ(named({{Effect::kFeedPresliding, 4000.0}, {Effect::kFeedCoulombFriction, 100.0}}).alias_set,
            Effects{Effect::kFeedPresliding});
}

TEST_F(Naming, IsHardlyBelievedBesideStructureWithoutAName) {
  EXPECT_NEAR(named({{Effect::kFeedSpring, 4000.0}}, 0.2).confidence, 0.8 * 0.98, 1.0e-6);
  EXPECT_NEAR(named({{Effect::kFeedSpring, 4000.0}}, 0.3).confidence, 0.07 * 0.98, 1.0e-6);
}

TEST_F(Naming, IsNotBelievedAtAllWhereItMakesTheGapLarger) {
  EXPECT_EQ(named({{Effect::kFeedSpring, 4000.0}}, 1.3).confidence, 0.0);
}

TEST_F(Naming, OfManyCausesIsBelievedWhereItIsTheStrongest) {
  const auto confidence = [this](std::size_t causes, bool is_strongest) {
    return named_effect(finding_of({{Effect::kFeedSpring, 4000.0}}), fit,
                        {.threshold = 40.0, .causes = causes, .is_strongest = is_strongest})
        .confidence;
  };
  EXPECT_NEAR(confidence(2, true), 0.98, 1.0e-6);
  EXPECT_NEAR(confidence(2, false), 0.98, 1.0e-6);
  EXPECT_NEAR(confidence(3, true), 0.833, 1.0e-6);
  EXPECT_NEAR(confidence(3, false), 0.147, 1.0e-6);
}

}  // namespace
}  // namespace morepro::host
