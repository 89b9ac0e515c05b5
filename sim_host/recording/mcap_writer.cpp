#include "sim_host/recording/mcap_writer.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <string>

#include "sim_host/recording/mcap_frame_json.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

constexpr std::uint16_t kSchemaId = 1;
constexpr std::uint16_t kChannelId = 1;
constexpr std::size_t kChunkBytes = std::size_t{1} << 20;
constexpr std::uint64_t kNsPerUs = 1000;

std::uint32_t continued_crc(std::uint32_t crc, std::string_view bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(crc, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

/// The first of each key: a map must not hold one twice.
McapBytes map_of(const Metadata& metadata) {
  McapBytes map;
  for (auto entry = metadata.begin(); entry != metadata.end(); ++entry) {
    const auto is_same = [&](const auto& other) { return other.first == entry->first; };
    if (std::none_of(metadata.begin(), entry, is_same)) map.put_text(entry->first).put_text(entry->second);
  }
  return map;
}

}  // namespace

McapWriter::McapWriter(OutputFile& file, const Metadata& metadata, std::uint16_t recorded,
                       std::int64_t start_us)
    : file_(file), time_(start_us) {
  McapBytes content;
  content.put(kSchemaId).put_text(kMcapSchemaName).put_text("jsonschema").put_text(mcap_schema(recorded));
  schema_.put_record(McapOp::kSchema, content.view());
  content.clear();
  content.put(kChannelId).put(kSchemaId).put_text(kMcapTopic).put_text("json").put_text({});
  channel_.put_record(McapOp::kChannel, content.view());
  append(kMcapMagic);
  append_record(McapOp::kHeader, McapBytes().put_text({}).put_text("morepro"));
  write_metadata(metadata);
  append(schema_.view());
  append(channel_.view());
}

void McapWriter::append(std::string_view bytes) {
  file_.write(bytes);
  crc_ = continued_crc(crc_, bytes);
  offset_ += bytes.size();
}

McapWriter::Place McapWriter::append_record(McapOp op, const McapBytes& content) {
  const std::uint64_t offset = offset_;
  append(McapBytes().put_record(op, content.view()).view());
  return {offset, offset_ - offset};
}

void McapWriter::write_metadata(const Metadata& metadata) {
  McapBytes content;
  content.put_text(kMcapMetadataName).put_text(map_of(metadata).view());
  metadata_ = append_record(McapOp::kMetadata, content);
}

bool McapWriter::write(const SensorFrame& frame) {
  if (!time_.advance(frame.time_us)) return false;
  if (time_.us() < 0)
    throw UserError(
        fmt::format("{}: the recording has the time {} s, MCAP has none below zero; choose .csv or .mat",
                    file_.path(), seconds(time_.us())));
  const std::uint64_t time_ns = static_cast<std::uint64_t>(time_.us()) * kNsPerUs;
  if (content_.size() == 0) open_.first_ns = time_ns;
  open_.last_ns = time_ns;
  message_index_.put(time_ns).put(content_.size());
  std::string json;
  append_frame_json(frame, json);
  McapBytes message;
  message.put(kChannelId).put(frame.sequence).put(time_ns).put(time_ns).append(json);
  content_.put_record(McapOp::kMessage, message.view());
  ++messages_;
  if (content_.size() >= kChunkBytes) flush_chunk();
  return true;
}

void McapWriter::flush_chunk() {
  if (content_.size() == 0) return;
  open_.content_size = content_.size();
  McapBytes chunk;
  chunk.put(open_.first_ns).put(open_.last_ns).put(content_.size());
  chunk.put(continued_crc(0, content_.view())).put_text({}).put(content_.size()).append(content_.view());
  open_.chunk = append_record(McapOp::kChunk, chunk);
  open_.message_index =
      append_record(McapOp::kMessageIndex, McapBytes().put(kChannelId).put_text(message_index_.view()));
  chunks_.push_back(open_);
  content_.clear();
  message_index_.clear();
}

McapBytes McapWriter::statistics() const {
  constexpr std::uint32_t kOne = 1;
  McapBytes content;
  content.put(messages_).put(std::uint16_t{1}).put(kOne).put(std::uint32_t{0}).put(kOne);
  content.put(static_cast<std::uint32_t>(chunks_.size()));
  content.put(chunks_.empty() ? std::uint64_t{0} : chunks_.front().first_ns);
  content.put(chunks_.empty() ? std::uint64_t{0} : chunks_.back().last_ns);
  content.put_text(McapBytes().put(kChannelId).put(messages_).view());
  return McapBytes().put_record(McapOp::kStatistics, content.view());
}

McapBytes McapWriter::chunk_indices() const {
  McapBytes records;
  for (const Chunk& chunk : chunks_) {
    McapBytes content;
    content.put(chunk.first_ns).put(chunk.last_ns).put(chunk.chunk.offset).put(chunk.chunk.size);
    content.put_text(McapBytes().put(kChannelId).put(chunk.message_index.offset).view());
    content.put(chunk.message_index.size).put_text({}).put(chunk.content_size).put(chunk.content_size);
    records.put_record(McapOp::kChunkIndex, content.view());
  }
  return records;
}

void McapWriter::write_summary() {
  McapBytes metadata_index;
  metadata_index.put(metadata_.offset).put(metadata_.size).put_text(kMcapMetadataName);
  const std::uint64_t summary = offset_;
  crc_ = 0;
  McapBytes offsets;
  const auto append_group = [&](McapOp op, const McapBytes& records) {
    const McapBytes entry = McapBytes().put(static_cast<std::uint8_t>(op)).put(offset_).put(records.size());
    if (records.size() > 0) offsets.put_record(McapOp::kSummaryOffset, entry.view());
    append(records.view());
  };
  append_group(McapOp::kSchema, schema_);
  append_group(McapOp::kChannel, channel_);
  append_group(McapOp::kStatistics, statistics());
  append_group(McapOp::kMetadataIndex, McapBytes().put_record(McapOp::kMetadataIndex, metadata_index.view()));
  append_group(McapOp::kChunkIndex, chunk_indices());
  const std::uint64_t summary_offsets = offset_;
  append(offsets.view());
  constexpr std::uint64_t kFooterSize = 8 + 8 + 4;
  append(McapBytes().put(static_cast<std::uint8_t>(McapOp::kFooter)).put(kFooterSize).view());
  append(McapBytes().put(summary).put(summary_offsets).view());
  append(McapBytes().put(crc_).view());
}

void McapWriter::finish() {
  flush_chunk();
  append_record(McapOp::kDataEnd, McapBytes().put(crc_));
  write_summary();
  append(kMcapMagic);
}

}  // namespace morepro::host
