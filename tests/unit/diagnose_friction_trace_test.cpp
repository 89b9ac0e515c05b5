// What a friction of the model did in each interval, as balances and boards are told of it.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>

#include "sim_host/diagnose/fit/innovation_pass.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::host {
namespace {

using diagnose_test::datasheet;
using diagnose_test::effect;
using diagnose_test::gap_model;
using diagnose_test::record;
using gap::Effect;

class FrictionTrace : public testing::TestWithParam<double> {};

// Where the axis slides all the time, friction is its size, in steps (250 Hz and faster) and in halves. A
// hundredth: it is less than that below 2.6 widths of its side, which the estimate passes now and then.
TEST_P(FrictionTrace, IsItsSizeWhereTheAxisSlides) {
  constexpr double kSizeN = 8.0, kSurelySlidingM_s = 0.01;
  const RecordingSignals signals = record(
      {.effects = {effect(Effect::kFeedCoulombFriction, kSizeN)}, .duration_s = 5.0, .rate_hz = GetParam()});
  GapModel model = gap_model(datasheet(0.0), signals);
  model.effects = {effect(Effect::kFeedCoulombFriction, kSizeN)};
  const EffectTrace trace = trace_effects(Axis::kFeed, signals, model);
  double sum_n = 0.0;
  std::size_t sliding = 0;
  for (std::size_t row = 0; row + 1 < signals.rows; ++row) {
    const double added_n = trace().added.force_n;
    const auto& speed = signals.value[index_of(Channel::kFeedSpeed)];
    const auto at = [&speed](std::size_t i) { return static_cast<double>(speed[i]); };
    if (std::fabs(at(row)) < kSurelySlidingM_s || at(row) * at(row + 1) < 0.0) continue;
    sum_n -= std::copysign(added_n, added_n * at(row));
    ++sliding;
  }
  ASSERT_GT(sliding, signals.rows / 10);
  EXPECT_NEAR(sum_n / static_cast<double>(sliding), kSizeN, 0.01 * kSizeN);
}

INSTANTIATE_TEST_SUITE_P(Rates, FrictionTrace, testing::Values(200.0, 1000.0, 10000.0));

}  // namespace
}  // namespace morepro::host
