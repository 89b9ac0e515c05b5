#pragma once
#include <cstddef>
#include <span>

#include "sim_host/diagnose/fit/gap_model.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"

namespace morepro::host {

/// How many parts an interval between two samples is integrated in. What a tool meets turns with the spindle,
/// a current in contact, an angle or a bristle is another one within a long interval, and no closed form
/// knows that.
class IntervalParts {
 public:
  /// `terms`: of the columns that are worked out along.
  IntervalParts(Axis axis, const RecordingSignals& signals, const GapModel& model,
                std::span<const gap::EffectForm> terms);

  /// Of an interval that begins at this speed of the spindle.
  [[nodiscard]] std::size_t at(double speed_rad_s) const {
    const bool cannot_turn = speed_rad_s > slow_rad_s_ || speed_rad_s < -slow_rad_s_;
    return !is_same_always_ && cannot_turn ? 1 : most_;
  }
  [[nodiscard]] std::size_t most() const { return most_; }

 private:
  std::size_t most_ = 1;
  bool is_same_always_ = true;
  double slow_rad_s_ = 0.0;  ///< up to here a spindle may turn within an interval
};

}  // namespace morepro::host
