#include "sim_host/diagnose/fit/lasting_noise.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "sim_host/diagnose/fit/memory_ages.hpp"

namespace morepro::host {
namespace {

template <class T>
using PerSensor = std::array<T, kSensorsPerAxis>;

constexpr Eigen::Index kOldest = kLongMemory.back().last;
constexpr auto kTaps = static_cast<Eigen::Index>(InputNews::kTaps);
constexpr Eigen::Index kPieceRows = 256;
constexpr double kWeightStiffness = 1.0e-6;  // of the rows: keeps weights of columns that are nothing at zero

std::span<const Ages> ages_of(Memory memory) {
  return memory == Memory::kShort ? std::span<const Ages>(kShortMemory) : kLongMemory;
}

/// Of the past of both sensors, and of what was new in the input.
using Weights = Eigen::VectorXd;
Eigen::Index weights_of(Memory memory) {
  return static_cast<Eigen::Index>(ages_of(memory).size() * kSensorsPerAxis) + kTaps;
}

/// Rows of one sensor in a piece of the recording, zero where it has none, and sums of those before.
struct PieceOfSensor {
  explicit PieceOfSensor(Eigen::Index width) : raw(Eigen::MatrixXd::Zero(kOldest + kPieceRows, width)) {
    past.fill(Eigen::MatrixXd::Zero(kPieceRows, width));
    news.setZero();
  }

  void sum_up_past(std::span<const Ages> ages) {
    for (std::size_t group = 0; group < ages.size(); ++group) {
      past[group] = raw.middleRows(kOldest - ages[group].first, kPieceRows);
      for (Eigen::Index age = ages[group].first + 1; age <= ages[group].last; ++age)
        past[group] += raw.middleRows(kOldest - age, kPieceRows);
    }
  }

  void move_on() {
    raw.topRows(kOldest) = raw.bottomRows(kOldest).eval();
    raw.bottomRows(kPieceRows).setZero();
    news.setZero();
    counts = {};
  }

  Eigen::MatrixXd raw;  ///< [columns | innovation]: the last ones of the piece before, then this one's
  std::array<Eigen::MatrixXd, kLongMemory.size()> past;  ///< of each group of ages
  Eigen::Matrix<double, kPieceRows, kTaps> news;
  std::array<bool, kPieceRows> counts{};
};

/// Moments of each sensor: [past innovations | columns | innovation], the last two less what `weights` make
/// of the past.
class PastAndPresent {
 public:
  PastAndPresent(Eigen::Index width, Memory memory, const InputNews* news, const PerSensor<Weights>& weights)
      : ages_(ages_of(memory)),
        count_(weights_of(memory)),
        weights_(weights),
        width_(width),
        news_(news),
        batch_(kPieceRows, count_ + width),
        sensors_{PieceOfSensor(width), PieceOfSensor(width)} {
    sums_.fill(Eigen::MatrixXd::Zero(count_ + width, count_ + width));
  }

  void begin_stretch(std::size_t first) {
    flush();
    for (PieceOfSensor& sensor : sensors_) sensor.raw.setZero();
    first_ = first;
    settled_ = first + kSettlingRows;
  }

  void take(const Innovation& innovation, double weight) {
    for (; innovation.row >= first_ + kPieceRows; first_ += kPieceRows) flush();
    PieceOfSensor& sensor = sensors_[innovation.sensor];
    const std::size_t i = innovation.row - first_;
    sensor.counts[i] = innovation.row >= settled_;
    auto row = sensor.raw.row(kOldest + static_cast<Eigen::Index>(i));
    const auto columns = static_cast<Eigen::Index>(innovation.columns.size());
    row.head(columns) = weight * Eigen::Map<const Eigen::RowVectorXd>(innovation.columns.data(), columns);
    row(columns) = weight * innovation.value;
    for (std::size_t tap = 0; news_ != nullptr && tap < InputNews::kTaps; ++tap)
      sensor.news(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(tap)) =
          weight * static_cast<double>(news_->change[tap][innovation.sensor][innovation.row]);
  }

  void flush() {
    for (PieceOfSensor& sensor : sensors_) sensor.sum_up_past(ages_);
    for (std::size_t sensor = 0; sensor < kSensorsPerAxis; ++sensor) add(sensor);
    for (PieceOfSensor& sensor : sensors_) sensor.move_on();
  }

  [[nodiscard]] double rows(std::size_t sensor) const { return rows_[sensor]; }
  /// What one step more makes of the weights.
  [[nodiscard]] Weights better_weights(std::size_t sensor) const {
    return weights_[sensor] + solved(sensor, sums_[sensor].bottomLeftCorner(1, count_).transpose());
  }
  /// Without what the past predicts with these weights or any others.
  [[nodiscard]] Eigen::MatrixXd without_past(std::size_t sensor) const {
    const auto across = sums_[sensor].bottomLeftCorner(width_, count_);
    const Eigen::MatrixXd all =
        sums_[sensor].bottomRightCorner(width_, width_).selfadjointView<Eigen::Lower>();
    return all - across * solved(sensor, across.transpose());
  }

