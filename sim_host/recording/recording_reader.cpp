#include "sim_host/recording/recording_reader.hpp"

#include <fmt/format.h>

#include "sim_host/recording/recording_format.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

using AnyReader = std::variant<CsvReader, NativeReader, ColumnsReader>;

AnyReader opened_reader(const std::string& path, const ColumnMapping& mapping) {
  const RecordingFormat format = format_of(path);
  if (format != RecordingFormat::kMat && !mapping.is_empty())
    throw UsageError(fmt::format("{}: --map and --rate are for .mat files; others have fixed names", path));
  switch (format) {
    case RecordingFormat::kNative:
      return AnyReader(std::in_place_type<NativeReader>, path);
    case RecordingFormat::kMat:
      return AnyReader(std::in_place_type<ColumnsReader>, load_mat(path, mapping));
    case RecordingFormat::kMcap:
      return AnyReader(std::in_place_type<ColumnsReader>, load_mcap(path));
    default:
      return AnyReader(std::in_place_type<CsvReader>, path);
  }
}

}  // namespace

RecordingReader::RecordingReader(const std::string& path, const ColumnMapping& mapping)
    : reader_(opened_reader(path, mapping)) {
  const auto* native = std::get_if<NativeReader>(&reader_);
  if (native != nullptr && native->integrity().frames == 0) {
    throw UserError(fmt::format("{}: the recording holds no frames; record again", path));
  }
}

hal::ReadStatus RecordingReader::next(SensorFrame& frame) {
  if (auto* csv = std::get_if<CsvReader>(&reader_)) {
    return csv->next(frame) ? hal::ReadStatus::kFrame : hal::ReadStatus::kEnd;
  }
  if (auto* columns = std::get_if<ColumnsReader>(&reader_)) {
    return columns->next(frame) ? hal::ReadStatus::kFrame : hal::ReadStatus::kEnd;
  }
  return next_native(std::get<NativeReader>(reader_), frame);
}

hal::ReadStatus RecordingReader::next_native(NativeReader& reader, SensorFrame& frame) {
  if (reader.integrity().corrupt.total() == 0)
    return reader.next(frame) ? hal::ReadStatus::kFrame : hal::ReadStatus::kEnd;
  if (!held_ && reader.damaged_so_far() == damage_reported_) {
    SensorFrame read;
    if (reader.next(read)) held_ = read;
  }
  if (reader.damaged_so_far() != damage_reported_) {
    ++damage_reported_;
    return hal::ReadStatus::kCorrupt;
  }
  if (!held_) return hal::ReadStatus::kEnd;
  frame = *held_;
  held_.reset();
  return hal::ReadStatus::kFrame;
}

const RecordingInfo& RecordingReader::info() const {
  return std::visit([](const auto& reader) -> const RecordingInfo& { return reader.info(); }, reader_);
}

const RecordingTally& RecordingReader::tally() const {
  return std::visit([](const auto& reader) -> const RecordingTally& { return reader.tally(); }, reader_);
}

std::optional<MonitorConfiguration> RecordingReader::configuration() const {
  const auto* native = std::get_if<NativeReader>(&reader_);
  return native == nullptr ? std::nullopt : native->configuration();
}

std::string RecordingReader::damage() const {
  if (const auto* columns = std::get_if<ColumnsReader>(&reader_)) return columns->damage();
  const auto* native = std::get_if<NativeReader>(&reader_);
  if (native == nullptr || native->integrity().is_complete()) return {};
  return fmt::format("{}", fmt::join(native->info().warnings, "; "));
}

std::uint64_t RecordingReader::frame_count() const {
  if (const auto* columns = std::get_if<ColumnsReader>(&reader_)) return columns->rows();
  const auto* native = std::get_if<NativeReader>(&reader_);
  return native == nullptr ? 0 : native->integrity().frames;
}

}  // namespace morepro::host
