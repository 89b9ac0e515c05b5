#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "hal/board.hpp"
#include "lib/wire/record_codec.hpp"
#include "sim_host/recording/recording_reader.hpp"
#include "sim_host/support/output_file.hpp"

namespace morepro::host {

/// The simulated board of a replay: any recording as its link, the recording's time as its clock, a machine
/// as its stored configuration.
class ReplayBoard {
 public:
  /// `usable`: bit_of(channel) of the signals that the monitor is shown. `answers` takes the encoded
  /// messages; null: they are dropped.
  ReplayBoard(RecordingReader& recording, const MonitorConfiguration& configuration, std::uint16_t usable,
              OutputFile* answers)
      : recording_(recording), usable_(usable), answers_(answers) {
    stored_size_ = wire::encode(configuration, stored_);
  }

  std::uint32_t now_us() { return now_us_; }

  hal::ReadStatus read_frame(SensorFrame& frame) {
    last_status_ = recording_.next(frame);
    if (last_status_ == hal::ReadStatus::kFrame) {
      frame.present = static_cast<std::uint16_t>(frame.present & usable_);
      if (static_cast<std::int32_t>(frame.time_us - now_us_) > 0) now_us_ = frame.time_us;
      last_frame_ = frame;
    }
    return last_status_;
  }

  bool send(std::span<const std::uint8_t> message) {
    if (answers_ != nullptr) answers_->write(message);
    return true;
  }

  std::size_t load(std::span<std::uint8_t> buffer) {
    if (stored_size_ > buffer.size()) return 0;
    std::copy_n(stored_.begin(), stored_size_, buffer.begin());
    return stored_size_;
  }

  /// A replay changes no configuration.
  bool store(std::span<const std::uint8_t>) { return false; }
  void kick_watchdog() {}
  void enter_safe_state() {}
  /// The same for every replay: the messages must not depend on the machine that replays.
  hal::ResetCause reset_cause() { return hal::ResetCause::kPowerOn; }

  [[nodiscard]] bool has_new_frame() const { return last_status_ == hal::ReadStatus::kFrame; }
  [[nodiscard]] const SensorFrame& last_frame() const { return last_frame_; }

 private:
  RecordingReader& recording_;
  std::uint16_t usable_;
  OutputFile* answers_;
  std::array<std::uint8_t, wire::kMaxEncodedSize<MonitorConfiguration>> stored_{};
  std::size_t stored_size_ = 0;
  std::uint32_t now_us_ = 0;
  hal::ReadStatus last_status_ = hal::ReadStatus::kNothing;
  SensorFrame last_frame_;
};

static_assert(hal::Board<ReplayBoard>);

}  // namespace morepro::host
