#include "lib/gap/gap_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "lib/gap/effect_catalogue.hpp"
#include "tests/support/gap_runs.hpp"

namespace morepro::gap {
namespace {

using test::GapRun;

template <class Real = float>
GapFinding found(const GapRun& run, const MachineParameters& believed = test::gap_configuration().machine,
                 const GapSettings& settings = test::gap_settings()) {
  const auto watch = std::make_unique<GapWatch<Real>>(test::new_watch<Real>(believed, settings));
  test::watch_run(*watch, run);
  watch->finish();
  return watch->finding();
}

std::string name(Effect effect) { return std::string(kEffects[index_of(effect)].name); }

bool is_named(const GapFinding& finding, Effect effect) {
  const auto end = finding.alias.begin() + finding.alias_count;
  return finding.effect == effect || std::find(finding.alias.begin(), end, effect) != end;
}

struct VisibleEffect {
  Effect effect;
  double size;
};

/// Sizes of a tenth to a third of what the quantity usually is: nobody would miss them in a plot.
constexpr VisibleEffect kVisible[] = {
    {Effect::kSpindleCoulombFriction, 0.05},
    {Effect::kSpindleWindage, 2.0e-7},
    {Effect::kSpindleCogging, 0.1},
    {Effect::kContactChipLoadDependence, 0.1},
    {Effect::kContactTemperatureDependence, 0.1},
    {Effect::kToolWearRamp, 0.05},
    {Effect::kTorqueConstantSaturation, 1.0e-4},
    {Effect::kBrushVoltageDrop, 2.0},
    {Effect::kSupplyVoltageOffset, 2.0},
    {Effect::kDriveLag, 4.0e-4},
    {Effect::kSpindleSpeedBias, 3.0},
    {Effect::kCurrentBias, 0.5},
    {Effect::kSpindleSpeedDelay, 1.0e-3},
    {Effect::kCurrentDelay, 3.0e-4},
    {Effect::kFeedCoulombFriction, 3.0},
    {Effect::kFeedForceOffset, 3.0},
    {Effect::kFeedAsymmetricFriction, 3.0},
    {Effect::kFeedSpring, 2000.0},
};

TEST(GapWatch, NamesWhatIsThere) {
  for (const auto& [effect, size] : kVisible) {
    const GapFinding finding =
        found({.effects = {test::gap_effect(effect, size)}, .duration_s = 24.0, .seed = 7});
    EXPECT_EQ(finding.verdict, GapVerdict::kEffect) << name(effect);
    EXPECT_TRUE(is_named(finding, effect)) << name(effect) << " was called " << name(finding.effect);
    EXPECT_EQ(finding.where, group_of(finding.effect)) << name(effect);
    EXPECT_GT(finding.confidence, 0.9F) << name(effect);
  }
}

GapFinding found_with(const GapRun& run, const EffectForm& form) {
  GapSettings settings = test::gap_settings();
  for (GapLimits* limits : {&settings.spindle, &settings.feed}) {
    limits->forms.form[0] = form;
    limits->forms.count = 1;
  }
  return found(run, test::gap_configuration().machine, settings);
}

// The stronger one explains less than half of it.
TEST(GapWatch, NamesTheStrongerOfTwoEffectsInOneAxis) {
  const GapFinding finding = found({.effects = {test::gap_effect(Effect::kSpindleCoulombFriction, 0.1),
                                                test::gap_effect(Effect::kBrushVoltageDrop, 0.45)},
                                    .duration_s = 24.0,
                                    .seed = 7});
  EXPECT_EQ(finding.verdict, GapVerdict::kEffect);
  EXPECT_EQ(finding.effect, Effect::kBrushVoltageDrop) << name(finding.effect);
}

// Seven periods per turn: the board's own form has eight.
TEST(GapWatch, KnowsTheFormsThatAMachineWasSeenToHave) {
  AppliedEffect cogging = test::gap_effect(Effect::kSpindleCogging, 0.1);
  cogging.form.shape = 7.0F;
  const GapRun run{.effects = {cogging}, .duration_s = 24.0, .seed = 7};
  EXPECT_NE(found(run).effect, Effect::kSpindleCogging);
  const GapFinding finding =
      found_with(run, {.effect = Effect::kSpindleCogging, .kind = 0, .parts = 2, .shape = 7.0F});
  EXPECT_EQ(finding.verdict, GapVerdict::kEffect);
  EXPECT_EQ(finding.effect, Effect::kSpindleCogging) << name(finding.effect);
}

// A large drop is far from linear: its column leaves more than half of the gap. What a host has not told of
// is not believed then.
TEST(GapWatch, BelievesALargeEffectThatItWasToldOf) {
  const AppliedEffect drop = test::gap_effect(Effect::kBrushVoltageDrop, 4.0);
  const GapRun run{.effects = {drop}, .duration_s = 24.0, .seed = 7};
  EXPECT_EQ(found(run).verdict, GapVerdict::kUnexplained);
  const GapFinding finding = found_with(run, drop.form);
  EXPECT_EQ(finding.verdict, GapVerdict::kEffect);
  EXPECT_EQ(finding.effect, Effect::kBrushVoltageDrop) << name(finding.effect);
}

TEST(GapWatch, DoesNotLookForWhatWasTakenAway) {
  const GapRun run{
      .effects = {test::gap_effect(Effect::kFeedForceOffset, 3.0)}, .duration_s = 24.0, .seed = 7};
  ASSERT_EQ(found(run).effect, Effect::kFeedForceOffset);
  const GapFinding finding =
      found_with(run, {.effect = Effect::kFeedForceOffset, .kind = 0, .parts = 0, .shape = 0.0F});
  EXPECT_FALSE(finding.verdict == GapVerdict::kEffect && is_named(finding, Effect::kFeedForceOffset));
}

/// With w |w|, the law of windage, without its name.
GapSettings nameless_windage(bool has_named_one) {
  GapSettings settings = test::gap_settings();
  MachineForms& forms = settings.spindle.forms;
  forms.form[0] = {.effect = Effect::kUnnamedTorque, .kind = 3, .parts = 1, .shape = 0.0F};
  forms.form[1] = {.effect = Effect::kSpindleWindage, .kind = 0, .parts = 0, .shape = 0.0F};
  forms.count = has_named_one ? 1 : 2;
  return settings;
}

GapFinding found_nameless(const std::vector<AppliedEffect>& effects, const GapSettings& settings) {
  return found({.effects = effects, .duration_s = 24.0, .seed = 7}, test::gap_configuration().machine,
               settings);
}

TEST(GapWatch, NamesNoFunctionWithoutAName) {
  const AppliedEffect windage = test::gap_effect(Effect::kSpindleWindage, 2.0e-7);
  EXPECT_EQ(found_nameless({windage}, nameless_windage(false)).verdict, GapVerdict::kUnexplained);
  const GapFinding alike = found_nameless({windage}, nameless_windage(true));
  EXPECT_EQ(alike.verdict, GapVerdict::kEffect);
  for (std::size_t i = 0; i < alike.alias_count; ++i) EXPECT_LT(alike.alias[i], Effect::kUnnamedTorque);
}

// What it explains is little of a residual that is all but noise.
TEST(GapWatch, NamesNoFunctionWithoutANameThatExplainsLittle) {
  GapSettings settings = nameless_windage(false);
  settings.spindle.noise_ratio = 0.88;
  EXPECT_EQ(found_nameless({test::gap_effect(Effect::kSpindleWindage, 6.0e-8)}, settings).verdict,
            GapVerdict::kUnexplained);
}

TEST(GapWatch, ClaimsNoCauseWhereAFunctionWithoutANameExplainsAsMuch) {
  const std::vector effects{test::gap_effect(Effect::kSpindleCogging, 0.05),
                            test::gap_effect(Effect::kSpindleWindage, 8.0e-7),
                            test::gap_effect(Effect::kCurrentBias, 0.16)};
  EXPECT_EQ(found_nameless(effects, nameless_windage(false)).verdict, GapVerdict::kUnexplained);
}

TEST(GapWatch, NamesNoEffectWhereThereIsNone) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    EXPECT_EQ(found({.duration_s = 8.0, .seed = seed}).verdict, GapVerdict::kNoGap) << seed;
}

TEST(GapWatch, CallsWrongParametersWhatTheyAre) {
  MachineParameters believed = test::gap_configuration().machine;
  believed.spindle.torque_constant_nm_a *= 1.1;
  believed.spindle.resistance_ohm *= 0.9;
  believed.feed.viscous_friction_ns_m *= 1.2;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    EXPECT_EQ(found({.duration_s = 8.0, .seed = seed}, believed).verdict, GapVerdict::kParameterError)
        << seed;
}

TEST(GapWatch, NamesNoCauseWithoutExcitation) {
  const GapFinding finding = found({.effects = {test::gap_effect(Effect::kSupplyVoltageOffset, 3.0)},
                                    .profile = host::ProfileKind::kProduction});
  EXPECT_EQ(finding.verdict, GapVerdict::kInsufficientExcitation);
  EXPECT_EQ(finding.alias_count, 0);
}

// Values that were fitted without an effect may be of another sign than the machine's.
TEST(GapWatch, KnowsHowWellALoadIsKnownWhateverItsSign) {
  MachineParameters believed = test::gap_configuration().machine;
  believed.feed.contact_force_n = -believed.feed.contact_force_n;
  believed.feed.contact_offset_n = 0.5;
  const GapFinding finding = found({.duration_s = 24.0, .seed = 7}, believed);
  EXPECT_EQ(finding.verdict, GapVerdict::kParameterError) << static_cast<int>(finding.verdict);
}

// Correlated loads that a stored noise does not know look like anything; one run in ten may still be named,
// and none where the host has stored the noise that it found.
TEST(GapWatch, IsWaryWhereTheNoiseIsNotTheOneItExpects) {
  int named = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
    named +=
        found({.duration_s = 8.0, .seed = seed, .process_noise = 0.3}).verdict == GapVerdict::kEffect ? 1 : 0;
  EXPECT_LE(named, 2);
}

TEST(GapWatch, TakesForNoiseWhatTheHostHasSeenAsNoise) {
  const GapRun run{.duration_s = 12.0, .seed = 4, .process_noise = 0.3};
  const auto& machine = test::gap_configuration().machine;
  GapSettings settings = test::gap_settings();
  for (GapLimits* limits : {&settings.spindle, &settings.feed}) limits->evidence = 1.0e6;
  EXPECT_EQ(found(run, machine, settings).verdict, GapVerdict::kUnexplained);
  for (GapLimits* limits : {&settings.spindle, &settings.feed}) limits->noise_ratio = 100.0;
  EXPECT_EQ(found(run, machine, settings).verdict, GapVerdict::kNoGap);
}

/// Sees a spindle that a production never stops: windage and more friction look the same to it.
std::unique_ptr<GapWatch<float>> watch_of_one_speed(double parameter_spread) {
  GapSettings settings = test::gap_settings();
  settings.spindle.excitation = 0.001;
  settings.spindle.parameter_spread = parameter_spread;
  auto watch =
      std::make_unique<GapWatch<float>>(test::new_watch<float>(test::gap_configuration().machine, settings));
  test::watch_run(*watch, {.effects = {test::gap_effect(Effect::kSpindleWindage, 2.0e-7)},
                           .profile = host::ProfileKind::kProduction,
                           .duration_s = 24.0});
  watch->finish();
  return watch;
}

TEST(GapWatch, TellsAnEffectFromOtherValuesWhereItKnowsThem) {
  const auto half_known = watch_of_one_speed(kDatasheetSpread);
  EXPECT_EQ(half_known->finding().verdict, GapVerdict::kParameterError);
  const auto known = watch_of_one_speed(0.005);
  EXPECT_EQ(known->finding().verdict, GapVerdict::kEffect);
  EXPECT_TRUE(is_named(known->finding(), Effect::kSpindleWindage)) << name(known->finding().effect);
  // What the frames tell does not depend on what was known before.
  EXPECT_EQ(known->spindle().evaluation().excitation(), half_known->spindle().evaluation().excitation());
}

// The inverse of both together would have no square in a float, and what is no number is no gap.
TEST(GapWatch, KnowsValuesAsWellAsAFloatCanTell) {
  MachineParameters machine = test::gap_configuration().machine;
  machine.feed.contact_force_n = machine.feed.contact_offset_n = 1.0e-12;
  GapSettings settings = test::gap_settings();
  settings.feed.parameter_spread = settings.feed.excitation = 1.0e-12;
  const GapFinding finding = found({}, machine, settings);
  EXPECT_NE(finding.verdict, GapVerdict::kNoGap) << "its contact pushes with all its force";
  EXPECT_TRUE(std::isfinite(finding.evidence));
}

TEST(GapWatch, SaysNothingBeforeItHasSeenEnough) {
  EXPECT_EQ(found({.duration_s = 0.5}).verdict, GapVerdict::kNotEnoughData);
}

TEST(GapWatch, FindsTheSameInFloatAndInDouble) {
  for (const GapRun& run : {GapRun{}, GapRun{.effects = {test::gap_effect(Effect::kFeedForceOffset, 3.0)}},
                            GapRun{.effects = {test::gap_effect(Effect::kSupplyVoltageOffset, 2.0)}},
                            GapRun{.effects = {test::gap_effect(Effect::kSpindleSpeedDelay, 1.0e-3)}}}) {
    const GapFinding in_float = found<float>(run);
    const GapFinding in_double = found<double>(run);
    EXPECT_EQ(in_float.verdict, in_double.verdict);
    EXPECT_EQ(in_float.effect, in_double.effect);
    EXPECT_EQ(in_float.alias_count, in_double.alias_count);
    // Rounding of a float, 6e-8, over some thousand additions, as a share of the evidence's residual.
    EXPECT_NEAR(in_float.evidence, in_double.evidence, 0.01F * std::max(100.0F, in_double.evidence));
  }
}

TEST(GapWatch, MergesShardsIntoTheVerdictOfAll) {
  const std::vector effects{test::gap_effect(Effect::kFeedForceOffset, 0.5)};
  const auto watch = [] {
    return std::make_unique<GapWatch<float>>(
        test::new_watch<float>(test::gap_configuration().machine, test::gap_settings()));
  };
  const auto all = watch();
  const auto reversed = watch();
  std::vector<std::unique_ptr<GapWatch<float>>> shards;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    shards.push_back(watch());
    test::watch_run(*shards.back(), {.effects = effects, .duration_s = 6.0, .seed = seed});
    shards.back()->finish();
  }
  for (const auto& shard : shards) all->merge(*shard);
  for (auto shard = shards.rbegin(); shard != shards.rend(); ++shard) reversed->merge(**shard);
  all->finish();
  reversed->finish();
  EXPECT_EQ(all->finding().verdict, GapVerdict::kEffect);
  EXPECT_EQ(all->finding().effect, Effect::kFeedForceOffset);
  EXPECT_EQ(all->finding().effect, reversed->finding().effect);
  EXPECT_NEAR(all->finding().evidence, reversed->finding().evidence, 1.0e-3F * all->finding().evidence);
  EXPECT_GT(all->finding().evidence, 2.0F * shards.front()->finding().evidence);
}

