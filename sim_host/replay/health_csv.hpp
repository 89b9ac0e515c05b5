#pragma once
#include <cstdint>

#include "lib/monitor/health.hpp"
#include "lib/monitor/monitor_configuration.hpp"
#include "sim_host/support/output_file.hpp"

namespace morepro::host {

/// The monitor's answer to every frame as CSV; an empty field where there is none. The file is the caller's
/// to commit.
class HealthCsv {
 public:
  /// `start_us`: time of the first frame, of which frames hold the lower 32 bits.
  HealthCsv(OutputFile& file, const MonitorConfiguration& configuration, std::int64_t start_us);
  void write(const Health& health);

 private:
  OutputFile& file_;
  HypothesisGrid grid_;
  bool has_probability_;
  std::int64_t time_us_;
};

}  // namespace morepro::host
