#pragma once
#include "firmware/boards/cortex_m/core.hpp"

namespace morepro::firmware {

/// Instructions in the emulator under -icount shift=10: one takes 1024 ns, which SysTick at 25 MHz counts in
/// steps of 40 ns. So a count is exact, up to 655,000 instructions.
struct InstructionCounter {
  static constexpr std::uint32_t kReload = 0x00FFFFFFU;

  static void start() {
    Mmio::write(core::kSysTickReload, kReload);
    Mmio::write(core::kSysTickValue, 0);
    Mmio::write(core::kSysTickControl, 5);  // core clock, no interrupt
  }
  /// Counts up, 24 bits.
  static std::uint32_t ticks() { return kReload - Mmio::read(core::kSysTickValue); }
  static std::uint32_t instructions(std::uint32_t from, std::uint32_t to) {
    return (((to - from) & kReload) * 5 + 64) / 128;
  }
};

}  // namespace morepro::firmware
