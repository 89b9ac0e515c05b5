#include "sim_host/recording/csv_writer.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <iterator>

namespace morepro::host {

CsvWriter::CsvWriter(OutputFile& file, const Metadata& metadata, std::uint16_t recorded)
    : file_(file), recorded_(recorded) {
  std::string head;
  for (const auto& [key, value] : metadata) head += fmt::format("# {}: {}\n", key, value);
  head += "time_s";
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    if (recorded & bit_of(static_cast<Channel>(i))) head += fmt::format(",{}", kChannels[i].column);
  }
  file_.write(head + "\n");
}

bool CsvWriter::write(const SensorFrame& frame) {
  const auto step_us = static_cast<std::int32_t>(frame.time_us - previous_us_);
  if (!is_first_ && step_us <= 0) return false;
  time_us_ = is_first_ ? std::int64_t{frame.time_us} : time_us_ + step_us;
  previous_us_ = frame.time_us;
  is_first_ = false;
  fmt::memory_buffer line;
  const auto out = std::back_inserter(line);
  fmt::format_to(out, FMT_COMPILE("{}.{:06}"), time_us_ / 1000000, time_us_ % 1000000);
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    const auto channel = static_cast<Channel>(i);
    if (!(recorded_ & bit_of(channel))) continue;
    line.push_back(',');
    if (frame.has(channel)) fmt::format_to(out, FMT_COMPILE("{}"), frame.get(channel));
  }
  line.push_back('\n');
  file_.write(std::string_view(line.data(), line.size()));
  return true;
}

}  // namespace morepro::host
