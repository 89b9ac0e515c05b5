#include "sim_host/support/file_window.hpp"

#include <algorithm>

namespace morepro::host {
namespace {

constexpr std::size_t kBlock = std::size_t{1} << 20U;

}  // namespace

FileWindow::FileWindow(const std::string& path) : file_(path) {
  if (file_.is_regular()) {
    to_read_ = file_.size();
    window_.resize(std::min(to_read_, kBlock));
  } else {
    keep_all();
  }
}

void FileWindow::rewind() {
  if (file_.is_regular()) {
    file_.rewind();
    to_read_ = file_.size();
    read_ = 0;
    ahead_ = {};
  } else {
    ahead_ = window_;
  }
}

void FileWindow::read_on() {
  std::copy(ahead_.begin(), ahead_.end(), window_.begin());
  const std::size_t wanted = std::min(window_.size() - ahead_.size(), to_read_);
  const std::size_t got = file_.read({window_.data() + ahead_.size(), wanted});
  ahead_ = {window_.data(), ahead_.size() + got};
  read_ += got;
  to_read_ = got < wanted ? 0 : to_read_ - got;
}

void FileWindow::keep_all() {
  std::size_t filled = 0;
  do {
    window_.resize(filled + kBlock);
    filled += file_.read({window_.data() + filled, kBlock});
  } while (filled == window_.size());
  window_.resize(filled);
  ahead_ = window_;
  read_ = filled;
}

}  // namespace morepro::host
