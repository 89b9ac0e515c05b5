#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <variant>

#include "hal/board.hpp"
#include "lib/monitor/monitor.hpp"
#include "lib/wire/decoder.hpp"

namespace morepro::firmware {

struct AppOptions {
  std::uint32_t health_every_frames = 1;  ///< >= 1; 1: an answer to every frame
  std::uint32_t build_id = 0;             ///< said in Ready
};

struct AppCounters {
  std::uint32_t frames = 0;         ///< given to the monitor
  std::uint32_t corrupt = 0;        ///< dropped by the link: no frames
  std::uint32_t dropped_sends = 0;  ///< messages that the link refused
  std::uint32_t overruns = 0;       ///< steps that took longer than a sampling period
};

/// The loop: frame in -> monitor -> health out. Thin on purpose: what it does with hardware is the board's,
/// what it computes is the monitor's. Large (it holds the monitor): make it static.
template <hal::Board B, class M = BoardMonitor>
class App {
 public:
  explicit App(B& board, AppOptions options = {}) : board_(board), options_(options) {}

  /// Until the frames end; a live board's never do. False: there was no usable configuration.
  bool run() {
    if (!start()) return false;
    while (pass()) {
    }
    return true;
  }

  /// Configures the monitor and says Ready. False: not even the built-in configuration was taken; the board
  /// is in its safe state.
  bool start() {
    const std::string_view source = configure();
    if (source.empty()) {
      board_.enter_safe_state();
      return false;
    }
    period_us_ = static_cast<std::uint32_t>(1.0e6 / monitor_.configuration().sampling.rate_hz);
    send(wire::Ready{.build_id = options_.build_id,
                     .reset_cause = static_cast<std::uint8_t>(board_.reset_cause())});
    send_text(source);
    return true;
  }

  /// Once around; false: the frames have ended. The watchdog is kicked at the end of a whole pass and nowhere
  /// else: a step that hangs is a reset.
  bool pass() {
    SensorFrame frame;
    switch (board_.read_frame(frame)) {
      case hal::ReadStatus::kFrame:
        step(frame);
        break;
      case hal::ReadStatus::kCorrupt:
        ++counters_.corrupt;
        monitor_.count_corrupt();
        break;
      case hal::ReadStatus::kNothing:
        break;
      case hal::ReadStatus::kEnd:
        send(wire::End{.frames = counters_.frames});
        return false;
    }
    board_.kick_watchdog();
    return true;
  }

  [[nodiscard]] const AppCounters& counters() const { return counters_; }
  [[nodiscard]] const M& monitor() const { return monitor_; }

 private:
  /// Where the configuration came from; empty: none was taken.
  std::string_view configure() {
    const std::size_t size = board_.load(scratch_);
    if (size != 0 && configure_from(std::span(scratch_).first(size))) return "configuration: stored";
    if (!monitor_.configure(reference_configuration()).ok()) return {};
    return size == 0 ? "configuration: built-in" : "configuration: built-in, the stored one was refused";
  }

  bool configure_from(std::span<const std::uint8_t> bytes) {
    wire::Decoder& decoder = decoder_.emplace();
    const bool decoded = decoder.next(bytes) == wire::DecodeEvent::kRecord;
    const auto* found = std::get_if<MonitorConfiguration>(&decoder.record());
    const bool taken = decoded && found != nullptr && monitor_.configure(*found).ok();
    decoder_.reset();
    return taken;
  }

  void step(const SensorFrame& frame) {
    const std::uint32_t start_us = board_.now_us();
    const Health& health = monitor_.step(frame);
    if (board_.now_us() - start_us > period_us_) ++counters_.overruns;
    if (++counters_.frames % options_.health_every_frames == 0) send(health);
  }

  template <class Record>
  void send(const Record& record) {
    const std::size_t size = wire::encode(record, scratch_);
    if (size == 0 || !board_.send(std::span<const std::uint8_t>(scratch_).first(size)))
      ++counters_.dropped_sends;
  }

  void send_text(std::string_view text) {
    wire::Text record;
    if (record.assign(text)) send(record);
  }

  B& board_;
  AppOptions options_;
  M monitor_;
  AppCounters counters_;
  std::uint32_t period_us_ = 0;
  std::optional<wire::Decoder> decoder_;
  std::array<std::uint8_t, wire::kMaxEncodedSize<MonitorConfiguration>> scratch_{};
};

}  // namespace morepro::firmware
