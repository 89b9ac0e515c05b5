// What one axis does to the other is in no catalogue: it is found as structure without a name, not in the
// names of other causes.
#include <gtest/gtest.h>

#include <vector>

#include "sim_host/diagnose/fit/innovation_pass.hpp"
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

// The speed of the feed, its product with the spindle's, and its force.
TEST(Crosstalk, ReachesTheSpindlesLaws) {
  const RecordingSignals signals = record({.duration_s = 1.0});
  const std::vector<gap::EffectForm> forms{{.effect = Effect::kUnnamedVoltage, .kind = 21},
                                           {.effect = Effect::kUnnamedTorque, .kind = 17},
                                           {.effect = Effect::kUnnamedVoltage, .kind = 23}};
  std::vector<double> squares(forms.size(), 0.0);
  host::run_observer(host::Axis::kSpindle, signals, gap_model(datasheet(0.0), signals),
                     host::Disturbances(forms), 0, signals.rows, [&](const host::Innovation& v) {
                       const auto columns = v.columns.last(forms.size());
                       for (std::size_t i = 0; i < forms.size(); ++i) squares[i] += columns[i] * columns[i];
                     });
  for (std::size_t i = 0; i < forms.size(); ++i) EXPECT_GT(squares[i], 0.0) << "form " << i;
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
