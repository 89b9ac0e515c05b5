#include "sim_host/diagnose/signals/current_noise.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace morepro::host {
namespace {

constexpr std::size_t kRowsOfPiece = 256;
constexpr std::size_t kFewestPieces = 8;

/// One, voltage, current and speed of a row, speed and current of the next one.
using RowAndNext = Eigen::Matrix<double, 6, 1>;

RowAndNext row_at(std::size_t row, const RecordingSignals& signals) {
  const auto at = [&](Channel channel, std::size_t i) {
    return static_cast<double>(signals.value[index_of(channel)][i]);
  };
  RowAndNext values;
  values << 1.0, at(Channel::kArmatureVoltage, row), at(Channel::kArmatureCurrent, row),
      at(Channel::kSpindleSpeed, row), at(Channel::kSpindleSpeed, row + 1),
      at(Channel::kArmatureCurrent, row + 1);
  return values;
}

/// Least squares over all rows.
using Law = Eigen::Matrix<double, 5, 1>;
Law law_of_current(const RecordingSignals& signals) {
  Eigen::Matrix<double, 6, 6> moments = Eigen::Matrix<double, 6, 6>::Zero();
  for (std::size_t i = 0; i + 1 < signals.rows; ++i)
    if (const RowAndNext row = row_at(i, signals); row.allFinite()) moments += row * row.transpose();
  const Law size = moments.diagonal().head<5>().cwiseSqrt();
  const Law scale = (size.array() > 0.0).select(size.cwiseInverse(), 1.0);
  Eigen::Matrix<double, 5, 5> known = scale.asDiagonal() * moments.topLeftCorner<5, 5>() * scale.asDiagonal();
  known.diagonal().array() += 1.0e-12;  // a voltage that never changes is in no law
  const Law across = moments.topRightCorner<5, 1>();
  return scale.cwiseProduct(known.ldlt().solve(scale.cwiseProduct(across)));
}

}  // namespace

// Of most pieces, not of half of them: the current of a machine that rests may be quieter.
double most_noise_of_current(const RecordingSignals& signals) {
  constexpr double kMost = 0.9;
  for (const Channel needed : {Channel::kArmatureVoltage, Channel::kArmatureCurrent, Channel::kSpindleSpeed})
    if (!signals.has(needed)) return 0.0;
  const Law law = law_of_current(signals);
  std::vector<double> variances;
  double squares = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i + 1 < signals.rows; ++i) {
    const RowAndNext row = row_at(i, signals);
    if (!row.allFinite()) continue;
    const double left = row(5) - law.dot(row.head<5>());
    squares += left * left;
    if (++count < kRowsOfPiece) continue;
    variances.push_back(squares / static_cast<double>(count));
    squares = 0.0;
    count = 0;
  }
  if (variances.size() < kFewestPieces) return 0.0;
  const auto most =
      variances.begin() + static_cast<std::ptrdiff_t>(kMost * static_cast<double>(variances.size()));
  std::nth_element(variances.begin(), most, variances.end());
  return std::sqrt(*most);
}

}  // namespace morepro::host
