#pragma once
#include "firmware/boards/almec/almec_board.hpp"
#include "hal/conformance.hpp"

/// The names under which the images know the board that they are built for.
namespace morepro::firmware {

using ThisBoard = almec::AlmecBoard;

/// QEMU has no flash controller for this part: there store() must refuse, after it read back.
inline constexpr hal::Capabilities kEmulatedCapabilities{.stores = false};

/// Time without the rest of the board, for images whose files come over semihosting.
struct BareTime {
  static void start() { f405::start_microseconds<Mmio>(f405::kInternalOscillator); }
  static std::uint32_t now_us() { return Mmio::read(f405::tim2::kCnt); }
};

}  // namespace morepro::firmware
