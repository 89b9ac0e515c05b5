#include "lib/monitor/monitor.hpp"
#include "lib/wire/decoder.hpp"
#include "tests/target/count/count.hpp"
#include "tests/target/count/recorded_frames.hpp"

namespace morepro {
namespace {

struct Board {
  count::RecordedFrames frames;
  BoardMonitor monitor;
};

Board* board = nullptr;
SensorFrame frame;

void take_board() { board = count::InTurn<Board>::get(); }

void next_frame() {
  take_board();
  board->frames.next(frame);
}

void step_monitor() { count::keep(board->monitor.step(frame)); }

void encode_health() {
  static std::array<std::uint8_t, wire::kMaxEncodedSize<Health>> message;
  count::keep(wire::encode(board->monitor.health(), message));
}

std::array<std::uint8_t, wire::kMaxEncodedSize<SensorFrame>> received;
std::size_t received_size;

void receive_next_frame() {
  next_frame();
  received_size = wire::encode(frame, received);
}

void decode_frame() {
  static wire::Decoder decoder;
  std::span<const std::uint8_t> bytes = std::span(received).first(received_size);
  count::keep(decoder.next(bytes));
  count::keep(decoder.record());
}

/// The last one is counted first: the health of a monitor that has seen nothing, whose zeros cost the
/// encoding most; then the recording from its start.
const count::Entry kDecodeFrame("decode_frame", 1, receive_next_frame, decode_frame);
const count::Entry kMonitorStep("monitor_step", 1, next_frame, step_monitor, count::kManyFrames);
const count::Entry kEncodeHealth("encode_health", 1, take_board, encode_health);

}  // namespace
}  // namespace morepro
