#include "sim_host/diagnose/leftover/bursts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sim_host/support/median.hpp"

namespace morepro::host {
namespace {

constexpr double kSurprisingValue = 5.0;  // standard deviations: of noise one row in two millions
constexpr std::size_t kApart = 3;         // rows, within a burst at most
constexpr std::size_t kFewestInOne = 3;   // what surprises alone is a tail of the noise
constexpr std::size_t kFewestInAll = 10;
// Of the rows. Of 125 axes without a gap (five other simulators, noise of Student's t with four degrees of
// freedom included) none had a burst; sensors that hang or spike now and then had 0.0012 and more.
constexpr double kLeastShareOfRows = 5.0e-4;

/// Standard deviation that innovations show, in those that the observer expects; at least 1.
double shown_deviation(const std::vector<float>& normalised) {
  std::vector<double> magnitudes(normalised.size());
  std::ranges::transform(normalised, magnitudes.begin(),
                         [](float value) { return std::fabs(static_cast<double>(value)); });
  return std::max(1.0, kDeviationPerMedian * median_of(magnitudes));
}

/// Collects the bursts of one sensor from its surprising rows, which come in their order.
class BurstCollector {
 public:
  explicit BurstCollector(const RecordingSignals& signals, Channel channel)
      : signals_(signals), column_(signals.value[index_of(channel)]), bursts_{.channel = channel} {}

  void add(std::size_t row, double square) {
    if (rows_ > 0 && row - last_ > kApart) end();
    if (rows_ == 0) first_ = row;
    last_ = row;
    ++rows_;
    squares_ += square;
    if (row > 0 && column_[row] == column_[row - 1]) ++repeats_;
  }

  /// What was left out before: how far it was off nobody knows, but it surprised.
  void add(const StuckSensor& stuck) {
    end();
    const double squares = kSurprisingValue * kSurprisingValue * static_cast<double>(stuck.rows);
    count(stuck.first_row, stuck.times, stuck.rows, squares, stuck.rows);
  }

  /// `all`: rows of the sensor.
  Bursts all_of(double all) {
    end();
    bursts_.hangs = 2 * repeats_of_all_ > bursts_.rows && !repeats_itself();
    bursts_.deviance = all * std::log1p(squares_of_all_ / all);
    return bursts_;
  }

 private:
  void end() {
    if (rows_ >= kFewestInOne) count(first_, 1, rows_, squares_, repeats_);
    rows_ = repeats_ = 0;
    squares_ = 0.0;
  }

  void count(std::size_t first_row, std::size_t times, std::size_t rows, double squares,
             std::size_t repeats) {
    const double first_s = signals_.start_s + signals_.time_s(first_row);
    bursts_.first_s = bursts_.times == 0 ? first_s : std::min(bursts_.first_s, first_s);
    bursts_.times += times;
    bursts_.rows += rows;
    squares_of_all_ += squares;
    repeats_of_all_ += repeats;
  }

  /// Does it always, in coarse steps?
  [[nodiscard]] bool repeats_itself() const {
    std::size_t repeats = 0;
    for (std::size_t row = 1; row < column_.size(); ++row)
      if (column_[row] == column_[row - 1]) ++repeats;
    return 4 * repeats > column_.size();
  }

  const RecordingSignals& signals_;
  const std::vector<float>& column_;
  Bursts bursts_;
  std::size_t first_ = 0, last_ = 0, rows_ = 0, repeats_ = 0;  // of the one that goes on
  double squares_ = 0.0;
  std::size_t repeats_of_all_ = 0;
  double squares_of_all_ = 0.0;
};

void add_surprises(const GapStatistics& left, std::size_t sensor, BurstCollector& bursts) {
  const std::vector<float>& normalised = left.normalised[sensor];
  const std::vector<std::uint32_t>& row = left.row[sensor];
  const double deviation = shown_deviation(normalised);
  std::size_t settled = 0;
  for (std::size_t i = 0; i < normalised.size(); ++i) {
    settled = i > 0 && row[i] - row[i - 1] <= kLongestBridge ? settled + 1 : 0;
    const double value = static_cast<double>(normalised[i]) / deviation;
    if (settled >= kSettlingRows && std::fabs(value) > kSurprisingValue) bursts.add(row[i], value * value);
  }
}

}  // namespace

std::vector<Bursts> bursts_of(const AxisFit& fit) {
  std::vector<Bursts> found;
  for (std::size_t sensor = 0; sensor < kSensorsPerAxis; ++sensor) {
    const GapStatistics& left = fit.innovations();
    if (left.normalised[sensor].empty()) continue;
    auto all = static_cast<double>(left.normalised[sensor].size());
    const Channel channel = channel_of(fit.axis(), sensor);
    BurstCollector collector(fit.signals(), channel);
    add_surprises(left, sensor, collector);
    for (const StuckSensor& stuck : fit.signals().stuck) {
      if (stuck.channel != channel) continue;
      collector.add(stuck);
      all += static_cast<double>(stuck.rows);
    }
    const Bursts bursts = collector.all_of(all);
    const double least = std::max(static_cast<double>(kFewestInAll), kLeastShareOfRows * all);
    if (static_cast<double>(bursts.rows) >= least) found.push_back(bursts);
  }
  return found;
}

}  // namespace morepro::host
