#include "firmware/app.hpp"
#include "this_board.hpp"

int main() {
  using namespace morepro::firmware;
  static ThisBoard board;
  // 100 answers per second at 10 kHz: a screen and an alarm need no more, and the line stays free.
  static App<ThisBoard> app(board, {.health_every_frames = 100, .build_id = MOREPRO_BUILD_ID});
  app.run();
}
