#include "sim_host/diagnose/gap_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace morepro::host {
namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Rows at the start of a stretch in which the observer still settles.
constexpr std::size_t kSettling = 50;
constexpr Eigen::Index kBatch = 256;
// A row beyond this many standard deviations counts as one of them (Huber).
constexpr double kHuber = 5.0;

class Collector {
 public:
  /// `parts` of each form; empty for all moments.
  Collector(Eigen::Index width, std::vector<Eigen::Index> parts, const RecordingSignals& signals,
            const Whitening& whitening, double block_s, GapStatistics& statistics)
      : whitening_(whitening),
        parts_(std::move(parts)),
        statistics_(statistics),
        rows_per_block_(std::max<std::size_t>(1, static_cast<std::size_t>(block_s * signals.rate_hz))),
        batch_(kBatch, width) {
    statistics.block_s = block_s;
    for (auto& values : statistics.normalised) values.reserve(signals.rows);
    for (auto& recent : recent_) recent = RowMatrix::Zero(kRing, width);
  }

  void begin_stretch() { settled_ = {}; }

  void take(const Innovation& innovation) {
    const double normalised = innovation.value / std::sqrt(innovation.variance);
    statistics_.normalised[innovation.sensor].push_back(static_cast<float>(normalised));
    statistics_.in_contact[innovation.sensor].push_back(innovation.in_contact);
    statistics_.log_variance[innovation.sensor] += std::log(innovation.variance);
    whiten(innovation);
    ++seen_[innovation.sensor];
    if (++settled_[innovation.sensor] <= kSettling) return;
    const std::size_t block = innovation.row / rows_per_block_;
    if (block != block_) flush();
    block_ = block;
    push(innovation.sensor);
  }

  void flush() {
    if (filled_ == 0) return;
    const Eigen::Index width = batch_.cols();
    while (statistics_.block.size() <= block_) {
      statistics_.block.emplace_back(Eigen::MatrixXd::Zero(width, width));
      statistics_.rows.push_back(0.0);
    }
    add(batch_.topRows(filled_), statistics_.block[block_]);
    statistics_.rows[block_] += static_cast<double>(filled_);
    filled_ = 0;
  }

 private:
  static constexpr Eigen::Index kRing = 32;

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
    Eigen::Index first = parameters;
    for (const Eigen::Index parts : parts_) {
      const auto form = rows.middleCols(first, parts);
      moments.block(first, first, parts, parts).noalias() += form.transpose().lazyProduct(form);
      first += parts;
    }
  }

  void whiten(const Innovation& innovation) {
    const SensorWhitening& white = whitening_[innovation.sensor];
    RowMatrix& ring = recent_[innovation.sensor];
    const double weight = 1.0 / (white.scale[innovation.in_contact ? 1 : 0] * std::sqrt(innovation.variance));
    const auto now = static_cast<Eigen::Index>(seen_[innovation.sensor]) % kRing;
    const auto columns = static_cast<Eigen::Index>(innovation.columns.size());
    ring.row(now).head(columns) =
        weight * Eigen::Map<const Eigen::RowVectorXd>(innovation.columns.data(), columns);
    ring(now, columns) = weight * innovation.value;
  }

  void push(std::size_t sensor) {
    const SensorWhitening& white = whitening_[sensor];
    const RowMatrix& ring = recent_[sensor];
    const auto newest = static_cast<Eigen::Index>(seen_[sensor] - 1);
    auto row = batch_.row(filled_);
    row = ring.row(newest % kRing);
    for (std::size_t i = 0; i < SensorWhitening::kLags.size(); ++i) {
      const auto lag = static_cast<Eigen::Index>(SensorWhitening::kLags[i]);
      if (white.memory[i] != 0.0) row -= white.memory[i] * ring.row((newest - lag) % kRing);
    }
    const double size = std::fabs(row(row.size() - 1));
    if (size > kHuber) row *= std::sqrt(kHuber / size);
    if (++filled_ == kBatch) flush();
  }

  const Whitening& whitening_;
  std::vector<Eigen::Index> parts_;
  GapStatistics& statistics_;
  std::size_t rows_per_block_;
  RowMatrix batch_;
  Eigen::Index filled_ = 0;
  std::size_t block_ = 0;
  std::array<RowMatrix, kSensorsPerAxis> recent_;
  std::array<std::size_t, kSensorsPerAxis> seen_{};
  std::array<std::size_t, kSensorsPerAxis> settled_{};  ///< rows of this stretch
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

double unlikeliness_of(const GapStatistics& statistics) {
  double sum = 0.0;
  const Whitening whitening = whitening_of(statistics);
  for (std::size_t i = 0; i < kSensorsPerAxis; ++i) {
    const auto& normalised = statistics.normalised[i];
    const auto is_finite = [](float value) { return std::isfinite(value); };
    if (!std::all_of(normalised.begin(), normalised.end(), is_finite))
      return std::numeric_limits<double>::quiet_NaN();
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
    whitening[i] = whitening_of(statistics.normalised[i], statistics.in_contact[i], statistics.may_remember);
  return whitening;
}

}  // namespace morepro::host
