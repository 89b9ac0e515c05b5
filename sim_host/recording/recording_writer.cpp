#include "sim_host/recording/recording_writer.hpp"

#include "sim_host/recording/recording_format.hpp"

namespace morepro::host {
namespace {

std::variant<CsvWriter, NativeWriter> open(OutputFile& file, const Metadata& metadata,
                                           std::uint16_t recorded) {
  if (format_of(file.path()) == RecordingFormat::kCsv) return CsvWriter(file, metadata, recorded);
  return NativeWriter(file, metadata);
}

}  // namespace

RecordingWriter::RecordingWriter(OutputFile& file, const Metadata& metadata, std::uint16_t recorded,
                                 const MonitorConfiguration& configuration)
    : writer_(open(file, metadata, recorded)) {
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
