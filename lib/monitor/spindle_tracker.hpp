#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "lib/estimation/bank.hpp"
#include "lib/estimation/chip_load_filter.hpp"
#include "lib/estimation/decision.hpp"
#include "lib/monitor/innovation_gate.hpp"
#include "lib/monitor/measurement_variance.hpp"
#include "lib/monitor/monitor_configuration.hpp"
#include "lib/monitor/running_ratio.hpp"

namespace morepro {

/// What the spindle's estimators did with one frame.
struct SpindleOutcome {
  bool speed_rejected = false;
  bool current_rejected = false;
  bool restarted = false;
};

/// The estimators of the spindle that see every frame: the bank with its decision, and the continuous chip
/// load, whose prediction is the gate for all of them.
template <std::size_t kN>
class SpindleTracker {
 public:
  using Lanes = std::array<float, kN>;
  using Measurement = SpindleMeasurement<float>;
  using Input = SpindleInput<float>;

  [[gnu::cold]] explicit SpindleTracker(const MonitorConfiguration& c)
      : period_s_(static_cast<float>(1.0 / c.sampling.rate_hz)),
        step_(make_spindle_step<float>(c.machine.spindle, 1.0 / c.sampling.rate_hz)),
        chip_loads_(lanes_of(c.grid)),
        plant_(c.machine.spindle),
        bank_(c.machine, step_, chip_loads_,
              {square(c.tuning.speed_process_noise_rad_s), square(c.tuning.current_process_noise_a)}),
        chip_load_(c.machine, step_, prior_of(c), square(c.tuning.speed_process_noise_rad_s),
                   square(c.tuning.current_process_noise_a)),
        rule_(c.rule),
        markov_(c.grid.count, static_cast<float>(c.tuning.switch_probability)),
        bayesian_(c.grid.count, kProbabilityFloor),
        integral_(c.grid.count, acceleration_noise(c), current_noise(c), period_s_),
        law_(c.machine) {}

  /// The state starts from the measurement; chip load and probabilities stay.
  void restart(const Measurement& y) {
    const float speed_variance = y.has_speed() ? y.speed_variance : kUnknownSpeedVariance;
    const float current_variance = y.has_current() ? y.current_variance : kUnknownCurrentVariance;
    const float speed = y.has_speed() ? y.speed_rad_s : 0.0F, current = y.has_current() ? y.current_a : 0.0F;
    bank_.start(speed, current, speed_variance, current_variance);
    chip_load_.restart_state(speed, current, speed_variance, current_variance);
    speed_gate_.restart();
    current_gate_.restart();
  }

  /// The chip load is unknown from now on: a cut begins, or another chip load was commanded.
  void forget_chip_load() {
    chip_load_.start_cut();
    frames_known_ = 0;
  }

  void start_cut() {
    forget_chip_load();
    markov_.reset();
    bayesian_.reset();
    integral_.reset();
  }

  /// One period without a measurement.
  void coast(const Input& input) {
    const Measurement none{0.0F, 0.0F, kUnmeasured, kUnmeasured};
    chip_load_.predict(input);
    bank_.step(input, none);
  }

  /// One period and the frame at its end; what the gate rejects is removed from `y`. `acceleration_rad_s2`:
  /// measured, or the difference of the measured speeds; only the thesis's rule uses it.
  SpindleOutcome step(const Input& input, Measurement& y, float acceleration_rad_s2) {
    const float speed_before = chip_load_.speed_rad_s(), current_before = chip_load_.current_a();
    chip_load_.predict(input);
    SpindleOutcome outcome = gate(y, speed_before, current_before);
    if (outcome.restarted) {
      restart(y);
      return outcome;
    }
    ratio_.step(chip_load_.update(y), (y.has_speed() ? 1U : 0U) + (y.has_current() ? 1U : 0U));
    bank_.step(input, y);
    if (input.contact > 0.0F) decide(input, y, acceleration_rad_s2);
    return outcome;
  }

  [[nodiscard]] const ChipLoadFilter<float>& chip_load() const { return chip_load_; }
  [[nodiscard]] const Bank<float, kN>& bank() const { return bank_; }
  [[nodiscard]] const RunningRatio& ratio() const { return ratio_; }
  /// Error of the chip load [mm] where motor torque and viscous friction are off by `tolerance`, relative:
  /// such an error leaves no residual, because the chip load absorbs it.
  [[nodiscard]] float chip_load_error_mm(float tolerance) const {
    const float torque = plant_.torque_constant * math::abs(chip_load_.current_a()) +
                         plant_.viscous_friction * math::abs(chip_load_.speed_rad_s());
    const float slope = math::abs(chip_load_.torque_per_chip_load());
    return slope > 0.0F ? tolerance * torque / slope : std::numeric_limits<float>::max();
  }

  /// Frames in contact since the chip load was last unknown.
  [[nodiscard]] std::uint32_t frames_known() const { return frames_known_; }

  [[nodiscard]] std::size_t selected() const {
    switch (rule_) {
      case DecisionRule::kBayesian:
        return bayesian_.selected();
      case DecisionRule::kThesis:
        return integral_.selected();
      default:
        return markov_.selected();
    }
  }

