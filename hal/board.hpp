#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "lib/frame/sensor_frame.hpp"

namespace morepro::hal {

/// What one attempt to get a frame gave.
enum class ReadStatus : std::uint8_t {
  kFrame = 0,    ///< the frame was filled
  kNothing = 1,  ///< nothing yet; ask again
  kCorrupt = 2,  ///< something came that is no frame (bad check sum, wrong length); it was dropped and counts
  kEnd = 3,      ///< there will be no more frames: a recording ended; a live board never says it
};

/// Why the processor started.
enum class ResetCause : std::uint8_t { kPowerOn = 0, kWatchdog = 1, kSoftware = 2, kUnknown = 3 };

/// What the monitor needs of hardware, all of it. Every operation returns within a bounded time; none
/// allocates. README.md of this folder is the porting guide, conformance.hpp the check that a port is right.
template <class B>
concept Board = requires(B board, SensorFrame& frame, std::span<const std::uint8_t> bytes,
                         std::span<std::uint8_t> buffer) {
  /// Microseconds since an arbitrary start, wraps; never runs backwards.
  { board.now_us() } -> std::same_as<std::uint32_t>;
  /// The next sensor frame, if there is one.
  { board.read_frame(frame) } -> std::same_as<ReadStatus>;
  /// Sends one encoded message; false: the link cannot take it now and it is dropped whole.
  { board.send(bytes) } -> std::same_as<bool>;
  /// The stored configuration record into `buffer`; returns its length, 0: none is stored or it is damaged.
  { board.load(buffer) } -> std::same_as<std::size_t>;
  /// Stores a configuration record; after a power cut the old or the new one is there, never a mix.
  { board.store(bytes) } -> std::same_as<bool>;
  /// Tells the watchdog that a step has been completed.
  { board.kick_watchdog() } -> std::same_as<void>;
  /// Brings every output to the state in which nothing can be harmed. Does not need to return.
  { board.enter_safe_state() } -> std::same_as<void>;
  { board.reset_cause() } -> std::same_as<ResetCause>;
};

}  // namespace morepro::hal
