#include "sim_host/thesis/identification_run.hpp"

#include <memory>

#include "lib/monitor/parameter_tracker.hpp"
#include "lib/plant/contact_law.hpp"
#include "sim_host/thesis/driven_machine.hpp"
#include "sim_host/thesis/printed_parameter_filter.hpp"

namespace morepro::host::thesis {
namespace {

constexpr std::uint64_t kFramesPerShown = 100;

// Of the printed filter, relative to the machine's true values; the thesis states neither.
constexpr double kStartFraction = 0.3;
constexpr double kWalkFraction = 1.0e-5;

std::uint64_t frames_of(const IdentificationSetting& setting) {
  return static_cast<std::uint64_t>(setting.duration_s / DrivenMachine::kPeriodS + 0.5);
}

template <class Value>
void keep(IdentificationTrace& trace, std::uint64_t frame, Value value) {
  if (frame % kFramesPerShown != 0) return;
  trace.time_s.push_back(static_cast<double>(frame) * DrivenMachine::kPeriodS);
  for (std::size_t j = 0; j < kParameterCount; ++j) trace.value[j].push_back(value(j));
}

MonitorConfiguration datasheet_of(const ParameterValues& start) {
  MonitorConfiguration c = thesis_configuration();
  auto& s = c.machine.spindle;
  s.torque_constant_nm_a = start[0];
  s.inertia_kgm2 = start[1];
  c.machine.feed.mass_kg = start[2];
  c.machine.feed.contact_force_n = start[3];
  s.inductance_h = start[4];
  s.resistance_ohm = start[5];
  s.back_emf_constant_vs_rad = start[6];
  return c;
}

SensorFrame frame_of(const PlantInput<double>& input) {
  SensorFrame frame;
  frame.set(Channel::kArmatureVoltage, static_cast<float>(input.armature_voltage_v));
  frame.set(Channel::kFeedForce, static_cast<float>(input.feed_force_n));
  frame.set(Channel::kContact, static_cast<float>(input.contact));
  frame.set(Channel::kToolTemperature, static_cast<float>(input.tool_temperature_degc));
  return frame;
}

DerivativeInput<float> derivative_input(const PlantState<double>& x, const PlantInput<double>& u,
                                        const ContactLaw<double>& law) {
  const double torque_nm = u.contact * law(x.speed_rad_s, u.chip_load_mm, u.tool_temperature_degc).torque_nm;
  return {.speed_rad_s = static_cast<float>(x.speed_rad_s),
          .feed_speed_m_s = static_cast<float>(x.feed_speed_m_s),
          .current_a = static_cast<float>(x.current_a),
          .armature_voltage_v = static_cast<float>(u.armature_voltage_v),
          .feed_force_n = static_cast<float>(u.feed_force_n),
          .contact = static_cast<float>(u.contact),
          .engagement = static_cast<float>(u.engagement),
          .contact_torque_nm = static_cast<float>(torque_nm)};
}

DerivativeMeasurement<float> measured(const PlantDerivative<double>& rate) {
  constexpr auto kSquare = [](double noise) { return static_cast<float>(noise * noise); };
  return {static_cast<float>(rate.acceleration_rad_s2),      static_cast<float>(rate.feed_acceleration_m_s2),
          static_cast<float>(rate.current_rate_a_s),         kSquare(DrivenMachine::kAccelerationNoiseRadS2),
          kSquare(DrivenMachine::kFeedAccelerationNoiseMS2), kSquare(DrivenMachine::kCurrentRateNoiseAS)};
}

}  // namespace

ParameterValues parameters_of(const MachineParameters& machine) { return Plant<double>(machine).theta(); }

SteadyState steady_state() {
  const DrivenMachine machine(Drive::kConstant, 1);
  return {machine.input().armature_voltage_v, machine.state().speed_rad_s, machine.state().current_a};
}

IdentificationTrace run_printed_filter(const IdentificationSetting& setting) {
  using Filter = PrintedParameterFilter;
  const MachineParameters machine = thesis_machine();
  const ParameterValues truth = parameters_of(machine);
  const Filter::Theta size = Eigen::Map<const Filter::Theta>(truth.data());
  const Filter::Covariance square = size.cwiseAbs2().asDiagonal();
  Filter filter(machine, Eigen::Map<const Filter::Theta>(setting.start.data()),
                square * (kStartFraction * kStartFraction), square * (kWalkFraction * kWalkFraction),
                Filter::Output(DrivenMachine::kAccelerationNoiseRadS2,
                               DrivenMachine::kFeedAccelerationNoiseMS2, DrivenMachine::kCurrentRateNoiseAS)
                    .cwiseAbs2());
  DrivenMachine driven(setting.drive, setting.seed);
  IdentificationTrace trace;
  for (std::uint64_t frame = 0; frame <= frames_of(setting); ++frame) {
    keep(trace, frame, [&](std::size_t j) { return filter.theta()(static_cast<int>(j)); });
    driven.step();
    const auto rate = driven.measured_derivative();
    filter.step(driven.measured_state(), driven.input(),
                {rate.acceleration_rad_s2, rate.feed_acceleration_m_s2, rate.current_rate_a_s});
  }
  return trace;
}

IdentificationTrace run_guarded_filter(const IdentificationSetting& setting) {
  const MonitorConfiguration c = datasheet_of(setting.start);
  const auto variance = [&](Channel channel) { return static_cast<float>(c.sensors[channel].variance()); };
  DerivativeIdentification<float> filter(
      c.machine,
      {variance(Channel::kSpindleSpeed), variance(Channel::kFeedSpeed), variance(Channel::kArmatureCurrent)},
      static_cast<float>(kStartFraction), static_cast<float>(kWalkFraction));
  const ContactLaw<double> law(c.machine);
  DrivenMachine driven(setting.drive, setting.seed);
  IdentificationTrace trace;
  for (std::uint64_t frame = 0; frame <= frames_of(setting); ++frame) {
    keep(trace, frame, [&](std::size_t j) {
      return static_cast<double>(filter.filter().value(static_cast<Parameter>(j)));
    });
    driven.step();
    const DerivativeMeasurement<float> rate = measured(driven.measured_derivative());
    filter.step(derivative_input(driven.measured_state(), driven.input(), law), rate);
  }
  for (std::size_t j = 0; j < kParameterCount; ++j) {
    trace.information[j] = filter.information(static_cast<Parameter>(j));
    trace.partner[j] = filter.partner(static_cast<Parameter>(j));
  }
  return trace;
}

IdentificationTrace run_library_filter(const IdentificationSetting& setting) {
  const MonitorConfiguration c = datasheet_of(setting.start);
  const auto tracker = std::make_unique<ParameterTracker>(c);
  const auto variance = [&](Channel channel) { return static_cast<float>(c.sensors[channel].variance()); };
  const float deviation = static_cast<float>(c.sensors[Channel::kFeedSpeed].noise);
  DrivenMachine driven(setting.drive, setting.seed);
  HeldInputs held(c.machine, c.sampling.rate_hz);
  IdentificationTrace trace;
  for (std::uint64_t frame = 0; frame <= frames_of(setting); ++frame) {
    keep(trace, frame, [&](std::size_t j) { return static_cast<double>(tracker->estimates()[j].value); });
    driven.step();
    const SensorFrame inputs = frame_of(driven.input());
    held.take({inputs, inputs.present});
    const PlantState<double> y = driven.measured_state();
    tracker->step_spindle(held,
                          {static_cast<float>(y.speed_rad_s), static_cast<float>(y.current_a),
                           variance(Channel::kSpindleSpeed), variance(Channel::kArmatureCurrent)},
                          true);
    tracker->step_feed(
        held, {static_cast<float>(y.feed_speed_m_s), 0.0F, variance(Channel::kFeedSpeed), kUnmeasured},
        deviation);
    tracker->refresh();
  }
  trace.last = tracker->estimates();
  return trace;
}

}  // namespace morepro::host::thesis
