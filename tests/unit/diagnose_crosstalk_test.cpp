// What one axis does to the other is in no catalogue: it is found as structure without a name, not in the
// names of other causes.
#include <gtest/gtest.h>

#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

using host::Verdict;

/// A recording of a machine whose spindle gets `volts_per_m_s` of the feed's speed too, whose voltage is
/// recorded without that.
RecordingSignals with_crosstalk(float volts_per_m_s) {
  RecordingSignals signals = record({.duration_s = 5.0});
  auto& voltage = signals.value[index_of(Channel::kArmatureVoltage)];
  const auto& feed = signals.value[index_of(Channel::kFeedSpeed)];
  float held = 0.0F;
  for (std::size_t row = 0; row < signals.rows; ++row) {
    if (feed[row] == feed[row]) held = feed[row];
    voltage[row] -= volts_per_m_s * held;
  }
  return signals;
}

TEST(Crosstalk, IsStructureWithoutAName) {
  const DiagnosisResult result = diagnosed(with_crosstalk(2.0F), datasheet(0.05));
  EXPECT_EQ(result.verdict, Verdict::kUnexplained) << said(result);
}

TEST(Crosstalk, IsNotThereWithoutIt) {
  const DiagnosisResult result = diagnosed(with_crosstalk(0.0F), datasheet(0.05));
  EXPECT_EQ(result.verdict, Verdict::kParameterError) << said(result);
}

}  // namespace
}  // namespace morepro::diagnose_test
