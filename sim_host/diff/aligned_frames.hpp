#pragma once
#include <cstdint>
#include <optional>

#include "sim_host/recording/recording_reader.hpp"
#include "sim_host/recording/recording_time.hpp"

namespace morepro::host {

/// A frame with its whole time.
struct TimedFrame {
  std::int64_t time_us = 0;
  SensorFrame frame;
};

/// Frames that belong together; one side is empty where it has none near enough.
struct AlignedRow {
  std::optional<TimedFrame> a, b;

  [[nodiscard]] std::int64_t time_us() const { return a ? a->time_us : b->time_us; }
};

/// The sample of one side; empty where it has none.
std::optional<double> sample_of(const std::optional<TimedFrame>& side, Channel channel);

/// The frames of one recording whose time increases, one looked ahead.
class FrameQueue {
 public:
  explicit FrameQueue(RecordingReader& recording);

  [[nodiscard]] const std::optional<TimedFrame>& current() const { return current_; }
  [[nodiscard]] const std::optional<TimedFrame>& following() const { return following_; }
  void advance();

 private:
  std::optional<TimedFrame> read();

  RecordingReader& recording_;
  IncreasingTime time_;
  std::optional<TimedFrame> current_, following_;
};

/// Two recordings side by side, in bounded memory. Every frame of the one with the lower rate gets the
/// nearest one of the other, at most `tolerance_us` away; what the faster one has in between is left out.
/// Where the rates are equal to a thousandth nothing is left out: a frame without a partner is a row of its
/// own.
class AlignedFrames {
 public:
  AlignedFrames(RecordingReader& a, RecordingReader& b, std::int64_t tolerance_us);
  AlignedFrames(const AlignedFrames&) = delete;
  AlignedFrames& operator=(const AlignedFrames&) = delete;

  /// False at the end.
  bool next(AlignedRow& row);

 private:
  bool next_of_slower(AlignedRow& row);
  bool rest_of_faster(AlignedRow& row);
  bool leave_faster(AlignedRow& row);
  AlignedRow row_of(std::optional<TimedFrame> slower, std::optional<TimedFrame> faster) const;

  FrameQueue a_, b_;
  bool is_a_slower_;
  bool is_same_rate_;
  std::int64_t tolerance_us_;
  FrameQueue& slower_;
  FrameQueue& faster_;
  bool is_faster_used_ = false;  ///< its current frame has a partner
};

}  // namespace morepro::host
