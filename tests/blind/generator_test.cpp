#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "conditions.hpp"
#include "sizing.hpp"
#include "suite.hpp"

namespace blind {
namespace {

Scenario scenario(std::uint64_t seed, bool is_thesis, bool is_rich, double sample_s = 1e-4) {
  Random random(seed, 1);
  Scenario s;
  s.machine = random_machine(random, is_thesis);
  s.seed = seed;
  s.excitation = is_rich ? rich_excitation(s.machine, 4.0, sample_s, random)
                         : production_excitation(s.machine, 4.0, sample_s, random);
  return s;
}

TEST(BlindPlant, LeavesNothingInTheRowsWithoutNoiseAndEffects) {
  for (const bool is_thesis : {false, true}) {
    const Scenario noisy = scenario(3, is_thesis, true);
    const Floor floor = floor_of(columns_of(simulate(noisy, {})), noisy.machine);
    Scenario quiet = noisy;
    for (Sensor* sensor :
         {&quiet.machine.speed, &quiet.machine.feed, &quiet.machine.current, &quiet.machine.tool})
      *sensor = {};
    // The trapezoid is not exact where the sampling interval is near L/R (thesis machine): 1 % of the noise
    // there.
    for (double ratio : residual_ratios(columns_of(simulate(quiet, {})), noisy.machine, floor))
      EXPECT_LT(ratio, 0.02);
  }
}

TEST(BlindPlant, SamplesAsOftenAsItIsAsked) {
  for (const double sample_s : {5e-4, 5e-5}) {
    Scenario s = scenario(3, false, true, sample_s);
    for (Sensor* sensor : {&s.machine.speed, &s.machine.feed, &s.machine.current}) *sensor = {};
    for (const bool sees_state : {false, true}) {
      s.controllers_see_state = sees_state;
      const blind::Run run = simulate(s, {});
      ASSERT_TRUE(run.is_finite);
      ASSERT_EQ(run.rows.size(), static_cast<std::size_t>(std::lround(4.0 / sample_s)));
      EXPECT_NEAR(run.rows[1].time_s - run.rows[0].time_s, sample_s, 1e-12);
    }
  }
}

// What sensors make of it does not reach the inputs then.
TEST(BlindPlant, IsControlledByItsStateWhereThatIsAsked) {
  for (const bool sees_state : {false, true}) {
    Scenario s = scenario(3, false, true);
    s.controllers_see_state = sees_state;
    const auto quiet = simulate(s, {});
    for (Sensor* sensor : {&s.machine.speed, &s.machine.feed}) sensor->noise *= 2.0;
    const auto loud = simulate(s, {});
    EXPECT_EQ(quiet.rows.back().in.voltage_v == loud.rows.back().in.voltage_v, sees_state);
    EXPECT_EQ(quiet.rows.back().in.force_n == loud.rows.back().in.force_n, sees_state);
    EXPECT_NE(quiet.rows.back().seen.w, loud.rows.back().seen.w);
  }
}

/// By how much farther the feed of a machine that cuts moves in 0.52 s with 10 N of an effect that sets in
/// after 0.5 s, as a share of its way.
double moved_by(const std::string& name) {
  Random random(3, 1);
  const Machine machine = random_machine(random, false);
  const auto way = [&](double strength) {
    const auto& kinds = catalogue_effects();
    const auto kind =
        std::find_if(kinds.begin(), kinds.end(), [&](const EffectKind& one) { return one.name == name; });
    Random shapes(5, 1);
    const auto effect = kind->make(shapes, machine);
    effect->strength = strength;
    Plant plant(machine, {{effect.get(), 0.5}}, 60.0, 10.0);
    const Inputs inputs{.voltage_v = 20.0, .force_n = 50.0, .contact = 1.0};
    for (int step = 0; step < 52000; ++step) plant.step(inputs, {}, kStep_s);
    return plant.now().x;
  };
  const double without = way(0.0);
  return std::abs(way(10.0) - without) / std::abs(without);
}

// What grows while the tool cuts grows from its onset on: 20 ms later it has done next to nothing, where half
// a second of cutting before it would be a tenth of all that it does.
TEST(BlindPlant, ALateDriftBeginsAtNothing) {
  const double by_force = moved_by("feed_force_offset");
  EXPECT_GT(by_force, 0.0);
  EXPECT_LT(moved_by("feed_contact_drift"), 0.02 * by_force);
}

TEST(BlindPlant, EveryEffectFadesOutWithItsStrength) {
  const Scenario s = scenario(5, false, true);
  const Floor floor = floor_of(columns_of(simulate(s, {})), s.machine);
  for (const auto* kinds : {&catalogue_effects(), &unknown_structures()})
    for (const EffectKind& kind : *kinds) {
      const Candidate candidate{&kind, 9, 0.0};
      const auto effect = made(candidate, s.machine, 1e-3 * kind.guess(s.machine));
      const auto run = simulate(s, {{effect.get(), 0.0}});
      const auto ratios = residual_ratios(columns_of(run), s.machine, floor);
      EXPECT_NEAR(*std::max_element(ratios.begin(), ratios.end()), 1.0, 0.02) << kind.name;
    }
}

TEST(BlindSizing, ReachesTheWantedRatio) {
  const Scenario s = scenario(7, false, true);
  const Floor floor = floor_of(columns_of(simulate(s, {})), s.machine);
  for (double wanted : {1.1, 2.0, 10.0}) {
    const auto& kinds = catalogue_effects();
    const auto kind = std::find_if(kinds.begin(), kinds.end(),
                                   [](const auto& k) { return k.name == "feed_coulomb_friction"; });
    const SizedRun result = sized(s, {&*kind, 11, 0.0}, floor, wanted);
    ASSERT_TRUE(result.is_reachable);
    EXPECT_NEAR(result.largest_ratio() - 1.0, wanted - 1.0, 0.1 * (wanted - 1.0) + 0.01);
    EXPECT_EQ(result.balance(), kFeedForce);
  }
}

TEST(BlindProcessNoise, HasTheShareOfTheSensorsPowerThatWasAskedFor) {
  Scenario s = scenario(13, false, true);
  for (Sensor* sensor : {&s.machine.speed, &s.machine.feed, &s.machine.current}) sensor->lsb = 0.0;
  const Floor sensors = floor_of(columns_of(simulate(s, {})), s.machine);
  s.process = process_noise_for(s.machine, 1.0, 1e-3, 1.0, 1e-4);
  // 4 s hold few rows of the lowest band, which carries most of this noise: 25 %.
  for (double ratio : residual_ratios(columns_of(simulate(s, {})), s.machine, sensors))
    EXPECT_NEAR(ratio, 2.0, 0.5);
}

TEST(BlindSuite, HoldsEveryNameAtEveryRatio) {
  std::set<std::pair<std::string, double>> rich;
  for (const TrialSpec& trial : suite("full", 1))
    if (trial.kind == "single" && trial.set == "rich") rich.insert({trial.effects[0], trial.ratios[0]});
  EXPECT_EQ(catalogue_effects().size(), 45U);
  EXPECT_EQ(rich.size(), 4U * 45U);
}

TEST(BlindSuite, IsAnotherOneForAnotherSeed) {
  EXPECT_EQ(suite("small", 1)[0].seed, suite("small", 1)[0].seed);
  EXPECT_NE(suite("small", 1)[0].seed, suite("small", 2)[0].seed);
}

TEST(BlindSuite, VariesHowItsTrialsAreRecordedAndNothingElse) {
  const auto full = suite("full", 1), varied = suite("varied", 1);
  ASSERT_EQ(full.size(), varied.size());
  std::set<double> samples_s;
  double quietest = 1.0, loudest = 1.0, seeing = 0.0, white = 0.0;
  for (std::size_t k = 0; k < full.size(); ++k) {
    EXPECT_EQ(full[k].seed, varied[k].seed);
    EXPECT_EQ(full[k].effects, varied[k].effects);
    const Conditions plain = conditions_of(full[k]), drawn = conditions_of(varied[k]);
    EXPECT_EQ(plain.sample_s, 1e-4);
    EXPECT_FALSE(plain.controllers_see_state);
    EXPECT_LE(drawn.duration_s / drawn.sample_s, 200001.0);
    samples_s.insert(drawn.sample_s);
    EXPECT_EQ(plain.loudness, 1.0);
    EXPECT_FALSE(plain.is_white);
    quietest = std::min(quietest, drawn.loudness);
    loudest = std::max(loudest, drawn.loudness);
    seeing += drawn.controllers_see_state;
    white += drawn.is_white;
  }
  EXPECT_EQ(samples_s.size(), 4U);
  EXPECT_LT(quietest, 0.35);
  EXPECT_GT(loudest, 2.8);
  const auto trials = static_cast<double>(full.size());
  EXPECT_NEAR(seeing / trials, 0.5, 0.1);
  EXPECT_NEAR(white / trials, 0.4, 0.1);
}

TEST(BlindTrial, RepeatsItselfBySeed) {
  const Scenario s = scenario(17, false, false);
  const auto a = simulate(s, {}), b = simulate(s, {});
  EXPECT_EQ(a.rows.back().seen.w, b.rows.back().seen.w);
  EXPECT_EQ(a.rows.back().seen.x, b.rows.back().seen.x);
}

}  // namespace
}  // namespace blind
