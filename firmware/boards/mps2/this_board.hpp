#pragma once
#include "firmware/boards/mps2/mps2_board.hpp"
#include "hal/conformance.hpp"

/// The names under which the images know the board that they are built for.
namespace morepro::firmware {

using ThisBoard = mps2::Mps2Board;

inline constexpr hal::Capabilities kEmulatedCapabilities{};

/// Time without the rest of the board, for images whose files come over semihosting.
struct BareTime {
  static void start() { Mmio::write(mps2::fpga::kPrescale, mps2::kCoreHz / 1'000'000 - 1); }
  static std::uint32_t now_us() { return Mmio::read(mps2::fpga::kCounter); }
};

}  // namespace morepro::firmware
