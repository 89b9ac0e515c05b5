#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "lib/identification/excitation.hpp"
#include "lib/identification/feed_parameter_filter.hpp"
#include "lib/identification/spindle_parameter_filter.hpp"
#include "lib/math/elementary.hpp"
#include "lib/monitor/health.hpp"
#include "lib/monitor/held_inputs.hpp"
#include "lib/monitor/monitor_configuration.hpp"
#include "lib/monitor/running_ratio.hpp"

namespace morepro {

/// The identification of the seven parameters: decides per frame which filter may learn, and reports each
/// estimate with its standard error and whether it may be used.
class ParameterTracker {
 public:
  [[gnu::cold]] explicit ParameterTracker(const MonitorConfiguration& c)
      : period_s_(period_of(c)),
        may_sample_inductance_(c.machine.spindle.inductance_h * c.sampling.rate_hz >=
                               kFewestSamples * c.machine.spindle.resistance_ohm),
        spindle_(c.machine, period_of(c), start_of(c), kDrift),
        feed_(c.machine, period_of(c), start_of(c), kDrift) {
    for (std::size_t j = 0; j < kParameterCount; ++j) report(static_cast<Parameter>(j));
  }

  /// The state starts from the measurements; what is known of the parameters stays.
  void restart() { is_spindle_running_ = is_feed_running_ = false; }

  /// One frame of the spindle. `chip_load_is_known`: what is cut is what was commanded, so that the contact
  /// torque is known; in the air it is known anyway.
  void step_spindle(const HeldInputs& held, const SpindleMeasurement<float>& y, bool chip_load_is_known) {
    const bool is_complete = held.knows(Channel::kArmatureVoltage) && y.has_speed() && y.has_current();
    if (is_complete) spindle_seen_ = true;
    const bool may_run =
        is_complete && may_sample_inductance_ && (chip_load_is_known || !held.is_in_contact()) && moves(y);
    if (may_run && is_spindle_running_) {
      spindle_.predict(held.spindle(), held.get(Channel::kChipLoad), y.speed_variance, y.current_variance);
      spindle_ratio_.step(capped(spindle_.update(y)), 2);
      if (spindle_.has_lost_the_state()) spindle_.restart_state(y);
    } else if (may_run) {
      spindle_.restart_state(y);
    }
    is_spindle_running_ = may_run;
  }

  /// One frame of the feed axis; the deviation is that of the feed filter's speed.
  void step_feed(const HeldInputs& held, const FeedMeasurement<float>& y, float speed_deviation_m_s) {
    const bool is_complete = held.knows(Channel::kFeedForce) && (y.has_speed() || y.has_position());
    if (is_complete) feed_seen_ = true;
    force_rest_.step(held.get(Channel::kFeedForce), kForceBand);
    contact_rest_.step(held.is_in_contact() ? 1.0F : 0.0F, kContactBand);
    const bool may_run = is_complete && !(force_rest_.is_at_rest() && contact_rest_.is_at_rest());
    if (may_run && is_feed_running_) {
      const float variance = y.has_speed() ? y.speed_variance : speed_deviation_m_s * speed_deviation_m_s;
      feed_.predict(held.feed(), kFeedProcessShare * variance);
      feed_ratio_.step(capped(feed_.update(y)), (y.has_speed() ? 1U : 0U) + (y.has_position() ? 1U : 0U));
      if (feed_.has_lost_the_state()) feed_.restart_state(y);
    } else if (may_run) {
      feed_.restart_state(y);
    }
    is_feed_running_ = may_run;
  }

  /// What need not be done in every frame, one piece every kSpacing frames in turn: a report costs rows of
  /// the factorisation, a random walk a rank-one update.
  void refresh() {
    turn_ = turn_ + 1 < kRound ? turn_ + 1 : 0;
    if (turn_ % kSpacing != 0) return;
    const std::size_t piece = turn_ / kSpacing;
    if (piece % 2 == 0)
      report(static_cast<Parameter>(piece / 2));
    else
      drift(piece / 2);
  }

  [[nodiscard]] const std::array<ParameterEstimate, kParameterCount>& estimates() const { return estimates_; }

 private:
  static constexpr std::size_t kSpacing = 4;
  static constexpr std::size_t kRound = 2 * kParameterCount * kSpacing;  ///< frames until all had their turn
  /// Samples within the datasheet's L/R: of one that is off by a factor of two the machine may have enough.
  static constexpr double kFewestSamples = 0.4;
  static constexpr float kDrift = 2.0e-5F;  // relative, per step: 0.2 % per second at 10 kHz
  static constexpr float kFeedProcessShare = 1.0e-3F;
  static constexpr float kContactBand = 0.01F;  // any change of contact is a change
  static constexpr float kForceBand = 0.05F;    // N
  static constexpr float kUsableError = 0.05F;  // a relative standard error above says nothing to an engineer
  static constexpr float kLearnt = 1.0F / 9.0F;  // variance against the datasheet's: a third of its deviation
  static constexpr float kCorrelated = 0.9F;
  static constexpr float kNullLine =
      0.98F;  // along such a line the claimed variance is not to be trusted either
  static constexpr float kSharp = 0.003F;   // so well known, it does not matter with what it is correlated
  static constexpr float kMismatch = 3.0F;  // normalised innovation squared of a model that does not fit

  static float period_of(const MonitorConfiguration& c) {
    return static_cast<float>(1.0 / c.sampling.rate_hz);
  }
  static float start_of(const MonitorConfiguration& c) {
    return static_cast<float>(c.tuning.parameter_start_fraction);
  }

  bool moves(const SpindleMeasurement<float>& y) {
    speed_rest_.step(y.speed_rad_s, math::sqrt(y.speed_variance));
    current_rest_.step(y.current_a, math::sqrt(y.current_variance));
    return !(speed_rest_.is_at_rest() && current_rest_.is_at_rest());
  }

