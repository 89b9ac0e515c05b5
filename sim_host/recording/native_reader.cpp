#include "sim_host/recording/native_reader.hpp"

#include <variant>

#include "sim_host/recording/recording_time.hpp"

namespace morepro::host {

NativeReader::NativeReader(const std::string& path) : bytes_(path), scan_(scan_native(path, bytes_)) {
  bytes_.rewind();
}

bool NativeReader::next(SensorFrame& frame) {
  // The scan has looked at the same bytes: where it found nothing damaged there is nothing.
  const FrameCheck check = scan_.integrity.corrupt.total() == 0 ? FrameCheck::kDone : FrameCheck::kCrc;
  while (!bytes_.ahead().empty()) {
    if (!decoder_.is_inside_record() && record_.take(bytes_.ahead(), check)) {
      record_.read(frame);
      count(frame);
      return true;
    }
    if (decoder_.next(bytes_.ahead()) != wire::DecodeEvent::kRecord) continue;
    if (const auto* read = std::get_if<SensorFrame>(&decoder_.record())) {
      frame = *read;
      count(frame);
      return true;
    }
  }
  return false;
}

void NativeReader::count(const SensorFrame& frame) {
  const auto frames = static_cast<std::int32_t>(frame.sequence - previous_sequence_);
  const auto step_us = static_cast<std::int32_t>(frame.time_us - previous_time_us_);
  if (tally_.rows++ > 0) {
    if (frames > 1) {
      tally_.missing_rows += static_cast<std::uint64_t>(frames) - 1;
      if (tally_.gaps++ == 0) tally_.first_gap_s = seconds(scan_.info.start_us) + tally_.duration_s;
    }
    if (step_us > 0) elapsed_us_ += static_cast<std::uint64_t>(step_us);
    tally_.duration_s = 1.0e-6 * static_cast<double>(elapsed_us_);
  }
  previous_sequence_ = frame.sequence;
  previous_time_us_ = frame.time_us;
}

}  // namespace morepro::host
