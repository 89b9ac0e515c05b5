#pragma once
#include "sim_host/diagnose/search/axis_diagnosis.hpp"
#include "sim_host/identify/identification.hpp"
#include "sim_host/machine/machine_description.hpp"
#include "sim_host/report/report_page.hpp"

namespace morepro::host {

/// The report of a recording that is in memory: `diagnose` and `identify`.
class SignalsReport {
 public:
  explicit SignalsReport(std::string_view command) : page_(command) {}

  void take_recording(const RecordingSignals& signals, const MachineDescription& machine);
  /// The models that a diagnosis has tried on one axis.
  void take(const AxisDiagnosis& diagnosis);
  /// The datasheet beside the values that were identified.
  void take(const RecordingSignals& signals, const MachineDescription& datasheet,
            const MachineDescription& identified);
  std::string html(std::string_view result, std::string_view command_line,
                   const std::vector<std::string>& files) {
    return page_.html(result, command_line, files);
  }

 private:
  std::size_t most_buckets_ = 0;
  ReportPage page_;
};

}  // namespace morepro::host
