#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "hal/board.hpp"

namespace morepro::host {

/// Share of frames that a bad link treats so, each in [0, 1]; their sum is at most 1.
struct LinkFaults {
  double drop = 0.0;
  double duplicate = 0.0;
  double reorder = 0.0;  ///< the frame changes places with the next one
  double corrupt = 0.0;  ///< the frame is lost and the board is told that something was
  std::uint32_t seed = 1;
};

/// A board in memory: frames come from any function, messages go to another, the link fails as often as
/// asked.
class SimulatedBoard {
 public:
  /// Fills the next frame; false: there are no more.
  using FrameSource = std::function<bool(SensorFrame&)>;
  using MessageSink = std::function<void(std::span<const std::uint8_t>)>;

  SimulatedBoard(FrameSource frames, MessageSink messages, LinkFaults faults = {})
      : frames_(std::move(frames)), messages_(std::move(messages)), faults_(faults), random_(faults.seed) {}

  /// A clock of its own: each look takes a microsecond.
  std::uint32_t now_us() { return ++clock_us_; }
  hal::ReadStatus read_frame(SensorFrame& frame);
  bool send(std::span<const std::uint8_t> message);
  std::size_t load(std::span<std::uint8_t> buffer);
  bool store(std::span<const std::uint8_t> record);
  void kick_watchdog() { ++kicks_; }
  void enter_safe_state() { is_safe_ = true; }
  hal::ResetCause reset_cause() { return hal::ResetCause::kPowerOn; }

  [[nodiscard]] std::uint64_t kicks() const { return kicks_; }
  [[nodiscard]] bool is_safe() const { return is_safe_; }
  /// While true every message is refused, as by a link that nobody listens to.
  void block_link(bool blocked) { link_blocked_ = blocked; }

 private:
  hal::ReadStatus deliver(SensorFrame& frame, const SensorFrame& fresh);
  /// Exact on every platform, unlike std::uniform_real_distribution.
  double uniform() { return static_cast<double>(random_()) / 4294967296.0; }

  FrameSource frames_;
  MessageSink messages_;
  LinkFaults faults_;
  std::mt19937 random_;
  std::optional<SensorFrame> waiting_;
  std::vector<std::uint8_t> stored_;
  std::uint32_t clock_us_ = 0;
  std::uint64_t kicks_ = 0;
  bool is_safe_ = false;
  bool link_blocked_ = false;
};

static_assert(hal::Board<SimulatedBoard>);

}  // namespace morepro::host
