#include "sim_host/diagnose/fit/input_news.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace morepro::host {
namespace {

constexpr std::size_t kMemory = 24;        // rows
constexpr double kPastStiffness = 1.0e-9;  // keeps a past that repeats itself solvable
constexpr double kLargestNews = 5.0;  // standard deviations: what moves on purpose tells nothing of the state

/// From row to row; 0 where nothing is known.
std::vector<double> changes_of(const std::vector<float>& input) {
  std::vector<double> change(input.size(), 0.0);
  double last = std::nan("");
  for (std::size_t i = 0; i < input.size(); ++i) {
    if (std::isnan(input[i])) continue;
    const auto now = static_cast<double>(input[i]);
    if (!std::isnan(last)) change[i] = now - last;
    last = now;
  }
  return change;
}

/// Weights of the last changes that predict the next one best.
Eigen::VectorXd memory_of(const std::vector<double>& change) {
  constexpr auto kCount = static_cast<Eigen::Index>(kMemory);
  using Values = Eigen::Map<const Eigen::VectorXd>;
  Eigen::VectorXd covariance = Eigen::VectorXd::Zero(kCount + 1);
  const auto rows = static_cast<Eigen::Index>(change.size()) - kCount;
  const Values now(change.data() + kMemory, rows);
  for (Eigen::Index age = 0; age <= kCount; ++age)
    covariance(age) = now.dot(Values(change.data() + kCount - age, rows));
  if (!(covariance(0) > 0.0)) return Eigen::VectorXd::Zero(kCount);
  Eigen::MatrixXd past(kCount, kCount);
  for (Eigen::Index i = 0; i < kCount; ++i)
    for (Eigen::Index j = 0; j < kCount; ++j) past(i, j) = covariance(std::abs(i - j));
  past.diagonal().array() += kPastStiffness * covariance(0);
  return past.ldlt().solve(covariance.tail(kCount));
}

std::vector<float> news_of(const std::vector<float>& input) {
  std::vector<float> news(input.size(), 0.0F);
  if (input.size() <= 2 * kMemory) return news;
  const std::vector<double> change = changes_of(input);
  const Eigen::VectorXd memory = memory_of(change);
  double squares = 0.0;
  for (std::size_t i = kMemory; i < input.size(); ++i) {
    double left = change[i];
    for (std::size_t age = 1; age <= kMemory; ++age)
      left -= memory(static_cast<Eigen::Index>(age) - 1) * change[i - age];
    news[i] = static_cast<float>(left);
    squares += left * left;
  }
  const auto most = static_cast<float>(kLargestNews * std::sqrt(squares / static_cast<double>(input.size())));
  for (float& value : news) value = std::clamp(value, -most, most);
  return news;
}

}  // namespace

InputNews input_news(Axis axis, const RecordingSignals& signals, const GapModel& model) {
  const Channel channel = axis == Axis::kFeed ? Channel::kFeedForce : Channel::kArmatureVoltage;
  const std::vector<float>& input = signals.value[index_of(channel)];
  const std::vector<float> news = news_of(input);
  std::array<std::vector<double>, kSensorsPerAxis> usual;
  for (auto& sensor : usual) sensor.assign(signals.rows, 0.0);
  run_observer(axis, signals, model, 0, signals.rows, [&](const Innovation& innovation) {
    usual[innovation.sensor][innovation.row] = innovation.value;
  });
  InputNews result;
  RecordingSignals again = signals;
  for (std::size_t tap = 0; tap < InputNews::kTaps; ++tap) {
    for (auto& sensor : result.change[tap]) sensor.assign(signals.rows, 0.0F);
    for (std::size_t row = tap; row < input.size(); ++row)
      again.value[index_of(channel)][row] = input[row] + news[row - tap];
    run_observer(axis, again, model, 0, signals.rows, [&](const Innovation& innovation) {
      const auto& [row, sensor] = std::pair(innovation.row, innovation.sensor);
      const double change = innovation.value - usual[sensor][row];
      result.change[tap][sensor][row] = static_cast<float>(change);
      if (tap == 0) result.answer += change * usual[sensor][row] / innovation.variance;
    });
  }
  return result;
}

}  // namespace morepro::host
