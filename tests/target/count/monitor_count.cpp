#include "firmware/block_board.hpp"
#include "firmware/semihosting/semihost.hpp"
#include "lib/monitor/monitor.hpp"
#include "lib/wire/decoder.hpp"
#include "tests/target/count/count.hpp"

namespace morepro {
namespace {

/// The frames of the recording, without anything to write to.
class RecordedFrames {
 public:
  RecordedFrames()
      : input_(firmware::semihost::open(count::recording(), firmware::semihost::OpenMode::kRead)) {}
  std::size_t read(std::span<std::uint8_t> buffer) { return firmware::semihost::read(input_, buffer); }
  bool write(std::span<const std::uint8_t>) { return true; }
  std::uint32_t now_us() { return 0; }

 private:
  int input_;
};

SensorFrame frame;

void next_frame() {
  static RecordedFrames files;
  static firmware::BlockSource<RecordedFrames> source(files);
  static firmware::FrameLink<firmware::BlockSource<RecordedFrames>> link(source);
  while (true) {
    const hal::ReadStatus status = link.read_frame(frame);
    if (status == hal::ReadStatus::kFrame) return;
    if (status == hal::ReadStatus::kEnd) firmware::semihost::exit(4);
  }
}

BoardMonitor& monitor() {
  static BoardMonitor the_monitor;
  return the_monitor;
}

/// The work on the gap goes round in some 11,300 frames. Every seventh counts, so that the 2000 counted calls
/// see all of it; seven has no factor in common with the rhythm of its pieces.
constexpr int kStride = 7;

void step_monitor() { count::keep(monitor().step(frame)); }

void next_counted_frame() {
  for (int i = 1; i < kStride; ++i) {
    next_frame();
    step_monitor();
  }
  next_frame();
}

void encode_health() {
  static std::array<std::uint8_t, wire::kMaxEncodedSize<Health>> message;
  count::keep(wire::encode(monitor().health(), message));
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

void nothing() {}

const count::Entry kMonitorStep("monitor_step", 1, next_counted_frame, step_monitor);
const count::Entry kDecodeFrame("decode_frame", 1, receive_next_frame, decode_frame);
const count::Entry kEncodeHealth("encode_health", 1, nothing, encode_health);

}  // namespace
}  // namespace morepro
