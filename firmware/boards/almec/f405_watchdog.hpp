#pragma once
#include <cstdint>

#include "firmware/boards/almec/f405_registers.hpp"
#include "firmware/boards/cortex_m/mmio.hpp"
#include "hal/board.hpp"

namespace morepro::firmware::f405 {

/// The independent watchdog: its own oscillator, cannot be stopped once it runs.
template <class Bus>
class Watchdog {
 public:
  void start(std::uint32_t timeout_ms) {
    Bus::write(iwdg::kKr, iwdg::kStart);
    set_timeout_ms(timeout_ms);
  }

  /// 1 .. 32000 ms; the oscillator is accurate to about +-50 %.
  void set_timeout_ms(std::uint32_t timeout_ms) {
    std::uint32_t prescaler = 0;
    while (ticks(timeout_ms, prescaler) > kMostTicks && prescaler < kLastPrescaler) ++prescaler;
    Bus::write(iwdg::kKr, iwdg::kUnlock);
    Bus::write(iwdg::kPr, prescaler);
    Bus::write(iwdg::kRlr, ticks(timeout_ms, prescaler) - 1);
    // A part that never takes the values keeps the shorter time-out of its reset state: nothing to do about
    // it here.
    (void)wait_for<Bus>(iwdg::kSr, 3U, 0, kPolls);
    kick();
  }

  void kick() { Bus::write(iwdg::kKr, iwdg::kReload); }

 private:
  static constexpr std::uint32_t kMostTicks = 4096, kLastPrescaler = 6, kPolls = 100'000;

  /// Prescaler code 0 divides by 4, every next one by twice as much.
  static constexpr std::uint32_t ticks(std::uint32_t timeout_ms, std::uint32_t prescaler) {
    return timeout_ms * (iwdg::kOscillatorHz / 1000) / (4U << prescaler);
  }
};

/// Reads the reset flags once and clears them for the next reset.
template <class Bus>
hal::ResetCause take_reset_cause() {
  const std::uint32_t flags = Bus::read(rcc::kCsr);
  set_bits<Bus>(rcc::kCsr, rcc::kRemoveResetFlags);
  if ((flags & rcc::kWatchdogReset) != 0) return hal::ResetCause::kWatchdog;
  if ((flags & rcc::kSoftwareReset) != 0) return hal::ResetCause::kSoftware;
  if ((flags & rcc::kPowerOnReset) != 0) return hal::ResetCause::kPowerOn;
  return hal::ResetCause::kUnknown;
}

}  // namespace morepro::firmware::f405
