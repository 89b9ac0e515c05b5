#include "sim_host/support/input_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

class Descriptor {
 public:
  explicit Descriptor(const std::string& path) : fd_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~Descriptor() {
    if (fd_ >= 0) close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int get() const { return fd_; }

 private:
  int fd_;
};

[[noreturn]] void refuse(const std::string& path, int reason) {
  throw UserError(
      fmt::format("cannot read {}: {}; check the path", path.empty() ? "''" : path, std::strerror(reason)));
}

std::string read_all(const std::string& path, int fd) {
  std::string all;
  std::array<char, 65536> block{};
  ssize_t count = 0;
  while ((count = read(fd, block.data(), block.size())) > 0)
    all.append(block.data(), static_cast<std::size_t>(count));
  if (count < 0) refuse(path, errno);
  return all;
}

}  // namespace

InputFile::InputFile(const std::string& path) {
  const Descriptor descriptor(path);
  struct stat status {};
  if (descriptor.get() < 0 || fstat(descriptor.get(), &status) != 0) refuse(path, errno);
  if (S_ISDIR(status.st_mode)) refuse(path, EISDIR);
  const auto size = static_cast<std::size_t>(status.st_size);
  if (S_ISREG(status.st_mode) && size > 0) {
    mapping_ = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor.get(), 0);
    if (mapping_ == MAP_FAILED) refuse(path, errno);
    madvise(mapping_, size, MADV_SEQUENTIAL);
    text_ = {static_cast<const char*>(mapping_), size};
  } else {
    copy_ = read_all(path, descriptor.get());
    text_ = copy_;
  }
}

InputFile::~InputFile() {
  if (mapping_ != nullptr) munmap(mapping_, text_.size());
}

}  // namespace morepro::host
