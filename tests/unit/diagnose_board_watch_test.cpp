// What a board is told by the host that has seen the same recording.
#include <gtest/gtest.h>

#include "sim_host/diagnose/board/board_settings.hpp"
#include "sim_host/diagnose/board/board_watch.hpp"
#include "sim_host/diagnose/signals/sampling_checks.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

gap::GapFinding watched(const RecordingSignals& signals, const host::BoardSight& sight,
                        gap::GapSettings& settings) {
  const MachineDescription machine = datasheet(0.0);
  const MachineParameters& right = machine.configuration.machine;
  return host::watch_on_board(signals, machine, {right, right}, sight, settings);
}

gap::GapSettings settings_with_noise(double share) {
  gap::GapSettings settings;
  settings.noise = host::usual_noise(reference_sensors());
  host::expect_process_noise(share, settings.noise);
  return settings;
}

TEST(BoardWatch, DoesNotLookForWhatTheHostKnowsNotToBeThere) {
  const RecordingSignals signals = record({.effects = {effect(Effect::kFeedForceOffset, 3.0)}});
  gap::GapSettings settings = settings_with_noise(0.01);
  const host::BoardSight right{.verdict = host::Verdict::kEffect, .causes = {Effect::kFeedForceOffset}};
  EXPECT_EQ(watched(signals, right, settings).effect, Effect::kFeedForceOffset);
  EXPECT_EQ(settings.feed.forms.count, 0U);
  const host::BoardSight other{.verdict = host::Verdict::kEffect, .causes = {Effect::kFeedDriveLag}};
  const gap::GapFinding found = watched(signals, other, settings);
  EXPECT_TRUE(settings.feed.forms.has(Effect::kFeedForceOffset));
  EXPECT_NE(found.effect, Effect::kFeedForceOffset);
}

TEST(BoardWatch, TakesAJitterThatTheHostDoesNotSeeForNoise) {
  const RecordingSignals signals = record({.effects = {effect(Effect::kClockJitter, 2.0e-5)}});
  gap::GapSettings settings = settings_with_noise(0.01);
  const host::BoardSight seeing{.verdict = host::Verdict::kEffect, .causes = {Effect::kClockJitter}};
  EXPECT_EQ(watched(signals, seeing, settings).effect, Effect::kClockJitter);
  EXPECT_EQ(settings.samples.clock_jitter_s, 0.0F);
  EXPECT_NE(watched(signals, {}, settings).verdict, gap::GapVerdict::kEffect);
  EXPECT_GT(settings.samples.clock_jitter_s, 2.0e-5F);
}

// Where a file says nothing of a sensor, steps that do not hide its noise are its own: the host told no
// fault, and the board a sensor_quantization.
TEST(BoardWatch, TakesStepsOfWhichNoFaultIsToldForTheSensorsOwn) {
  SimulatedRun run;
  run.configuration.sensors[Channel::kArmatureCurrent].lsb = 0.07;
  MachineDescription machine = datasheet(0.0);
  machine.assumed_noise = bit_of(Channel::kArmatureCurrent);
  const DiagnosisResult result = diagnosed(record(run), machine);
  EXPECT_EQ(result.verdict, host::Verdict::kNoGap) << said(result);
  EXPECT_EQ(result.board.verdict, gap::GapVerdict::kNoGap) << gap::info_of(result.board.effect).name;
}

// The machine that is found states the noise that was assumed. Without the steps the next recording of it had
// a sensor_quantization. What the file states stays.
TEST(BoardWatch, HasTheSensorsOwnStepsInTheMachineThatWasFound) {
  SimulatedRun run;
  run.configuration.sensors[Channel::kArmatureCurrent].lsb = 0.07;
  run.configuration.sensors[Channel::kSpindleSpeed].lsb = 0.2;
  MachineDescription machine = datasheet(0.0);
  machine.assumed_noise = bit_of(Channel::kArmatureCurrent);
  MachineDescription found;
  const RecordingSignals first = record(run);
  ASSERT_NEAR(host::step_of(first.value[index_of(Channel::kSpindleSpeed)]), 0.2, 1.0e-3);
  host::diagnose(first, machine, {}, found);
  EXPECT_NEAR(found.configuration.sensors[Channel::kArmatureCurrent].lsb, 0.07, 1.0e-6);
  EXPECT_EQ(found.configuration.sensors[Channel::kSpindleSpeed].lsb, 0.0);
  found.assumed_noise = 0;
  run.seed += 1;
  const DiagnosisResult result = diagnosed(record(run), found);
  EXPECT_EQ(result.verdict, host::Verdict::kNoGap) << said(result);
}

