#pragma once
#include <cstdint>

#include "firmware/boards/almec/f405_registers.hpp"
#include "firmware/boards/cortex_m/mmio.hpp"

namespace morepro::firmware::f405 {

/// Frequencies after start_clock().
struct Clocks {
  std::uint32_t core_hz;
  std::uint32_t apb2_hz;        ///< USART1
  std::uint32_t apb1_timer_hz;  ///< TIM2
};

/// What the part runs on after reset; a dead crystal leaves it there, slower but alive.
inline constexpr Clocks kInternalOscillator{16'000'000, 16'000'000, 16'000'000};
inline constexpr Clocks kFullSpeed{168'000'000, 84'000'000, 84'000'000};

/// Polls until a clock is called dead; the crystal's start-up takes a few ms, 40,000 polls at 16 MHz
/// about 20.
inline constexpr std::uint32_t kClockPolls = 40'000;

template <class Bus>
bool start_pll(std::uint32_t crystal_hz) {
  set_bits<Bus>(rcc::kCr, rcc::kHseOn);
  if (!wait_for<Bus>(rcc::kCr, rcc::kHseReady, rcc::kHseReady, kClockPolls)) return false;
  // VCO input 1 MHz, VCO 336 MHz, core 336/2, USB 336/7
  Bus::write(rcc::kPllCfgr,
             (crystal_hz / 1'000'000) | (336U << 6) | (0U << 16) | rcc::kPllFromHse | (7U << 24));
  set_bits<Bus>(rcc::kCr, rcc::kPllOn);
  return wait_for<Bus>(rcc::kCr, rcc::kPllReady, rcc::kPllReady, kClockPolls);
}

/// Crystal -> PLL -> 168 MHz with five flash wait states; on failure the internal oscillator goes on.
template <class Bus>
Clocks start_clock(std::uint32_t crystal_hz) {
  if (!start_pll<Bus>(crystal_hz)) return kInternalOscillator;
  Bus::write(flash::kAcr, flash::kLatency5 | flash::kPrefetch | flash::kInstructionCache | flash::kDataCache);
  change_bits<Bus>(rcc::kCfgr, rcc::kSwitchMask, rcc::kApb1By4 | rcc::kApb2By2 | rcc::kSwitchPll);
  if (!wait_for<Bus>(rcc::kCfgr, rcc::kStatusMask, rcc::kStatusPll, kClockPolls)) return kInternalOscillator;
  return kFullSpeed;
}

/// A free-running 32-bit counter of microseconds: wraps as Board::now_us() does and needs no interrupt.
template <class Bus>
void start_microseconds(const Clocks& clocks) {
  set_bits<Bus>(rcc::kApb1Enr, rcc::kTim2Enable);
  Bus::write(tim2::kPsc, clocks.apb1_timer_hz / 1'000'000 - 1);
  Bus::write(tim2::kArr, 0xFFFFFFFFU);
  Bus::write(tim2::kEgr, tim2::kUpdate);
  Bus::write(tim2::kCr1, tim2::kEnable);
}

}  // namespace morepro::firmware::f405
