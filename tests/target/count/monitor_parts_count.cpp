#include "lib/monitor/frame_guard.hpp"
#include "lib/monitor/held_inputs.hpp"
#include "lib/monitor/parameter_tracker.hpp"
#include "lib/monitor/sensor_watch.hpp"
#include "lib/monitor/wear_judge.hpp"
#include "tests/target/count/count.hpp"

namespace morepro::count {
namespace {

SensorFrame frame;

/// Eight channels with a little noise, in order and in time.
void next_frame() {
  static std::uint32_t random = 1;
  random = random * 1664525U + 1013904223U;
  const float noise = static_cast<float>(static_cast<std::int32_t>(random)) * 8.0e-10F;
  ++frame.sequence;
  frame.time_us += 100;
  frame.set(Channel::kArmatureVoltage, 48.0F);
  frame.set(Channel::kFeedForce, 26.0F);
  frame.set(Channel::kContact, 1.0F);
  frame.set(Channel::kChipLoad, 0.05F);
  frame.set(Channel::kToolTemperature, 500.0F + noise);
  frame.set(Channel::kSpindleSpeed, 577.7F + noise);
  frame.set(Channel::kArmatureCurrent, 2.2F + 0.05F * noise);
  frame.set(Channel::kFeedSpeed, 0.02F + 0.002F * noise);
}

void check_frame() {
  static FrameGuard guard(10000.0);
  keep(guard.check(frame));
}

void hold_inputs() {
  static HeldInputs held(reference_machine(), 10000.0);
  held.take({frame, frame.present});
  keep(held);
}

void refresh_parameters() {
  static ParameterTracker tracker(reference_configuration());
  tracker.refresh();
  keep(tracker.estimates());
}

void watch_sensors() {
  static SensorWatch watch;
  watch.step(frame.present, 0, 0);
  keep(watch.fault());
}

void judge_wear() {
  static WearJudge judge(WearLimits{}, 10000.0);
  keep(judge.judge({true, true, true, 0.05F, 0.0501F, 0.001F, 1000}));
}

const Entry kGuard{"frame_guard", 1, next_frame, check_frame};
const Entry kHeld{"held_inputs", 1, next_frame, hold_inputs};
const Entry kRefresh{"parameter_refresh", 1, next_frame, refresh_parameters};
const Entry kWatch{"sensor_watch", 1, next_frame, watch_sensors};
const Entry kJudge{"wear_judge", 1, next_frame, judge_wear};

}  // namespace
}  // namespace morepro::count
