#pragma once
#include <array>

#include "sim_host/diagnose/signals/recording_signals.hpp"
#include "sim_host/machine/machine_description.hpp"
#include "sim_host/report/phase.hpp"
#include "sim_host/report/report_page.hpp"

namespace morepro::host {

/// The recording itself: its signals, the machine's phases, where rows are missing, how fast the spindle
/// turned.
class RecordingTrace {
 public:
  RecordingTrace(double row_s, const Sensors& sensors, std::size_t most_buckets);

  /// The frame of a row of the recording's grid; `row` increases. Gives what the machine was doing.
  Phase take(std::uint64_t row, const SensorFrame& frame);
  void take_all(const RecordingSignals& signals);
  /// `rows`: of the whole grid. `teeth`: of the tool; 0: unknown.
  void add_to(std::uint64_t rows, int teeth, ReportPage& page);

 private:
  void take_speed(double speed_rad_s, Phase phase);

  PhaseWatch watch_;
  SeriesTable table_;
  std::array<std::size_t, kChannelCount> columns_{};
  std::size_t phase_column_;
  std::size_t missing_column_;
  std::uint64_t next_row_ = 0;
  std::uint64_t missing_ = 0;
  std::uint16_t recorded_ = 0;
  /// Of the magnitude of the spindle speed in the air and in the cut: count, sum, sum of squares.
  std::array<std::array<double, 3>, 2> speed_{};
};

/// A spindle that stands this long between two cuts may have been given another tool.
inline constexpr double kToolChangeS = 2.0;

/// 0: the machine file describes no tool.
int teeth_of(const MachineDescription& machine);

/// Changes of a signal that holds whole numbers: [[first bucket, number], ...], null where there is none.
Json runs_of(const Pyramid& pyramid);

}  // namespace morepro::host
