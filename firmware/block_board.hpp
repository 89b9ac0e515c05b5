#pragma once
#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/frame_link.hpp"
#include "hal/board.hpp"

namespace morepro::firmware {

/// Two files as a board knows them: read() gives 0 at the end, write() true when every byte was taken.
template <class F>
concept BlockFiles = requires(F files, std::span<std::uint8_t> buffer, std::span<const std::uint8_t> bytes) {
  { files.read(buffer) } -> std::same_as<std::size_t>;
  { files.write(bytes) } -> std::same_as<bool>;
  { files.now_us() } -> std::same_as<std::uint32_t>;
};

/// Reads a recording block by block.
template <BlockFiles F>
class BlockSource {
 public:
  explicit BlockSource(F& files) : files_(files) {}

  wire::DecodeEvent feed(wire::Decoder& decoder) {
    while (!ended_) {
      const wire::DecodeEvent event = decoder.next(rest_);
      if (event != wire::DecodeEvent::kNothing) return event;
      rest_ = std::span(block_).first(files_.read(block_));
      ended_ = rest_.empty();
    }
    return wire::DecodeEvent::kNothing;
  }

  [[nodiscard]] bool ended() const { return ended_; }

 private:
  static constexpr std::size_t kBlockBytes = 16384;

  F& files_;
  std::array<std::uint8_t, kBlockBytes> block_{};
  std::span<const std::uint8_t> rest_;
  bool ended_ = false;
};

/// The board of a replay: frames and configuration come from a recording, messages go to a file in blocks.
/// The same code on a target (files over semihosting) and on a host, so that equal recordings give equal
/// files.
template <BlockFiles F>
class BlockBoard {
 public:
  explicit BlockBoard(F& files) : files_(files), source_(files), link_(source_) {}

  std::uint32_t now_us() { return files_.now_us(); }
  hal::ReadStatus read_frame(SensorFrame& frame) { return link_.read_frame(frame); }

  bool send(std::span<const std::uint8_t> message) {
    if (message.size() > output_.size()) return false;
    if (message.size() > output_.size() - used_ && !flush()) return false;
    std::copy(message.begin(), message.end(), output_.begin() + static_cast<std::ptrdiff_t>(used_));
    used_ += message.size();
    return true;
  }

  /// What store() took, else the configuration that the recording begins with.
  std::size_t load(std::span<std::uint8_t> buffer) {
    if (stored_ == 0 && !configuration_read_) {
      configuration_read_ = true;
      stored_ = link_.read_configuration(record_, kEveryRecord, [] {});
    }
    if (stored_ > buffer.size()) return 0;
    std::copy_n(record_.begin(), stored_, buffer.begin());
    return stored_;
  }

  bool store(std::span<const std::uint8_t> record) {
    if (record.empty() || record.size() > record_.size()) return false;
    std::copy(record.begin(), record.end(), record_.begin());
    stored_ = record.size();
    return true;
  }

  void kick_watchdog() {}
  void enter_safe_state() {}
  /// The same for every replay: the messages must not depend on the machine.
  hal::ResetCause reset_cause() { return hal::ResetCause::kPowerOn; }

  /// Writes what waits; false: the file could not take it. Call it at the end.
  bool flush() {
    complete_ = files_.write(std::span(output_).first(used_)) && complete_;
    used_ = 0;
    return complete_;
  }

 private:
  static constexpr std::size_t kOutputBytes = 8192;
  static constexpr std::uint32_t kEveryRecord = 0xFFFFFFFFU;

  F& files_;
  BlockSource<F> source_;
  FrameLink<BlockSource<F>> link_;
  std::array<std::uint8_t, kOutputBytes> output_{};
  std::size_t used_ = 0;
  bool complete_ = true;
  std::array<std::uint8_t, wire::kMaxEncodedSize<MonitorConfiguration>> record_{};
  std::size_t stored_ = 0;
  bool configuration_read_ = false;
};

}  // namespace morepro::firmware
