#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "lib/frame/sensor_frame.hpp"
#include "sim_host/recording/mcap_record.hpp"
#include "sim_host/recording/recording_info.hpp"
#include "sim_host/recording/recording_time.hpp"
#include "sim_host/support/output_file.hpp"

namespace morepro::host {

/// Writes frames as MCAP, for Foxglove and PlotJuggler: JSON messages on one topic, in chunks with an index,
/// so that a reader can seek; metadata in a metadata record. Not compressed.
class McapWriter {
 public:
  /// `recorded`: bit_of(channel) of the columns. `start_us`: time of the first frame. The file is the
  /// caller's to commit, after finish().
  McapWriter(OutputFile& file, const Metadata& metadata, std::uint16_t recorded, std::int64_t start_us);

  /// Returns false, and writes nothing, where the frame's time is not after the one before. Throws UserError
  /// for a time below zero, which the format does not have.
  bool write(const SensorFrame& frame);
  /// Index and footer; without them readers look through the whole file.
  void finish();

 private:
  struct Place {
    std::uint64_t offset = 0;
    std::uint64_t size = 0;
  };

  /// One chunk, as the index at the end describes it.
  struct Chunk {
    std::uint64_t first_ns = 0;
    std::uint64_t last_ns = 0;
    Place chunk;
    Place message_index;
    std::uint64_t content_size = 0;
  };

  void append(std::string_view bytes);
  Place append_record(McapOp op, const McapBytes& content);
  void write_metadata(const Metadata& metadata);
  void flush_chunk();
  void write_message_index();
  void write_summary();
  [[nodiscard]] McapBytes statistics() const;
  [[nodiscard]] McapBytes chunk_indices() const;

  OutputFile& file_;
  IncreasingTime time_;
  std::uint64_t offset_ = 0;
  std::uint32_t crc_ = 0;  ///< of everything since the file or the summary began
  McapBytes schema_;       ///< record
  McapBytes channel_;      ///< record
  Place metadata_;
  McapBytes content_;        ///< messages of the open chunk
  McapBytes message_index_;  ///< the times and places of them
  Chunk open_;
  std::vector<Chunk> chunks_;
  std::uint64_t messages_ = 0;
};

}  // namespace morepro::host
