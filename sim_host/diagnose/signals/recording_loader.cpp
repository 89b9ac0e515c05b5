#include "sim_host/diagnose/signals/recording_loader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

// An hour at 20 kHz fits; a file of a few rows that are days apart must not take all memory.
constexpr std::size_t kMostRows = 200'000'000;
constexpr double kMostGaps = 4.0;

bool is_possible(std::size_t channel, float value) {
  const ChannelInfo& info = kChannels[channel];
  return value >= info.lowest && value <= info.highest;
}

class Loader {
 public:
  Loader(RecordingReader& recording, std::uint16_t usable) : recording_(recording), usable_(usable) {
    signals_.rate_hz = recording.info().rate_hz;
    signals_.start_s = static_cast<double>(recording.info().start_us) * 1.0e-6;
  }

  RecordingSignals load() {
    SensorFrame frame;
    for (;;) {
      const hal::ReadStatus status = recording_.next(frame);
      if (status == hal::ReadStatus::kEnd) break;
      if (status == hal::ReadStatus::kFrame) take(frame);
    }
    for (auto& column : signals_.value)
      if (!column.empty()) column.resize(signals_.rows, kMissing);
    signals_.missing_rows = signals_.rows - frames_;
    count_cutting_time(signals_);
    return std::move(signals_);
  }

 private:
  static constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

  std::size_t row_of(const SensorFrame& frame) {
    if (frames_ == 0) last_us_ = frame.time_us;
    elapsed_us_ += static_cast<double>(frame.time_us - last_us_);  // unsigned: right across the wrap
    last_us_ = frame.time_us;
    const double row = std::round(elapsed_us_ * 1.0e-6 * signals_.rate_hz);
    if (row > static_cast<double>(kMostRows) || row > kMostGaps * static_cast<double>(frames_) + 1.0e6)
      throw UserError(fmt::format("{}: more rows are missing than there are; cut the recording at its gaps",
                                  recording_.info().file));
    return std::max(static_cast<std::size_t>(row), signals_.rows);
  }

  void take(const SensorFrame& frame) {
    const std::size_t row = row_of(frame);
    ++frames_;
    signals_.rows = row + 1;
    for (std::size_t i = 0; i < kChannelCount; ++i) {
      const auto channel = static_cast<Channel>(i);
      if (!frame.has(channel) || (usable_ & bit_of(channel)) == 0) continue;
      if (!is_possible(i, frame.value[i])) {
        if (!std::isnan(frame.value[i])) ++signals_.impossible[i];
        continue;
      }
      auto& column = signals_.value[i];
      column.resize(row, kMissing);
      column.push_back(frame.value[i]);
      signals_.recorded = static_cast<std::uint16_t>(signals_.recorded | bit_of(channel));
    }
  }

  RecordingReader& recording_;
  std::uint16_t usable_;
  RecordingSignals signals_;
  std::size_t frames_ = 0;
  std::uint32_t last_us_ = 0;
  double elapsed_us_ = 0.0;
};

}  // namespace

RecordingSignals load_signals(RecordingReader& recording, std::uint16_t usable) {
  return Loader(recording, usable).load();
}

std::vector<std::string> impossible_samples(const RecordingSignals& signals) {
  std::vector<std::string> notices;
  for (std::size_t i = 0; i < kChannelCount; ++i) {
    if (signals.impossible[i] == 0) continue;
    const ChannelInfo& info = kChannels[i];
    const auto& taken = signals.value[i];
    const auto possible = std::count_if(taken.begin(), taken.end(), [](float v) { return v == v; });
    const std::size_t all = signals.impossible[i] + static_cast<std::size_t>(possible);
    notices.push_back(
        fmt::format("{}: {} of {} samples are outside {:g} .. {:g} and count as missing; is the unit right?",
                    info.column, signals.impossible[i], all, info.lowest, info.highest));
  }
  return notices;
}

void check_contact(const RecordingSignals& signals, const MachineDescription& machine) {
  if (!machine.has_spindle || machine.has_contact || !signals.has(Channel::kSpindleSpeed)) return;
  for (const float contact : signals.value[index_of(Channel::kContact)]) {
    if (!(contact > 0.0F)) continue;
    throw UserError(
        fmt::format("the tool is in contact, but machine '{}' describes no contact; add [tool] and "
                    "[contact] to its file",
                    machine.name));
  }
}

}  // namespace morepro::host
