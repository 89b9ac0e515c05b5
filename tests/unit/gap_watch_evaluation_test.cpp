// What a board says of statistics that are made by hand: how much of a gap has to have a name.
#include "lib/gap/gap_watch_evaluation.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace morepro::gap {
namespace {

// One parameter and four forms.
using Evaluation = GapWatchEvaluation<float, 1, 4, 5>;
constexpr std::array kForms{Effect::kSupplyVoltageOffset, Effect::kArmatureReaction, Effect::kCurrentBias,
                            Effect::kBrushVoltageDrop};
constexpr std::array kHarmonics{3, 5, 7, 11};

/// How much each form explains of a gap of 100 times the noise; the rest nothing does.
using Shares = std::array<double, kForms.size()>;

/// Waves that have nothing in common over whole turns.
float wave(int harmonic, int row) {
  constexpr double kTurn = 6.283185307179586;
  return static_cast<float>(std::sqrt(2.0) * std::sin(kTurn * harmonic * row / 1000.0));
}

Evaluation::Statistics rows_of(const Shares& shares) {
  constexpr double kGap = 100.0;
  const auto size = [](double share) { return static_cast<float>(std::sqrt(kGap * share)); };
  const double rest = 1.0 - std::accumulate(shares.begin(), shares.end(), 0.0);
  Evaluation::Statistics statistics;
  for (int row = 0; row < 3000; ++row) {
    Evaluation::Statistics::Row columns{wave(2, row)};
    float& y = columns[Evaluation::Statistics::kY];
    y = wave(211, row) + size(rest) * wave(97, row);
    for (std::size_t i = 0; i < shares.size(); ++i) {
      columns[1 + i] = wave(kHarmonics[i], row);
      y += size(shares[i]) * columns[1 + i];
    }
    statistics.add(columns);
  }
  return statistics;
}

/// The last `told` forms are those that a host has told of.
GapVerdict verdict_on(const Shares& shares, std::size_t told) {
  Evaluation evaluation({1.0F}, GapLimits{});
  for (std::size_t i = 0; i < kForms.size(); ++i)
    evaluation.add({.effect = kForms[i], .kind = 0, .parts = 1, .shape = 0.0F}, i + told >= kForms.size());
  const Evaluation::Statistics statistics = rows_of(shares);
  evaluation.begin();
  while (!evaluation.advance(statistics)) {
  }
  return evaluation.finding().verdict;
}

TEST(GapWatchEvaluation, BelievesInAHalfOfTheGap) {
  EXPECT_EQ(verdict_on({0.55}, 0), GapVerdict::kEffect);
  EXPECT_EQ(verdict_on({0.45}, 0), GapVerdict::kUnexplained);
}

TEST(GapWatchEvaluation, BelievesInAQuarterByWhatItWasToldOf) {
  EXPECT_EQ(verdict_on({0.0, 0.0, 0.0, 0.3}, 1), GapVerdict::kEffect);
  EXPECT_EQ(verdict_on({0.0, 0.0, 0.0, 0.2}, 1), GapVerdict::kUnexplained);
}

// A bend that passes for another effect is small.
TEST(GapWatchEvaluation, SeesANewEffectBesideOneThatItWasToldOf) {
  EXPECT_EQ(verdict_on({0.1, 0.0, 0.0, 0.35}, 1), GapVerdict::kEffect);
  EXPECT_EQ(verdict_on({0.3, 0.0, 0.0, 0.35}, 1), GapVerdict::kUnexplained);
  EXPECT_EQ(verdict_on({0.0, 0.0, 0.3, 0.35}, 2), GapVerdict::kEffect) << "told of both";
  EXPECT_EQ(verdict_on({0.35, 0.0, 0.0, 0.3}, 1), GapVerdict::kUnexplained);
  EXPECT_EQ(verdict_on({0.08, 0.0, 0.0, 0.2}, 1), GapVerdict::kUnexplained) << "a quarter together only";
  EXPECT_EQ(verdict_on({0.2, 0.15, 0.15, 0.15}, 3), GapVerdict::kUnexplained) << "the largest one is new";
}

// Two that leave next to nothing are two effects, whatever was told.
TEST(GapWatchEvaluation, BelievesInSeveralThatExplainFourFifths) {
  for (const std::size_t told : {0U, 1U})
    EXPECT_EQ(verdict_on({0.45, 0.0, 0.0, 0.4}, told), GapVerdict::kEffect) << told;
  EXPECT_EQ(verdict_on({0.45, 0.3}, 0), GapVerdict::kUnexplained);
}

}  // namespace
}  // namespace morepro::gap