  void drift(std::size_t turn) {
    constexpr auto kFrames = static_cast<float>(kRound);
    if (turn < kSpindleParameterCount) {
      if (is_spindle_running_) spindle_.drift(static_cast<SpindleParameter>(turn), kFrames);
    } else if (is_feed_running_) {
      feed_.drift(static_cast<FeedParameter>(turn - kSpindleParameterCount), kFrames);
    }
  }

  void report(Parameter parameter) {
    auto& estimate = estimates_[index_of(parameter)];
    switch (parameter) {
      case Parameter::kTorqueConstant:
        return report_spindle(SpindleParameter::kTorqueConstant, estimate);
      case Parameter::kInertia:
        return report_spindle(SpindleParameter::kInertia, estimate);
      case Parameter::kInductance:
        return report_spindle(SpindleParameter::kInductance, estimate);
      case Parameter::kResistance:
        return report_spindle(SpindleParameter::kResistance, estimate);
      case Parameter::kBackEmfConstant:
        return report_spindle(SpindleParameter::kBackEmfConstant, estimate);
      case Parameter::kMass:
        return report_feed(FeedParameter::kMass, estimate);
      case Parameter::kContactForce:
        return report_feed(FeedParameter::kContactForce, estimate);
    }
  }

  void report_spindle(SpindleParameter parameter, ParameterEstimate& estimate) const {
    // In the order of SpindleParameter.
    constexpr std::array kParameters{Parameter::kTorqueConstant, Parameter::kInertia, Parameter::kInductance,
                                     Parameter::kResistance, Parameter::kBackEmfConstant};
    float most = 0.0F;
    Parameter partner{};
    for (std::size_t k = 0; k < kSpindleParameterCount; ++k) {
      const float now = correlation_squared(spindle_, parameter, static_cast<SpindleParameter>(k));
      const bool is_more = now > most;
      most = is_more ? now : most;
      partner = is_more ? kParameters[k] : partner;
    }
    write(spindle_, parameter, most, estimate);
    estimate.partner = is_correlated(most) ? partner_named(partner) : Partner::kNone;
    estimate.status = !spindle_seen_                 ? ParameterStatus::kNoSignal
                      : !samples_inductance()        ? ParameterStatus::kSamplingTooSlow
                      : does_not_fit(spindle_ratio_) ? ParameterStatus::kModelMismatch
                                                     : estimate.status;
  }

  void report_feed(FeedParameter parameter, ParameterEstimate& estimate) const {
    const auto other =
        parameter == FeedParameter::kMass ? FeedParameter::kContactForce : FeedParameter::kMass;
    const float correlation = correlation_squared(feed_, parameter, other);
    write(feed_, parameter, correlation, estimate);
    const bool is_mass = parameter == FeedParameter::kMass;
    estimate.partner = is_correlated(correlation)
                           ? partner_named(is_mass ? Parameter::kContactForce : Parameter::kMass)
                           : (is_mass ? Partner::kNone : Partner::kContactOffset);
    estimate.status = !feed_seen_                 ? ParameterStatus::kNoSignal
                      : does_not_fit(feed_ratio_) ? ParameterStatus::kModelMismatch
                                                  : estimate.status;
  }

  /// One sample within L/R or more, as far as is known by now.
  [[nodiscard]] bool samples_inductance() const {
    return may_sample_inductance_ && spindle_.value(SpindleParameter::kInductance) >=
                                         spindle_.value(SpindleParameter::kResistance) * period_s_;
  }

  static bool is_correlated(float correlation_squared) {
    return correlation_squared > kCorrelated * kCorrelated;
  }
  /// One spike is no misfit of the model, many in a row are.
  static float capped(float nis) {
    constexpr auto kLargest = static_cast<float>(OutlierGate<float>::kLargest);
    return nis < kLargest ? nis : kLargest;
  }
  static bool does_not_fit(const RunningRatio& ratio) {
    return ratio.is_settled() && ratio.value() > kMismatch;
  }

  template <class Filter, class Name>
  static float correlation_squared(const Filter& filter, Name a, Name b) {
    if (a == b) return 0.0F;
    const float joint = filter.covariance(a, b);
    const float product = filter.covariance(a, a) * filter.covariance(b, b);
    return product > 0.0F ? joint * joint / product : 0.0F;
  }

  template <class Filter, class Name>
  static void write(const Filter& filter, Name parameter, float correlation_squared,
                    ParameterEstimate& estimate) {
    const float variance = filter.covariance(parameter, parameter);
    estimate.value = filter.value(parameter);
    estimate.standard_error = estimate.value * math::sqrt(variance);
    const bool is_on_null_line = correlation_squared > kNullLine * kNullLine && variance > kSharp * kSharp;
    const bool is_learnt = variance <= kUsableError * kUsableError &&
                           variance <= kLearnt * filter.start_variance() && !is_on_null_line;
    estimate.status = is_learnt                            ? ParameterStatus::kIdentifiable
                      : is_correlated(correlation_squared) ? ParameterStatus::kCorrelated
                                                           : ParameterStatus::kNoExcitation;
  }

  float period_s_;
  bool may_sample_inductance_;
  SpindleParameterFilter<float> spindle_;
  FeedParameterFilter<float> feed_;
  RestDetector<float> speed_rest_, current_rest_, force_rest_, contact_rest_;
  RunningRatio spindle_ratio_, feed_ratio_;
  bool is_spindle_running_ = false, is_feed_running_ = false;
  bool spindle_seen_ = false, feed_seen_ = false;
  std::size_t turn_ = 0;
  std::array<ParameterEstimate, kParameterCount> estimates_{};
};

}  // namespace morepro
