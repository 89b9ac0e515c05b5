#include "sim_host/simulate/disturbance.hpp"

#include <cmath>

namespace morepro::host {
namespace {

constexpr double kCorrelationS = 1.0e-3;

enum DisturbanceStream : std::uint64_t { kTorqueStream = 200, kForceStream = 201, kVoltageStream = 202 };

}  // namespace

Disturbance::Disturbance(const MonitorConfiguration& configuration, double fraction, double step_s,
                         std::uint64_t seed)
    : keep_(std::exp(-step_s / kCorrelationS)),
      renew_(std::sqrt(1.0 - keep_ * keep_)),
      torque_(mixed(seed, kTorqueStream)),
      force_(mixed(seed, kForceStream)),
      voltage_(mixed(seed, kVoltageStream)) {
  const auto rate = [&](Channel channel) {
    return fraction * std::sqrt(configuration.sensors[channel].variance()) / kCorrelationS;
  };
  scale_ = {rate(Channel::kSpindleSpeed), rate(Channel::kFeedSpeed), rate(Channel::kArmatureCurrent)};
  value_ = {scale_.acceleration_rad_s2 * torque_.next(), scale_.feed_acceleration_m_s2 * force_.next(),
            scale_.current_rate_a_s * voltage_.next()};
}

PlantDerivative<double> Disturbance::next() {
  const auto renewed = [this](double value, double scale, NormalNumbers& normal) {
    return keep_ * value + renew_ * scale * normal.next();
  };
  const PlantDerivative<double> value = value_;
  value_ = {renewed(value.acceleration_rad_s2, scale_.acceleration_rad_s2, torque_),
            renewed(value.feed_acceleration_m_s2, scale_.feed_acceleration_m_s2, force_),
            renewed(value.current_rate_a_s, scale_.current_rate_a_s, voltage_)};
  return value;
}

}  // namespace morepro::host
