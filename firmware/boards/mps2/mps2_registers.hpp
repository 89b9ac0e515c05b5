#pragma once
#include <cstdint>

/// Addresses and bits of the MPS2 images AN386 and AN500 that this port uses (CMSDK peripherals, FPGA
/// system).
namespace morepro::firmware::mps2 {

inline constexpr std::uint32_t kCoreHz = 25'000'000;

namespace uart0 {
inline constexpr std::uint32_t kBase = 0x40004000U;
inline constexpr std::uint32_t kData = kBase + 0x00, kState = kBase + 0x04, kControl = kBase + 0x08;
inline constexpr std::uint32_t kInterruptClear = kBase + 0x0C, kBaudDivider = kBase + 0x10;
inline constexpr std::uint32_t kTransmitFull = 1U << 0, kReceiveFull = 1U << 1, kReceiveOverrun = 1U << 3;
inline constexpr std::uint32_t kTransmitEnable = 1U << 0, kReceiveEnable = 1U << 1;
inline constexpr std::uint32_t kTransmitInterrupt = 1U << 2, kReceiveInterrupt = 1U << 3;
inline constexpr std::uint32_t kTransmitInterruptBit = 1U << 0, kReceiveInterruptBit = 1U << 1;
inline constexpr std::uint32_t kReceiveInterruptNumber = 0, kTransmitInterruptNumber = 1;
/// The smallest divider that the part allows: 1.5625 Mbaud.
inline constexpr std::uint32_t kFastest = 16;
}  // namespace uart0

namespace watchdog {
inline constexpr std::uint32_t kBase = 0x40008000U;
inline constexpr std::uint32_t kLoad = kBase + 0x000, kControl = kBase + 0x008,
                               kInterruptClear = kBase + 0x00C;
inline constexpr std::uint32_t kLock = kBase + 0xC00;
inline constexpr std::uint32_t kKey = 0x1ACCE551U, kInterruptAndReset = 3U;
}  // namespace watchdog

/// The counter of the FPGA system: +1 each time that a counter of core cycles has run through `kPrescale`.
namespace fpga {
inline constexpr std::uint32_t kCounter = 0x40028018U, kPrescale = 0x4002801CU;
inline constexpr std::uint32_t kLeds = 0x40028000U;
}  // namespace fpga

}  // namespace morepro::firmware::mps2
