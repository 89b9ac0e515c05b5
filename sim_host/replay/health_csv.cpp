#include "sim_host/replay/health_csv.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <iterator>

#include "lib/monitor/reason.hpp"
#include "sim_host/recording/recording_time.hpp"
#include "sim_host/replay/names.hpp"

namespace morepro::host {

HealthCsv::HealthCsv(OutputFile& file, const MonitorConfiguration& configuration, std::int64_t start_us)
    : file_(file),
      grid_(configuration.grid),
      has_probability_(configuration.rule != DecisionRule::kThesis),
      time_us_(start_us) {
  file_.write(std::string_view(
      "sequence,time_us,state,reason,frame_flags,rejected_channels,chip_load_mm,chip_load_standard_error_mm,"
      "hypothesis_mm,probability,spindle_speed_rad_s,feed_speed_m_s,armature_current_a,innovation_ratio\n"));
}

void HealthCsv::write(const Health& health) {
  time_us_ = unwrapped(health.time_us, time_us_);
  fmt::memory_buffer row;
  const auto out = std::back_inserter(row);
  fmt::format_to(out, FMT_COMPILE("{},{},{},{},{},{},"), health.sequence, time_us_, name_of(health.state),
                 text_of(static_cast<ReasonCode>(health.reason)).name, health.frame_flags,
                 health.rejected_channels);
  if (health.chip_load_state == ChipLoadState::kValid) {
    fmt::format_to(out, FMT_COMPILE("{},{},{:.6g},"), health.chip_load_mm, health.chip_load_standard_error_mm,
                   grid_.value_mm(health.selected_hypothesis));
    if (has_probability_) fmt::format_to(out, FMT_COMPILE("{}"), health.selected_probability);
    row.push_back(',');
  } else {
    fmt::format_to(out, FMT_COMPILE(",,,,"));
  }
  fmt::format_to(out, FMT_COMPILE("{},{},{},{}\n"), health.spindle_speed_rad_s, health.feed_speed_m_s,
                 health.armature_current_a, health.innovation_ratio);
  file_.write(std::string_view(row.data(), row.size()));
}

}  // namespace morepro::host
