#include "sim_host/diagnose/gap_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace morepro::host {
namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Rows at the start in which the observer still settles.
constexpr std::size_t kSettling = 50;
constexpr Eigen::Index kBatch = 256;
// A row beyond this many standard deviations counts as one of them (Huber).
constexpr double kHuber = 5.0;

class Collector {
 public:
  Collector(Eigen::Index width, const RecordingSignals& signals, const Whitening& whitening, double block_s,
            GapStatistics& statistics)
      : whitening_(whitening),
        statistics_(statistics),
        rows_per_block_(std::max<std::size_t>(1, static_cast<std::size_t>(block_s * signals.rate_hz))),
        batch_(kBatch, width) {
    statistics.block_s = block_s;
    for (auto& recent : recent_) recent = RowMatrix::Zero(kRing, width);
  }

  void take(const Innovation& innovation) {
    const double normalised = innovation.value / std::sqrt(innovation.variance);
    statistics_.normalised[innovation.sensor].push_back(static_cast<float>(normalised));
    statistics_.in_contact[innovation.sensor].push_back(innovation.in_contact);
    statistics_.log_variance[innovation.sensor] += std::log(innovation.variance);
    whiten(innovation);
    if (++seen_[innovation.sensor] <= kSettling) return;
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
    statistics_.block[block_].selfadjointView<Eigen::Lower>().rankUpdate(batch_.topRows(filled_).transpose());
    statistics_.rows[block_] += static_cast<double>(filled_);
    filled_ = 0;
  }

 private:
  static constexpr Eigen::Index kRing = 32;

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
  GapStatistics& statistics_;
  std::size_t rows_per_block_;
  RowMatrix batch_;
  Eigen::Index filled_ = 0;
  std::size_t block_ = 0;
  std::array<RowMatrix, kSensorsPerAxis> recent_;
  std::array<std::size_t, kSensorsPerAxis> seen_{};
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

GapStatistics collect(Axis axis, const RecordingSignals& signals, const GapModel& model,
                      const Disturbances& disturbances, const Whitening& whitening, double block_s) {
  GapStatistics statistics;
  statistics.may_remember = !signals.is_thinned;
  std::size_t terms = 0;
  for (const gap::EffectForm& form : disturbances.forms) terms += form.parts;
  const auto width = static_cast<Eigen::Index>(parameter_count(axis) + terms + 1);
  Collector collector(width, signals, whitening, block_s, statistics);
  run_observer(axis, signals, model, disturbances, 0, signals.rows,
               [&collector](const Innovation& innovation) { collector.take(innovation); });
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
