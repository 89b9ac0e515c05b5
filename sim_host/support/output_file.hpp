#pragma once
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace morepro::host {

/// A file that appears whole or not at all: bytes go to a temporary file beside it, commit() renames it. What
/// is no regular file (a pipe, a device) and "-" (standard output) are written to directly. Every function
/// throws UserError when the operating system refuses.
class OutputFile {
 public:
  explicit OutputFile(std::string path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);
  void write(std::span<const std::uint8_t> bytes);
  /// Makes the file visible under its name. Without it nothing is left behind.
  void commit();
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const;
  };
  void open_temporary();
  [[noreturn]] void refuse(int reason) const;

  std::string path_;
  std::string target_;
  std::string temporary_;
  std::unique_ptr<std::FILE, Close> file_;
};

/// None where `path` is empty.
std::unique_ptr<OutputFile> open_if_asked(const std::string& path);

}  // namespace morepro::host
