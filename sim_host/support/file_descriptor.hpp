#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace morepro::host {

/// A file open for reading.
class FileDescriptor {
 public:
  /// Throws UserError where the file cannot be opened or is a directory.
  explicit FileDescriptor(const std::string& path);
  ~FileDescriptor();
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;

  [[nodiscard]] int get() const { return fd_; }
  /// A file that can be mapped and read again, not a pipe.
  [[nodiscard]] bool is_regular() const { return is_regular_; }
  /// Of a regular file when it was opened, in bytes.
  [[nodiscard]] std::size_t size() const { return size_; }

  /// The next bytes, as many as there are room for; fewer only at the end. Throws UserError.
  std::size_t read(std::span<std::uint8_t> room);
  void rewind();

  /// Throws UserError with what `errno` says.
  [[noreturn]] void refuse() const;

 private:
  std::string path_;
  int fd_;
  bool is_regular_ = false;
  std::size_t size_ = 0;
};

}  // namespace morepro::host
