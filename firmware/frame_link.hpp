#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <variant>

#include "hal/board.hpp"
#include "lib/wire/decoder.hpp"

namespace morepro::firmware {

/// Where the bytes of a link come from: a receive ring, the blocks of a file.
template <class S>
concept ByteSource = requires(S source, const S& readable, wire::Decoder& decoder) {
  /// Feeds bytes until a record ends; kNothing: no bytes are left for now.
  { source.feed(decoder) } -> std::same_as<wire::DecodeEvent>;
  /// There will never be more.
  { readable.ended() } -> std::same_as<bool>;
};

/// Frames, and the configuration that may come before them, out of a stream of records.
template <ByteSource S>
class FrameLink {
 public:
  explicit FrameLink(S& source) : source_(source) {}

  /// As Board::read_frame(). Records that are no frames count as nothing; End, or no more bytes, is the end.
  hal::ReadStatus read_frame(SensorFrame& frame) {
    const wire::DecodeEvent event = next_event();
    if (event == wire::DecodeEvent::kCorrupt) return hal::ReadStatus::kCorrupt;
    if (event == wire::DecodeEvent::kNothing)
      return source_.ended() ? hal::ReadStatus::kEnd : hal::ReadStatus::kNothing;
    return take_record(frame);
  }

  /// As Board::load(): the configuration record that comes before the first frame. Asks the source at most
  /// `polls` times and calls `waiting` before each; what comes instead of a configuration is kept for
  /// read_frame().
  template <class Waiting>
  std::size_t read_configuration(std::span<std::uint8_t> buffer, std::uint32_t polls, Waiting waiting) {
    for (std::uint32_t poll = 0; poll < polls && !source_.ended(); ++poll) {
      waiting();
      const wire::DecodeEvent event = source_.feed(decoder_);
      if (event == wire::DecodeEvent::kNothing || is_preamble()) continue;
      if (const auto* found = std::get_if<MonitorConfiguration>(&decoder_.record()))
        return wire::encode(*found, buffer);
      held_ = event;
      return 0;
    }
    return 0;
  }

 private:
  wire::DecodeEvent next_event() {
    if (held_ == wire::DecodeEvent::kNothing) return source_.feed(decoder_);
    const wire::DecodeEvent event = held_;
    held_ = wire::DecodeEvent::kNothing;
    return event;
  }

  hal::ReadStatus take_record(SensorFrame& frame) {
    if (const auto* found = std::get_if<SensorFrame>(&decoder_.record())) {
      frame = *found;
      return hal::ReadStatus::kFrame;
    }
    return std::holds_alternative<wire::End>(decoder_.record()) ? hal::ReadStatus::kEnd
                                                                : hal::ReadStatus::kNothing;
  }

  [[nodiscard]] bool is_preamble() const {
    return std::holds_alternative<wire::Text>(decoder_.record()) ||
           std::holds_alternative<wire::Ready>(decoder_.record());
  }

  S& source_;
  wire::Decoder decoder_;
  wire::DecodeEvent held_ = wire::DecodeEvent::kNothing;
};

}  // namespace morepro::firmware
