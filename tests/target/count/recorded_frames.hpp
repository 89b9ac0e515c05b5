#pragma once
#include "firmware/block_board.hpp"
#include "firmware/semihosting/semihost.hpp"
#include "tests/target/count/count.hpp"

namespace morepro::count {

/// Counted calls with one frame each. The work on the gap goes round in some 11,300 frames: all of it is
/// seen.
inline constexpr std::uint32_t kManyFrames = 17000;

/// The frames of the recording that the image was started with, from the first one on.
class RecordedFrames {
 public:
  /// The image ends with status 4 where the recording is too short.
  void next(SensorFrame& frame) {
    while (true) {
      const hal::ReadStatus status = link_.read_frame(frame);
      if (status == hal::ReadStatus::kFrame) return;
      if (status == hal::ReadStatus::kEnd) firmware::semihost::exit(4);
    }
  }

 private:
  /// The recording, without anything to write to.
  struct Input {
    int file = firmware::semihost::open(recording(), firmware::semihost::OpenMode::kRead);
    std::size_t read(std::span<std::uint8_t> buffer) { return firmware::semihost::read(file, buffer); }
    bool write(std::span<const std::uint8_t>) { return true; }
    std::uint32_t now_us() { return 0; }
  };

  Input input_;
  firmware::BlockSource<Input> source_{input_};
  firmware::FrameLink<firmware::BlockSource<Input>> link_{source_};
};

}  // namespace morepro::count
