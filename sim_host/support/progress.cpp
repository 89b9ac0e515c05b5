#include "sim_host/support/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <utility>

#include "sim_host/support/terminal.hpp"

namespace morepro::host {

Progress::Progress(std::string label, std::uint64_t total, bool is_on)
    : label_(std::move(label)),
      total_(total),
      is_on_(is_on && total > 0),
      is_terminal_(is_terminal(STDERR_FILENO)) {}

Progress::~Progress() {
  if (has_line_) fmt::print(stderr, "\r\033[K");
}

void Progress::show() {
  const auto now = Clock::now();
  const std::uint64_t tenths = 10 * done_ / total_;
  if (now < next_ || (!is_terminal_ && tenths == shown_tenths_)) return;
  next_ = now + std::chrono::milliseconds(200);
  shown_tenths_ = tenths;
  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  const double share = static_cast<double>(done_) / static_cast<double>(total_);
  const std::string line =
      fmt::format("{}: {:.0f} %, {:.0f} frames/s, {:.0f} s left", label_, 100.0 * share,
                  static_cast<double>(done_) / elapsed_s, elapsed_s * (1.0 / share - 1.0));
  fmt::print(stderr, "{}{}{}", is_terminal_ ? "\r\033[K" : "", line, is_terminal_ ? "" : "\n");
  std::fflush(stderr);
  has_line_ = is_terminal_;
}

StageProgress::StageProgress(std::string label, bool is_on)
    : label_(std::move(label)), is_on_(is_on), is_terminal_(is_terminal(STDERR_FILENO)) {}

StageProgress::~StageProgress() {
  if (has_line_) fmt::print(stderr, "\r\033[K");
}

void StageProgress::show(std::string_view stage, double share) {
  if (!is_on_) return;
  const auto now = Clock::now();
  const int tenths = static_cast<int>(10.0 * share);
  if (stage != stage_) {
    stage_ = stage;
    stage_start_ = now;
    shown_tenths_ = -1;
  }
  if (now < next_ || (!is_terminal_ && tenths == shown_tenths_)) return;
  // A log is read afterwards: a line a second is enough of it.
  next_ = now + std::chrono::milliseconds(is_terminal_ ? 200 : 1000);
  shown_tenths_ = tenths;
  fmt::print(stderr, "{}{}: {}{}{}", is_terminal_ ? "\r\033[K" : "", label_, stage, left(share, now),
             is_terminal_ ? "" : "\n");
  std::fflush(stderr);
  has_line_ = is_terminal_;
}

/// ", 40 %, 3 s left"; nothing before there is something to judge by.
std::string StageProgress::left(double share, Clock::time_point now) const {
  constexpr double kTooSoonS = 0.3;
  const double elapsed_s = std::chrono::duration<double>(now - stage_start_).count();
  if (!(share > 0.0) || elapsed_s < kTooSoonS) return {};
  return fmt::format(", {:.0f} %, {:.0f} s left", 100.0 * share, elapsed_s * (1.0 / share - 1.0));
}

}  // namespace morepro::host
