#include "sim_host/boards/simulated_board.hpp"

#include <algorithm>

namespace morepro::host {
namespace {

/// Longest message and longest record of a real link and a real store.
constexpr std::size_t kMostBytes = 4096;

}  // namespace

hal::ReadStatus SimulatedBoard::read_frame(SensorFrame& frame) {
  if (waiting_) {
    frame = *std::exchange(waiting_, std::nullopt);
    return hal::ReadStatus::kFrame;
  }
  SensorFrame fresh;
  return frames_(fresh) ? deliver(frame, fresh) : hal::ReadStatus::kEnd;
}

hal::ReadStatus SimulatedBoard::deliver(SensorFrame& frame, const SensorFrame& fresh) {
  double draw = uniform();
  const auto hit = [&draw](double share) { return (draw -= share) < 0.0; };
  if (hit(faults_.drop)) return hal::ReadStatus::kNothing;
  if (hit(faults_.corrupt)) return hal::ReadStatus::kCorrupt;
  frame = fresh;
  if (hit(faults_.duplicate)) {
    waiting_ = fresh;
  } else if (SensorFrame next; hit(faults_.reorder) && frames_(next)) {
    frame = next;
    waiting_ = fresh;
  }
  return hal::ReadStatus::kFrame;
}

bool SimulatedBoard::send(std::span<const std::uint8_t> message) {
  if (link_blocked_ || message.size() > kMostBytes) return false;
  messages_(message);
  return true;
}

std::size_t SimulatedBoard::load(std::span<std::uint8_t> buffer) {
  if (stored_.size() > buffer.size()) return 0;
  std::copy(stored_.begin(), stored_.end(), buffer.begin());
  return stored_.size();
}

bool SimulatedBoard::store(std::span<const std::uint8_t> record) {
  if (record.empty() || record.size() > kMostBytes) return false;
  stored_.assign(record.begin(), record.end());
  return true;
}

}  // namespace morepro::host
