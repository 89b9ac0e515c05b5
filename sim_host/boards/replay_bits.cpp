#include <cstdio>
#include <memory>

#include "firmware/app.hpp"
#include "sim_host/boards/recording_board.hpp"

namespace {

using morepro::firmware::App;
using morepro::host::FileBlocks;
using morepro::host::RecordingBoard;

int replay(const char* input, const char* output) {
  FileBlocks files(input, output);
  if (!files.ok()) {
    std::fprintf(stderr, "cannot open %s or cannot write %s\n", input, output);
    return 1;
  }
  const auto board = std::make_unique<RecordingBoard>(files);
  const auto app = std::make_unique<App<RecordingBoard>>(*board);
  const bool complete = app->run() && board->flush() && files.close() && app->counters().dropped_sends == 0;
  std::printf("frames %lu\ncorrupt %lu\n", static_cast<unsigned long>(app->counters().frames),
              static_cast<unsigned long>(app->counters().corrupt));
  return complete ? 0 : 1;
}

}  // namespace

/// replay_bits IN.mrec OUT.health: what the replay image of a board does, with the same loop and the same
/// monitor. Needs nothing but this repository, so that it builds for every architecture.
int main(int count, char** arguments) {
  if (count == 3) return replay(arguments[1], arguments[2]);
  std::fputs("usage: replay_bits RECORDING ANSWERS\n", stderr);
  return 2;
}
