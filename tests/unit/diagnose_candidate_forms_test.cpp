// Every form that is tried has room in one pass over a recording: what has none would never be named.
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

#include "sim_host/diagnose/fit/innovation_pass.hpp"
#include "sim_host/diagnose/search/candidate_forms.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

/// Everything is recorded and varies; the tool cuts whichever way the spindle turns.
RecordingSignals everything() {
  RecordingSignals signals;
  signals.rate_hz = 10000.0;
  signals.rows = 64;
  signals.recorded = (1U << kChannelCount) - 1U;
  for (std::size_t c = 0; c < kChannelCount; ++c)
    for (std::size_t row = 0; row < signals.rows; ++row)
      signals.value[c].push_back(row % 2 == 0 ? 1.0F : -1.0F);
  signals.value[index_of(Channel::kContact)].assign(signals.rows, 1.0F);
  host::count_cutting_time(signals);
  return signals;
}

std::size_t columns(host::Axis axis, const RecordingSignals& signals, const host::GapModel& model) {
  std::size_t count = 0;
  for (const gap::EffectForm& form : host::candidate_forms(axis, signals, model, {})) count += form.parts;
  return count;
}

TEST(CandidateForms, HaveRoomBesideTheRunOutOfEveryTooth) {
  const RecordingSignals signals = everything();
  host::GapModel model = gap_model(datasheet(0.0), signals);
  for (const Effect teeth : {Effect::kToothPassingTorque, Effect::kFeedToothPassingForce})
    for (const std::uint8_t kind : {std::uint8_t{0}, std::uint8_t{2}})
      model.effects.push_back({.form = {.effect = teeth, .kind = kind, .parts = 4}, .coefficient = {}});
  EXPECT_LE(columns(host::Axis::kSpindle, signals, model), host::kMostTerms);
  EXPECT_LE(columns(host::Axis::kFeed, signals, model), host::kMostTerms);
}

}  // namespace
}  // namespace morepro::diagnose_test