/// Sees seconds `from_s` to `to_s` of a machine that knows its position, whose screw pushes and pulls.
std::unique_ptr<GapWatch<float>> watch_of_screw(double from_s, double to_s) {
  MonitorConfiguration configuration = reference_configuration();
  MachineParameters& machine = configuration.machine;
  machine.feed.screw_pitch_m = 5.0e-3;
  const ReferencePoint point = host::reference_point_of(machine);
  host::SimulationOptions options{.profile = host::ProfileKind::kRich, .duration_s = to_s};
  options.effects = {applied(Effect::kFeedScrewPeriodic, 2.0, {machine, point})};
  host::Simulation simulation(configuration, options);
  GapSettings settings = test::gap_settings();
  settings.noise.feed_position_variance = configuration.sensors[Channel::kFeedPosition].variance();
  auto watch = std::make_unique<GapWatch<float>>(machine, point, 1.0 / options.rate_hz, settings);
  const auto first = static_cast<std::uint32_t>(from_s * options.rate_hz);
  for (SensorFrame frame; simulation.next(frame);) {
    if (watch->is_resting()) watch->begin_anew();
    if (frame.sequence >= first) watch->step(test::gap_frame<float>(frame));
  }
  watch->finish();
  return watch;
}

// Each begins elsewhere on the way.
TEST(GapWatch, MergesWatchesThatBeganElsewhereOnTheScrew) {
  const auto first = watch_of_screw(0.0, 4.0);
  const auto merged = watch_of_screw(4.0, 8.0);
  const float later = merged->finding().evidence;
  ASSERT_EQ(first->finding().effect, Effect::kFeedScrewPeriodic) << name(first->finding().effect);
  ASSERT_EQ(merged->finding().effect, Effect::kFeedScrewPeriodic) << name(merged->finding().effect);
  merged->merge(*first);
  merged->finish();
  EXPECT_EQ(merged->finding().verdict, GapVerdict::kEffect);
  EXPECT_EQ(merged->finding().effect, Effect::kFeedScrewPeriodic) << name(merged->finding().effect);
  EXPECT_GT(merged->finding().evidence, 0.9F * (later + first->finding().evidence));
}

