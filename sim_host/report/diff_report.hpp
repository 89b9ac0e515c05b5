#pragma once
#include <array>
#include <string>
#include <vector>

#include "sim_host/diff/aligned_frames.hpp"
#include "sim_host/diff/diff_result.hpp"
#include "sim_host/diff/tolerances.hpp"
#include "sim_host/report/phase.hpp"
#include "sim_host/report/report_page.hpp"

namespace morepro::host {

/// The report of a comparison: of recordings every signal of both, collected row by row while they are
/// compared, and below it the difference with what is allowed; of results the table alone.
class DiffReport {
 public:
  /// Throws UserError where this program was built without pages.
  DiffReport() : page_("diff", k_diff_page) {}

  /// Before the rows of two recordings.
  void begin(const RecordingInfo& a, const RecordingInfo& b, const Tolerances& tolerances);
  /// In the order of time, rows that only one side has included.
  void take(const AlignedRow& row);
  /// `result`: the text that --json writes.
  std::string html(const DiffResult& compared, std::string_view result, std::string_view command_line,
                   const std::vector<std::string>& files);

 private:
  struct Columns {
    std::size_t a, b, difference, allowed;
  };
  struct Flags {
    std::size_t phase, out, only_in_a, only_in_b;
  };
  /// False where the signal is out of tolerance, or missing on one side.
  bool take_signal(std::size_t channel, const AlignedRow& row);
  void add_strips();
  void add_charts(const SignalDiff& signal);

  ReportPage page_;
  SeriesTable table_{1.0, 2};
  std::array<Columns, kChannelCount> columns_{};
  std::array<Tolerance, kChannelCount> tolerance_{};
  Flags flags_{};
  std::uint16_t in_a_ = 0;
  std::uint16_t in_b_ = 0;
  double rate_hz_ = 0.0;
  std::int64_t start_us_ = 0;
  std::uint64_t rows_ = 0;
  PhaseWatch phase_{reference_sensors()};  ///< a comparison knows no machine
};

}  // namespace morepro::host
