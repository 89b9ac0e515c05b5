#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/boards/almec/f405_clock.hpp"
#include "firmware/boards/almec/f405_flash.hpp"
#include "firmware/boards/almec/f405_usart.hpp"
#include "firmware/boards/almec/f405_watchdog.hpp"
#include "firmware/boards/cortex_m/core.hpp"
#include "firmware/frame_link.hpp"
#include "firmware/ring_source.hpp"
#include "firmware/uart_link.hpp"
#include "hal/board.hpp"
#include "hal/two_slot_store.hpp"

namespace morepro::firmware::almec {

/// The data board: frames come over USART1 and health goes back over it, configuration in the last flash
/// sectors. One object; the interrupt handlers work on its link.
class AlmecBoard {
 public:
  using Link = UartLink<f405::Usart1<Mmio>, core::InterruptLock>;
  using Frames = FrameLink<RingSource<Link>>;

  /// Clock, outputs, time, line, watchdog. Interrupts are on afterwards.
  AlmecBoard();

  std::uint32_t now_us() { return Mmio::read(f405::tim2::kCnt); }
  /// Sleeps until the next interrupt (at the latest the 1 ms tick) where nothing has come.
  hal::ReadStatus read_frame(SensorFrame& frame);
  bool send(std::span<const std::uint8_t> message);
  std::size_t load(std::span<std::uint8_t> buffer) { return store_.load(buffer); }
  /// Stalls for up to 2 s while the part erases a sector: only while the machine stands.
  bool store(std::span<const std::uint8_t> record);
  void kick_watchdog() { watchdog_.kick(); }
  void enter_safe_state();
  hal::ResetCause reset_cause() { return reset_cause_; }

  /// For test images: as read_frame(), but it believes an End that comes over the line.
  hal::ReadStatus read_line(SensorFrame& frame);
  Frames& frames() { return frames_; }

 private:
  static constexpr std::size_t kStoreBytes = 1024;

  hal::ResetCause reset_cause_;
  f405::Watchdog<Mmio> watchdog_;
  f405::StoreFlash<Mmio> flash_;
  hal::TwoSlotStore<f405::StoreFlash<Mmio>, kStoreBytes> store_{flash_};
  RingSource<Link> source_;
  Frames frames_{source_};
};

static_assert(hal::Board<AlmecBoard>);

}  // namespace morepro::firmware::almec
