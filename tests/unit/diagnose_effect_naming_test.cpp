#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <optional>
#include <utility>
#include <vector>

#include "lib/gap/effect_catalogue.hpp"
#include "lib/gap/effect_size.hpp"
#include "sim_host/diagnose/outcome/effect_naming.hpp"
#include "sim_host/diagnose/search/effect_family.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::host {
namespace {

using gap::Effect;
using Effects = std::vector<Effect>;

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
TEST_F(Naming, DoubtsWhatIsWorthNextToNothingOfTheStrongest) {
  const Finding finding = finding_of({{Effect::kFeedSpring, 4000.0}});
  const auto confidence = [&](double share) {
    return named_effect(finding, fit, {.threshold = 40.0, .is_strongest = false, .share = share}).confidence;
  };
  EXPECT_NEAR(confidence(0.025), 0.98, 1.0e-6);
  EXPECT_NEAR(confidence(0.015), 0.2 * 0.98, 1.0e-6);
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
