#pragma once
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim_host/diagnose/fit/innovation_pass.hpp"
#include "sim_host/diagnose/fit/whitening.hpp"

namespace morepro::host {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Rows at the start of a stretch in which the observer still settles.
inline constexpr std::size_t kSettlingRows = 50;
/// A row beyond this many standard deviations counts as one of them (Huber).
inline constexpr double kHuber = 5.0;

/// Second moments of whitened rows [parameters | terms | innovation], block of time by block of time.
struct GapStatistics {
  std::vector<Eigen::MatrixXd> block;
  std::vector<double> rows;  ///< of each block
  double block_s = 0.0;      ///< as long as their whole rows last
  /// May what is left remember itself? Of a thinned recording what remembers itself is structure: to whiten
  /// it would judge by the reversals alone.
  bool may_remember = true;
  /// For the next whitening, and for looking at what is left: innovations over the observer's standard
  /// deviation.
  std::array<std::vector<float>, kSensorsPerAxis> normalised;
  std::array<std::vector<bool>, kSensorsPerAxis> in_contact;
  std::array<std::vector<std::uint32_t>, kSensorsPerAxis> row;  ///< of the recording: a sensor may lack some
  std::array<double, kSensorsPerAxis>
      log_variance{};  ///< sum over the innovations, as the observer expects it

  [[nodiscard]] Eigen::MatrixXd total() const;
  [[nodiscard]] double total_rows() const;
};

/// Which moments are worth their time: all of them; none between the terms of different forms, where each
/// form is tried by itself; or those of the innovations alone.
enum class Moments : std::uint8_t { kAll, kFormByForm, kOfInnovations };

/// One pass over stretches of a recording, in their order, in blocks of as many whole rows as `block_s` > 0
/// has room for, at least one.
GapStatistics collect(Axis axis, const RecordingSignals& signals, std::span<const Stretch> stretches,
                      const GapModel& model, const Disturbances& disturbances, const Whitening& whitening,
                      double block_s, Moments moments = Moments::kAll);

/// The whitening that fits what a pass has left.
Whitening whitening_of(const GapStatistics& statistics);

/// Twice the negative logarithm of the likelihood of a pass, with the whitening that fits it: what models of
/// different noise are compared by. Smaller is better; infinite where the model runs away.
double unlikeliness_of(const GapStatistics& statistics, const Whitening& fitting);

}  // namespace morepro::host
