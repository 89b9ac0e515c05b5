#pragma once
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>

#include "sim_host/diagnose/signals/recording_signals.hpp"
#include "tests/support/spindle_simulation.hpp"

namespace morepro::test {

/// What a machine that is driven in different ways records, 2 s at 10 kHz.
class Recorder {
 public:
  Recorder(const MonitorConfiguration& configuration, std::uint64_t seed)
      : configuration_(configuration), machine_(configuration, seed) {
    signals_.rate_hz = configuration.sampling.rate_hz;
    machine_.input = {.armature_voltage_v = 48.0,
                      .feed_force_n = 26.0,
                      .contact = 0.0,
                      .engagement = 1.0,
                      .chip_load_mm = configuration.machine.tool.chip_load_mm,
                      .tool_temperature_degc = 500.0};
  }

  /// Voltage with a 1 ms and a 20 ms random part, feed force with a 30 ms one, contact on and off every 100
  /// ms.
  host::RecordingSignals excited() {
    double fast = 6.0, slow = 6.0, force = 4.0;
    const auto sign = [&] { return (machine_.random()() & 1U) != 0 ? 1.0 : -1.0; };
    for (std::size_t k = 0; k < kRows; ++k) {
      if (k % 10 == 0) fast = 6.0 * sign();
      if (k % 200 == 0) slow = 6.0 * sign();
      if (k % 300 == 0) force = 4.0 * sign();
      machine_.input.armature_voltage_v = 48.0 + fast + slow;
      machine_.input.feed_force_n = 26.0 + force;
      machine_.input.contact = static_cast<double>((k / 1000) % 2);
      take();
    }
    return std::move(signals_);
  }

  /// Voltage and force with their random parts, never in contact.
  host::RecordingSignals excited_in_the_air() {
    for (std::size_t k = 0; k < kRows; ++k) {
      const auto sign = [&] { return (machine_.random()() & 1U) != 0 ? 6.0 : -6.0; };
      if (k % 10 == 0) machine_.input.armature_voltage_v = 48.0 + sign();
      if (k % 300 == 0) machine_.input.feed_force_n = 26.0 + sign();
      take();
    }
    return std::move(signals_);
  }

  /// One start from rest, contact once.
  host::RecordingSignals started() {
    for (std::size_t k = 0; k < kRows; ++k) {
      machine_.input.contact = k > kRows / 2 ? 1.0 : 0.0;
      take();
    }
    return std::move(signals_);
  }

  /// Sines on voltage and force, contact for half of every second.
  host::RecordingSignals swinging() {
    for (std::size_t k = 0; k < 2 * kRows; ++k) {
      const double turn = 2.0 * M_PI * 1.0e-4 * static_cast<double>(k);
      machine_.input.armature_voltage_v = 48.0 + 6.0 * std::sin(3.0 * turn);
      machine_.input.feed_force_n = 26.0 + 4.0 * std::sin(2.0 * turn);
      machine_.input.contact = k % 10000 > 5000 ? 1.0 : 0.0;
      take();
    }
    return std::move(signals_);
  }

  /// The thesis's own excitation: the steady cut; or the same in the air.
  host::RecordingSignals steady(double contact = 1.0) {
    machine_.input.contact = contact;
    for (std::size_t k = 0; k < kRows; ++k) machine_.step();
    for (std::size_t k = 0; k < kRows; ++k) take();
    return std::move(signals_);
  }

 private:
  static constexpr std::size_t kRows = 20000;

  void put(Channel channel, double value) {
    signals_.value[index_of(channel)].push_back(static_cast<float>(value));
    signals_.recorded = static_cast<std::uint16_t>(signals_.recorded | bit_of(channel));
  }

  void take() {
    const auto y = machine_.measure();
    const auto& u = machine_.input;
    put(Channel::kArmatureVoltage, u.armature_voltage_v);
    put(Channel::kFeedForce, u.feed_force_n);
    put(Channel::kContact, u.contact);
    put(Channel::kToolTemperature, u.tool_temperature_degc);
    put(Channel::kSpindleSpeed, static_cast<double>(y.speed_rad_s));
    put(Channel::kArmatureCurrent, static_cast<double>(y.current_a));
    put(Channel::kFeedSpeed,
        machine_.state().feed_speed_m_s +
            configuration_.sensors[Channel::kFeedSpeed].noise * normal_(machine_.random()));
    machine_.step();
    ++signals_.rows;
  }

  MonitorConfiguration configuration_;
  SpindleSimulation machine_;
  std::normal_distribution<double> normal_;
  host::RecordingSignals signals_;
};

}  // namespace morepro::test
