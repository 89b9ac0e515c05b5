#pragma once
#include "lib/estimation/feed_filter.hpp"
#include "lib/monitor/innovation_gate.hpp"
#include "lib/monitor/monitor_configuration.hpp"
#include "lib/monitor/running_ratio.hpp"

namespace morepro {

/// What the feed axis's filter did with one frame.
struct FeedOutcome {
  bool speed_rejected = false;
  bool position_rejected = false;
  bool restarted = false;
};

/// The state of the feed axis: common to all hypotheses, because the feed speed does not enter the spindle.
class FeedTracker {
 public:
  using Measurement = FeedMeasurement<float>;
  using Input = FeedInput<float>;

  explicit FeedTracker(const MonitorConfiguration& c)
      : filter_(c.machine.feed, 1.0 / c.sampling.rate_hz,
                static_cast<float>(c.tuning.feed_process_noise_m_s * c.tuning.feed_process_noise_m_s)) {}

  void restart(const Measurement& y) {
    filter_.start(y);
    speed_gate_.restart();
    position_gate_.restart();
  }

  /// One period without a measurement.
  void coast(const Input& input) { filter_.predict(input); }

  /// One period and the frame at its end; what the gate rejects is removed from `y`.
  FeedOutcome step(const Input& input, Measurement& y) {
    const float speed_before = filter_.speed_m_s(), position_before = filter_.position_m();
    filter_.predict(input);
    const FeedOutcome outcome = gate(y, speed_before, position_before);
    if (outcome.restarted) {
      restart(y);
      return outcome;
    }
    ratio_.step(filter_.update(y), (y.has_speed() ? 1U : 0U) + (y.has_position() ? 1U : 0U));
    return outcome;
  }

  [[nodiscard]] const FeedFilter<float>& filter() const { return filter_; }
  [[nodiscard]] const RunningRatio& ratio() const { return ratio_; }

 private:
  FeedOutcome gate(Measurement& y, float speed_before, float position_before) {
    FeedOutcome outcome;
    const auto e = filter_.innovation(y);
    outcome.speed_rejected = y.has_speed() && speed_gate_.rejects(e.speed_m_s, e.speed_variance,
                                                                  filter_.speed_m_s() - speed_before);
    outcome.position_rejected =
        y.has_position() &&
        position_gate_.rejects(e.position_m, e.position_variance, filter_.position_m() - position_before);
    outcome.restarted = speed_gate_.has_lost_the_state() || position_gate_.has_lost_the_state();
    if (outcome.restarted) return outcome;
    if (outcome.speed_rejected) y.speed_variance = kUnmeasured;
    if (outcome.position_rejected) y.position_variance = kUnmeasured;
    return outcome;
  }

  FeedFilter<float> filter_;
  InnovationGate speed_gate_;
  InnovationGate position_gate_;
  RunningRatio ratio_;
};

}  // namespace morepro
