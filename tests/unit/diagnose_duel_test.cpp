// Which of the candidates for a cause get a trial, and what is said of those that get none.
#include <gtest/gtest.h>

#include <optional>

#include "sim_host/diagnose/search/candidate_forms.hpp"
#include "sim_host/diagnose/search/effect_duel.hpp"
#include "sim_host/diagnose/search/effect_trial.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

using host::Axis;
using host::AxisFit;
using host::Candidate;

constexpr double kLeast = 5.0;

/// A feed axis with a constant force, its model without one, and what promises to explain it.
class Duel : public testing::Test {
 protected:
  static AxisFit settled(const RecordingSignals& signals) {
    AxisFit fit(Axis::kFeed, signals, gap_model(datasheet(0.0), signals));
    fit.settle();
    return fit;
  }

  /// `rival` as it is ranked, with another promise.
  Candidate promising(Effect rival, double evidence, bool is_lifted) const {
    const auto forms = host::candidate_forms(Axis::kFeed, signals_, fit_.model(), {});
    for (Candidate& one : host::rank_candidates(fit_, fit_.collect_with_each(forms), forms)) {
      if (one.form.effect != rival) continue;
      one.evidence = evidence;
      one.is_lifted = is_lifted;
      return one;
    }
    ADD_FAILURE() << gap::info_of(rival).name;
    return {};
  }

  RecordingSignals signals_ = record({.effects = {effect(Effect::kFeedForceOffset, 6.0)}, .duration_s = 2.0});
  AxisFit fit_ = settled(signals_);
};

// Three that were lifted to the promise of the best would take its trial.
TEST_F(Duel, LetsTheBestInBesideAllThatWereLifted) {
  std::vector<Candidate> ranked{promising(Effect::kFeedSpring, 900.0, true),
                                promising(Effect::kFeedCuttingSpeedDependence, 900.0, true),
                                promising(Effect::kFeedAsymmetricFriction, 900.0, true),
                                promising(Effect::kFeedForceOffset, 900.0, false)};
  const AxisFit winner = host::duel(fit_, {kLeast, false}, ranked);
  ASSERT_EQ(winner.model().effects.size(), 1U);
  EXPECT_EQ(winner.model().effects.front().form.effect, Effect::kFeedForceOffset);
  EXPECT_EQ(ranked.front().form.effect, Effect::kFeedForceOffset);
  for (const Candidate& one : ranked) EXPECT_GT(one.evidence, kLeast) << "takes the place of a trial";
}

// The trials of what was lifted come on top of the best three.
TEST_F(Duel, LetsTheSecondBestInBesideThoseThatWereLifted) {
  std::vector<Candidate> ranked{promising(Effect::kFeedAsymmetricFriction, 900.0, true),
                                promising(Effect::kFeedScrewPeriodic, 900.0, true),
                                promising(Effect::kFeedForceSaturation, 900.0, false),
                                promising(Effect::kFeedForceOffset, 800.0, false)};
  host::duel(fit_, {kLeast, false}, ranked);
  EXPECT_EQ(ranked.front().form.effect, Effect::kFeedForceOffset);
}

// What it is worth beyond its promise says nothing of theirs: it has none of its own.
TEST_F(Duel, JudgesNoneByAPromiseThatWasLifted) {
  constexpr double kTooLittle = 0.8 * kLeast;  // for a trial
  std::vector<Candidate> ranked{promising(Effect::kFeedForceOffset, 100.0, true),
                                promising(Effect::kFeedScrewPeriodic, kTooLittle, false)};
  host::duel(fit_, {kLeast, false}, ranked);
  ASSERT_EQ(ranked.front().form.effect, Effect::kFeedForceOffset);
  EXPECT_GT(ranked.front().evidence, 200.0);
  EXPECT_DOUBLE_EQ(ranked.back().evidence, kTooLittle);
}

/// Does an effect of this size act as no machine's does, beside one that the machine file states?
class WrongWay : public Duel {
 protected:
  bool acts_wrong(Effect found, double size, std::optional<Effect> stated = {}) {
    gap::AppliedEffect one = gap::applied(found, size, {});
    if (gap::size_is_shape(found) || found == Effect::kShaftCompliance) one.coefficient[0] = size;
    return acts_wrong(one, stated);
  }

