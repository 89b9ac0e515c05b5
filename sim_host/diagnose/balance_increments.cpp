#include "sim_host/diagnose/balance_increments.hpp"

#include <cmath>
#include <limits>

#include "lib/plant/contact_law.hpp"
#include "sim_host/diagnose/innovation_pass.hpp"

namespace morepro::host {
namespace {

using Row = Eigen::RowVectorXf;
constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

/// Share of the interval's first sample in the integral of a current that decays with R/L under a held
/// voltage.
double first_share(double decay) {
  return std::fabs(decay) < 1.0e-3 ? 0.5 - decay / 12.0 : 1.0 / decay - 1.0 / std::expm1(decay);
}

GapModel without_findings(GapModel model) {
  model.effects.clear();
  return model;
}

gap::Contribution<double> less(const gap::Contribution<double>& a, const gap::Contribution<double>& b) {
  return {.torque_nm = a.torque_nm - b.torque_nm,
          .force_n = a.force_n - b.force_n,
          .voltage_v = a.voltage_v - b.voltage_v,
          .speed_rad_s = a.speed_rad_s - b.speed_rad_s,
          .current_a = a.current_a - b.current_a,
          .feed_speed_m_s = a.feed_speed_m_s - b.feed_speed_m_s};
}

EffectTrace less(EffectTrace a, const EffectTrace& b) {
  for (std::size_t i = 0; i < a.added.size(); ++i) {
    a.added[i] = less(a.added[i], b.added[i]);
    a.shown[i] = less(a.shown[i], b.shown[i]);
  }
  return a;
}

class Increments {
 public:
  explicit Increments(const AxisDiagnosis& diagnosis)
      : fit_(diagnosis.fit),
        signals_(fit_.signals()),
        machine_(fit_.model().machine),
        step_s_(1.0 / signals_.rate_hz),
        known_(trace_effects(fit_.axis(), signals_, without_findings(fit_.model()))),
        found_(less(trace_effects(fit_.axis(), signals_, fit_.model()), known_)) {
    FrameSource frames(signals_, machine_, 0);
    frames_.reserve(signals_.rows);
    for (std::size_t i = 0; i < signals_.rows; ++i) frames_.push_back(frames.next());
  }

  std::vector<BalanceIncrements> of_spindle() {
    std::vector<BalanceIncrements> balances;
    const bool has_current = signals_.has(Channel::kArmatureCurrent);
    balances.push_back(
        all(gap::Balance::kSpindleTorque, 4, [&](std::size_t i) { return torque(i, has_current); }));
    if (has_current)
      balances.push_back(all(gap::Balance::kArmatureVoltage, 4, [&](std::size_t i) { return voltage(i); }));
    return balances;
  }
  std::vector<BalanceIncrements> of_feed() {
    if (signals_.has(Channel::kFeedSpeed))
      return {all(gap::Balance::kFeedForce, 5, [&](std::size_t i) { return force(i); })};
    return {all(gap::Balance::kFeedForce, 5, [&](std::size_t i) { return force_by_position(i); })};
  }

 private:
  template <class Make>
  BalanceIncrements all(gap::Balance balance, Eigen::Index width, Make make) const {
    BalanceIncrements increments{balance,
                                 Eigen::MatrixXf(static_cast<Eigen::Index>(signals_.rows), width + 1)};
    increments.columns.setConstant(kMissing);
    for (std::size_t i = 1; i + 1 < signals_.rows; ++i)
      increments.columns.row(static_cast<Eigen::Index>(i)) = make(i);
    return increments;
  }

  static Row row(std::initializer_list<double> values) {
    Row r(static_cast<Eigen::Index>(values.size()));
    Eigen::Index j = 0;
    for (const double value : values) r(j++) = static_cast<float>(value);
    return r;
  }
  static double or_missing(bool has, double value) { return has ? value : static_cast<double>(kMissing); }
  [[nodiscard]] double speed(std::size_t i) const {
    return or_missing(frames_[i].has_speed, frames_[i].speed_rad_s);
  }
  [[nodiscard]] double current(std::size_t i) const {
    return or_missing(frames_[i].has_current, frames_[i].current_a);
  }
  [[nodiscard]] double feed_speed(std::size_t i) const {
    return or_missing(frames_[i].has_feed_speed, frames_[i].feed_speed_m_s);
  }
  [[nodiscard]] double position(std::size_t i) const {
    return or_missing(frames_[i].has_feed_position, frames_[i].feed_position_m);
  }
  [[nodiscard]] double electrical(double at_start, double at_end) const {
    const double share =
        first_share(step_s_ * machine_.spindle.resistance_ohm / machine_.spindle.inductance_h);
    return step_s_ * (share * at_start + (1.0 - share) * at_end);
  }
  [[nodiscard]] double mean(double at_start, double at_end) const {
    return 0.5 * step_s_ * (at_start + at_end);
  }
  [[nodiscard]] double contact(std::size_t i) const {
    const auto& input = frames_[i].input;
    if (input.contact == 0.0) return 0.0;
    const auto torque = [&](double w) {
      return law_(w, input.chip_load_mm, input.tool_temperature_degc).torque_nm * input.contact;
    };
    return mean(torque(speed(i)), torque(speed(i + 1)));
  }

