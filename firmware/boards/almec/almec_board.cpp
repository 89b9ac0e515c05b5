#include "firmware/boards/almec/almec_board.hpp"

#include "firmware/boards/almec/almec_board_pins.hpp"
#include "firmware/boards/cortex_m/vector_table.hpp"

namespace morepro::firmware::almec {
namespace {

using namespace f405;

constinit AlmecBoard::Link link;

constexpr std::uint32_t kEraseTimeoutMs = 10'000;

void on_link() { link.on_interrupt(); }
void on_tick() {}

void start_release_output() {
  set_bits<Mmio>(rcc::kAhb1Enr, rcc::kGpioBEnable);
  change_bits<Mmio>(gpio::kB + gpio::kMode, 3U << (2 * kReleasePin), 1U << (2 * kReleasePin));
}

void release(bool wanted) {
  Mmio::write(gpio::kB + gpio::kSetReset, wanted ? 1U << kReleasePin : 1U << (kReleasePin + 16));
}

constexpr VectorTable<82> make_vectors() {
  VectorTable<82> table;
  table.tick = on_tick;
  table.interrupts[usart1::kInterrupt] = on_link;
  return table;
}

}  // namespace

AlmecBoard::AlmecBoard() : reset_cause_(take_reset_cause<Mmio>()), source_(link) {
  start_release_output();
  release(true);
  const Clocks clocks = start_clock<Mmio>(kCrystalHz);
  start_microseconds<Mmio>(clocks);
  Usart1<Mmio>::start(clocks.apb2_hz, kLinkBaud);
  core::start_tick(clocks.core_hz / 1000);
  core::enable_interrupt(usart1::kInterrupt);
  core::unmask_interrupts();
  watchdog_.start(kWatchdogMs);
}

hal::ReadStatus AlmecBoard::read_line(SensorFrame& frame) {
  link.pump();
  const hal::ReadStatus status = frames_.read_frame(frame);
  if (status == hal::ReadStatus::kNothing) core::sleep_unless([] { return link.has_received(); });
  return status;
}

hal::ReadStatus AlmecBoard::read_frame(SensorFrame& frame) {
  const hal::ReadStatus status = read_line(frame);
  return status == hal::ReadStatus::kEnd ? hal::ReadStatus::kNothing : status;
}

bool AlmecBoard::send(std::span<const std::uint8_t> message) { return link.send(message); }

bool AlmecBoard::store(std::span<const std::uint8_t> record) {
  watchdog_.set_timeout_ms(kEraseTimeoutMs);
  const bool stored = store_.store(record);
  watchdog_.set_timeout_ms(kWatchdogMs);
  return stored;
}

void AlmecBoard::enter_safe_state() { release(false); }

}  // namespace morepro::firmware::almec

extern "C" {
extern const morepro::firmware::VectorTable<82> __interrupt_vector;
__attribute__((section(".data.init.enter"), used)) constinit const morepro::firmware::VectorTable<82>
    __interrupt_vector = morepro::firmware::almec::make_vectors();
}
