#include "sim_host/diagnose/leftover/bursts.hpp"

#include <algorithm>
#include <cmath>

#include "sim_host/support/median.hpp"

namespace morepro::host {
namespace {

constexpr double kSurprising = 5.0;   // standard deviations: of noise one row in two millions
constexpr std::size_t kTogether = 3;  // rows, as far from each other at most
constexpr std::size_t kFewest = 3;    // of one burst: what surprises alone is a tail of the noise
constexpr std::size_t kFewestAll = 10;
// Of the rows. Of 129 axes without a gap (five other simulators, noise of Student's t with four degrees of
// freedom included) none had a burst; sensors that hang or spike now and then had 0.0012 and more.
constexpr double kLeastShare = 5.0e-4;

/// Standard deviation that innovations show, in those that the observer expects; at least 1.
double shown_deviation(const std::vector<float>& normalised) {
  constexpr double kDeviation = 1.4826;  // per median of the absolute value
  std::vector<double> magnitudes(normalised.size());
  std::ranges::transform(normalised, magnitudes.begin(),
                         [](float value) { return std::fabs(static_cast<double>(value)); });
  return std::max(1.0, kDeviation * median_of(magnitudes));
}

/// Collects the bursts of one sensor from its surprising rows.
class BurstCollector {
 public:
  explicit BurstCollector(const AxisFit& fit, Channel channel)
      : signals_(fit.signals()), column_(signals_.value[index_of(channel)]), bursts_{.channel = channel} {}

  void add(std::size_t row, double square) {
    if (rows_ > 0 && row - last_ > kTogether) end();
    if (rows_ == 0) first_ = row;
    last_ = row;
    ++rows_;
    squares_ += square;
    if (row > 0 && column_[row] == column_[row - 1]) ++repeats_;
  }

  /// `all`: rows that the sensor has.
  Bursts all_of(double all) {
    end();
    constexpr std::size_t kMostly = 2;
    bursts_.hangs = kMostly * repeats_of_all_ > bursts_.rows && !repeats_itself();
    bursts_.deviance = all * std::log1p(squares_of_all_ / all);
    return bursts_;
  }

 private:
  void end() {
    if (rows_ >= kFewest) {
      if (bursts_.times == 0) bursts_.first_s = signals_.start_s + signals_.time_s(first_);
      ++bursts_.times;
      bursts_.rows += rows_;
      squares_of_all_ += squares_;
      repeats_of_all_ += repeats_;
    }
    rows_ = repeats_ = 0;
    squares_ = 0.0;
  }

  /// Does it always, in coarse steps?
  [[nodiscard]] bool repeats_itself() const {
    constexpr std::size_t kOneInFour = 4;
    std::size_t repeats = 0;
    for (std::size_t row = 1; row < column_.size(); ++row)
      if (column_[row] == column_[row - 1]) ++repeats;
    return kOneInFour * repeats > column_.size();
  }

  const RecordingSignals& signals_;
  const std::vector<float>& column_;
  Bursts bursts_;
  std::size_t first_ = 0, last_ = 0, rows_ = 0, repeats_ = 0;  // of the one that goes on
  std::size_t repeats_of_all_ = 0;
  double squares_ = 0.0, squares_of_all_ = 0.0;
};

Bursts bursts_of_sensor(const AxisFit& fit, std::size_t sensor) {
  const std::vector<float>& normalised = fit.innovations().normalised[sensor];
  const std::vector<std::uint32_t>& row = fit.innovations().row[sensor];
  const double deviation = shown_deviation(normalised);
  BurstCollector collector(fit, channel_of(fit.axis(), sensor));
  for (std::size_t i = 0; i < normalised.size(); ++i) {
    const double value = static_cast<double>(normalised[i]) / deviation;
    if (std::fabs(value) > kSurprising) collector.add(row[i], value * value);
  }
  return collector.all_of(static_cast<double>(normalised.size()));
}

}  // namespace

std::vector<Bursts> bursts_of(const AxisFit& fit) {
  std::vector<Bursts> found;
  for (std::size_t sensor = 0; sensor < kSensorsPerAxis; ++sensor) {
    const std::size_t all = fit.innovations().normalised[sensor].size();
    if (all == 0) continue;
    const Bursts bursts = bursts_of_sensor(fit, sensor);
    const double least = std::max(static_cast<double>(kFewestAll), kLeastShare * static_cast<double>(all));
    if (static_cast<double>(bursts.rows) >= least) found.push_back(bursts);
  }
  return found;
}

}  // namespace morepro::host
