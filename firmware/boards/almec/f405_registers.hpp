#pragma once
#include <cstdint>

/// Addresses and bits of the STM32F405 that this port uses (reference manual RM0090).
namespace morepro::firmware::f405 {

namespace rcc {
inline constexpr std::uint32_t kBase = 0x40023800U;
inline constexpr std::uint32_t kCr = kBase + 0x00, kPllCfgr = kBase + 0x04, kCfgr = kBase + 0x08;
inline constexpr std::uint32_t kAhb1Enr = kBase + 0x30, kApb1Enr = kBase + 0x40, kApb2Enr = kBase + 0x44;
inline constexpr std::uint32_t kCsr = kBase + 0x74;
inline constexpr std::uint32_t kHseOn = 1U << 16, kHseReady = 1U << 17, kPllOn = 1U << 24,
                               kPllReady = 1U << 25;
inline constexpr std::uint32_t kPllFromHse = 1U << 22;
inline constexpr std::uint32_t kSwitchMask = 3U, kSwitchPll = 2U, kStatusMask = 3U << 2, kStatusPll = 2U << 2;
inline constexpr std::uint32_t kApb1By4 = 5U << 10, kApb2By2 = 4U << 13;
inline constexpr std::uint32_t kGpioAEnable = 1U << 0, kGpioBEnable = 1U << 1;
inline constexpr std::uint32_t kTim2Enable = 1U << 0, kUsart1Enable = 1U << 4;
inline constexpr std::uint32_t kRemoveResetFlags = 1U << 24, kPowerOnReset = 1U << 27,
                               kSoftwareReset = 1U << 28;
inline constexpr std::uint32_t kWatchdogReset = 1U << 29;
}  // namespace rcc

namespace flash {
inline constexpr std::uint32_t kBase = 0x40023C00U;
inline constexpr std::uint32_t kAcr = kBase + 0x00, kKeyR = kBase + 0x04, kSr = kBase + 0x0C,
                               kCr = kBase + 0x10;
inline constexpr std::uint32_t kKey1 = 0x45670123U, kKey2 = 0xCDEF89ABU;
inline constexpr std::uint32_t kProgram = 1U << 0, kSectorErase = 1U << 1, kWordSize = 2U << 8,
                               kStart = 1U << 16;
inline constexpr std::uint32_t kLock = 1U << 31, kBusy = 1U << 16, kErrors = 0xF2U;
inline constexpr std::uint32_t kSectorShift = 3;
inline constexpr std::uint32_t kLatency5 = 5U, kPrefetch = 1U << 8, kInstructionCache = 1U << 9;
inline constexpr std::uint32_t kDataCache = 1U << 10, kDataCacheReset = 1U << 12;
}  // namespace flash

namespace usart1 {
inline constexpr std::uint32_t kBase = 0x40011000U;
inline constexpr std::uint32_t kSr = kBase + 0x00, kDr = kBase + 0x04, kBrr = kBase + 0x08;
inline constexpr std::uint32_t kCr1 = kBase + 0x0C, kCr3 = kBase + 0x14;
inline constexpr std::uint32_t kOverrun = 1U << 3, kReceived = 1U << 5, kTransmitEmpty = 1U << 7;
inline constexpr std::uint32_t kReceiveEnable = 1U << 2, kTransmitEnable = 1U << 3,
                               kReceiveInterrupt = 1U << 5;
inline constexpr std::uint32_t kTransmitInterrupt = 1U << 7, kUsartEnable = 1U << 13,
                               kOversampleBy8 = 1U << 15;
inline constexpr std::uint32_t kRequestToSend = 1U << 8, kClearToSend = 1U << 9;
inline constexpr std::uint32_t kInterrupt = 37;
}  // namespace usart1

namespace tim2 {
inline constexpr std::uint32_t kBase = 0x40000000U;
inline constexpr std::uint32_t kCr1 = kBase + 0x00, kEgr = kBase + 0x14, kCnt = kBase + 0x24,
                               kPsc = kBase + 0x28;
inline constexpr std::uint32_t kArr = kBase + 0x2C, kEnable = 1U << 0, kUpdate = 1U << 0;
}  // namespace tim2

namespace iwdg {
inline constexpr std::uint32_t kBase = 0x40003000U;
inline constexpr std::uint32_t kKr = kBase + 0x00, kPr = kBase + 0x04, kRlr = kBase + 0x08,
                               kSr = kBase + 0x0C;
inline constexpr std::uint32_t kStart = 0xCCCCU, kUnlock = 0x5555U, kReload = 0xAAAAU;
inline constexpr std::uint32_t kOscillatorHz = 32'000;
}  // namespace iwdg

namespace gpio {
inline constexpr std::uint32_t kA = 0x40020000U, kB = 0x40020400U;
inline constexpr std::uint32_t kMode = 0x00, kSpeed = 0x08, kSetReset = 0x18, kAlternateHigh = 0x24;
}  // namespace gpio

}  // namespace morepro::firmware::f405
