#include "firmware/boards/cortex_m/panic.hpp"
#include "firmware/semihosting/semihost.hpp"

namespace morepro::firmware {

void panic() {
  semihost::print("panic: fault or unexpected interrupt\n");
  semihost::exit(70);
}

}  // namespace morepro::firmware
