#include "sim_host/support/output_file.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

constexpr std::size_t kBufferBytes = 1U << 20;

bool is_written_directly(const std::string& path) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

// A symbolic link stays one: the file that it points to is replaced.
std::string resolved(const std::string& path) {
  std::error_code error;
  const auto target = std::filesystem::canonical(path, error);
  return error ? path : target.string();
}

}  // namespace

void OutputFile::Close::operator()(std::FILE* file) const {
  if (file != stdout) std::fclose(file);
}

OutputFile::OutputFile(std::string path) : path_(std::move(path)), target_(resolved(path_)) {
  if (path_ == "-") {
    file_.reset(stdout);
  } else if (is_written_directly(path_)) {
    file_.reset(std::fopen(path_.c_str(), "wb"));
    if (!file_) refuse(errno);
  } else {
    open_temporary();
  }
}

void OutputFile::open_temporary() {
  if (std::filesystem::is_directory(target_)) refuse(EISDIR);
  temporary_ = fmt::format("{}.{}.partial", target_, getpid());
  file_.reset(std::fopen(temporary_.c_str(), "wbx"));
  if (!file_) {
    const int reason = errno;
    temporary_.clear();
    refuse(reason);
  }
  std::setvbuf(file_.get(), nullptr, _IOFBF, kBufferBytes);
}

OutputFile::~OutputFile() {
  file_.reset();
  if (!temporary_.empty()) std::remove(temporary_.c_str());
}

void OutputFile::write(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) refuse(errno);
}

void OutputFile::write(std::span<const std::uint8_t> bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) refuse(errno);
}

void OutputFile::commit() {
  if (std::fflush(file_.get()) != 0) refuse(errno);
  if (temporary_.empty()) return;
  file_.reset();
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) refuse(errno);
  temporary_.clear();
}

void OutputFile::refuse(int reason) const {
  throw UserError(
      fmt::format("cannot write {}: {}; choose a path in an existing folder with room and write permission",
                  path_ == "-"    ? "to standard output"
                  : path_.empty() ? "''"
                                  : path_,
                  std::strerror(reason)));
}

std::unique_ptr<OutputFile> open_if_asked(const std::string& path) {
  return path.empty() ? nullptr : std::make_unique<OutputFile>(path);
}

}  // namespace morepro::host
