// How much process noise a fit may expect, and whether it has needed any.
#include <gtest/gtest.h>

#include <cmath>

#include "sim_host/diagnose/fit/noise_fit.hpp"
#include "sim_host/diagnose/fit/nominal_fit.hpp"
#include "sim_host/diagnose/search/effect_trial.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::host {
namespace {

using diagnose_test::datasheet;
using diagnose_test::gap_model;
using diagnose_test::record;

// A fit of a feed that has begun with loud noise has fitted its own: the spindle's, which it never looks at,
// is as loud as before.
TEST(NeedsNoise, IsSaidOfTheOwnAxisAlone) {
  const RecordingSignals signals = record({.duration_s = 1.0});
  for (const Axis axis : {Axis::kFeed, Axis::kSpindle}) {
    AxisFit fit(axis, signals, gap_model(datasheet(0.0), signals));
    fit.expect_noise(kTrustingNoiseShare);
    EXPECT_TRUE(needs_noise(fit));
    EXPECT_TRUE(needs_random_forces(fit));
    fit.settle();
    EXPECT_FALSE(needs_noise(fit));
    EXPECT_FALSE(needs_random_forces(fit));
  }
}

// A trial that begins at the datasheet kept a hundredth of the sensor's noise, whatever the other fit may
// have: in its blur a plain friction left room for a curve.
TEST(AtDatasheet, MayExpectAsLittleNoise) {
  const RecordingSignals signals = record({.duration_s = 0.2});
  AxisFit fit(Axis::kFeed, signals, gap_model(datasheet(0.0), signals));
  const auto least_share = [](AxisFit anew) {
    anew.expect_little_noise();
    const gap::GapNoise<double>& noise = anew.model().noise;
    return noise.feed_step / std::sqrt(noise.feed_speed_variance);
  };
  EXPECT_DOUBLE_EQ(least_share(at_datasheet(fit)), kUsualNoiseShare);
  fit.allow_little_noise();
  EXPECT_DOUBLE_EQ(least_share(at_datasheet(fit)), kLittleNoiseShare);
}

}  // namespace
}  // namespace morepro::host
