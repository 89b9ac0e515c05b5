#pragma once

namespace morepro::firmware {

/// Where a fault or an interrupt that nobody asked for ends. In the product image it waits for the watchdog;
/// an image with semihosting ends with exit status 70. Linked, not passed: any code may need it.
[[noreturn]] void panic();

}  // namespace morepro::firmware
