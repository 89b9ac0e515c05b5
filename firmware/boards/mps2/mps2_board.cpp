#include "firmware/boards/mps2/mps2_board.hpp"

#include "firmware/boards/cortex_m/vector_table.hpp"

namespace morepro::firmware::mps2 {
namespace {

constinit Mps2Board::Link link;

/// Between two expiries; the second one resets. An emulated core may rest that long while its host is busy.
constexpr std::uint32_t kWatchdogCycles = 3 * kCoreHz;
constexpr std::uint32_t kReleaseLed = 1;

void on_link() { link.on_interrupt(); }
void on_tick() {}

void release(bool wanted) { Mmio::write(fpga::kLeds, wanted ? kReleaseLed : 0); }

/// First expiry. It is not acknowledged: the second one resets.
void on_watchdog() {
  release(false);
  mark_watchdog_reset();
  while (true) __asm volatile("");
}

void start_watchdog() {
  Mmio::write(watchdog::kLock, watchdog::kKey);
  Mmio::write(watchdog::kLoad, kWatchdogCycles);
  Mmio::write(watchdog::kControl, watchdog::kInterruptAndReset);
}

constexpr VectorTable<32> make_vectors() {
  VectorTable<32> table;
  table.nmi = on_watchdog;
  table.tick = on_tick;
  table.interrupts[uart0::kReceiveInterruptNumber] = on_link;
  table.interrupts[uart0::kTransmitInterruptNumber] = on_link;
  return table;
}

}  // namespace

Mps2Board::Mps2Board() : reset_cause_(take_reset_cause()), source_(link) {
  release(true);
  Mmio::write(fpga::kPrescale, kCoreHz / 1'000'000 - 1);
  Uart0<Mmio>::start();
  core::start_tick(kCoreHz / 1000);
  core::enable_interrupt(uart0::kReceiveInterruptNumber);
  core::enable_interrupt(uart0::kTransmitInterruptNumber);
  core::unmask_interrupts();
  start_watchdog();
}

hal::ReadStatus Mps2Board::read_line(SensorFrame& frame) {
  link.pump();
  const hal::ReadStatus status = frames_.read_frame(frame);
  if (status == hal::ReadStatus::kNothing) core::sleep_unless([] { return link.has_received(); });
  return status;
}

hal::ReadStatus Mps2Board::read_frame(SensorFrame& frame) {
  const hal::ReadStatus status = read_line(frame);
  return status == hal::ReadStatus::kEnd ? hal::ReadStatus::kNothing : status;
}

bool Mps2Board::send(std::span<const std::uint8_t> message) { return link.send(message); }

void Mps2Board::enter_safe_state() { release(false); }

}  // namespace morepro::firmware::mps2

extern "C" {
extern const morepro::firmware::VectorTable<32> __interrupt_vector;
__attribute__((section(".data.init.enter"), used)) constinit const morepro::firmware::VectorTable<32>
    __interrupt_vector = morepro::firmware::mps2::make_vectors();
}
