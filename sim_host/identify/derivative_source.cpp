#include "sim_host/identify/derivative_source.hpp"

#include <cmath>

namespace morepro::host {
namespace {

Channel derivative_channel(DerivativeBalance balance) {
  return balance == DerivativeBalance::kForce ? Channel::kFeedAcceleration : Channel::kSpindleAcceleration;
}

}  // namespace

bool is_measured(DerivativeBalance balance, const RecordingSignals& signals) {
  return balance != DerivativeBalance::kVoltage && signals.has(derivative_channel(balance));
}

double mean_current_error(double period) { return std::pow(period, 6) / 30240.0; }

DerivativeSource::DerivativeSource(const RecordingSignals& signals, const MachineParameters& machine,
                                   DerivativeBalance balance)
    : signals_(signals),
      machine_(machine),
      balance_(balance),
      is_measured_(morepro::host::is_measured(balance, signals)),
      law_(machine),
      frames_(signals, machine, 0),
      after_(read()) {}

bool DerivativeSource::next() {
  if (row_ == signals_.rows) return false;
  ++row_;
  before_ = now_;
  now_ = after_;
  after_ = frames_.row() < signals_.rows ? read() : Instant{};
  return true;
}

bool DerivativeSource::is_complete(const gap::GapFrame<double>& frame) const {
  if (balance_ != DerivativeBalance::kForce) return frame.has_speed && frame.has_current;
  // Without friction a measured acceleration needs no speed.
  return frame.has_feed_speed || (is_measured_ && !(machine_.feed.viscous_friction_ns_m > 0.0));
}

double DerivativeSource::contact_torque(const Instant& inputs, double speed_rad_s) const {
  if (balance_ != DerivativeBalance::kTorque || !(inputs.input.contact > 0.0)) return 0.0;
  return inputs.input.contact *
         law_(speed_rad_s, inputs.chip_load_mm, inputs.tool_temperature_degc).torque_nm;
}

DerivativeSource::Instant DerivativeSource::read() {
  const std::size_t row = frames_.row();
  const gap::GapFrame<double> frame = frames_.next();
  const PlantInput<double>& in = frame.input;
  Instant instant;
  instant.input = {frame.speed_rad_s, frame.feed_speed_m_s, frame.current_a, in.armature_voltage_v,
                   in.feed_force_n,   in.contact,           in.engagement};
  instant.chip_load_mm = in.chip_load_mm;
  instant.tool_temperature_degc = in.tool_temperature_degc;
  instant.input.contact_torque_nm = contact_torque(instant, frame.speed_rad_s);
  instant.is_complete = is_complete(frame);
  if (is_measured_)
    instant.acceleration = static_cast<double>(signals_.value[index_of(derivative_channel(balance_))][row]);
  return instant;
}

std::optional<DerivativeSample> DerivativeSource::sample() const {
  if (!now_.is_complete) return std::nullopt;
  if (is_measured_)
    return std::isnan(now_.acceleration) ? std::nullopt
                                         : std::optional(DerivativeSample{now_.input, now_.acceleration});
  if (!after_.is_complete) return std::nullopt;
  return DerivativeSample{mean(), difference()};
}

std::optional<DerivativeInput<double>> DerivativeSource::before() const {
  return before_.is_complete ? std::optional(before_.input) : std::nullopt;
}

double DerivativeSource::difference() const {
  const auto& a = now_.input;
  const auto& b = after_.input;
  const double change = balance_ == DerivativeBalance::kTorque  ? b.speed_rad_s - a.speed_rad_s
                        : balance_ == DerivativeBalance::kForce ? b.feed_speed_m_s - a.feed_speed_m_s
                                                                : b.current_a - a.current_a;
  return change * signals_.rate_hz;
}

// Trapezoids with the derivatives at both ends (Euler and Maclaurin), of the current with the third ones too:
// where a period is as long as L/R the trapezoid alone is wrong by 8 % of what the inductance takes. Inputs
// are held, so they do not enter the differences.
DerivativeInput<double> DerivativeSource::mean() const {
  const auto& a = now_.input;
  const auto& b = after_.input;
  const auto& s = machine_.spindle;
  const double dw = b.speed_rad_s - a.speed_rad_s, di = b.current_a - a.current_a;
  const double twelfth = 1.0 / (12.0 * signals_.rate_hz);
  const double period = s.resistance_ohm / (s.inductance_h * signals_.rate_hz);  // in L/R
  DerivativeInput<double> mean = a;
  mean.speed_rad_s =
      0.5 * (a.speed_rad_s + b.speed_rad_s) +
      twelfth * (s.viscous_friction_nms_rad * dw - s.torque_constant_nm_a * di) / s.inertia_kgm2;
  mean.current_a = 0.5 * (a.current_a + b.current_a) +
                   twelfth * (1.0 - period * period / 60.0) *
                       (s.resistance_ohm * di + s.back_emf_constant_vs_rad * dw) / s.inductance_h;
  mean.contact_torque_nm = 0.5 * (a.contact_torque_nm + contact_torque(now_, b.speed_rad_s));
  mean.feed_speed_m_s = 0.5 * (a.feed_speed_m_s + b.feed_speed_m_s);
  return mean;
}

}  // namespace morepro::host