// Steps that a file states as an effect are not its sensor's as well: the two would be multiplied.
TEST(BoardWatch, LeavesStepsToTheEffectThatStatesThem) {
  SimulatedRun run;
  run.configuration.sensors[Channel::kArmatureCurrent].lsb = 0.07;
  MachineDescription machine = datasheet(0.0);
  machine.assumed_noise = bit_of(Channel::kArmatureCurrent);
  machine.effects = {effect(Effect::kSensorQuantization, 1.4)};
  MachineDescription found;
  host::diagnose(record(run), machine, {}, found);
  EXPECT_EQ(found.configuration.sensors[Channel::kArmatureCurrent].lsb, 0.0);
  EXPECT_EQ(found.effects.size(), 1U);
}

/// Values that an effect has bent too far do not show it any more.
TEST(BoardWatch, LooksBesideTheEffectWhereItHasBentTheValues) {
  const RecordingSignals signals = record({.effects = {effect(Effect::kFeedForceOffset, 3.0)}});
  const MachineDescription machine = datasheet(0.0);
  const MachineParameters& right = machine.configuration.machine;
  MachineParameters bent = right;
  bent.feed.mass_kg *= 0.1;
  const host::BoardSight sight{.verdict = host::Verdict::kEffect, .causes = {Effect::kFeedForceOffset}};
  const auto found = [&](const host::FittedValues& fitted) {
    gap::GapSettings settings = settings_with_noise(0.01);
    return host::watch_on_board(signals, machine, fitted, sight, settings);
  };
  EXPECT_EQ(found({bent, bent}).verdict, gap::GapVerdict::kUnexplained);
  EXPECT_EQ(found({bent, right}).verdict, gap::GapVerdict::kEffect);
  EXPECT_EQ(found({bent, right}).effect, Effect::kFeedForceOffset);
}

/// Of a spindle that never stops windage is more friction, unless its values are known.
TEST(BoardWatch, TellsAnEffectFromOtherValuesAsWellAsTheHostKnowsThem) {
  const RecordingSignals signals = record({.effects = {effect(Effect::kSpindleWindage, 2.0e-7)},
                                           .duration_s = 6.0,
                                           .profile = host::ProfileKind::kProduction});
  const MachineDescription machine = datasheet(0.0);
  const MachineParameters& right = machine.configuration.machine;
  const host::BoardSight sight{
      .verdict = host::Verdict::kEffect, .causes = {Effect::kSpindleWindage}, .is_excited = true};
  gap::GapSettings settings;
  const auto verdict_beside = [&](double spread) {
    settings = settings_with_noise(0.01);
    const host::FittedValues fitted{
        .without_effects = right, .beside_effects = right, .spindle_spread = spread};
    return host::watch_on_board(signals, machine, fitted, sight, settings).verdict;
  };
  EXPECT_EQ(verdict_beside(gap::kDatasheetSpread), gap::GapVerdict::kParameterError);
  EXPECT_EQ(verdict_beside(0.005), gap::GapVerdict::kEffect);
  EXPECT_EQ(settings.spindle.parameter_spread, 0.005);
  EXPECT_EQ(host::tuning_for_board(settings, {}, 1.0).spindle.parameter_spread, 0.005);
}

/// The host has seen what was before, from which it knows the values.
TEST(BoardWatch, IsToldHowWellTheHostKnowsTheValues) {
  gap::AppliedEffect late = effect(Effect::kSpindleWindage, 2.0e-7);
  late.onset_s = 2.0;
  const DiagnosisResult result =
      diagnosed(record({.effects = {late}, .duration_s = 6.0, .profile = host::ProfileKind::kProduction}),
                datasheet(0.0));
  ASSERT_EQ(result.verdict, host::Verdict::kEffect) << said(result);
  EXPECT_LT(result.for_board.spindle.parameter_spread, 0.02);
  EXPECT_GE(result.for_board.spindle.parameter_spread, 0.005);
  EXPECT_TRUE(result.board_agrees) << gap::name_of(result.board.verdict);
}

