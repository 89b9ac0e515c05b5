#pragma once
#include <array>
#include <cstddef>

#include "lib/frame/sensor_frame.hpp"
#include "lib/monitor/configuration_error.hpp"
#include "lib/monitor/health.hpp"
#include "lib/monitor/monitor_configuration.hpp"
#include "lib/monitor/reason.hpp"

namespace morepro {

/// Everything that runs at every sample, in fixed memory. kN: hypotheses that the bank can hold, 1..64.
template <std::size_t kN>
class Monitor {
 public:
  Monitor() { (void)configure(reference_configuration()); }

  /// Takes a configuration and forgets everything measured so far; on refusal the old one stays.
  [[nodiscard]] ConfigurationResult configure(const MonitorConfiguration& configuration) {
    configuration_ = configuration;
    reset();
    return {};
  }

  /// Forgets everything measured so far.
  void reset() { health_ = Health{}; }

  /// One frame in, one answer out. Bounded time; may run in an interrupt.
  const Health& step(const SensorFrame& frame) {
    health_.sequence = frame.sequence;
    health_.time_us = frame.time_us;
    ++health_.frames_accepted;
    return health_;
  }

  /// The link dropped something that was no frame.
  void count_corrupt() { ++health_.frames_rejected; }

  [[nodiscard]] const Health& health() const { return health_; }
  [[nodiscard]] const MonitorConfiguration& configuration() const { return configuration_; }
  [[nodiscard]] std::size_t hypothesis_count() const { return configuration_.grid.count; }
  [[nodiscard]] float hypothesis_mm(std::size_t index) const {
    return static_cast<float>(configuration_.grid.first_mm + static_cast<double>(index) * configuration_.grid.step_mm);
  }
  [[nodiscard]] float probability(std::size_t) const { return 0.0F; }

 private:
  MonitorConfiguration configuration_;
  Health health_;
};

/// The monitor of the board images and of the replay.
inline constexpr std::size_t kMonitorHypotheses = 11;
using BoardMonitor = Monitor<kMonitorHypotheses>;

}  // namespace morepro