  bool acts_wrong(const gap::AppliedEffect& found, std::optional<Effect> stated = {}) {
    auto& known = fit_.change_model().known;
    known.clear();
    if (stated) known.push_back(gap::applied(*stated, 1.0, {}));
    return host::acts_the_wrong_way(found, fit_);
  }
};

TEST_F(WrongWay, IsWhatNoMachineDoes) {
  EXPECT_TRUE(acts_wrong(Effect::kFeedForceSaturation, -1.0e-5));
  EXPECT_FALSE(acts_wrong(Effect::kFeedForceSaturation, 1.0e-5));
  EXPECT_TRUE(acts_wrong(Effect::kFeedPresliding, -5.9));
  EXPECT_FALSE(acts_wrong(Effect::kFeedSpring, -10.0));
  EXPECT_FALSE(acts_wrong(Effect::kFeedStribeckFriction, -0.6)) << "a shape of the friction beside it";
  EXPECT_FALSE(acts_wrong(Effect::kSpindleWindage, -1.0e-5)) << "a shape of the viscous friction";
}

TEST_F(WrongWay, MayBeWhatIsMissingOfOneThatIsStated) {
  EXPECT_FALSE(acts_wrong(Effect::kFeedCoulombFriction, -1.0, Effect::kFeedCoulombFriction));
  EXPECT_FALSE(acts_wrong(Effect::kFeedCoulombFriction, -1.0, Effect::kFeedStribeckFriction)) << "its kind";
  EXPECT_TRUE(acts_wrong(Effect::kFeedCoulombFriction, -1.0, Effect::kSpindleCoulombFriction)) << "elsewhere";
  EXPECT_TRUE(acts_wrong(Effect::kFeedForceSaturation, -1.0e-5, Effect::kFeedSpring)) << "of no kind, either";
}

// A mass at the far end of a shaft, the width of a play: none is less than nothing, whatever was there
// before.
TEST_F(WrongWay, IsASizeThatCannotBe) {
  for (const Effect one : {Effect::kShaftCompliance, Effect::kFeedBacklash})
    EXPECT_TRUE(acts_wrong(one, -0.1, one)) << gap::info_of(one).name;
}

// A drive that clips hard bends so much that its law begins the other way.
TEST_F(WrongWay, IsSeenWhereALawThatBendsActsMost) {
  gap::AppliedEffect clipped = gap::applied(Effect::kFeedForceSaturation, -0.35e-4, {});
  clipped.form.parts = 2;
  const double most_n = signals_.largest(Channel::kFeedForce) / fit_.model().point.feed_force_n;
  clipped.coefficient[1] = 0.52e-4 / (most_n * most_n);
  EXPECT_FALSE(acts_wrong(clipped));
  clipped.coefficient[1] *= 0.5;
  EXPECT_TRUE(acts_wrong(clipped));
}

// It may lose 0.9 of what is asked, but nowhere in the range more than all of it.
TEST_F(WrongWay, IsADriveThatSaturatesUntilItPushesBack) {
  const double most_n = signals_.largest(Channel::kFeedForce);
  const double all = 1.0 / (most_n * most_n);
  EXPECT_FALSE(acts_wrong(Effect::kFeedForceSaturation, 0.9 * all));
  EXPECT_TRUE(acts_wrong(Effect::kFeedForceSaturation, 1.3 * all));
  gap::AppliedEffect bent = gap::applied(Effect::kFeedForceSaturation, 6.0 * all, {});
  bent.form.parts = 2;
  const double reference_n = fit_.model().point.feed_force_n;
  bent.coefficient[1] = -5.1 * all * (reference_n * reference_n) / (most_n * most_n);
  EXPECT_TRUE(acts_wrong(bent));
  bent.coefficient[0] = 3.0 * all;
  bent.coefficient[1] *= 2.9 / 5.1;
  EXPECT_FALSE(acts_wrong(bent)) << "0.8 of it, at most";
  const double most_a = signals_.largest(Channel::kArmatureCurrent);
  EXPECT_TRUE(acts_wrong(Effect::kTorqueConstantSaturation, 1.3 / (most_a * most_a))) << "a motor, too";
}

}  // namespace
}  // namespace morepro::diagnose_test