/// What noise may be worth is an estimate, and the host sees more.
TEST(BoardWatch, HearsOfACauseThatTheHostIsSureOf) {
  const RecordingSignals signals = record({.effects = {effect(Effect::kFeedForceOffset, 0.1)}});
  const host::BoardSight named{
      .verdict = host::Verdict::kEffect, .causes = {Effect::kFeedForceOffset}, .is_excited = true};
  gap::GapSettings settings = settings_with_noise(0.01);
  const double evidence = static_cast<double>(watched(signals, named, settings).evidence);
  ASSERT_GT(evidence, 100.0);
  settings.feed.evidence = 2.0 * evidence;
  EXPECT_EQ(watched(signals, {}, settings).verdict, gap::GapVerdict::kNoGap);
  EXPECT_EQ(watched(signals, named, settings).effect, Effect::kFeedForceOffset);
  EXPECT_LT(settings.feed.evidence, evidence);
  settings.feed.evidence = 4.0 * evidence;
  EXPECT_EQ(watched(signals, named, settings).verdict, gap::GapVerdict::kNoGap);
}

/// Half a percent is no error to the host, nor is it to a board that the host has told so.
TEST(BoardWatch, TakesARightMachineForRight) {
  const RecordingSignals signals = record(SimulatedRun{});
  const MachineDescription sheet = datasheet(0.005);
  const MachineParameters refitted = datasheet(0.0).configuration.machine;
  const auto seen_by_host = [&](host::Verdict verdict) {
    gap::GapSettings settings = settings_with_noise(0.01);
    const host::BoardSight sight{
        .verdict = verdict, .is_excited = true, .is_spindle_quiet = true, .is_feed_quiet = true};
    return host::watch_on_board(signals, sheet, {refitted, refitted}, sight, settings).verdict;
  };
  EXPECT_EQ(seen_by_host(host::Verdict::kParameterError), gap::GapVerdict::kParameterError);
  EXPECT_EQ(seen_by_host(host::Verdict::kNoGap), gap::GapVerdict::kNoGap);
}

/// Noise that was fitted to what has no name holds it: of a machine as it should be there is less.
TEST(BoardWatch, SeesWhatNoiseWasFittedTo) {
  const RecordingSignals signals = record({.process_noise = 8.0});
  const gap::GapSettings fitted = settings_with_noise(1.0);
  gap::GapSettings settings = fitted;
  const gap::GapNoise<double> expected = settings_with_noise(0.01).noise;
  const auto with_noise = [&] { return watched(signals, {.expected_noise = expected}, settings); };
  EXPECT_NE(with_noise().verdict, gap::GapVerdict::kUnexplained);
  settings = fitted;
  const auto nameless =
      watched(signals, {.verdict = host::Verdict::kUnexplained, .expected_noise = expected}, settings);
  EXPECT_EQ(nameless.verdict, gap::GapVerdict::kUnexplained);
  EXPECT_EQ(settings.noise.feed_step, expected.feed_step);
}

/// A machine file holds what a board does not look for, too; not what has no name, and nothing of the
/// sampling, which is no form.
TEST(BoardWatch, WhatItDoesNotLookForIsStated) {
  gap::MachineForms forms;
  for (const gap::EffectForm& form : {gap::EffectForm{.effect = Effect::kFeedDriveLag, .parts = 0},
                                      gap::EffectForm{.effect = Effect::kUnnamedForce},
                                      gap::EffectForm{.effect = Effect::kSampleDropout, .parts = 0},
                                      gap::EffectForm{.effect = Effect::kFeedForceOffset}})
    forms.form[forms.count++] = form;
  const gap::EffectScales<double> scales;
  const gap::MachineForms stated = host::stated_forms(forms, scales, scales);
  ASSERT_EQ(stated.count, 2U);
  EXPECT_EQ(stated.form[0].effect, Effect::kFeedDriveLag);
  EXPECT_EQ(stated.form[0].parts, 0U);
  EXPECT_EQ(stated.form[1].effect, Effect::kFeedForceOffset);
}

}  // namespace
}  // namespace morepro::diagnose_test
