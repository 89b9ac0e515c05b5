#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>

#include "lib/frame/frame_flag.hpp"
#include "lib/frame/sensor_frame.hpp"
#include "lib/monitor/configuration_check.hpp"
#include "lib/monitor/configuration_error.hpp"
#include "lib/monitor/feed_tracker.hpp"
#include "lib/monitor/frame_guard.hpp"
#include "lib/monitor/gap_tracker.hpp"
#include "lib/monitor/health.hpp"
#include "lib/monitor/held_inputs.hpp"
#include "lib/monitor/known_effects.hpp"
#include "lib/monitor/monitor_configuration.hpp"
#include "lib/monitor/parameter_tracker.hpp"
#include "lib/monitor/reason.hpp"
#include "lib/monitor/restart_watch.hpp"
#include "lib/monitor/sensor_model.hpp"
#include "lib/monitor/sensor_watch.hpp"
#include "lib/monitor/spindle_tracker.hpp"
#include "lib/monitor/wear_judge.hpp"

namespace morepro {

/// Everything that runs at every sample, in fixed memory: guard, bank, decision, continuous chip load, feed
/// axis, identification, gap between model and machine, verdict. kN: hypotheses that the bank can
/// hold, 1..64.
///
/// The same frames give the same bits on every machine. step() takes a bounded time and may run in an
/// interrupt; no call allocates, blocks or reads a clock.
template <std::size_t kN>
class Monitor {
 public:
  /// With the reference machine, so that a board works without any file.
  Monitor() : configuration_(reference_configuration()), estimators_(configuration_) {}

  /// Takes a configuration and forgets everything measured so far; on refusal the old one stays and nothing
  /// is forgotten.
  [[nodiscard]] ConfigurationResult configure(const MonitorConfiguration& configuration) {
    const auto result = check(configuration, kN);
    if (!result.ok()) return result;
    configuration_ = configuration;
    reset();
    return result;
  }

  /// Forgets everything measured so far.
  void reset() {
    health_ = Health{};
    static_assert(std::is_trivially_destructible_v<Estimators>);
    std::construct_at(&estimators_, configuration_);
  }

  /// One frame in, one answer out; the answer stays valid until the next call.
  const Health& step(const SensorFrame& frame) {
    const GuardedFrame seen = estimators_.guard.check(frame);
    health_.sequence = frame.sequence;
    health_.time_us = frame.time_us;
    health_.frame_flags = seen.flags;
    health_.rejected_channels = seen.rejected;
    if (!seen.is_accepted) {
      ++health_.frames_rejected;
      return health_;
    }
    ++health_.frames_accepted;
    health_.frames_missing += seen.missing;
    process(seen);
    return health_;
  }

  /// The link dropped something that was no frame.
  void count_corrupt() { ++health_.frames_rejected; }

  /// Somebody changed the tool: its wear starts anew.
  void tool_changed() { estimators_.wear.tool_changed(); }

  [[nodiscard]] const Health& health() const { return health_; }
  /// What holds from the last frame on and was measured by then, of the machine without its known effects.
  [[nodiscard]] const HeldInputs& held() const { return estimators_.held; }
  [[nodiscard]] const MonitorConfiguration& configuration() const { return configuration_; }
  [[nodiscard]] std::size_t hypothesis_count() const { return configuration_.grid.count; }
  [[nodiscard]] float hypothesis_mm(std::size_t index) const {
    return static_cast<float>(configuration_.grid.value_mm(index));
  }
  /// Of a hypothesis, given the measurements in contact so far; equal for all before the first contact. 0
  /// from hypothesis_count() on.
  [[nodiscard]] float probability(std::size_t index) const { return estimators_.spindle.probability(index); }

 private:
  struct Estimators {
    [[gnu::cold]] explicit Estimators(const MonitorConfiguration& c)
        : guard(c.sampling.rate_hz),
          held(c.machine, c.sampling.rate_hz),
          known(c),
          spindle(c),
          feed(c),
          parameters(c),
          wear(c.wear, c.sampling.rate_hz),
          sensor_model(c),
          gap(c),
          rate_hz(static_cast<float>(c.sampling.rate_hz)) {}