  // What effects add to the increment of each balance.
  [[nodiscard]] double on_torque(const EffectTrace& trace, std::size_t i, bool has_current) const {
    const auto& s = machine_.spindle;
    const auto& here = trace.shown[i];
    const auto& next = trace.shown[i + 1];
    const double shown_w = mean(here.speed_rad_s, next.speed_rad_s);
    const double shown_i = electrical(here.current_a, next.current_a);
    const double electric = has_current ? 0.0
                                        : step_s_ * trace.added[i].voltage_v * s.torque_constant_nm_a /
                                              (s.resistance_ohm * s.inertia_kgm2);
    return step_s_ * trace.added[i].torque_nm / s.inertia_kgm2 + next.speed_rad_s - here.speed_rad_s +
           s.viscous_friction_nms_rad / s.inertia_kgm2 * shown_w -
           s.torque_constant_nm_a / s.inertia_kgm2 * shown_i + electric;
  }
  [[nodiscard]] double on_voltage(const EffectTrace& trace, std::size_t i) const {
    const auto& s = machine_.spindle;
    const auto& here = trace.shown[i];
    const auto& next = trace.shown[i + 1];
    return step_s_ * trace.added[i].voltage_v / s.inductance_h + next.current_a - here.current_a +
           s.resistance_ohm / s.inductance_h * electrical(here.current_a, next.current_a) +
           s.back_emf_constant_vs_rad / s.inductance_h * mean(here.speed_rad_s, next.speed_rad_s);
  }
  [[nodiscard]] double on_force(const EffectTrace& trace, std::size_t i) const {
    const auto& f = machine_.feed;
    const auto& here = trace.shown[i];
    const auto& next = trace.shown[i + 1];
    return step_s_ * trace.added[i].force_n / f.mass_kg + next.feed_speed_m_s - here.feed_speed_m_s +
           f.viscous_friction_ns_m / f.mass_kg * mean(here.feed_speed_m_s, next.feed_speed_m_s);
  }
  // A machine whose file has no viscous friction has no such parameter: it is an effect there.
  [[nodiscard]] double if_viscous(double travel_m) const {
    return fit_.datasheet().machine.feed.viscous_friction_ns_m > 0.0 ? travel_m : 0.0 * travel_m;
  }
  [[nodiscard]] double on_position(const EffectTrace& trace, std::size_t i) const {
    return 0.5 * step_s_ * (trace.added[i - 1].force_n + trace.added[i].force_n) / machine_.feed.mass_kg;
  }

  [[nodiscard]] Row torque(std::size_t i, bool has_current) const {
    const double drive =
        has_current ? electrical(current(i), current(i + 1)) : step_s_ * frames_[i].input.armature_voltage_v;
    return row({drive, mean(speed(i), speed(i + 1)), contact(i), on_torque(found_, i, has_current),
                speed(i + 1) - speed(i) - on_torque(known_, i, has_current)});
  }
  [[nodiscard]] Row voltage(std::size_t i) const {
    return row({step_s_ * frames_[i].input.armature_voltage_v, electrical(current(i), current(i + 1)),
                mean(speed(i), speed(i + 1)), on_voltage(found_, i),
                current(i + 1) - current(i) - on_voltage(known_, i)});
  }
  [[nodiscard]] Row force(std::size_t i) const {
    const auto& input = frames_[i].input;
    return row({step_s_ * input.feed_force_n, step_s_ * input.contact * input.engagement,
                step_s_ * input.contact, if_viscous(mean(feed_speed(i), feed_speed(i + 1))),
                on_force(found_, i), feed_speed(i + 1) - feed_speed(i) - on_force(known_, i)});
  }
  // The increment of a speed that was not recorded: a second difference of the position, with the inputs of
  // both intervals that it spans.
  [[nodiscard]] Row force_by_position(std::size_t i) const {
    const auto& a = frames_[i - 1].input;
    const auto& b = frames_[i].input;
    const double half = 0.5 * step_s_;
    const double cut_a = a.contact;
    const double cut_b = b.contact;
    return row({half * (a.feed_force_n + b.feed_force_n),
                half * (cut_a * a.engagement + cut_b * b.engagement), half * (cut_a + cut_b),
                if_viscous(0.5 * (position(i + 1) - position(i - 1))), on_position(found_, i),
                (position(i + 1) - 2.0 * position(i) + position(i - 1)) / step_s_ - on_position(known_, i)});
  }

  const AxisFit& fit_;
  const RecordingSignals& signals_;
  const MachineParameters& machine_;
  double step_s_;
  EffectTrace known_;
  EffectTrace found_;
  ContactLaw<double> law_{machine_};
  std::vector<gap::GapFrame<double>> frames_;
};

}  // namespace

std::vector<BalanceIncrements> balance_increments(const AxisDiagnosis& diagnosis) {
  Increments increments(diagnosis);
  return diagnosis.fit.axis() == Axis::kSpindle ? increments.of_spindle() : increments.of_feed();
}

}  // namespace morepro::host
