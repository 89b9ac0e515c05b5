#include "sim_host/diagnose/balances/line_columns.hpp"

#include <Eigen/LU>
#include <cmath>

#include "sim_host/support/turn.hpp"

namespace morepro::host {
namespace {

/// Phase of the line in every row, rad.
Eigen::VectorXd phases_of(const LeftLine& line, const RecordingSignals& signals) {
  Eigen::VectorXd phases(static_cast<Eigen::Index>(signals.rows));
  const auto& speed = signals.value[index_of(Channel::kSpindleSpeed)];
  const double step_s = 1.0 / signals.rate_hz;
  double rate_rad_s = kTurn * line.frequency;
  double phase = 0.0;
  for (std::size_t i = 0; i < signals.rows; ++i) {
    phases(static_cast<Eigen::Index>(i)) = phase;
    if (line.is_order && speed[i] == speed[i])
      rate_rad_s = line.frequency * std::fabs(static_cast<double>(speed[i]));
    phase += rate_rad_s * step_s;
  }
  return phases;
}

/// Cosine and sine that fit best to `values`, of which some may be unknown.
Eigen::Vector2d amplitude_of(const Eigen::VectorXd& values, const Eigen::VectorXd& phases, Eigen::Index first,
                             Eigen::Index last) {
  Eigen::Matrix2d moments = 1.0e-9 * Eigen::Matrix2d::Identity();
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (Eigen::Index i = first; i < last; ++i) {
    if (std::isnan(values(i))) continue;
    const Eigen::Vector2d wave(std::cos(phases(i)), std::sin(phases(i)));
    moments += wave * wave.transpose();
    sum += values(i) * wave;
  }
  return moments.inverse() * sum;
}

}  // namespace

gap::Balance balance_of(Axis axis, const LeftLine& line) {
  if (axis == Axis::kFeed) return gap::Balance::kFeedForce;
  return line.sensor == 0 ? gap::Balance::kSpindleTorque : gap::Balance::kArmatureVoltage;
}

void add_line(const LeftLine& line, const RecordingSignals& signals, const Eigen::VectorXd& coefficient,
              BalanceIncrements& balance) {
  constexpr double kInStep = 0.25;  // of what tells two frequencies apart
  Eigen::MatrixXf& columns = balance.columns;
  const Eigen::VectorXd left =
      columns.rightCols(1).cast<double>() - columns.leftCols(coefficient.size()).cast<double>() * coefficient;
  const Eigen::VectorXd phases = phases_of(line, signals);
  const double longest = kInStep * kTurn * line.frequency / line.resolution;
  const Eigen::Index rows = std::min(left.size(), phases.size());
  for (Eigen::Index first = 0, last = 0; first < rows; first = last) {
    while (last < rows && phases(last) - phases(first) < longest) ++last;
    const Eigen::Vector2d amplitude = amplitude_of(left, phases, first, last);
    for (Eigen::Index i = first; i < last; ++i)
      columns(i, columns.cols() - 2) +=
          static_cast<float>(amplitude(0) * std::cos(phases(i)) + amplitude(1) * std::sin(phases(i)));
  }
}

}  // namespace morepro::host