    FrameGuard guard;
    HeldInputs held;
    KnownEffects known;
    SpindleTracker<kN> spindle;
    FeedTracker feed;
    ParameterTracker parameters;
    WearJudge wear;
    SensorWatch sensors;
    SensorModel sensor_model;
    GapTracker gap;
    RestartWatch spindle_restarts;
    RestartWatch feed_restarts;
    float rate_hz;
    float last_speed_rad_s = 0.0F;
  };

  static constexpr float kGapRatio = 3.0F;
  static constexpr unsigned kSpeedFlags =
      bits_of(ContactFlag::kCuttingSpeedLow) | bits_of(ContactFlag::kCuttingSpeedHigh);

  void process(const GuardedFrame& seen) {
    auto& e = estimators_;
    if (!seen.is_restart)
      for (std::uint32_t k = 1; k < seen.periods; ++k) coast();
    const FrameView frame = e.known.is_empty() ? seen.frame : e.known.take_out(seen.frame, seen.is_restart);
    auto spindle = e.sensor_model.spindle(frame);
    auto feed = e.sensor_model.feed(frame);
    if (seen.is_restart)
      restart(spindle, feed);
    else
      step_estimators(spindle, feed, acceleration(frame));
    e.sensors.step(frame.usable, seen.rejected, seen.flags);
    e.last_speed_rad_s = frame.has(Channel::kSpindleSpeed) ? frame.get(Channel::kSpindleSpeed)
                                                           : e.spindle.chip_load().speed_rad_s();
    hold_inputs(frame);
    look_ahead(frame.usable);
    watch_gap(seen);
    write_health();
  }

  /// Inputs of the nominal machine for the interval that begins.
  void look_ahead(std::uint16_t measured) {
    auto& e = estimators_;
    if (e.known.is_empty()) return;
    const auto& spindle = e.spindle.chip_load();
    e.known.look_ahead({spindle.speed_rad_s(), spindle.current_a(), e.feed.filter().speed_m_s()}, measured,
                       e.held);
  }

  /// After the other estimators: what they have found to be no measurement is none for the watch either. A
  /// frame after a gap has cost them enough, and behind a first frame stands nothing that could prove it: the
  /// watch goes on with the next one.
  void watch_gap(const GuardedFrame& seen) {
    auto& e = estimators_;
    if (!sensors_are_sound()) return e.gap.distrust();
    const bool is_untimely = (seen.flags & bits_of(FrameFlag::kTimeJump)) != 0;
    if (seen.is_restart || seen.missing > 0 || is_untimely)
      return e.gap.interrupt(seen.is_restart ? 0 : seen.missing);
    e.gap.step(e.held, static_cast<std::uint16_t>(seen.frame.usable & ~health_.rejected_channels));
  }

  [[nodiscard]] bool sensors_are_sound() const {
    return estimators_.sensors.fault() == ReasonCode::kNone && estimators_.sensors.is_fresh();
  }

  void restart(const SpindleMeasurement<float>& spindle, const FeedMeasurement<float>& feed) {
    estimators_.spindle.restart(spindle);
    estimators_.feed.restart(feed);
    estimators_.parameters.restart();
  }

  void coast() {
    auto& e = estimators_;
    if (e.held.knows(Channel::kArmatureVoltage)) e.spindle.coast(e.held.spindle());
    if (e.held.knows(Channel::kFeedForce)) e.feed.coast(e.held.feed());
    e.parameters.restart();
    look_ahead(0);
  }

  /// Measured, or the difference of the last two measured speeds.
  float acceleration(const FrameView& frame) const {
    if (frame.has(Channel::kSpindleAcceleration)) return frame.get(Channel::kSpindleAcceleration);
    return (frame.get(Channel::kSpindleSpeed) - estimators_.last_speed_rad_s) * estimators_.rate_hz;
  }

  void step_estimators(SpindleMeasurement<float>& spindle, FeedMeasurement<float>& feed,
                       float acceleration_rad_s2) {
    auto& e = estimators_;
    if (!e.held.knows(Channel::kArmatureVoltage) && !e.held.knows(Channel::kFeedForce))
      flag(FrameFlag::kNoInput);
    // Before the others: their gates rest on the datasheet, and what they reject is what a wrong one is known
    // by.
    e.parameters.step_spindle(e.held, spindle, cuts_as_commanded());
    e.parameters.step_feed(e.held, feed, math::sqrt(e.feed.filter().speed_variance()));
    if (e.held.knows(Channel::kArmatureVoltage)) step_spindle(spindle, acceleration_rad_s2);
    if (e.held.knows(Channel::kFeedForce)) step_feed(feed);
    e.parameters.refresh();
  }

