// A controller that sees the machine's state itself: its input tells of random forces before the recorded
// sensors do.
#include <gtest/gtest.h>

#include "tests/unit/driven_axis.hpp"

namespace morepro::diagnose_test {
namespace {

TEST(SeeingController, MakesNoDriveLate) {
  for (const double rate_hz : {2000.0, 5000.0}) {
    DrivenAxis axis{.rate_hz = rate_hz};
    axis.random_force_n = 3.0;
    const DiagnosisResult result = diagnosed(record(axis), datasheet(0.0));
    EXPECT_EQ(result.verdict, host::Verdict::kNoGap) << rate_hz << " Hz: " << said(result);
  }
}

}  // namespace
}  // namespace morepro::diagnose_test
