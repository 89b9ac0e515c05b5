// A mass that is not the same along the way: no name of the catalogue, and no fault of the datasheet either.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/driven_axis.hpp"

namespace morepro::diagnose_test {
namespace {

/// Its mass is (1 + share * sin(place / 20 mm)) of the datasheet's.
RecordingSignals axis_with_mass_over_place(double share) {
  DrivenAxis axis;
  axis.mass_at = [share](double place_m) { return 1.0 + share * std::sin(place_m / 0.02); };
  return record(axis);
}

// About ten times what the mass is known to, and too little for anything else without a name to show it each
// time.
TEST(PlaceDependentMass, IsUnexplained) {
  for (const double share : {2.5e-4, 3.5e-4, 6.0e-4, -3.0e-4}) {
    const DiagnosisResult result = diagnosed(axis_with_mass_over_place(share), datasheet(0.0));
    EXPECT_EQ(result.verdict, host::Verdict::kUnexplained) << share << ": " << said(result);
    EXPECT_TRUE(result.which.empty()) << share << ": " << said(result);
  }
}

// Even over the place, so that no line over it follows: random forces took it, and the verdict was "no_gap".
TEST(PlaceDependentMass, IsUnexplainedWhereNoLineOverThePlaceFollowsIt) {
  for (const double share : {5.0e-4, 1.0e-3}) {
    DrivenAxis axis;
    axis.mass_at = [share](double place_m) { return 1.0 + share * std::cos(place_m / 0.02); };
    const DiagnosisResult result = diagnosed(record(axis), datasheet(0.0));
    EXPECT_EQ(result.verdict, host::Verdict::kUnexplained) << share << ": " << said(result);
    ASSERT_FALSE(result.unexplained_follows.empty()) << share;
    EXPECT_TRUE(result.unexplained_follows.front().signal.starts_with("the feed force near "))
        << result.unexplained_follows.front().signal;
  }
}

TEST(PlaceDependentMass, IsNoneWhereItIsTheSameEverywhere) {
  const DiagnosisResult result = diagnosed(axis_with_mass_over_place(0.0), datasheet(0.0));
  EXPECT_EQ(result.verdict, host::Verdict::kNoGap) << said(result);
}

}  // namespace
}  // namespace morepro::diagnose_test
