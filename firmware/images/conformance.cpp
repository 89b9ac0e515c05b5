#include "hal/conformance.hpp"

#include "firmware/semihosting/semihost.hpp"
#include "this_board.hpp"

/// Runs the suite on this board; exit status: number of checks that failed.
int main() {
  using namespace morepro::firmware;
  static ThisBoard board;
  static int failures = 0;
  const auto report = [](const char* name, bool passed) {
    semihost::print(passed ? "ok      " : "FAILED  ");
    semihost::print(name);
    semihost::print("\n");
    failures += passed ? 0 : 1;
    board.kick_watchdog();
  };
  morepro::hal::check_conformance(board, report, kEmulatedCapabilities);
  semihost::exit(failures);
}
