#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "sim_host/diagnose/fit/gap_statistics.hpp"
#include "sim_host/diagnose/fit/input_news.hpp"

namespace morepro::host {

/// What no innovation of the last rows, of either sensor, predicts.
struct NewParts {
  Eigen::MatrixXd moments;  ///< second ones of [parameters | terms | innovation], of unit variance
  double rows = 0.0;
  double deviance = 0.0;  ///< twice the negative logarithm of their likelihood
};

/// How many innovations of each sensor are the past: 24, which names were judged by wherever there is a
/// figure, or 128, for values: a ripple of 2 ms at 20 kHz lasts for longer than 24 samples.
enum class Memory : std::uint8_t { kShort, kLong };

/// The weights of the past are fitted along. Noise that lasts longer than an observer expects bends what is
/// fitted otherwise, because in closed loop it is in the machine's motion, too. `news`: weighed along; none
/// where an input knows no more of the state than the sensors.
NewParts look_beside_lasting_noise(Axis axis, const RecordingSignals& signals,
                                   std::span<const Stretch> stretches, const GapModel& model,
                                   const Disturbances& disturbances, const Whitening& whitening,
                                   Memory memory, const InputNews* news = nullptr);

}  // namespace morepro::host
