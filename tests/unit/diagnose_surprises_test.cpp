#include <gtest/gtest.h>

#include "sim_host/diagnose/fit/surprises.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

using host::Axis;
using host::AxisFit;
using host::Surprises;

Surprises surprises_of(const SimulatedRun& run) {
  const RecordingSignals signals = record(run);
  return host::surprises_of(AxisFit(Axis::kSpindle, signals, gap_model(datasheet(0.0), signals)));
}

TEST(Surprises, AreNoneWhereTheModelIsRight) {
  const Surprises surprises = surprises_of({.effects = {}, .duration_s = 1.0});
  EXPECT_LT(surprises.share, 1.0e-4);
  EXPECT_LT(surprises.deviance, 1000.0);  // a tenth of a row's worth: sampling and rounding
}

// Six tenths of the recording have one row in six or more that nobody expects.
TEST(Surprises, AreWhatALateCauseMakes) {
  const Surprises surprises =
      surprises_of({.effects = {effect(Effect::kSupplyVoltageOffset, 2.0, 0.4)}, .duration_s = 1.0});
  EXPECT_GT(surprises.share, 0.1);
  EXPECT_GT(surprises.deviance, 10000.0);
}

}  // namespace
}  // namespace morepro::diagnose_test
