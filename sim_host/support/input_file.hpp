#pragma once
#include <string>
#include <string_view>

namespace morepro::host {

/// The bytes of a file, read-only: mapped where the operating system can, read into memory where it is a
/// pipe.
class InputFile {
 public:
  /// Throws UserError where the file cannot be opened or is a directory.
  explicit InputFile(const std::string& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  [[nodiscard]] std::string_view text() const { return text_; }

 private:
  std::string copy_;
  std::string_view text_;
  void* mapping_ = nullptr;
};

}  // namespace morepro::host
