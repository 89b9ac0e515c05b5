#pragma once
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

namespace morepro::host {

/// How far a long job is, on stderr: a line that rewrites itself on a terminal, a line per tenth elsewhere.
/// Silent for jobs of less than a second.
class Progress {
 public:
  /// `total` 0: unknown, nothing is shown.
  Progress(std::string label, std::uint64_t total, bool is_on);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Cheap: looks at the clock every few thousand calls only.
  void advance() {
    if (is_on_ && ++done_ % kStride == 0) show();
  }

 private:
  static constexpr std::uint64_t kStride = 8192;
  using Clock = std::chrono::steady_clock;
  void show();

  std::string label_;
  std::uint64_t total_;
  bool is_on_;
  bool is_terminal_;
  bool has_line_ = false;
  std::uint64_t done_ = 0;
  std::uint64_t shown_tenths_ = 0;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_ = start_ + std::chrono::seconds(1);
};

/// The same for a job whose stages are known and whose length is not: a stage's share and what is left of it
/// on a terminal, a line per stage elsewhere.
class StageProgress {
 public:
  explicit StageProgress(std::string label, bool is_on);
  ~StageProgress();
  StageProgress(const StageProgress&) = delete;
  StageProgress& operator=(const StageProgress&) = delete;

  /// `share` of the stage that is done, 0 .. 1.
  void show(std::string_view stage, double share);

 private:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] std::string left(double share, Clock::time_point now) const;

  std::string label_;
  bool is_on_;
  bool is_terminal_;
  bool has_line_ = false;
  std::string stage_;
  int shown_tenths_ = -1;
  Clock::time_point stage_start_ = Clock::now();
  Clock::time_point next_ = Clock::now() + std::chrono::seconds(1);
};

}  // namespace morepro::host
