// A large effect whose shape is not the catalogue's leaves much in likelihood, and little of the gap.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

/// A speed sensor that shows too much by these shares once and `order` times a turn.
RecordingSignals seen_eccentrically(double once, double more, double order) {
  auto signals = record({.duration_s = 5.0, .seed = 3});
  double theta = 0.0;
  auto& speed = signals.value[index_of(Channel::kSpindleSpeed)];
  for (std::size_t row = 0; row < signals.rows; ++row) {
    theta += static_cast<double>(speed[row]) / signals.rate_hz;
    speed[row] *= static_cast<float>(1.0 + once * std::sin(theta) + more * std::sin(order * theta + 1.0));
  }
  return signals;
}

TEST(OtherShape, KeepsItsNameWhereTheGapCloses) {
  // No eccentricity of the catalogue has anything three times a turn.
  const DiagnosisResult result = diagnosed(seen_eccentrically(0.02, 0.0027, 3.0), datasheet(0.0));
  EXPECT_EQ(result.verdict, host::Verdict::kEffect) << said(result);
  ASSERT_FALSE(result.which.empty()) << said(result);
  EXPECT_EQ(result.which.front().effect, Effect::kEncoderEccentricity) << said(result);
  EXPECT_GT(result.which.front().confidence, 0.3);
  EXPECT_GT(result.unexplained_share, 0.25);
}

TEST(OtherShape, OfADiscThatIsNotRoundIsTheEncodersAlone) {
  const DiagnosisResult result = diagnosed(seen_eccentrically(0.004, 0.0012, 2.0), datasheet(0.0));
  ASSERT_EQ(result.which.size(), 1U) << said(result);
  EXPECT_EQ(result.which.front().effect, Effect::kEncoderEccentricity) << said(result);
  EXPECT_NEAR(result.which.front().magnitude, 0.004, 0.0002);
  EXPECT_LT(result.unexplained_share, 0.05);
}

}  // namespace
}  // namespace morepro::diagnose_test
