#include "lib/c/morepro_monitor.h"
#include "tests/target/count/count.hpp"
#include "tests/target/count/recorded_frames.hpp"

namespace morepro::count {
namespace {

struct Board {
  RecordedFrames frames;
  morepro_monitor monitor{};

  Board() {
    const morepro_configuration configuration = morepro_reference_configuration();
    if (morepro_monitor_create(&monitor, &configuration, nullptr) != MOREPRO_OK) firmware::semihost::exit(5);
  }
};

Board* board = nullptr;
morepro_frame frame;
morepro_health health;

void next_frame() {
  static SensorFrame recorded;
  board = InTurn<Board>::get();
  board->frames.next(recorded);
  frame.sequence = recorded.sequence;
  frame.time_us = recorded.time_us;
  frame.present = recorded.present;
  for (std::size_t i = 0; i < kChannelCount; ++i) frame.value[i] = recorded.value[i];
}

void step_monitor() {
  (void)morepro_monitor_step(&board->monitor, &frame, &health);
  keep(health);
}

/// The same frames as for monitor_step: the difference is what the interface for C adds.
const Entry kStep{"morepro_monitor_step", 1, next_frame, step_monitor, kManyFrames};

}  // namespace
}  // namespace morepro::count
