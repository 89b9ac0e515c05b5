#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sim_host/support/file_descriptor.hpp"

namespace morepro::host {

/// The bytes of a file from the first to the last, through a window in memory: a block that is read costs a
/// tenth of pages that are mapped one by one, and a recording is read faster than those. A pipe is kept
/// whole, because it cannot be read twice.
class FileWindow {
 public:
  /// Throws UserError where the file cannot be opened or is a directory.
  explicit FileWindow(const std::string& path);

  /// What comes next; take from its front. At least kAhead bytes, fewer only at the end of the file as long
  /// as it was when it was opened. Throws UserError where it cannot be read.
  std::span<const std::uint8_t>& ahead() {
    if (ahead_.size() < kAhead && to_read_ > 0) read_on();
    return ahead_;
  }
  /// Of the first byte that is not taken.
  [[nodiscard]] std::uint64_t offset() const { return read_ - ahead_.size(); }
  void rewind();

  static constexpr std::size_t kAhead = 4096;

 private:
  void read_on();
  void keep_all();

  FileDescriptor file_;
  std::vector<std::uint8_t> window_;
  std::span<const std::uint8_t> ahead_;
  std::uint64_t read_ = 0;
  std::size_t to_read_ = 0;
};

}  // namespace morepro::host
