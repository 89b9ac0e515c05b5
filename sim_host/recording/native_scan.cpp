#include "sim_host/recording/native_scan.hpp"

#include <fmt/format.h>

#include <cmath>
#include <variant>

#include "lib/wire/decoder.hpp"
#include "sim_host/recording/intact_frame.hpp"
#include "sim_host/recording/native_rate.hpp"
#include "sim_host/recording/recording_time.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

class Scanner {
 public:
  explicit Scanner(NativeScan& scan) : scan_(scan) {}

  void operator()(std::monostate) {}
  void operator()(const Health&) {}
  void operator()(const wire::Ready&) {}

  void operator()(const SensorFrame& frame) { take_frame(frame.sequence, frame.time_us, frame.present); }
  void take_frame(std::uint32_t sequence, std::uint32_t time_us, std::uint16_t present) {
    if (scan_.integrity.frames++ == 0) scan_.info.start_us = unwrapped(time_us, stated_start_us());
    scan_.info.recorded |= present;
    rate_.add(sequence, time_us);
  }

  void operator()(const MonitorConfiguration& configuration) {
    if (!scan_.configuration) scan_.configuration = configuration;
  }

  void operator()(const wire::End& end) {
    scan_.integrity.has_end = true;
    scan_.integrity.frames_written = end.frames;
  }

  void operator()(const wire::Text& text) {
    const std::string line(text.view());
    const auto colon = line.find(": ");
    if (colon != std::string::npos)
      scan_.info.metadata.emplace_back(line.substr(0, colon), line.substr(colon + 2));
  }

  [[nodiscard]] double rate_hz() const { return rate_.rate_hz(); }

 private:
  /// Without a statement the first frame's time is between 0 and 2^32 us.
  [[nodiscard]] std::int64_t stated_start_us() const {
    constexpr std::int64_t kMiddleUs = std::int64_t{1} << 31;
    const auto stated_s = scan_.info.metadata_number(kStartKey);
    return stated_s && std::fabs(*stated_s) < kLongestTimeS ? microseconds(*stated_s) : kMiddleUs;
  }

  NativeScan& scan_;
  NativeRate rate_;
};

/// Returns the number of records.
std::uint64_t scan_records(FileWindow& bytes, NativeScan& scan) {
  Scanner scanner(scan);
  wire::Decoder decoder;
  IntactFrame frame;
  std::uint64_t records = 0;
  std::uint64_t piece_offset = 0;  // where what the decoder is in the middle of began
  while (!bytes.ahead().empty()) {
    if (!decoder.is_inside_record()) {
      piece_offset = bytes.offset();
      if (frame.take(bytes.ahead(), FrameCheck::kCrc)) {
        scan.integrity.has_end = false;
        scanner.take_frame(frame.sequence(), frame.time_us(), frame.present());
        scan.integrity.cut_offset = bytes.offset();
        ++records;
        continue;
      }
    }
    const auto event = decoder.next(bytes.ahead());
    if (event == wire::DecodeEvent::kCorrupt && decoder.corrupt().total() == 1)
      scan.integrity.first_corrupt_offset = piece_offset;
    if (event != wire::DecodeEvent::kRecord) continue;
    scan.integrity.has_end = false;
    std::visit(scanner, decoder.record());
    scan.integrity.cut_offset = bytes.offset();
    ++records;
  }
  if (decoder.is_inside_record()) scan.integrity.has_end = false;
  scan.integrity.corrupt = decoder.corrupt();
  scan.info.rate_hz = scanner.rate_hz();
  return records;
}

void warn(NativeScan& scan) {
  const auto& found = scan.integrity;
  auto& warnings = scan.info.warnings;
  if (found.corrupt.total() > 0)
    warnings.push_back(fmt::format("{}: {} damaged record(s) were skipped, the first at byte {}",
                                   scan.info.file, found.corrupt.total(), found.first_corrupt_offset));
  if (!found.has_end)
    warnings.push_back(
        fmt::format("{}: the recording was cut behind byte {}; {} frames before it can be read",
                    scan.info.file, found.cut_offset, found.frames));
  else if (found.frames_written != static_cast<std::uint32_t>(found.frames))
    warnings.push_back(fmt::format("{}: {} frames were written, {} can be read", scan.info.file,
                                   found.frames_written, found.frames));
}

}  // namespace

NativeScan scan_native(const std::string& file, FileWindow& bytes) {
  NativeScan scan;
  scan.info.file = file;
  if (scan_records(bytes, scan) == 0)
    throw UserError(fmt::format(
        "{}: no native recording: {}; give a file that morepro wrote, or a CSV that ends in .csv", file,
        bytes.offset() == 0 ? "the file is empty" : "it holds no intact record from byte 0 on"));
  warn(scan);
  return scan;
}

}  // namespace morepro::host
