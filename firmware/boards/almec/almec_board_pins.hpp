#pragma once
#include <cstdint>

/// Everything that is AL.MEC's own. The maker publishes no pinout of the data board: these are assumptions
/// for a board with an STM32F405-class part, to be checked against the real one. Nothing else in this port
/// depends on the board, only on the part.
namespace morepro::firmware::almec {

inline constexpr std::uint32_t kCrystalHz = 8'000'000;

/// USART1 on port A; with the request-to-send and clear-to-send lines the sender can be held, which the
/// back-pressure of the receive ring relies on.
inline constexpr std::uint32_t kLinkTransmitPin = 9;
inline constexpr std::uint32_t kLinkReceivePin = 10;
inline constexpr std::uint32_t kLinkClearToSendPin = 11;
inline constexpr std::uint32_t kLinkRequestToSendPin = 12;
/// Divides the 84 MHz of the bus without remainder; 840 kB/s: at 10 kHz 84 B per frame, the longest has 73.
inline constexpr std::uint32_t kLinkBaud = 8'400'000;

/// Port B; high lets the machine's stop request rest, low raises it. The reset state of the pin with the
/// pull-down resistor of the safe side is the same as enter_safe_state().
inline constexpr std::uint32_t kReleasePin = 0;

/// A step takes less than a sampling period; ten times the longest sampling period (100 Hz) means that it
/// hangs.
inline constexpr std::uint32_t kWatchdogMs = 100;

}  // namespace morepro::firmware::almec
