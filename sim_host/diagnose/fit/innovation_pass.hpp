#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "lib/gap/effect_form.hpp"
#include "sim_host/diagnose/fit/gap_model.hpp"
#include "sim_host/diagnose/signals/recording_signals.hpp"

namespace morepro::host {

inline constexpr std::size_t kMostTerms = 160;
inline constexpr std::size_t kMostApplied = 16;
inline constexpr std::size_t kDelaySteps = 254;

/// What an axis is watched through, in the order of `Innovation::sensor`.
inline constexpr std::size_t kSensorsPerAxis = 2;

constexpr Channel channel_of(Axis axis, std::size_t sensor) {
  if (axis == Axis::kSpindle) return sensor == 0 ? Channel::kSpindleSpeed : Channel::kArmatureCurrent;
  return sensor == 0 ? Channel::kFeedPosition : Channel::kFeedSpeed;
}

/// One innovation of one sensor, not yet divided by its standard deviation.
struct Innovation {
  std::size_t row = 0;     ///< of the recording
  std::size_t sensor = 0;  ///< spindle: speed, current; feed: position, speed
  bool in_contact = false;
  double value = 0.0;
  double variance = 1.0;
  /// Parameters of the axis, then the terms of the forms in their order; none without disturbances.
  std::span<const double> columns{};
};

using OnInnovation = std::function<void(const Innovation&)>;

/// Number of parameter columns that come before the terms.
std::size_t parameter_count(Axis axis);

/// Disturbances that might act, each from the start of the recording or from its onset.
struct Disturbances {
  std::span<const gap::EffectForm> forms{};
  std::span<const double> onset_s{};  ///< one per form; empty: all from the start
  /// Are columns of one law to be compared with each other? Then those of the model's own dry friction are no
  /// better than the others.
  bool are_compared = false;

  Disturbances() = default;
  template <class Forms>
  Disturbances(const Forms& all, std::span<const double> onsets = {}) : forms(all), onset_s(onsets) {}
};

/// Runs the observer of one axis over rows [first, last) of the recording with the model. The observer starts
/// at `first`. The innovations have no columns.
void run_observer(Axis axis, const RecordingSignals& signals, const GapModel& model, std::size_t first,
                  std::size_t last, const OnInnovation& on_innovation);

/// The same with the columns of the parameters and of disturbances.
void run_observer(Axis axis, const RecordingSignals& signals, const GapModel& model,
                  const Disturbances& disturbances, std::size_t first, std::size_t last,
                  const OnInnovation& on_innovation);

/// What the effects of a model do in a row of a recording: to the balances during the interval that begins
/// there, to the sensors at its beginning.
struct EffectsOfRow {
  gap::Contribution<double> added;
  gap::Contribution<double> shown;
};
/// Gives them row by row, from the first.
using EffectTrace = std::function<EffectsOfRow()>;
EffectTrace trace_effects(Axis axis, const RecordingSignals& signals, const GapModel& model);

}  // namespace morepro::host