TEST(GapWatch, BeginsAStretchAnewAfterAGap) {
  auto watch = test::new_watch<float>(test::gap_configuration().machine, test::gap_settings());
  GapFrame<float> frame;
  frame.has_speed = frame.has_current = true;
  for (int k = 0; k < 200; ++k) watch.step(frame);
  watch.interrupt();
  int observed = 0;
  for (; !watch.is_resting(); ++observed) watch.step(frame);
  EXPECT_EQ(observed, 272);
}

TEST(GapWatch, AStretchThatIsAbandonedIsNotUsed) {
  auto watch = test::new_watch<float>(test::gap_configuration().machine, test::gap_settings());
  GapFrame<float> frame;
  frame.has_speed = frame.has_current = frame.has_feed_speed = true;
  while (!watch.is_resting()) watch.step(frame);
  for (int k = 0; k < 288; ++k) watch.rest(0.0F, 0.0F, 0.0F);
  watch.abandon();
  watch.finish();
  EXPECT_EQ(watch.spindle().statistics().rows(), 0U);
  EXPECT_EQ(watch.feed().statistics().rows(), 0U);
}

// What a PC compares a board with: every row of a recording, as of a board that has watched for long.
TEST(GapWatch, ThatBeginsAnewUsesEveryWholeStretch) {
  using Watch = GapWatch<float>;
  auto watch = test::new_watch<float>(test::gap_configuration().machine, test::gap_settings());
  GapFrame<float> frame;
  frame.has_speed = frame.has_current = frame.has_feed_speed = true;
  for (int stretch = 1; stretch <= 3; ++stretch) {
    for (std::size_t k = 0; k < Watch::kStretch; ++k) watch.step(frame);
    watch.begin_anew();
    EXPECT_FALSE(watch.is_resting());
    EXPECT_EQ(watch.spindle().statistics().rows(), stretch * Watch::kRowsOfStretch);
    EXPECT_EQ(watch.feed().statistics().rows(), stretch * Watch::kRowsOfStretch);
  }
  for (std::size_t k = 0; k + 1 < Watch::kStretch; ++k) watch.step(frame);
  watch.begin_anew();
  EXPECT_EQ(watch.spindle().statistics().rows(), 3 * Watch::kRowsOfStretch) << "of a stretch that was cut";
}

TEST(GapWatch, KnowsTheGroupOfEveryEffect) {
  for (const EffectInfo& info : kEffects) EXPECT_EQ(group_of(info.effect), info.group) << info.name;
}

TEST(GapWatch, LooksForAtLeastTwentyFourForms) { EXPECT_GE(kSpindleForms.size() + kFeedForms.size(), 24U); }

}  // namespace
}  // namespace morepro::gap
