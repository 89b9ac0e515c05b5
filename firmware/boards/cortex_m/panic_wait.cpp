#include "firmware/boards/cortex_m/panic.hpp"

namespace morepro::firmware {

void panic() {
  while (true) __asm volatile("");
}

}  // namespace morepro::firmware
