#include "sim_host/recording/recording_writer.hpp"

#include <fmt/format.h>

#include "sim_host/recording/recording_format.hpp"
#include "sim_host/recording/recording_time.hpp"

namespace morepro::host {
namespace {

Metadata without_start(const RecordingInfo& info) {
  Metadata metadata = info.metadata;
  std::erase_if(metadata, [](const auto& entry) { return entry.first == kStartKey; });
  return metadata;
}

std::variant<CsvWriter, NativeWriter> open(OutputFile& file, const RecordingInfo& info) {
  Metadata metadata = without_start(info);
  if (format_of(file.path()) == RecordingFormat::kCsv)
    return CsvWriter(file, metadata, info.recorded, info.start_us);
  if (info.start_us != wrapped(info.start_us))
    metadata.emplace_back(kStartKey, fmt::format("{:.6f}", seconds(info.start_us)));
  return NativeWriter(file, metadata);
}

}  // namespace

RecordingWriter::RecordingWriter(OutputFile& file, const RecordingInfo& info,
                                 const MonitorConfiguration& configuration)
    : writer_(open(file, info)) {
  if (auto* native = std::get_if<NativeWriter>(&writer_)) native->write(configuration);
}

bool RecordingWriter::write(const SensorFrame& frame) {
  if (auto* csv = std::get_if<CsvWriter>(&writer_)) return csv->write(frame);
  std::get<NativeWriter>(writer_).write(frame);
  return true;
}

void RecordingWriter::finish() {
  if (auto* native = std::get_if<NativeWriter>(&writer_)) native->finish();
}

}  // namespace morepro::host
