#include "sim_host/diagnose/leftover/ringing.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <vector>

#include "sim_host/diagnose/fit/size_columns.hpp"
#include "sim_host/diagnose/fit/whitening.hpp"

namespace morepro::host {
namespace {

constexpr double kMeansPerS = 2000.0;  // of innovations: a resonance of a machine is slower than these
constexpr double kLowestHz = 5.0;
constexpr double kHighestHz = 120.0;
constexpr double kHighestShare = 0.15;  // of the means' rate
constexpr double kFrequencyStep = 1.2;
constexpr double kDampingRatio = 0.05;  // broad enough for every frequency between the steps
constexpr Eigen::Index kLags = 2;
constexpr double kShortestLagS = 0.5e-3;  // the other one is twice as long
constexpr Eigen::Index kBatchRows = 256;
constexpr double kHuber = 3.0;  // standard deviations

struct Ages {
  std::size_t first;
  std::size_t last;
};
constexpr std::array<Ages, 13> kPast{{{1, 1},
                                      {2, 2},
                                      {3, 3},
                                      {4, 4},
                                      {5, 5},
                                      {6, 6},
                                      {7, 8},
                                      {9, 11},
                                      {12, 16},
                                      {17, 24},
                                      {25, 40},
                                      {41, 72},
                                      {73, 128}}};
constexpr std::size_t kOldest = kPast.back().last;
constexpr auto kPastColumns = static_cast<Eigen::Index>(kSensorsPerAxis * kPast.size());

std::vector<double> frequencies_hz(double means_per_s) {
  std::vector<double> frequencies;
  const double highest = std::min(kHighestHz, kHighestShare * means_per_s);
  for (double f = kLowestHz; f < highest; f *= kFrequencyStep) frequencies.push_back(f);
  return frequencies;
}

/// Lags, and resonances of every frequency, set in motion by the changes of one channel.
class DrivenStates {
 public:
  DrivenStates(const std::vector<float>& values, std::size_t rows_per_mean,
               std::span<const double> frequencies_hz, double step_s)
      : values_(&values),
        rows_per_mean_(rows_per_mean),
        state_(Eigen::ArrayXcd::Zero(kLags + static_cast<Eigen::Index>(frequencies_hz.size()))),
        factor_(state_.size()) {
    for (Eigen::Index i = 0; i < kLags; ++i)
      factor_(i) = std::exp(-step_s / (kShortestLagS * std::exp2(static_cast<double>(i))));
    for (Eigen::Index i = kLags; i < state_.size(); ++i) {
      const double rate = 2.0 * std::numbers::pi * frequencies_hz[static_cast<std::size_t>(i - kLags)];
      const double damped = rate * std::sqrt(1.0 - kDampingRatio * kDampingRatio);
      factor_(i) = std::exp(std::complex<double>(-kDampingRatio * rate, damped) * step_s);
    }
  }

  /// Up to the row before the mean begins.
  void swing_to(std::size_t mean) {
    for (const std::size_t last = mean * rows_per_mean_; row_ < last; ++row_) {
      const float value = (*values_)[row_];
      if (std::isfinite(value)) now_ = static_cast<double>(value);
    }
    state_ *= factor_;
    if (mean > 1) state_ += now_ - before_;
    before_ = now_;
  }
  [[nodiscard]] auto lags() const { return state_.head(kLags).real(); }
  [[nodiscard]] auto resonances() const { return state_.tail(state_.size() - kLags); }

 private:
  const std::vector<float>* values_;
  std::size_t rows_per_mean_;
  Eigen::ArrayXcd state_;
  Eigen::ArrayXcd factor_;
  std::size_t row_ = 0;
  double now_ = 0.0;
  double before_ = 0.0;
};

/// What may set something swinging: what drives the feed, and its motion.
std::array<Channel, 2> drives_of(const RecordingSignals& signals) {
  return {Channel::kFeedForce,
          signals.has(Channel::kFeedSpeed) ? Channel::kFeedSpeed : Channel::kFeedPosition};
}

/// Moments of each sensor's mean innovations: [past ones | columns of the model | lags | resonances | the
/// mean]. A controller that knows more of the state than the sensors tells of it by its force, which lags
/// take: they do not ring.
class RingingMoments {
 public:
  RingingMoments(const AxisFit& fit, const Disturbances& of_effects)
      : fit_(&fit),
        rows_per_mean_(
            std::max<std::size_t>(1, static_cast<std::size_t>(fit.signals().rate_hz / kMeansPerS))),
        frequencies_(frequencies_hz(means_per_s())),
        model_columns_(static_cast<Eigen::Index>(parameter_count(fit.axis()))) {
    for (const gap::EffectForm& form : of_effects.forms) model_columns_ += form.parts;
    for (const Channel channel : drives_of(fit.signals()))
      drives_.emplace_back(fit.signals().value[index_of(channel)], rows_per_mean_, frequencies_,
                           1.0 / means_per_s());
    const Eigen::Index width = explained_columns() + resonance_columns() + 1;
    for (Sensor& sensor : sensors_) {
      sensor.sum = Eigen::VectorXd::Zero(model_columns_ + 1);
      sensor.batch = Eigen::MatrixXd::Zero(kBatchRows, width);
      sensor.moments = Eigen::MatrixXd::Zero(width, width);
    }
  }

