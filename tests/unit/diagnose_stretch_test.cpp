// A run that begins within a recording sees the effects as one does that comes from its beginning: where the
// axis stood, how far the spindle had turned, how long the cut was when an effect set in.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim_host/diagnose/fit/innovation_pass.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

using host::Axis;
using host::GapModel;

struct StretchCase {
  const char* name;
  Axis axis;
  gap::AppliedEffect effect;
  std::vector<Channel> missing{};
  // A hundredth in amplitude, of what the effect does. The sum of noisy speeds is not quite the angle that
  // the observer has: a hundredth of a radian, times eight periods per turn.
  double most = 1.0e-4;
};

void PrintTo(const StretchCase& c, std::ostream* out) { *out << c.name; }

class Stretch : public testing::TestWithParam<StretchCase> {};

/// Innovations in units of their standard deviation; of a row that shows nothing 0.
std::vector<double> innovations(Axis axis, const RecordingSignals& signals, const GapModel& model,
                                std::size_t first) {
  std::vector<double> values(2 * signals.rows, 0.0);
  host::run_observer(axis, signals, model, first, signals.rows, [&](const host::Innovation& v) {
    values[2 * v.row + v.sensor] = v.value / std::sqrt(v.variance);
  });
  return values;
}

TEST_P(Stretch, SeesWhatTheWholeSees) {
  RecordingSignals signals = record({.effects = {GetParam().effect}});
  for (const Channel channel : GetParam().missing) leave_out(signals, channel);
  host::follow_motion(signals);
  GapModel model = gap_model(datasheet(0.0), signals);
  model.effects = {GetParam().effect};
  const std::size_t first = 2 * signals.rows / 3;
  const std::size_t settled = first + 3000;
  const auto whole = innovations(GetParam().axis, signals, model, 0);
  const auto stretch = innovations(GetParam().axis, signals, model, first);
  GapModel without = model;
  without.effects.clear();
  const auto nothing = innovations(GetParam().axis, signals, without, 0);
  double difference = 0.0;
  double effect = 0.0;
  for (std::size_t i = 2 * settled; i < whole.size(); ++i) {
    difference += std::pow(stretch[i] - whole[i], 2);
    effect += std::pow(nothing[i] - whole[i], 2);
  }
  ASSERT_GT(effect, 0.0);
  EXPECT_LT(difference, GetParam().most * effect);
}

INSTANTIATE_TEST_SUITE_P(
    , Stretch,
    testing::Values(
        StretchCase{"position", Axis::kFeed, effect(Effect::kFeedSpring, 200.0), {}},
        StretchCase{"way", Axis::kFeed, effect(Effect::kFeedSpring, 200.0), {Channel::kFeedPosition}},
        StretchCase{"cut", Axis::kFeed, effect(Effect::kFeedContactDrift, 100.0, 0.7), {}},
        StretchCase{
            "angle", Axis::kSpindle, effect(Effect::kSpindleCogging, 0.2), {Channel::kSpindleAngle}, 1.0e-2},
        StretchCase{
            "tooth", Axis::kFeed, effect(Effect::kFeedToothPassingForce, 20.0), {Channel::kSpindleAngle}},
        StretchCase{"wear", Axis::kSpindle, effect(Effect::kToolWearRamp, 0.2, 0.7), {}}),
    [](const auto& param) { return std::string(param.param.name); });

}  // namespace
}  // namespace morepro::diagnose_test
