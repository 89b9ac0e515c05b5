#include "sim_host/diagnose/leftover/ringing.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numeric>
#include <span>
#include <vector>

#include "sim_host/diagnose/fit/gap_statistics.hpp"
#include "sim_host/diagnose/fit/linear_fit.hpp"
#include "sim_host/diagnose/fit/memory_ages.hpp"
#include "sim_host/diagnose/fit/whitening.hpp"
#include "sim_host/diagnose/leftover/driven_states.hpp"

namespace morepro::host {
namespace {

constexpr double kHighestShare = 0.15;  // of the means' rate
constexpr double kFrequencyStep = 1.2;
constexpr Eigen::Index kBatchRows = 256;
constexpr auto kOldest = static_cast<std::size_t>(kLongMemory.back().last);  // means
constexpr auto kPastColumns = static_cast<Eigen::Index>(kSensorsPerAxis * kLongMemory.size());

std::vector<double> frequencies_hz(const RingingBand& band, double means_per_s) {
  std::vector<double> frequencies;
  const double highest = std::min(band.highest_hz, kHighestShare * means_per_s);
  for (double f = band.lowest_hz; f < highest; f *= kFrequencyStep) frequencies.push_back(f);
  return frequencies;
}

/// What may set something swinging: what drives the feed, and its motion.
std::array<Channel, 2> drives_of(const RecordingSignals& signals) {
  return {Channel::kFeedForce,
          signals.has(Channel::kFeedSpeed) ? Channel::kFeedSpeed : Channel::kFeedPosition};
}

/// Moments of each sensor's mean innovations: [past ones | lags | resonances | the mean]. A controller that
/// knows more of the state than the sensors tells of it by its force, which lags take: they do not ring.
class RingingMoments {
 public:
  RingingMoments(const AxisFit& fit, const RingingBand& band)
      : fit_(&fit),
        rows_per_mean_(
            std::max<std::size_t>(1, static_cast<std::size_t>(fit.signals().rate_hz / band.means_per_s))),
        frequencies_(frequencies_hz(band, means_per_s())) {
    for (const Channel channel : drives_of(fit.signals()))
      drives_.emplace_back(fit.signals().value[index_of(channel)], fit.signals().rate_hz, rows_per_mean_,
                           frequencies_);
    const Eigen::Index width = explained_columns() + resonance_columns() + 1;
    for (Sensor& sensor : sensors_) {
      sensor.batch = Eigen::MatrixXd::Zero(kBatchRows, width);
      sensor.moments = Eigen::MatrixXd::Zero(width, width);
    }
  }

  void take(const Innovation& innovation) {
    while (innovation.row >= (mean_ + 1) * rows_per_mean_) finish_mean();
    const double weight = 1.0 / deviation_of(fit_->whitening(), innovation);
    Sensor& sensor = sensors_[innovation.sensor];
    sensor.sum += weight * innovation.value;
    sensor.count += 1.0;
  }

  /// Deviance that each resonance takes, drive by drive.
  [[nodiscard]] Eigen::VectorXd deviances(std::size_t sensor) const {
    Eigen::VectorXd taken = Eigen::VectorXd::Zero(resonance_columns() / 2);
    const Sensor& of = sensors_[sensor];
    if (!(of.rows > static_cast<double>(of.moments.cols()))) return taken;
    const Eigen::MatrixXd moments = of.moments.selfadjointView<Eigen::Lower>();
    std::vector<Eigen::Index> explained(static_cast<std::size_t>(explained_columns()));
    std::iota(explained.begin(), explained.end(), Eigen::Index{0});
    const Eigen::VectorXd no_prior = Eigen::VectorXd::Zero(moments.cols());
    const Remainder rest = remainder(moments, explained, no_prior, no_prior);
    Eigen::VectorXd coefficient;
    for (Eigen::Index i = 0; i < taken.size(); ++i) {
      const double gain = gain_of(rest, moments, explained_columns() + 2 * i, 2, coefficient);
      taken(i) = of.rows * std::log(rest.rss / std::max(rest.rss - gain, 1.0e-9 * rest.rss));
    }
    return taken;
  }

