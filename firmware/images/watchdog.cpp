#include <algorithm>
#include <array>

#include "firmware/app.hpp"
#include "firmware/semihosting/semihost.hpp"
#include "this_board.hpp"

namespace morepro::firmware {
namespace {

/// A step that never comes back.
class HangingMonitor : public BoardMonitor {
 public:
  const Health& step(const SensorFrame&) {
    while (true) __asm volatile("");
  }
};

/// This board with a frame always at hand.
class FedBoard {
 public:
  explicit FedBoard(ThisBoard& board) : board_(board) {}
  std::uint32_t now_us() { return board_.now_us(); }
  hal::ReadStatus read_frame(SensorFrame& frame) {
    frame = SensorFrame{};
    return hal::ReadStatus::kFrame;
  }
  bool send(std::span<const std::uint8_t>) { return true; }
  std::size_t load(std::span<std::uint8_t>) { return 0; }
  bool store(std::span<const std::uint8_t>) { return false; }
  void kick_watchdog() { board_.kick_watchdog(); }
  void enter_safe_state() { board_.enter_safe_state(); }
  hal::ResetCause reset_cause() { return board_.reset_cause(); }

 private:
  ThisBoard& board_;
};

constexpr std::array<std::uint8_t, 5> kRecord{1, 2, 3, 4, 5};

bool record_survived(ThisBoard& board) {
  std::array<std::uint8_t, 16> buffer{};
  return board.load(buffer) == kRecord.size() && std::equal(kRecord.begin(), kRecord.end(), buffer.begin());
}

}  // namespace
}  // namespace morepro::firmware

/// First start: stores a record, then a step hangs. After the reset: the cause must be the watchdog and the
/// record must be there.
int main() {
  using namespace morepro;
  using namespace morepro::firmware;
  static ThisBoard board;
  if (board.reset_cause() == hal::ResetCause::kWatchdog) {
    semihost::print("reset by the watchdog\n");
    semihost::exit(record_survived(board) ? 0 : 1);
  }
  if (!board.store(kRecord)) semihost::exit(3);
  semihost::print("step hangs\n");
  static FedBoard fed(board);
  static App<FedBoard, HangingMonitor> app(fed);
  app.run();
}
