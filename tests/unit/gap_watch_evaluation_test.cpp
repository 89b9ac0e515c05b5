// What a board says of statistics that are made by hand: how much of a gap has to have a name.
#include "lib/gap/gap_watch_evaluation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace morepro::gap {
namespace {

// One parameter and two forms.
using Evaluation = GapWatchEvaluation<float, 1, 2, 3>;

/// Waves that have nothing in common over whole turns.
float wave(int harmonic, int row) {
  constexpr double kTurn = 6.283185307179586;
  return static_cast<float>(std::sqrt(2.0) * std::sin(kTurn * harmonic * row / 1000.0));
}

/// Of a gap of 100 times the noise: how much a first and a second form explain; the rest nothing does.
struct Shares {
  double first;
  double second;
};

/// 3000 rows in which every form explains its share.
Evaluation::Statistics rows_of(const Shares& shares) {
  constexpr double kGap = 100.0;
  const auto size = [](double share) { return static_cast<float>(std::sqrt(kGap * share)); };
  Evaluation::Statistics statistics;
  for (int row = 0; row < 3000; ++row) {
    const float noise = wave(211, row);
    const float rest = size(1.0 - shares.first - shares.second) * wave(97, row);
    const float y = size(shares.first) * wave(3, row) + size(shares.second) * wave(5, row) + rest + noise;
    statistics.add({wave(2, row), wave(3, row), wave(5, row), y});
  }
  return statistics;
}

GapVerdict verdict_on(const Shares& shares, bool is_first_told, bool is_second_told) {
  Evaluation evaluation({1.0F}, GapLimits{});
  evaluation.add({.effect = Effect::kSupplyVoltageOffset, .kind = 0, .parts = 1, .shape = 0.0F},
                 is_first_told);
  evaluation.add({.effect = Effect::kArmatureReaction, .kind = 0, .parts = 1, .shape = 0.0F}, is_second_told);
  const Evaluation::Statistics statistics = rows_of(shares);
  evaluation.begin();
  while (!evaluation.advance(statistics)) {
  }
  return evaluation.finding().verdict;
}

TEST(GapWatchEvaluation, BelievesInAHalfOfTheGap) {
  EXPECT_EQ(verdict_on({.first = 0.55, .second = 0.0}, false, false), GapVerdict::kEffect);
  EXPECT_EQ(verdict_on({.first = 0.45, .second = 0.0}, false, false), GapVerdict::kUnexplained);
}

TEST(GapWatchEvaluation, BelievesInAQuarterByWhatItWasToldOf) {
  EXPECT_EQ(verdict_on({.first = 0.3, .second = 0.0}, true, true), GapVerdict::kEffect);
  EXPECT_EQ(verdict_on({.first = 0.2, .second = 0.0}, true, true), GapVerdict::kUnexplained);
}

// A bend that passes for another effect is small.
TEST(GapWatchEvaluation, SeesANewEffectBesideOneThatItWasToldOf) {
  // Forms that were told come last.
  const auto beside = [](double old, double added, bool is_new) {
    return verdict_on({.first = added, .second = old}, !is_new, true);
  };
  EXPECT_EQ(beside(0.35, 0.1, true), GapVerdict::kEffect);
  EXPECT_EQ(beside(0.35, 0.3, true), GapVerdict::kUnexplained);
  EXPECT_EQ(beside(0.35, 0.3, false), GapVerdict::kEffect) << "told of both";
  EXPECT_EQ(beside(0.3, 0.35, true), GapVerdict::kUnexplained);
  EXPECT_EQ(beside(0.2, 0.08, true), GapVerdict::kUnexplained) << "a quarter of the gap together only";
}

// Two that leave next to nothing are two effects, whatever was told.
TEST(GapWatchEvaluation, BelievesInSeveralThatExplainFourFifths) {
  for (const bool is_told : {false, true})
    EXPECT_EQ(verdict_on({.first = 0.45, .second = 0.4}, false, is_told), GapVerdict::kEffect) << is_told;
  EXPECT_EQ(verdict_on({.first = 0.45, .second = 0.3}, false, false), GapVerdict::kUnexplained);
}

}  // namespace
}  // namespace morepro::gap
