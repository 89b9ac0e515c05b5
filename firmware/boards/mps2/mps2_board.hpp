#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/boards/cortex_m/core.hpp"
#include "firmware/boards/mps2/cmsdk_uart.hpp"
#include "firmware/boards/mps2/preserved_store.hpp"
#include "firmware/frame_link.hpp"
#include "firmware/ring_source.hpp"
#include "firmware/uart_link.hpp"
#include "hal/board.hpp"
#include "hal/two_slot_store.hpp"

namespace morepro::firmware::mps2 {

/// MPS2 with AN386 (Cortex-M4F) or AN500 (Cortex-M7): frames and health over UART0, configuration in RAM that
/// survives a reset, the watchdog of the part. One object; the interrupt handlers work on its link.
class Mps2Board {
 public:
  using Link = UartLink<Uart0<Mmio>, core::InterruptLock>;
  using Frames = FrameLink<RingSource<Link>>;

  /// Outputs, time, line, watchdog. Interrupts are on afterwards.
  Mps2Board();

  std::uint32_t now_us() { return Mmio::read(fpga::kCounter); }
  /// Sleeps until the next interrupt (at the latest the 1 ms tick) where nothing has come.
  hal::ReadStatus read_frame(SensorFrame& frame);
  bool send(std::span<const std::uint8_t> message);
  std::size_t load(std::span<std::uint8_t> buffer) { return store_.load(buffer); }
  bool store(std::span<const std::uint8_t> record) { return store_.store(record); }
  void kick_watchdog() { Mmio::write(watchdog::kInterruptClear, 1); }
  void enter_safe_state();
  hal::ResetCause reset_cause() { return reset_cause_; }

  /// For test images: as read_frame(), but it believes an End that comes over the line.
  hal::ReadStatus read_line(SensorFrame& frame);
  Frames& frames() { return frames_; }

 private:
  static constexpr std::size_t kStoreBytes = 1024;

  hal::ResetCause reset_cause_;
  PreservedStore memory_;
  hal::TwoSlotStore<PreservedStore, kStoreBytes> store_{memory_};
  RingSource<Link> source_;
  Frames frames_{source_};
};

static_assert(hal::Board<Mps2Board>);

}  // namespace morepro::firmware::mps2
