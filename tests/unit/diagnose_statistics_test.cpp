#include <gtest/gtest.h>

#include <vector>

#include "sim_host/diagnose/fit/axis_fit.hpp"
#include "sim_host/diagnose/fit/gap_statistics.hpp"
#include "sim_host/diagnose/fit/noise_fit.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::host {
namespace {

using diagnose_test::datasheet;
using diagnose_test::effect;
using diagnose_test::gap_model;
using diagnose_test::record;
using gap::Effect;

constexpr double kBlock = 0.25;

/// Residuals that remember themselves, so that rows of different instants are mixed.
Whitening with_memory() {
  Whitening whitening;
  for (SensorWhitening& sensor : whitening) {
    sensor.memory[0] = 0.3;
    sensor.memory[8] = -0.1;
  }
  return whitening;
}

struct Statistics : testing::Test {
  const RecordingSignals signals = record({.duration_s = 1.0});
  const GapModel model = gap_model(built_in_machine("reference"), signals);
  const Whitening whitening = with_memory();

  [[nodiscard]] GapStatistics collected(const std::vector<gap::EffectForm>& forms, Moments moments) const {
    return collect(Axis::kSpindle, signals, all_of(signals), model, forms, whitening, kBlock, moments);
  }
};

// Ranking tries one form at a time. What it reads of the moments has to be what the full product has, and the
// rest must not look like something.
TEST_F(Statistics, OfFormsOneByOneAreThoseOfAllTogether) {
  const std::vector<gap::EffectForm> forms{
      {.effect = Effect::kSpindleCoulombFriction, .parts = 1, .shape = 0.01F},
      {.effect = Effect::kSpindleCogging, .parts = 2, .shape = 6.0F},
      {.effect = Effect::kToothPassingTorque, .parts = 4, .shape = 0.0F},
      {.effect = Effect::kCurrentBias, .parts = 1, .shape = 0.0F}};
  const GapStatistics all = collected(forms, Moments::kAll);
  const GapStatistics each = collected(forms, Moments::kFormByForm);
  ASSERT_EQ(all.block.size(), each.block.size());
  EXPECT_EQ(all.rows, each.rows);
  const Eigen::MatrixXd full = all.total(), some = each.total();
  const auto parameters = static_cast<Eigen::Index>(parameter_count(Axis::kSpindle));
  std::vector<int> form_of(static_cast<std::size_t>(full.cols()), -1);  // -1: parameters and the innovation
  std::size_t column = static_cast<std::size_t>(parameters);
  for (std::size_t f = 0; f < forms.size(); ++f)
    for (int part = 0; part < forms[f].parts; ++part) form_of[column++] = static_cast<int>(f);
  for (Eigen::Index a = 0; a < full.cols(); ++a)
    for (Eigen::Index b = 0; b < full.cols(); ++b) {
      const int here = form_of[static_cast<std::size_t>(a)], there = form_of[static_cast<std::size_t>(b)];
      const bool is_read = here < 0 || there < 0 || here == there;
      // Sums of 20,000 products in another order.
      const double rounding = 1.0e-12 * std::sqrt(full(a, a) * full(b, b));
      EXPECT_NEAR(some(a, b), is_read ? full(a, b) : 0.0, rounding) << a << ", " << b;
    }
}

TEST_F(Statistics, OfInnovationsAloneAreThoseWithColumns) {
  const GapStatistics all = collected({}, Moments::kAll);
  const GapStatistics alone = collected({}, Moments::kOfInnovations);
  EXPECT_EQ(all.normalised, alone.normalised);
  EXPECT_EQ(unlikeliness_of(all, whitening_of(all)), unlikeliness_of(alone, whitening_of(alone)));
  const Eigen::MatrixXd total = all.total();
  ASSERT_EQ(alone.total().size(), 1);
  EXPECT_NEAR(alone.total()(0, 0), total.bottomRightCorner(1, 1)(0, 0), 1.0e-12 * total.maxCoeff());
}

// Where an onset is, is told in blocks: those that lasted longer by their name than by their rows ended after
// the recording.
TEST_F(Statistics, BlocksLastAsLongAsTheirRows) {
  constexpr double kRoomFor125Rows = 0.01257;
  const GapStatistics statistics = collect(Axis::kSpindle, signals, all_of(signals), model, Disturbances{},
                                           whitening, kRoomFor125Rows, Moments::kOfInnovations);
  EXPECT_EQ(statistics.block_s, 125.0 / signals.rate_hz);
  EXPECT_EQ(statistics.block.size(), 80U);
}

// With the columns of all candidates a block has half a megabyte: those of hours fit into memory.
TEST_F(Statistics, BlocksOfALongRecordingAreNotMoreThanFitIntoMemory) {
  RecordingSignals slow = signals;
  slow.rate_hz = 1.0;  // 10,000 s of the same rows
  const AxisFit fit(Axis::kSpindle, slow, model);
  EXPECT_EQ(fit.innovations().block.size(), 500U);
  EXPECT_EQ(AxisFit(Axis::kSpindle, signals, model).block_s(), kBlock);
}

TEST_F(Statistics, NoiseOfNothingIsAsItWas) {
  GapModel fitted = model;
  const Stretch nothing = after(signals, 2.0 * signals.duration_s());
  EXPECT_FALSE(fit_noise(Axis::kSpindle, signals, nothing, model.noise, NoiseBounds{}, false, fitted));
  EXPECT_EQ(fitted.noise.speed_step, model.noise.speed_step);
}

TEST(QuarterOf, ALongRecordingLiesEverywhereInIt) {
  RecordingSignals signals;
  signals.rows = 100'000;
  const std::vector<Stretch> stretches = quarter_of(signals);
  std::size_t rows = 0, before = 0;
  for (const auto& [first, last] : stretches) {
    EXPECT_GE(first, before);
    EXPECT_LE(last, signals.rows);
    EXPECT_LT(first - before, signals.rows / 8) << "nothing is seen for an eighth of it";
    rows += last - first;
    before = last;
  }
  EXPECT_NEAR(static_cast<double>(rows), 25'000.0, 16.0);
  signals.rows = 10'000;
  ASSERT_EQ(quarter_of(signals).size(), 1U);
  EXPECT_EQ(quarter_of(signals).front().last, signals.rows);
}

// Pieces of two seconds are too short to show a resonance, those of twenty are not.
TEST(QuarterOf, FewRowsIsOfWhatLasts) {
  RecordingSignals signals;
  signals.rows = 20'000;
  signals.rate_hz = 10'000.0;
  EXPECT_EQ(quarter_of(signals).size(), 1U);
  signals.rate_hz = 1'000.0;
  EXPECT_GT(quarter_of(signals).size(), 1U);
}

// A fit that begins with a part of a recording ends where one ends that has seen all of it from the start: 5
// is the deviance that a round of either may leave.
TEST(AxisFitOfALongRecording, EndsWhereAllOfItLeads) {
  const RecordingSignals signals =
      record({.effects = {effect(Effect::kSpindleWindage, 4.0e-6, 2.5)}, .duration_s = 5.0});
  for (const Axis axis : {Axis::kSpindle, Axis::kFeed}) {
    AxisFit by_part(axis, signals, gap_model(datasheet(0.2), signals));
    by_part.settle();
    AxisFit on = by_part;
    for (int round = 0; round < 4; ++round) {
      on.match_noise();
      on.refit();
    }
    EXPECT_NEAR(by_part.unlikeliness(), on.unlikeliness(), 5.0);
  }
}

}  // namespace
}  // namespace morepro::host