  void step_spindle(SpindleMeasurement<float>& y, float acceleration_rad_s2) {
    auto& e = estimators_;
    const auto outcome = e.spindle.step(e.held.spindle(), y, acceleration_rad_s2);
    note(outcome.speed_rejected, Channel::kSpindleSpeed);
    note(outcome.current_rejected, Channel::kArmatureCurrent);
    count_restart(e.spindle_restarts, outcome.restarted);
    flag_law(e.spindle.chip_load().flags());
  }

  void step_feed(FeedMeasurement<float>& y) {
    auto& e = estimators_;
    const auto outcome = e.feed.step(e.held.feed(), y);
    note(outcome.speed_rejected, Channel::kFeedSpeed);
    note(outcome.position_rejected, Channel::kFeedPosition);
    count_restart(e.feed_restarts, outcome.restarted);
  }

  void flag(FrameFlag flag) {
    health_.frame_flags = static_cast<std::uint16_t>(health_.frame_flags | bits_of(flag));
  }

  void note(bool rejected, Channel channel) {
    if (!rejected) return;
    flag(FrameFlag::kInnovationGate);
    health_.rejected_channels = static_cast<std::uint16_t>(health_.rejected_channels | bit_of(channel));
  }

  void count_restart(RestartWatch& axis, bool restarted) {
    axis.step(restarted);
    if (restarted) flag(FrameFlag::kEstimatorReset);
  }

  void flag_law(std::uint8_t contact_flags) {
    if (!estimators_.held.is_in_contact()) return;
    if ((contact_flags & bits_of(ContactFlag::kCuttingSpeedLow)) != 0) flag(FrameFlag::kSpeedLow);
    if ((contact_flags & bits_of(ContactFlag::kCuttingSpeedHigh)) != 0) flag(FrameFlag::kSpeedHigh);
  }

  /// The inputs of this frame hold from now on; a new cut or a new command makes the chip load unknown.
  void hold_inputs(const FrameView& frame) {
    auto& e = estimators_;
    const bool was_in_contact = e.held.is_in_contact();
    const float commanded_mm = e.held.get(Channel::kChipLoad);
    e.held.take(frame);
    if (!e.held.is_in_contact()) return;
    if (!was_in_contact)
      e.spindle.start_cut();
    else if (!(e.held.get(Channel::kChipLoad) == commanded_mm))
      e.spindle.forget_chip_load();
  }

  /// Identification may use the contact torque only where the tool cuts what was commanded.
  [[nodiscard]] bool cuts_as_commanded() const {
    const auto& e = estimators_;
    if (!e.held.knows(Channel::kChipLoad)) return false;
    const auto& filter = e.spindle.chip_load();
    const float commanded_mm = e.held.get(Channel::kChipLoad);
    const float distance = math::abs(filter.chip_load_mm() - commanded_mm);
    return distance <= 0.1F * commanded_mm + 3.0F * math::sqrt(filter.chip_load_variance_mm2());
  }

  void write_health() {
    auto& e = estimators_;
    const auto& filter = e.spindle.chip_load();
    const ChipLoadEvidence evidence = chip_load_evidence();
    const Verdict verdict = decide(evidence);
    health_.state = verdict.state;
    health_.reason = static_cast<std::uint16_t>(verdict.reason);
    health_.chip_load_state = is_valid(evidence) ? ChipLoadState::kValid : ChipLoadState::kUndetermined;
    health_.chip_load_mm = evidence.estimate_mm;
    health_.chip_load_standard_error_mm = evidence.standard_error_mm;
    health_.hypothesis_count = static_cast<std::uint8_t>(configuration_.grid.count);
    health_.selected_hypothesis = static_cast<std::uint8_t>(e.spindle.selected());
    health_.selected_probability = e.spindle.probability(e.spindle.selected());
    health_.spindle_speed_rad_s = filter.speed_rad_s();
    health_.armature_current_a = e.known.current_a(filter.current_a());
    health_.feed_speed_m_s = e.feed.filter().speed_m_s();
    health_.innovation_ratio = e.spindle.ratio().value();
    health_.parameters = e.parameters.estimates();
    health_.gap = e.gap.finding();
  }