  void take(const Innovation& innovation) {
    while (innovation.row >= (mean_ + 1) * rows_per_mean_) finish_mean();
    const SensorWhitening& whitening = fit_->whitening()[innovation.sensor];
    const double weight =
        1.0 / (whitening.scale[innovation.in_contact ? 1 : 0] * std::sqrt(innovation.variance));
    Sensor& sensor = sensors_[innovation.sensor];
    const auto columns = static_cast<Eigen::Index>(innovation.columns.size());
    sensor.sum.head(columns) +=
        weight * Eigen::Map<const Eigen::VectorXd>(innovation.columns.data(), columns);
    sensor.sum(model_columns_) += weight * innovation.value;
    sensor.count += 1.0;
  }

  /// Deviance that each resonance takes, drive by drive.
  [[nodiscard]] Eigen::VectorXd deviances(std::size_t sensor) const {
    Eigen::VectorXd taken = Eigen::VectorXd::Zero(resonance_columns() / 2);
    const Sensor& of = sensors_[sensor];
    if (!(of.rows > static_cast<double>(of.moments.cols()))) return taken;
    Eigen::MatrixXd moments = of.moments.selfadjointView<Eigen::Lower>();
    const Eigen::VectorXd scale = moments.diagonal().cwiseMax(1.0e-300).cwiseSqrt().cwiseInverse();
    moments = scale.asDiagonal() * moments * scale.asDiagonal();
    moments.diagonal().array() += 1.0e-9;
    const Eigen::Index explained = explained_columns();
    const Eigen::Index rest = moments.cols() - explained;
    const Eigen::MatrixXd across = moments.topRightCorner(explained, rest);
    const Eigen::MatrixXd left =
        moments.bottomRightCorner(rest, rest) -
        across.transpose() * moments.topLeftCorner(explained, explained).ldlt().solve(across);
    const double unexplained = left(rest - 1, rest - 1);
    for (Eigen::Index i = 0; i < taken.size(); ++i) {
      const Eigen::Vector2d with = left.block<2, 1>(2 * i, rest - 1);
      const double gain = with.dot(left.block<2, 2>(2 * i, 2 * i).ldlt().solve(with));
      if (gain > 0.0) taken(i) = of.rows * std::log(unexplained / std::max(unexplained - gain, 1.0e-9));
    }
    return taken;
  }

  [[nodiscard]] double frequency_hz(Eigen::Index resonance) const {
    return frequencies_[static_cast<std::size_t>(resonance) % frequencies_.size()];
  }

 private:
  struct Sensor {
    Eigen::VectorXd sum;  ///< of [columns | innovation] since the mean began
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
    return kPastColumns + model_columns_ + static_cast<Eigen::Index>(drives_.size()) * kLags;
  }
  [[nodiscard]] Eigen::Index resonance_columns() const {
    return static_cast<Eigen::Index>(2 * drives_.size() * frequencies_.size());
  }

  void finish_mean() {
    for (DrivenStates& drive : drives_) drive.swing_to(mean_);
    if (mean_ >= 2 * kOldest)
      for (std::size_t sensor = 0; sensor < kSensorsPerAxis; ++sensor)
        if (sensors_[sensor].count > 0.0) add_row(sensor);
    for (Sensor& sensor : sensors_) {
      sensor.means.push_back(sensor.count > 0.0 ? static_cast<float>(mean_of(sensor)(model_columns_)) : 0.0F);
      sensor.sum.setZero();
      sensor.count = 0.0;
    }
    ++mean_;
  }

  static Eigen::VectorXd mean_of(const Sensor& sensor) { return sensor.sum / std::sqrt(sensor.count); }

  void add_row(std::size_t index) {
    Sensor& sensor = sensors_[index];
    auto row = sensor.batch.row(sensor.filled);
    Eigen::Index next = 0;
    for (const Sensor* of : {&sensor, &sensors_[1 - index]})
      for (const auto& [first, last] : kPast) {
        double sum = 0.0;
        for (std::size_t age = first; age <= last; ++age) sum += static_cast<double>(of->means[mean_ - age]);
        row(next++) = sum;
      }
    const Eigen::VectorXd mean = mean_of(sensor);
    row.segment(next, model_columns_) = mean.head(model_columns_);
    next += model_columns_;
    for (const DrivenStates& drive : drives_) {
      row.segment(next, kLags) = drive.lags().matrix();
      next += kLags;
    }
    for (const DrivenStates& drive : drives_)
      for (const std::complex<double>& swing : drive.resonances()) {
        row(next++) = swing.real();
        row(next++) = swing.imag();
      }
    row(next) = mean(model_columns_);
    row *= std::sqrt(std::min(1.0, kHuber / std::max(std::fabs(row(next)), 1.0e-9)));
    sensor.rows += 1.0;
    if (++sensor.filled < kBatchRows) return;
    sensor.moments.selfadjointView<Eigen::Lower>().rankUpdate(sensor.batch.transpose());
    sensor.filled = 0;
  }

  const AxisFit* fit_;
  std::size_t rows_per_mean_;
  std::vector<double> frequencies_;
  Eigen::Index model_columns_;
  std::vector<DrivenStates> drives_{};
  std::array<Sensor, kSensorsPerAxis> sensors_{};
  std::size_t mean_ = 0;
};

}  // namespace

Ringing ringing_of(const AxisFit& fit) {
  const SizeColumns sizes(fit.model().effects);
  RingingMoments moments(fit, sizes.disturbances());
  run_observer(fit.axis(), fit.signals(), fit.model(), sizes.disturbances(), 0, fit.signals().rows,
               [&moments](const Innovation& innovation) { moments.take(innovation); });
  const Eigen::VectorXd taken = moments.deviances(0) + moments.deviances(1);
  if (taken.size() == 0) return {};
  Eigen::Index most = 0;
  const double deviance = taken.maxCoeff(&most);
  return {deviance, moments.frequency_hz(most)};
}

}  // namespace morepro::host
