#include "sim_host/recording/csv_writer.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <cstdlib>
#include <iterator>

namespace morepro::host {

CsvWriter::CsvWriter(OutputFile& file, const Metadata& metadata, std::uint16_t recorded,
                     std::int64_t start_us)
    : file_(file), recorded_(recorded), time_(start_us) {
  std::string head;
  for (const auto& [key, value] : metadata) head += fmt::format("# {}: {}\n", key, value);
  head += "time_s";
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    if (recorded & bit_of(static_cast<Channel>(i))) head += fmt::format(",{}", kChannels[i].column);
  }
  file_.write(head + "\n");
}

bool CsvWriter::write(const SensorFrame& frame) {
  if (!time_.advance(frame.time_us)) return false;
  fmt::memory_buffer line;
  const auto out = std::back_inserter(line);
  fmt::format_to(out, FMT_COMPILE("{}{}.{:06}"), time_.us() < 0 ? "-" : "", std::abs(time_.us()) / 1000000,
                 std::abs(time_.us()) % 1000000);
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
