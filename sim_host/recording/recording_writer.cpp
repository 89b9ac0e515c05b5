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

NativeWriter open_native(OutputFile& file, Metadata metadata, std::int64_t start_us) {
  if (start_us != wrapped(start_us))
    metadata.emplace_back(kStartKey, fmt::format("{:.6f}", seconds(start_us)));
  return {file, metadata};
}

std::variant<CsvWriter, NativeWriter, MatWriter, McapWriter> opened_writer(OutputFile& file,
                                                                           const RecordingInfo& info) {
  Metadata metadata = without_start(info);
  switch (format_of(file.path())) {
    case RecordingFormat::kNative:
      return open_native(file, metadata, info.start_us);
    case RecordingFormat::kMat:
      return MatWriter(file, metadata, info.recorded, info.start_us);
    case RecordingFormat::kMcap:
      return McapWriter(file, metadata, info.recorded, info.start_us);
    default:
      return CsvWriter(file, metadata, info.recorded, info.start_us);
  }
}

}  // namespace

RecordingWriter::RecordingWriter(OutputFile& file, const RecordingInfo& info,
                                 const MonitorConfiguration& configuration)
    : writer_(opened_writer(file, info)) {
  if (auto* native = std::get_if<NativeWriter>(&writer_)) native->write(configuration);
}

bool RecordingWriter::write(const SensorFrame& frame) {
  if (auto* native = std::get_if<NativeWriter>(&writer_)) {
    native->write(frame);
    return true;
  }
  if (auto* csv = std::get_if<CsvWriter>(&writer_)) return csv->write(frame);
  if (auto* mat = std::get_if<MatWriter>(&writer_)) return mat->write(frame);
  return std::get<McapWriter>(writer_).write(frame);
}

void RecordingWriter::finish() {
  if (auto* native = std::get_if<NativeWriter>(&writer_)) native->finish();
  if (auto* mat = std::get_if<MatWriter>(&writer_)) mat->finish();
  if (auto* mcap = std::get_if<McapWriter>(&writer_)) mcap->finish();
}

}  // namespace morepro::host
