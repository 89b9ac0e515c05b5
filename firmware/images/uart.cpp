#include "firmware/app.hpp"
#include "firmware/line_test_board.hpp"
#include "this_board.hpp"

/// The product's board and drivers with a test harness at the other end of the line: every frame is answered,
/// End ends the run and the image rests.
int main() {
  using namespace morepro::firmware;
  static ThisBoard board;
  static LineTestBoard<ThisBoard> line(board);
  static App<LineTestBoard<ThisBoard>> app(line, {.build_id = MOREPRO_BUILD_ID});
  app.run();
  while (true) {
    board.kick_watchdog();
    (void)board.send({});
  }
}