 private:
  [[nodiscard]] Eigen::MatrixXd solved(std::size_t sensor, const Eigen::MatrixXd& right) const {
    Eigen::MatrixXd past = sums_[sensor].topLeftCorner(count_, count_);
    past.diagonal().array() += kWeightStiffness * std::max(rows_[sensor], 1.0);
    return past.selfadjointView<Eigen::Lower>().ldlt().solve(right);
  }

  void add(std::size_t sensor) {
    const PieceOfSensor& own = sensors_[sensor];
    if (std::none_of(own.counts.begin(), own.counts.end(), [](bool counts) { return counts; })) return;
    auto now = batch_.rightCols(width_);
    now = own.raw.bottomRows(kPieceRows);
    Eigen::Index next = 0;
    for (const PieceOfSensor* of : std::array<const PieceOfSensor*, 2>{&own, &sensors_[1 - sensor]})
      for (const Eigen::MatrixXd& past : std::span(of->past).first(ages_.size())) {
        batch_.col(next) = past.rightCols(1);
        now -= weights_[sensor](next++) * past;
      }
    batch_.middleCols(next, kTaps) = own.news;
    now.rightCols(1) -= own.news * weights_[sensor].tail(kTaps);
    Eigen::Array<double, kPieceRows, 1> share;
    for (Eigen::Index i = 0; i < kPieceRows; ++i) {
      const bool counts = own.counts[static_cast<std::size_t>(i)];
      const double size = std::fabs(now(i, width_ - 1));
      share(i) = !counts ? 0.0 : size > kHuber ? std::sqrt(kHuber / size) : 1.0;
      rows_[sensor] += counts ? 1.0 : 0.0;
    }
    batch_.array().colwise() *= share;
    sums_[sensor].selfadjointView<Eigen::Lower>().rankUpdate(batch_.transpose());
  }

  std::span<const Ages> ages_;
  Eigen::Index count_;  ///< of weights
  PerSensor<Weights> weights_;
  Eigen::Index width_;
  const InputNews* news_;
  Eigen::MatrixXd batch_;
  PerSensor<PieceOfSensor> sensors_;
  PerSensor<Eigen::MatrixXd> sums_;
  PerSensor<double> rows_{};
  std::size_t first_ = 0;
  std::size_t settled_ = 0;
};

}  // namespace

NewParts look_beside_lasting_noise(Axis axis, const RecordingSignals& signals,
                                   std::span<const Stretch> stretches, const GapModel& model,
                                   const Disturbances& disturbances, const Whitening& whitening,
                                   Memory memory, const InputNews* news) {
  PerSensor<double> log_variance{};
  // Where only the weights are looked for, nothing but the innovations themselves is needed.
  const Weights none = Weights::Zero(weights_of(memory));
  PastAndPresent innovations(1, memory, news, {none, none});
  for (const auto& [first, last] : stretches) {
    innovations.begin_stretch(first);
    run_observer(axis, signals, model, first, last, [&](const Innovation& innovation) {
      const double deviation = deviation_of(whitening, innovation);
      log_variance[innovation.sensor] += 2.0 * std::log(deviation);
      innovations.take(innovation, 1.0 / deviation);
    });
  }
  innovations.flush();
  Eigen::Index width = static_cast<Eigen::Index>(parameter_count(axis)) + 1;
  for (const gap::EffectForm& form : disturbances.forms) width += form.parts;
  PastAndPresent all(width, memory, news, {innovations.better_weights(0), innovations.better_weights(1)});
  for (const auto& [first, last] : stretches) {
    all.begin_stretch(first);
    run_observer(axis, signals, model, disturbances, first, last, [&](const Innovation& innovation) {
      all.take(innovation, 1.0 / deviation_of(whitening, innovation));
    });
  }
  all.flush();
  NewParts parts{.moments = Eigen::MatrixXd::Zero(width, width)};
  for (std::size_t sensor = 0; sensor < kSensorsPerAxis; ++sensor) {
    const double rows = all.rows(sensor);
    if (!(rows > static_cast<double>(none.size()))) continue;
    const Eigen::MatrixXd moments = all.without_past(sensor);
    const double left = moments(width - 1, width - 1) / rows;
    parts.moments += moments / left;
    parts.rows += rows;
    parts.deviance += rows * std::log(left) + log_variance[sensor];
  }
  return parts;
}

}  // namespace morepro::host
