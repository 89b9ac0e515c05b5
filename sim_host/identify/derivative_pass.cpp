#include "sim_host/identify/derivative_pass.hpp"

#include "lib/identification/derivative_identification.hpp"
#include "lib/plant/contact_law.hpp"

namespace morepro::host {
namespace {

using Filter = DerivativeIdentification<double>;

class Pass {
 public:
  Pass(const RecordingSignals& signals, const MonitorConfiguration& c)
      : signals_(signals),
        configuration_(c),
        law_(c.machine),
        acceleration_variance_(c.sensors[Channel::kSpindleAcceleration].variance()),
        feed_acceleration_variance_(c.sensors[Channel::kFeedAcceleration].variance()),
        filter_(c.machine,
                {c.sensors[Channel::kSpindleSpeed].variance(), c.sensors[Channel::kFeedSpeed].variance(),
                 c.sensors[Channel::kArmatureCurrent].variance()},
                kDatasheetFraction, 0.0) {}

  const DerivativeParameterFilter<double>& run() {
    FrameSource source(signals_, configuration_.machine, 0);
    for (std::size_t row = 0; row < signals_.rows; ++row) step(source.next(), row);
    return filter_.filter();
  }

 private:
  /// NaN where there is no sample.
  double sample(Channel channel, std::size_t row) const {
    const auto& column = signals_.value[index_of(channel)];
    return column.empty() ? std::nan("") : static_cast<double>(column[row]);
  }

  void step(const gap::GapFrame<double>& frame, std::size_t row) {
    const auto& in = frame.input;
    DerivativeInput<double> u{frame.speed_rad_s, frame.feed_speed_m_s, frame.current_a, in.armature_voltage_v,
                              in.feed_force_n,   in.contact,           in.engagement};
    if (in.contact > 0.0)
      u.contact_torque_nm =
          in.contact * law_(frame.speed_rad_s, in.chip_load_mm, in.tool_temperature_degc).torque_nm;
    DerivativeMeasurement<double> y{0.0, 0.0, 0.0, kNone, kNone, kNone};
    const double acceleration = sample(Channel::kSpindleAcceleration, row);
    const double feed_acceleration = sample(Channel::kFeedAcceleration, row);
    if (frame.has_speed && frame.has_current && !std::isnan(acceleration)) {
      y.acceleration_rad_s2 = acceleration;
      y.acceleration_variance = acceleration_variance_;
    }
    const bool needs_speed = configuration_.machine.feed.viscous_friction_ns_m > 0.0;
    if ((frame.has_feed_speed || !needs_speed) && !std::isnan(feed_acceleration)) {
      y.feed_acceleration_m_s2 = feed_acceleration;
      y.feed_acceleration_variance = feed_acceleration_variance_;
    }
    filter_.step(u, y);
  }

  static constexpr auto kNone = static_cast<double>(kUnmeasured);

  const RecordingSignals& signals_;
  const MonitorConfiguration& configuration_;
  ContactLaw<double> law_;
  double acceleration_variance_;
  double feed_acceleration_variance_;
  Filter filter_;
};

AxisEstimate estimate_of(const DerivativeParameterFilter<double>& filter,
                         const std::vector<Parameter>& parameters) {
  AxisEstimate estimate;
  const auto count = static_cast<Eigen::Index>(parameters.size());
  estimate.covariance.resize(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Parameter a = parameters[static_cast<std::size_t>(i)];
    estimate.names.push_back(value_of(a));
    estimate.value.push_back(filter.value(a));
    for (Eigen::Index j = 0; j < count; ++j)
      estimate.covariance(i, j) = filter.covariance(a, parameters[static_cast<std::size_t>(j)]);
  }
  return estimate;
}

/// The machine with the values that a first pass found.
MonitorConfiguration moved(const MonitorConfiguration& c, const DerivativeParameterFilter<double>& filter) {
  MonitorConfiguration next = c;
  next.machine.spindle.torque_constant_nm_a = filter.value(Parameter::kTorqueConstant);
  next.machine.spindle.inertia_kgm2 = filter.value(Parameter::kInertia);
  next.machine.feed.mass_kg = filter.value(Parameter::kMass);
  next.machine.feed.contact_force_n = filter.value(Parameter::kContactForce);
  return next;
}

}  // namespace

std::vector<AxisEstimate> derivative_pass(const RecordingSignals& signals,
                                          const MonitorConfiguration& configuration) {
  Pass first(signals, configuration);
  const MonitorConfiguration next = moved(configuration, first.run());
  Pass second(signals, next);
  const auto& filter = second.run();
  return {estimate_of(filter, {Parameter::kTorqueConstant, Parameter::kInertia}),
          estimate_of(filter, {Parameter::kMass, Parameter::kContactForce})};
}

}  // namespace morepro::host
