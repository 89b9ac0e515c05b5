#pragma once
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <variant>

#include "lib/wire/cobs.hpp"
#include "lib/wire/record.hpp"
#include "lib/wire/record_codec.hpp"

namespace morepro::wire {

enum class DecodeEvent : std::uint8_t {
  kNothing = 0,  ///< no record has ended
  kRecord = 1,   ///< record() is new
  kCorrupt = 2,  ///< something ended that is no record; it was counted
};

/// Turns the link's bytes into records, in fixed memory (about two times the largest record). It trusts
/// nothing: every byte is allowed to be anything. After garbage, the record behind the next delimiter is read
/// again.
class Decoder {
 public:
  /// Takes one byte. Bounded time; may run in an interrupt.
  DecodeEvent push(std::uint8_t byte) {
    if (byte != kDelimiter) {
      stream_.push(byte);
      return DecodeEvent::kNothing;
    }
    return stream_.is_empty() ? DecodeEvent::kNothing : accept(stream_.finish());
  }

  /// Takes bytes from the front of `bytes` up to the end of the first record, good or corrupt, and leaves the
  /// rest; kNothing: all were taken. The same answers as push(), faster where whole records lie in `bytes`.
  DecodeEvent next(std::span<const std::uint8_t>& bytes) {
    DecodeEvent event = DecodeEvent::kNothing;
    while (event == DecodeEvent::kNothing && !bytes.empty())
      event = stream_.is_empty() ? take_whole_record(bytes) : take_rest_of_record(bytes);
    return event;
  }

  /// The record of the last kRecord; std::monostate after kCorrupt and before the first. Ask with
  /// std::get_if.
  [[nodiscard]] const Record& record() const { return record_; }

  [[nodiscard]] const CorruptCounts& corrupt() const { return corrupt_; }

  /// Bytes of an unfinished record were taken: a recording that ends here was cut.
  [[nodiscard]] bool is_inside_record() const { return !stream_.is_empty(); }

 private:
  static std::size_t find_delimiter(std::span<const std::uint8_t> bytes) {
    const auto* found = static_cast<const std::uint8_t*>(std::memchr(bytes.data(), kDelimiter, bytes.size()));
    return found == nullptr ? bytes.size() : static_cast<std::size_t>(found - bytes.data());
  }

  DecodeEvent take_whole_record(std::span<const std::uint8_t>& bytes) {
    const std::size_t size = find_delimiter(bytes);
    if (size == bytes.size()) return take_rest_of_record(bytes);
    const auto encoded = bytes.first(size);
    bytes = bytes.subspan(size + 1);
    return encoded.empty() ? DecodeEvent::kNothing : accept(stream_.decode(encoded));
  }

  DecodeEvent take_rest_of_record(std::span<const std::uint8_t>& bytes) {
    DecodeEvent event = DecodeEvent::kNothing;
    std::size_t taken = 0;
    while (event == DecodeEvent::kNothing && taken < bytes.size()) event = push(bytes[taken++]);
    bytes = bytes.subspan(taken);
    return event;
  }

  DecodeEvent accept(CobsResult result) {
    const RecordFault fault = fault_of(result);
    corrupt_.count(fault);
    return fault == RecordFault::kNone ? DecodeEvent::kRecord : DecodeEvent::kCorrupt;
  }

  RecordFault fault_of(CobsResult result) {
    if (result.status == CobsStatus::kOk) return decode(stream_.decoded(result.size), record_);
    record_.emplace<std::monostate>();
    return result.status == CobsStatus::kBroken ? RecordFault::kCobs : RecordFault::kLength;
  }

  CobsStream<kLargestRecord> stream_;
  Record record_;
  CorruptCounts corrupt_;
};

}  // namespace morepro::wire
