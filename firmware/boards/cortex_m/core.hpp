#pragma once
#include <cstdint>

#include "firmware/boards/cortex_m/mmio.hpp"

/// The parts of the ARMv7-M core that every port uses.
namespace morepro::firmware::core {

inline constexpr std::uint32_t kNvicEnable = 0xE000E100U;
inline constexpr std::uint32_t kSysTickControl = 0xE000E010U;
inline constexpr std::uint32_t kSysTickReload = 0xE000E014U;
inline constexpr std::uint32_t kSysTickValue = 0xE000E018U;

inline void mask_interrupts() { __asm volatile("cpsid i" ::: "memory"); }
inline void unmask_interrupts() { __asm volatile("cpsie i" ::: "memory"); }

/// Interrupts are masked while an object of this class lives.
class InterruptLock {
 public:
  InterruptLock() { mask_interrupts(); }
  ~InterruptLock() { unmask_interrupts(); }
  InterruptLock(const InterruptLock&) = delete;
  InterruptLock& operator=(const InterruptLock&) = delete;
};

inline void enable_interrupt(std::uint32_t number) {
  Mmio::write(kNvicEnable + 4 * (number / 32), 1U << (number % 32));
}

/// Starts the periodic interrupt that ends every sleep.
inline void start_tick(std::uint32_t cycles_per_tick) {
  Mmio::write(kSysTickReload, cycles_per_tick - 1);
  Mmio::write(kSysTickValue, 0);
  Mmio::write(kSysTickControl, 7);
}

/// Sleeps until an interrupt, unless `has_work()`: asked with interrupts masked, so that none is missed
/// between.
template <class HasWork>
void sleep_unless(HasWork has_work) {
  mask_interrupts();
  if (!has_work()) __asm volatile("dsb\n wfi");
  unmask_interrupts();
}

}  // namespace morepro::firmware::core
