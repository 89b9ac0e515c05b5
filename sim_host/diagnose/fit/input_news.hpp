#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "sim_host/diagnose/fit/innovation_pass.hpp"

namespace morepro::host {

/// By how much what is new in the input, acting once more, would change the innovations.
struct InputNews {
  /// In the row in which it is new and in the next one: that moves a state anywhere.
  static constexpr std::size_t kTaps = 2;

  /// Of each tap and sensor, row by row; 0 where there is no innovation.
  std::array<std::array<std::vector<float>, kSensorsPerAxis>, kTaps> change;

  /// Sum over all rows and sensors of what the news of a row change in its innovation (tap 0) times that
  /// innovation, over its variance. More input lets a model expect more motion, so that innovations are less:
  /// the sum is more than 0 where the input works against what innovations show, as a controller's answer to
  /// a state that it sees does, and less than 0 where it moves the machine more than the model lets it.
  double answer = 0.0;
};

/// A controller that sees the machine's state itself, not the samples that were recorded, answers to random
/// forces before these show them. New is what the input's own past does not predict of it.
InputNews input_news(Axis axis, const RecordingSignals& signals, const GapModel& model);

}  // namespace morepro::host
