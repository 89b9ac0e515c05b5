#pragma once
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>

namespace morepro::host {

/// A recording and a file for the answers, as firmware::BlockFiles.
class FileBlocks {
 public:
  /// ok() tells whether both could be opened.
  FileBlocks(const char* input, const char* output)
      : input_(std::fopen(input, "rb")), output_(std::fopen(output, "wb")) {}

  [[nodiscard]] bool ok() const { return input_ && output_; }
  std::size_t read(std::span<std::uint8_t> buffer) {
    return std::fread(buffer.data(), 1, buffer.size(), input_.get());
  }
  bool write(std::span<const std::uint8_t> bytes) {
    return std::fwrite(bytes.data(), 1, bytes.size(), output_.get()) == bytes.size();
  }
  std::uint32_t now_us() {
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    return static_cast<std::uint32_t>(std::chrono::duration_cast<std::chrono::microseconds>(since).count());
  }
  /// True when everything reached the file.
  bool close() { return std::fclose(output_.release()) == 0; }

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> input_;
  std::unique_ptr<std::FILE, Close> output_;
};

}  // namespace morepro::host
