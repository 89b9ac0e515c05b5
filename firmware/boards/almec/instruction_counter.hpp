#pragma once
#include "firmware/boards/almec/f405_registers.hpp"
#include "firmware/boards/cortex_m/mmio.hpp"

namespace morepro::firmware {

/// Instructions in the emulator under -icount shift=0: TIM2 without its prescaler ticks once per instruction.
struct InstructionCounter {
  static void start() { Mmio::write(f405::tim2::kPsc, 0); }
  static std::uint32_t ticks() { return Mmio::read(f405::tim2::kCnt); }
  static std::uint32_t instructions(std::uint32_t from, std::uint32_t to) { return to - from; }
};

}  // namespace morepro::firmware