  /// A decision from fewer frames of a cut is chance, as is one whose error spans more than one hypothesis.
  static constexpr std::uint32_t kFewestFrames = 5;

  [[nodiscard]] bool is_valid(const ChipLoadEvidence& evidence) const {
    const auto& e = estimators_;
    return evidence.has_signals && evidence.is_in_contact && evidence.is_inside_law && e.sensors.is_fresh() &&
           !has_spindle_gap() && e.spindle.chip_load().is_inside_prior() &&
           evidence.frames_known >= kFewestFrames &&
           evidence.standard_error_mm <= static_cast<float>(configuration_.grid.step_mm);
  }

  ChipLoadEvidence chip_load_evidence() const {
    const auto& e = estimators_;
    const auto& filter = e.spindle.chip_load();
    return {.is_in_contact = e.held.is_in_contact(),
            .has_signals = e.held.knows(Channel::kArmatureVoltage) && e.held.knows(Channel::kContact) &&
                           e.held.knows(Channel::kSpindleSpeed) && e.held.knows(Channel::kArmatureCurrent),
            .is_commanded = e.held.knows(Channel::kChipLoad),
            .reference_mm = e.held.get(Channel::kChipLoad),
            .estimate_mm = filter.chip_load_mm(),
            .standard_error_mm = math::sqrt(filter.chip_load_variance_mm2()),
            .datasheet_error_mm =
                e.spindle.chip_load_error_mm(static_cast<float>(configuration_.wear.datasheet_tolerance)),
            .is_inside_law = (filter.flags() & kSpeedFlags) == 0,
            .frames_known = e.spindle.frames_known()};
  }

  /// A broken sensor or a model that does not fit come first: what is judged with them means nothing, and
  /// does not count towards a later judgement.
  Verdict decide(const ChipLoadEvidence& evidence) {
    auto& wear = estimators_.wear;
    const ReasonCode fault = estimators_.sensors.fault();
    if (!sensors_are_sound() || has_spindle_gap()) wear.distrust();
    if (fault != ReasonCode::kNone) return {HealthState::kSensorFault, fault};
    if (wear.is_worn()) return {HealthState::kReplace, ReasonCode::kWearLoadHigh};
    if (has_spindle_gap()) return {HealthState::kModelGap, ReasonCode::kModelResidual};
    if (has_feed_gap()) return {HealthState::kModelGap, ReasonCode::kModelFeedResidual};
    return with_gap(wear.judge(evidence));
  }

  /// A gap whose cause is found is said where nothing is wrong with the tool.
  [[nodiscard]] Verdict with_gap(const Verdict& verdict) const {
    if (verdict.state != HealthState::kHealthy && verdict.state != HealthState::kNotEnoughData)
      return verdict;
    switch (estimators_.gap.finding().verdict) {
      case gap::GapVerdict::kEffect:
        return {HealthState::kModelGap, ReasonCode::kModelEffect};
      case gap::GapVerdict::kUnexplained:
        return {HealthState::kModelGap, ReasonCode::kModelUnexplained};
      default:
        return verdict;
    }
  }

  [[nodiscard]] bool has_spindle_gap() const {
    return has_gap(estimators_.spindle_restarts, estimators_.spindle.ratio());
  }

  [[nodiscard]] bool has_feed_gap() const {
    return has_gap(estimators_.feed_restarts, estimators_.feed.ratio());
  }

  static bool has_gap(const RestartWatch& restarts, const RunningRatio& ratio) {
    return restarts.are_many() || (ratio.is_settled() && ratio.value() > kGapRatio);
  }

  MonitorConfiguration configuration_;
  Health health_;
  Estimators estimators_;
};

/// The monitor of the board images and of the replay.
inline constexpr std::size_t kMonitorHypotheses = 11;
using BoardMonitor = Monitor<kMonitorHypotheses>;

}  // namespace morepro
