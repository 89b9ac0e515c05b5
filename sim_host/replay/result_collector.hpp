#pragma once
#include "lib/monitor/monitor.hpp"
#include "sim_host/replay/replay_result.hpp"

namespace morepro::host {

/// Watches the monitor while a recording runs through it and keeps what the result needs.
class ResultCollector {
 public:
  /// `start_us`: time of the first frame, of which frames hold the lower 32 bits.
  explicit ResultCollector(std::int64_t start_us) : time_us_(start_us) {}

  /// After every frame: the frame as the board gave it, the monitor after it.
  void take(const SensorFrame& frame, const BoardMonitor& monitor);

  /// Adds what was collected to the result.
  void finish(const BoardMonitor& monitor, ReplayResult& result) const;

 private:
  void count_flags(std::uint16_t flags);
  void note_change(const Health& health);

  ReplayResult kept_;
  std::array<std::uint64_t, 16> flag_counts_{};
  std::int64_t time_us_;
  float commanded_mm_ = 0.0F;
};

}  // namespace morepro::host
