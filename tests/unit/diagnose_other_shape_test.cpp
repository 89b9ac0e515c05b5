// A large effect whose shape is not the catalogue's leaves much in likelihood, and little of the gap.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

TEST(OtherShape, KeepsItsNameWhereTheGapCloses) {
  constexpr double kOnce = 0.02;
  constexpr double kTwice = 0.004;  // per turn, which no eccentricity of the catalogue has
  auto signals = record({.duration_s = 5.0, .seed = 3});
  double theta = 0.0;
  auto& speed = signals.value[index_of(Channel::kSpindleSpeed)];
  for (std::size_t row = 0; row < signals.rows; ++row) {
    theta += static_cast<double>(speed[row]) / signals.rate_hz;
    speed[row] *= static_cast<float>(1.0 + kOnce * std::sin(theta) + kTwice * std::sin(2.0 * theta + 1.0));
  }
  const DiagnosisResult result = diagnosed(std::move(signals), datasheet(0.0));
  EXPECT_EQ(result.verdict, host::Verdict::kEffect) << said(result);
  ASSERT_FALSE(result.which.empty()) << said(result);
  EXPECT_EQ(result.which.front().effect, Effect::kEncoderEccentricity) << said(result);
  EXPECT_GT(result.which.front().confidence, 0.3);
  EXPECT_GT(result.unexplained_share, 0.25);
}

}  // namespace
}  // namespace morepro::diagnose_test