  [[nodiscard]] bool has_frequencies() const { return !frequencies_.empty(); }
  [[nodiscard]] double rows() const { return std::max(sensors_[0].rows, sensors_[1].rows); }
  [[nodiscard]] double frequency_hz(Eigen::Index resonance) const {
    return frequencies_[static_cast<std::size_t>(resonance) % frequencies_.size()];
  }

 private:
  struct Sensor {
    double sum = 0.0;  ///< since the mean began
    double count = 0.0;
    std::vector<float> means{};
    Eigen::MatrixXd batch;
    Eigen::Index filled = 0;
    Eigen::MatrixXd moments;
    double rows = 0.0;
  };

  [[nodiscard]] double means_per_s() const {
    return fit_->signals().rate_hz / static_cast<double>(rows_per_mean_);
  }
  [[nodiscard]] Eigen::Index explained_columns() const {
    return kPastColumns + static_cast<Eigen::Index>(drives_.size()) * DrivenStates::kLags;
  }
  [[nodiscard]] Eigen::Index resonance_columns() const {
    return static_cast<Eigen::Index>(2 * drives_.size() * frequencies_.size());
  }

  void finish_mean() {
    for (DrivenStates& drive : drives_) drive.move_to(mean_);
    // Not before what the state was at the beginning has been forgotten.
    if (mean_ >= 2 * kOldest)
      for (std::size_t sensor = 0; sensor < kSensorsPerAxis; ++sensor)
        if (sensors_[sensor].count > 0.0) add_row(sensor);
    for (Sensor& sensor : sensors_) {
      sensor.means.push_back(sensor.count > 0.0 ? static_cast<float>(mean_of(sensor)) : 0.0F);
      sensor.sum = 0.0;
      sensor.count = 0.0;
    }
    ++mean_;
  }

  /// Of the variance of one innovation.
  static double mean_of(const Sensor& sensor) { return sensor.sum / std::sqrt(sensor.count); }

  void add_row(std::size_t index) {
    Sensor& sensor = sensors_[index];
    auto row = sensor.batch.row(sensor.filled);
    Eigen::Index next = 0;
    for (const Sensor* of : {&sensor, &sensors_[1 - index]})
      for (const auto& [first, last] : kLongMemory) {
        double sum = 0.0;
        for (Eigen::Index age = first; age <= last; ++age)
          sum += static_cast<double>(of->means[mean_ - static_cast<std::size_t>(age)]);
        row(next++) = sum;
      }
    for (const DrivenStates& drive : drives_) {
      row.segment(next, DrivenStates::kLags) = drive.lags().matrix();
      next += DrivenStates::kLags;
    }
    for (const DrivenStates& drive : drives_)
      for (const std::complex<double>& swing : drive.resonances()) {
        row(next++) = swing.real();
        row(next++) = swing.imag();
      }
    row(next) = mean_of(sensor);
    row *= std::sqrt(std::min(1.0, kHuber / std::max(std::fabs(row(next)), 1.0e-9)));
    if (++sensor.filled < kBatchRows) return;
    sensor.rows += static_cast<double>(kBatchRows);
    sensor.moments.selfadjointView<Eigen::Lower>().rankUpdate(sensor.batch.transpose());
    sensor.filled = 0;
  }

  const AxisFit* fit_;
  std::size_t rows_per_mean_;
  std::vector<double> frequencies_;
  std::vector<DrivenStates> drives_{};
  std::array<Sensor, kSensorsPerAxis> sensors_{};
  std::size_t mean_ = 0;
};

}  // namespace

Ringing ringing_of(const AxisFit& fit, const RingingBand& band) {
  RingingMoments moments(fit, band);
  if (!moments.has_frequencies()) return {};
  run_observer(fit.axis(), fit.signals(), fit.model(), 0, fit.signals().rows,
               [&moments](const Innovation& innovation) { moments.take(innovation); });
  const Eigen::VectorXd taken = moments.deviances(0) + moments.deviances(1);
  Eigen::Index most = 0;
  const double deviance = taken.maxCoeff(&most);
  return {deviance, moments.rows(), moments.frequency_hz(most)};
}

}  // namespace morepro::host
