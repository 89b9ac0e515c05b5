#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/boards/cortex_m/panic.hpp"

extern "C" {
void _start();
extern std::uint32_t __stack[];
}

namespace morepro::firmware {

using Handler = void (*)();

/// As ARMv7-M wants it at the start of flash. kInterrupts: of the part.
template <std::size_t kInterrupts>
struct VectorTable {
  const std::uint32_t* stack = __stack;
  Handler reset = _start;
  Handler nmi = panic;
  std::array<Handler, 4> faults{panic, panic, panic, panic};
  std::array<Handler, 4> reserved{};
  std::array<Handler, 2> service_and_debug{panic, panic};
  Handler reserved_too = nullptr;
  Handler pend_service = panic;
  Handler tick = panic;
  std::array<Handler, kInterrupts> interrupts = all_unexpected();

  static constexpr std::array<Handler, kInterrupts> all_unexpected() {
    std::array<Handler, kInterrupts> handlers{};
    handlers.fill(panic);
    return handlers;
  }
};

}  // namespace morepro::firmware
