#include <array>
#include <cstring>

#include "firmware/app.hpp"
#include "firmware/block_board.hpp"
#include "firmware/boards/cortex_m/stack_paint.hpp"
#include "firmware/semihosting/semihost_files.hpp"

namespace morepro::firmware {
namespace {

void print_figure(const char* name, std::uint32_t value) {
  semihost::print(name);
  semihost::print(" ");
  semihost::print(value);
  semihost::print("\n");
}

int replay(const char* input, const char* output) {
  static SemihostFiles files(input, output);
  if (!files.ok()) return 1;
  static BlockBoard<SemihostFiles> board(files);
  static App<BlockBoard<SemihostFiles>> app(board);
  const bool complete = app.run() && board.flush() && app.counters().dropped_sends == 0;
  files.close();
  print_figure("frames", app.counters().frames);
  print_figure("corrupt", app.counters().corrupt);
  print_figure("sizeof_monitor", sizeof(BoardMonitor));
  print_figure("sizeof_app", sizeof(app));
  print_figure("painted_stack", painted_stack_used());
  return complete ? 0 : 1;
}

}  // namespace
}  // namespace morepro::firmware

/// Arguments: the recording, the file for the answers.
int main() {
  using namespace morepro::firmware;
  paint_stack();
  BareTime::start();
  static std::array<char, 1024> arguments{};
  if (!semihost::command_line(arguments)) semihost::exit(2);
  semihost::exit(replay(arguments.data(), arguments.data() + std::strlen(arguments.data()) + 1));
}
