#include "sim_host/diagnose/fit/gap_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "sim_host/diagnose/fit/repeated_logarithm.hpp"

namespace morepro::host {
namespace {

constexpr Eigen::Index kBatchRows = 256;

/// Rows of one sensor on their way into the moments. They wait until there are many: to whiten and to
/// multiply them together takes a fraction of the time.
class SensorRows {
 public:
  explicit SensorRows(Eigen::Index width) : raw_(RowMatrix::Zero(kLookBack + kBatchRows, width)) {}

  /// Where the next row goes; zero but for what was put there.
  [[nodiscard]] auto next() { return raw_.row(kLookBack + waiting_); }
  /// It is there. Rows that are not `counted` come first; they are for the memory of later ones only.
  void push(bool counted) {
    ++waiting_;
    if (!counted) first_ = waiting_;
  }
  [[nodiscard]] bool is_full() const { return waiting_ == kBatchRows; }

  /// Whitened rows that count; they wait no longer.
  Eigen::Ref<const RowMatrix> take(const SensorWhitening& white, RowMatrix& batch) {
    const Eigen::Index count = waiting_ - first_;
    const Eigen::Index begin = kLookBack + first_;
    batch.topRows(count) = raw_.middleRows(begin, count);
    for (std::size_t i = 0; i < SensorWhitening::kLags.size(); ++i) {
      const auto lag = static_cast<Eigen::Index>(SensorWhitening::kLags[i]);
      if (white.memory[i] != 0.0)
        batch.topRows(count) -= white.memory[i] * raw_.middleRows(begin - lag, count);
    }
    for (Eigen::Index i = 0; i < count; ++i) {
      const double size = std::fabs(batch(i, batch.cols() - 1));
      if (size > kHuber) batch.row(i) *= std::sqrt(kHuber / size);
    }
    raw_.topRows(kLookBack) = raw_.middleRows(waiting_, kLookBack).eval();
    waiting_ = first_ = 0;
    return batch.topRows(count);
  }

 private:
  static constexpr Eigen::Index kLookBack = SensorWhitening::kLags.back();

  RowMatrix raw_;  ///< the last ones that were taken, then those that wait
  Eigen::Index waiting_ = 0;
  Eigen::Index first_ = 0;  ///< of them that counts
};

class Collector {
 public:
  /// `parts` of each form; empty for all moments.
  Collector(Eigen::Index width, std::vector<Eigen::Index> parts, const RecordingSignals& signals,
            const Whitening& whitening, double block_s, GapStatistics& statistics)
      : whitening_(whitening),
        parts_(std::move(parts)),
        statistics_(statistics),
        rows_per_block_(std::max<std::size_t>(1, static_cast<std::size_t>(block_s * signals.rate_hz))),
        width_(width),
        batch_(kBatchRows, width),
        rows_{SensorRows(width), SensorRows(width)} {
    statistics.block_s = static_cast<double>(rows_per_block_) / signals.rate_hz;
    for (auto& values : statistics.normalised) values.reserve(signals.rows);
    for (auto& rows : statistics.row) rows.reserve(signals.rows);
  }

  void begin_stretch() {
    flush();
    settled_ = {};
  }

  void take(const Innovation& innovation) {
    const std::size_t sensor = innovation.sensor;
    const double deviation = std::sqrt(innovation.variance);
    statistics_.normalised[sensor].push_back(static_cast<float>(innovation.value / deviation));
    statistics_.in_contact[sensor].push_back(innovation.in_contact);
    statistics_.row[sensor].push_back(static_cast<std::uint32_t>(innovation.row));
    statistics_.log_variance[sensor] += log_[sensor](innovation.variance);
    const std::size_t block = innovation.row / rows_per_block_;
    if (block != block_) flush();
    block_ = block;
    SensorRows& rows = rows_[sensor];
    put(innovation, 1.0 / (whitening_[sensor].scale[innovation.in_contact ? 1 : 0] * deviation), rows.next());
    rows.push(++settled_[sensor] > kSettlingRows);
    if (rows.is_full()) flush(sensor);
  }

  void flush() {
    for (std::size_t sensor = 0; sensor < kSensorsPerAxis; ++sensor) flush(sensor);
  }

 private:
  void flush(std::size_t sensor) {
    const auto rows = rows_[sensor].take(whitening_[sensor], batch_);
    if (rows.rows() == 0) return;
    while (statistics_.block.size() <= block_) {
      statistics_.block.emplace_back(Eigen::MatrixXd::Zero(width_, width_));
      statistics_.rows.push_back(0.0);
    }
    add(rows, statistics_.block[block_]);
    statistics_.rows[block_] += static_cast<double>(rows.rows());
  }

  template <class Row>
  static void put(const Innovation& innovation, double weight, Row row) {
    const auto columns = static_cast<Eigen::Index>(innovation.columns.size());
    row.head(columns) = weight * Eigen::Map<const Eigen::RowVectorXd>(innovation.columns.data(), columns);
    row(columns) = weight * innovation.value;
  }

