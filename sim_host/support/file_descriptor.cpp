#include "sim_host/support/file_descriptor.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "sim_host/support/user_error.hpp"

namespace morepro::host {

FileDescriptor::FileDescriptor(const std::string& path)
    : path_(path), fd_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
  if (fd_ < 0) refuse();
  struct stat status {};
  int fault = fstat(fd_, &status) != 0 ? errno : 0;
  if (fault == 0 && S_ISDIR(status.st_mode)) fault = EISDIR;
  if (fault != 0) {
    close(fd_);
    errno = fault;
    refuse();
  }
  is_regular_ = S_ISREG(status.st_mode);
  if (is_regular_) size_ = static_cast<std::size_t>(status.st_size);
}

FileDescriptor::~FileDescriptor() { close(fd_); }

std::size_t FileDescriptor::read(std::span<std::uint8_t> room) {
  std::size_t filled = 0;
  while (filled < room.size()) {
    const ssize_t count = ::read(fd_, room.data() + filled, room.size() - filled);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuse();
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
  }
  return filled;
}

void FileDescriptor::rewind() {
  if (lseek(fd_, 0, SEEK_SET) != 0) refuse();
}

void FileDescriptor::refuse() const {
  throw UserError(
      fmt::format("cannot read {}: {}; check the path", path_.empty() ? "''" : path_, std::strerror(errno)));
}

}  // namespace morepro::host
