#include <fmt/format.h>
#include <zlib.h>

#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "sim_host/recording/columns_reader.hpp"
#include "sim_host/recording/mcap_cursor.hpp"
#include "sim_host/recording/mcap_frame_json.hpp"
#include "sim_host/support/input_file.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

std::uint32_t crc_of(std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

class McapLoader {
 public:
  McapLoader(const std::string& path, std::string_view whole) : whole_(whole) { recording_.info.file = path; }

  LoadedRecording load() {
    if (!whole_.starts_with(kMcapMagic))
      throw UserError(fmt::format("{}: no MCAP file; give a file that morepro convert wrote", file()));
    take_records(whole_.substr(kMcapMagic.size()));
    if (!channel_)
      throw UserError(fmt::format(
          "{}: there is no topic '{}'; only files that morepro convert wrote are read", file(), kMcapTopic));
    if (!is_at_end_ && rows() < kFewestRows)
      throw UserError(
          fmt::format("{}: the recording was cut before its first chunk was whole, so nothing of it can be "
                      "read; copy or convert it again",
                      file()));
    if (!is_at_end_)
      recording_.damage =
          fmt::format("{}: the recording was cut; {} frames before the cut can be read", file(), rows());
    return std::move(recording_);
  }

 private:
  [[nodiscard]] const std::string& file() const { return recording_.info.file; }
  [[nodiscard]] std::size_t rows() const { return recording_.columns.time_s.size(); }

  void take_records(std::string_view bytes) {
    McapCursor cursor(bytes);
    while (!is_at_end_ && cursor.has_record()) {
      const auto op = static_cast<McapOp>(cursor.get<std::uint8_t>());
      take_record(op, McapCursor(cursor.get_bytes(cursor.get<std::uint64_t>())));
    }
  }

  void take_record(McapOp op, McapCursor content) {
    switch (op) {
      case McapOp::kSchema:
        return take_schema(content);
      case McapOp::kChannel:
        return take_channel(content);
      case McapOp::kMessage:
        return take_message(content);
      case McapOp::kChunk:
        return take_chunk(content);
      case McapOp::kMetadata:
        return take_metadata(content);
      case McapOp::kDataEnd:
        return take_end(content);
      default:
        return;
    }
  }

  void take_schema(McapCursor content) {
    const auto id = content.get<std::uint16_t>();
    const std::string_view name = content.get_text();
    content.get_text();
    if (name == kMcapSchemaName) schemas_[id] = channels_of_schema(content.get_text());
  }

  void take_channel(McapCursor content) {
    const auto id = content.get<std::uint16_t>();
    const auto schema = schemas_.find(content.get<std::uint16_t>());
    const std::string_view topic = content.get_text();
    if (topic != kMcapTopic || schema == schemas_.end() || content.get_text() != "json") {
      recording_.info.warnings.push_back(fmt::format("{}: topic '{}' is not read", file(), topic));
      return;
    }
    channel_ = id;
    recording_.info.recorded = schema->second;
  }

  void take_metadata(McapCursor content) {
    if (content.get_text() != kMcapMetadataName) return;
    for (McapCursor map(content.get_text()); !map.is_empty();) {
      const std::string_view key = map.get_text();
      recording_.info.metadata.emplace_back(key, map.get_text());
    }
  }

  void take_chunk(McapCursor content) {
    content.get_bytes(3 * sizeof(std::uint64_t));
    const auto crc = content.get<std::uint32_t>();
    const std::string_view compression = content.get_text();
    if (!compression.empty())
      throw UserError(
          fmt::format("{}: compressed with {}; write it again without compression", file(), compression));
    const std::string_view records = content.get_bytes(content.get<std::uint64_t>());
    if (!content.is_intact() || (crc != 0 && crc != crc_of(records)))
      throw UserError(fmt::format(
          "{}: the chunk behind message {} is damaged; copy or convert the file again", file(), rows()));
    take_records(records);
  }

  /// The check sum of everything before; 0: the writer made none.
  void take_end(McapCursor content) {
    const auto size = static_cast<std::size_t>(content.rest().data() - whole_.data()) - kMcapRecordHead;
    const auto crc = content.get<std::uint32_t>();
    if (crc != 0 && crc != crc_of(whole_.substr(0, size)))
      throw UserError(fmt::format("{}: the file is damaged; copy or convert it again", file()));
    is_at_end_ = true;
  }

  void take_message(McapCursor content) {
    if (content.get<std::uint16_t>() != channel_) return;
    content.get<std::uint32_t>();
    const auto time_ns = content.get<std::uint64_t>();
    content.get<std::uint64_t>();
    SensorFrame frame;
    if (!read_frame_json(content.rest(), frame))
      throw UserError(fmt::format(
          "{}: message {} is no frame; only files that morepro convert wrote are read", file(), rows() + 1));
    recording_.columns.time_s.push_back(static_cast<double>(time_ns) / 1.0e9);
    for (std::size_t i = 0; i < kChannelCount; ++i) {
      const auto channel = static_cast<Channel>(i);
      if ((recording_.info.recorded & bit_of(channel)) == 0) continue;
      recording_.columns.value[i].push_back(frame.has(channel) ? frame.get(channel) : kMissing);
    }
  }

  static constexpr std::size_t kFewestRows = 2;
  static constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

  std::string_view whole_;
  LoadedRecording recording_;
  std::map<std::uint16_t, std::uint16_t> schemas_;  ///< id, recorded channels
  std::optional<std::uint16_t> channel_;
  bool is_at_end_ = false;
};

}  // namespace

LoadedRecording load_mcap(const std::string& path) {
  const InputFile file(path);
  return McapLoader(path, file.text()).load();
}

}  // namespace morepro::host