  /// Probability of a hypothesis; the thesis's rule has none: 0.
  [[nodiscard]] float probability(std::size_t j) const {
    switch (rule_) {
      case DecisionRule::kBayesian:
        return bayesian_.probability()[j];
      case DecisionRule::kThesis:
        return 0.0F;
      default:
        return markov_.probability()[j];
    }
  }

 private:
  static constexpr float kProbabilityFloor = 1.0e-6F;
  static constexpr float kUnknownSpeedVariance =
      1.0e4F;  // (100 rad/s)^2: any speed of a machine of this class
  static constexpr float kUnknownCurrentVariance = 1.0e2F;  // (10 A)^2

  static float square(double x) { return static_cast<float>(x * x); }

  static Lanes lanes_of(const HypothesisGrid& grid) {
    Lanes lanes;
    for (std::size_t j = 0; j < kN; ++j)
      lanes[j] = static_cast<float>(grid.value_mm(j < grid.count ? j : grid.count - 1));
    return lanes;
  }

  /// Twice the grid's range on its upper side: a worn tool cuts like a chip load beyond the grid.
  static ChipLoadPrior<float> prior_of(const MonitorConfiguration& c) {
    const double low = c.grid.first_mm, high = c.grid.value_mm(c.grid.count - 1);
    return {.mean_mm = static_cast<float>(0.5 * (low + high)),
            .standard_deviation_mm = static_cast<float>(0.5 * (high - low) + 0.5 * c.grid.step_mm),
            .lowest_mm = 0.0F,
            .highest_mm = static_cast<float>(2.0 * high),
            .drift_mm = static_cast<float>(c.tuning.chip_load_drift_mm)};
  }

  static float current_noise(const MonitorConfiguration& c) {
    return math::sqrt(measurement_variance(c, Channel::kArmatureCurrent));
  }
  /// Of the accelerometer, or of the difference of two measured speeds where there is none.
  static float acceleration_noise(const MonitorConfiguration& c) {
    const auto measured = static_cast<float>(c.sensors[Channel::kSpindleAcceleration].variance());
    const auto rate = static_cast<float>(c.sampling.rate_hz);
    return math::sqrt(measured > 0.0F ? measured
                                      : 2.0F * measurement_variance(c, Channel::kSpindleSpeed) * rate * rate);
  }

  SpindleOutcome gate(Measurement& y, float speed_before, float current_before) {
    SpindleOutcome outcome;
    const auto e = chip_load_.innovation(y);
    outcome.speed_rejected = y.has_speed() && speed_gate_.rejects(e.speed_rad_s, e.speed_variance,
                                                                  chip_load_.speed_rad_s() - speed_before);
    outcome.current_rejected =
        y.has_current() &&
        current_gate_.rejects(e.current_a, e.current_variance, chip_load_.current_a() - current_before);
    outcome.restarted = speed_gate_.has_lost_the_state() || current_gate_.has_lost_the_state();
    if (outcome.restarted) return outcome;
    if (outcome.speed_rejected) y.speed_variance = kUnmeasured;
    if (outcome.current_rejected) y.current_variance = kUnmeasured;
    return outcome;
  }

  void decide(const Input& input, const Measurement& y, float acceleration_rad_s2) {
    if (!(y.has_speed() || y.has_current())) return;
    ++frames_known_;
    switch (rule_) {
      case DecisionRule::kBayesian:
        bayesian_.step(bank_.log_likelihood());
        break;
      case DecisionRule::kThesis:
        integrate(input, y, acceleration_rad_s2);
        break;
      default:
        markov_.step(bank_.log_likelihood());
        break;
    }
  }

  /// The thesis's outputs of each filter, angular acceleration and current, against the measured ones.
  void integrate(const Input& input, const Measurement& y, float acceleration_rad_s2) {
    if (!(y.has_speed() && y.has_current())) return;
    Lanes acceleration_error, current_error;
    for (std::size_t j = 0; j < kN; ++j) {
      const float w = bank_.speed_rad_s(j), i = bank_.current_a(j);
      const float torque =
          input.contact * law_.at_thermal_factor(w, chip_loads_[j], input.thermal_factor).torque_nm;
      acceleration_error[j] =
          acceleration_rad_s2 -
          (plant_.torque_constant * i - plant_.viscous_friction * w - torque) * plant_.per_inertia;
      current_error[j] = y.current_a - i;
    }
    integral_.step(acceleration_error, current_error);
  }

  struct SpindleConstants {
    explicit SpindleConstants(const MachineParameters::Spindle& spindle)
        : torque_constant(static_cast<float>(spindle.torque_constant_nm_a)),
          viscous_friction(static_cast<float>(spindle.viscous_friction_nms_rad)),
          per_inertia(static_cast<float>(1.0 / spindle.inertia_kgm2)) {}
    float torque_constant;
    float viscous_friction;
    float per_inertia;
  };

  float period_s_;
  SpindleStep<float> step_;
  Lanes chip_loads_;
  SpindleConstants plant_;
  Bank<float, kN> bank_;
  ChipLoadFilter<float> chip_load_;
  DecisionRule rule_;
  MarkovDecision<float, kN> markov_;
  BayesianDecision<float, kN> bayesian_;
  MinimumIntegralDecision<float, kN> integral_;
  ContactLaw<float> law_;
  InnovationGate speed_gate_;
  InnovationGate current_gate_;
  RunningRatio ratio_;
  std::uint32_t frames_known_ = 0;
};

}  // namespace morepro
