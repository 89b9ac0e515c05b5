#pragma once
#include <array>
#include <vector>

#include "lib/monitor/monitor.hpp"
#include "sim_host/recording/recording_reader.hpp"
#include "sim_host/replay/replay_result.hpp"
#include "sim_host/report/live_model.hpp"
#include "sim_host/report/model_trace.hpp"
#include "sim_host/report/recording_trace.hpp"
#include "sim_host/report/wear_trend.hpp"

namespace morepro::host {

/// The report of a replay, collected while the recording runs through the monitor; the recording may be
/// longer than memory.
class ReplayReport {
 public:
  /// `recording` is read by the replay; it knows the time of the last frame, however long the one before is
  /// ago.
  ReplayReport(const RecordingReader& recording, const MachineDescription& machine);

  /// After every frame: the frame as the board gave it, the monitor after it.
  void take(const SensorFrame& frame, const BoardMonitor& monitor);
  /// After the last one. The page then lacks its result and its origin.
  ReportPage& finish(const ReplayResult& result);

 private:
  struct MonitorColumns {
    std::size_t chip_load, error, commanded, wear, wear_error, ratio, state, gated;
  };
  void take_monitor(const SensorFrame& frame, const BoardMonitor& monitor);
  void take_wear(double ratio);
  /// After a stop that is long enough for it the tool may be another one.
  void note_stop(Phase phase);
  void add_wear_charts(const WearLimits& limits);
  void note_change(const Health& health);
  void add_monitor_charts(const ReplayResult& result);

  const RecordingReader& reader_;
  ReportPage page_;
  double rate_hz_;
  int teeth_;
  std::uint64_t rows_ = 0;
  RecordingTrace recording_;
  LiveModel model_;
  std::array<ModelTrace, 2> traces_;
  SeriesTable monitor_;
  MonitorColumns columns_{};
  double commanded_mm_ = 0.0;
  HealthState state_ = HealthState::kNotEnoughData;
  std::uint16_t reason_ = 0;
  std::uint64_t changes_ = 0;
  WearTrend wear_;
  std::uint64_t stopped_rows_ = 0;
  bool may_be_another_tool_ = false;
  Json events_ = Json::array();
  std::vector<std::size_t> probability_;
};

}  // namespace morepro::host
