#pragma once
#include <cstddef>
#include <cstdint>
#include <span>

#include "firmware/semihosting/semihost.hpp"
#include "this_board.hpp"

namespace morepro::firmware {

/// A recording and a file for the answers on the machine that hosts the debugger or emulator.
class SemihostFiles {
 public:
  SemihostFiles(const char* input, const char* output)
      : input_(semihost::open(input, semihost::OpenMode::kRead)),
        output_(semihost::open(output, semihost::OpenMode::kWrite)) {}

  [[nodiscard]] bool ok() const { return input_ >= 0 && output_ >= 0; }
  std::size_t read(std::span<std::uint8_t> buffer) { return semihost::read(input_, buffer); }
  bool write(std::span<const std::uint8_t> bytes) { return semihost::write(output_, bytes); }
  std::uint32_t now_us() { return BareTime::now_us(); }
  void close() { semihost::close(output_); }

 private:
  int input_;
  int output_;
};

}  // namespace morepro::firmware