  /// Their lower triangle.
  void add(const Eigen::Ref<const RowMatrix>& rows, Eigen::MatrixXd& moments) const {
    if (parts_.empty()) {
      moments.selfadjointView<Eigen::Lower>().rankUpdate(rows.transpose());
      return;
    }
    const Eigen::Index width = rows.cols();
    const Eigen::Index parameters =
        width - 1 - std::accumulate(parts_.begin(), parts_.end(), Eigen::Index{0});
    moments.leftCols(parameters).noalias() += rows.transpose() * rows.leftCols(parameters);
    const Eigen::Index others = width - parameters;
    moments.bottomRightCorner(1, others).noalias() += rows.rightCols(1).transpose() * rows.rightCols(others);
    // Between columns so far apart, all along the rows: within forms only few of them are needed, but memory
    // is read in its order.
    const Eigen::Index most_parts = *std::max_element(parts_.begin(), parts_.end());
    for (Eigen::Index apart = 0; apart < most_parts; ++apart) {
      const Eigen::RowVectorXd products =
          rows.leftCols(width - apart).cwiseProduct(rows.rightCols(width - apart)).colwise().sum();
      Eigen::Index first = parameters;
      for (const Eigen::Index parts : parts_) {
        for (Eigen::Index j = first; j + apart < first + parts; ++j) moments(j + apart, j) += products(j);
        first += parts;
      }
    }
  }

  const Whitening& whitening_;
  std::vector<Eigen::Index> parts_;
  GapStatistics& statistics_;
  std::size_t rows_per_block_;
  Eigen::Index width_;
  RowMatrix batch_;
  std::size_t block_ = 0;
  std::array<SensorRows, kSensorsPerAxis> rows_;
  std::array<std::size_t, kSensorsPerAxis> settled_{};  ///< rows of this stretch
  std::array<RepeatedLogarithm, kSensorsPerAxis> log_{};
};

}  // namespace

Eigen::MatrixXd GapStatistics::total() const {
  if (block.empty()) return {};
  Eigen::MatrixXd sum = block.front();
  for (std::size_t i = 1; i < block.size(); ++i) sum += block[i];
  return sum.selfadjointView<Eigen::Lower>();
}

double GapStatistics::total_rows() const {
  double sum = 0.0;
  for (const double n : rows) sum += n;
  return sum;
}

GapStatistics collect(Axis axis, const RecordingSignals& signals, std::span<const Stretch> stretches,
                      const GapModel& model, const Disturbances& disturbances, const Whitening& whitening,
                      double block_s, Moments moments) {
  GapStatistics statistics;
  statistics.may_remember = !signals.is_thinned;
  const bool has_columns = moments != Moments::kOfInnovations;
  Eigen::Index width = has_columns ? static_cast<Eigen::Index>(parameter_count(axis)) + 1 : 1;
  std::vector<Eigen::Index> parts;
  for (const gap::EffectForm& form : disturbances.forms) parts.push_back(form.parts);
  for (const Eigen::Index count : parts) width += count;
  if (moments == Moments::kAll) parts.clear();
  Collector collector(width, std::move(parts), signals, whitening, block_s, statistics);
  const auto take = [&collector](const Innovation& innovation) { collector.take(innovation); };
  for (const auto& [first, last] : stretches) {
    collector.begin_stretch();
    if (has_columns)
      run_observer(axis, signals, model, disturbances, first, last, take);
    else
      run_observer(axis, signals, model, first, last, take);
  }
  collector.flush();
  return statistics;
}

double unlikeliness_of(const GapStatistics& statistics, const Whitening& whitening) {
  double sum = 0.0;
  for (std::size_t i = 0; i < kSensorsPerAxis; ++i) {
    const auto& normalised = statistics.normalised[i];
    const auto is_finite = [](float value) { return std::isfinite(value); };
    if (!std::all_of(normalised.begin(), normalised.end(), is_finite))
      return std::numeric_limits<double>::infinity();
    const SensorWhitening& white = whitening[i];
    const auto& contact = statistics.in_contact[i];
    const auto cut = static_cast<double>(std::count(contact.begin(), contact.end(), true));
    const auto all = static_cast<double>(contact.size());
    sum += statistics.log_variance[i] +
           2.0 * ((all - cut) * std::log(white.scale[0]) + cut * std::log(white.scale[1])) +
           all * std::log(white.left);
  }
  return sum;
}

Whitening whitening_of(const GapStatistics& statistics) {
  Whitening whitening;
  for (std::size_t i = 0; i < kSensorsPerAxis; ++i)
    whitening[i] = whitening_of(statistics.normalised[i], statistics.in_contact[i], statistics.row[i],
                                statistics.may_remember);
  return whitening;
}

}  // namespace morepro::host
