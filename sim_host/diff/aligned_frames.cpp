#include "sim_host/diff/aligned_frames.hpp"

#include <cmath>
#include <cstdlib>
#include <utility>

namespace morepro::host {
namespace {

constexpr double kSameRate = 1.0e-3;

std::int64_t distance_us(const TimedFrame& one, const TimedFrame& other) {
  return std::abs(one.time_us - other.time_us);
}

}  // namespace

std::optional<double> sample_of(const std::optional<TimedFrame>& side, Channel channel) {
  if (!side || !side->frame.has(channel) || std::isnan(side->frame.get(channel))) return std::nullopt;
  return static_cast<double>(side->frame.get(channel));
}

FrameQueue::FrameQueue(RecordingReader& recording)
    : recording_(recording), time_(recording.info().start_us), current_(read()), following_(read()) {}

void FrameQueue::advance() {
  current_ = std::exchange(following_, std::nullopt);
  if (current_) following_ = read();
}

std::optional<TimedFrame> FrameQueue::read() {
  SensorFrame frame;
  for (auto status = recording_.next(frame); status != hal::ReadStatus::kEnd; status = recording_.next(frame))
    if (status == hal::ReadStatus::kFrame && time_.advance(frame.time_us))
      return TimedFrame{time_.us(), frame};
  return std::nullopt;
}

AlignedFrames::AlignedFrames(RecordingReader& a, RecordingReader& b, std::int64_t tolerance_us)
    : a_(a),
      b_(b),
      is_a_slower_(a.info().rate_hz <= b.info().rate_hz),
      is_same_rate_(std::fabs(a.info().rate_hz / b.info().rate_hz - 1.0) <= kSameRate),
      tolerance_us_(tolerance_us),
      slower_(is_a_slower_ ? a_ : b_),
      faster_(is_a_slower_ ? b_ : a_) {}

bool AlignedFrames::next(AlignedRow& row) {
  return slower_.current() ? next_of_slower(row) : rest_of_faster(row);
}

bool AlignedFrames::next_of_slower(AlignedRow& row) {
  const TimedFrame slower = *slower_.current();
  while (faster_.following() &&
         distance_us(*faster_.following(), slower) < distance_us(*faster_.current(), slower))
    if (leave_faster(row)) return true;
  const bool has_partner = faster_.current() && distance_us(*faster_.current(), slower) <= tolerance_us_;
  row = row_of(slower, has_partner ? faster_.current() : std::nullopt);
  is_faster_used_ |= has_partner;
  slower_.advance();
  return true;
}

bool AlignedFrames::rest_of_faster(AlignedRow& row) {
  while (faster_.current())
    if (leave_faster(row)) return true;
  return false;
}

/// To the next frame of the faster one; true where the one before was a row of its own.
bool AlignedFrames::leave_faster(AlignedRow& row) {
  const bool is_row = is_same_rate_ && !is_faster_used_;
  if (is_row) row = row_of(std::nullopt, faster_.current());
  faster_.advance();
  is_faster_used_ = false;
  return is_row;
}

AlignedRow AlignedFrames::row_of(std::optional<TimedFrame> slower, std::optional<TimedFrame> faster) const {
  if (is_a_slower_) return {std::move(slower), std::move(faster)};
  return {std::move(faster), std::move(slower)};
}

}  // namespace morepro::host
