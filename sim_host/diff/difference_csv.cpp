#include <fmt/compile.h>
#include <fmt/format.h>

#include <iterator>

#include "sim_host/diff/diff_output.hpp"

namespace morepro::host {

DifferenceCsv::DifferenceCsv(OutputFile& file, const RecordingInfo& a, const RecordingInfo& b)
    : file_(file), recorded_(a.recorded & b.recorded) {
  std::string head = fmt::format("# difference: B minus A\n# a: {}\n# b: {}\ntime_s", a.file, b.file);
  for (std::size_t i = 0; i < kChannelCount; ++i)
    if (recorded_ & bit_of(static_cast<Channel>(i))) head += fmt::format(",{}", kChannels[i].column);
  file_.write(head + "\n");
}

void DifferenceCsv::write(const AlignedRow& row) {
  if (!row.a || !row.b) return;
  fmt::memory_buffer line;
  const auto out = std::back_inserter(line);
  fmt::format_to(out, FMT_COMPILE("{:.6f}"), seconds(row.time_us()));
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    const auto channel = static_cast<Channel>(i);
    if ((recorded_ & bit_of(channel)) == 0) continue;
    line.push_back(',');
    const auto a = sample_of(row.a, channel), b = sample_of(row.b, channel);
    if (a && b) fmt::format_to(out, FMT_COMPILE("{}"), *a == *b ? 0.0 : *b - *a);
  }
  line.push_back('\n');
  file_.write(std::string_view(line.data(), line.size()));
}

}  // namespace morepro::host
