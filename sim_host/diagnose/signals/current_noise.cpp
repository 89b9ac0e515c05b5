#include "sim_host/diagnose/signals/current_noise.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <vector>

#include "sim_host/support/median.hpp"

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

}  // namespace

double most_noise_of_current(const RecordingSignals& signals) {
  for (const Channel needed : {Channel::kArmatureVoltage, Channel::kArmatureCurrent, Channel::kSpindleSpeed})
    if (!signals.has(needed)) return 0.0;
  std::vector<RowAndNext> rows;
  for (std::size_t i = 0; i + 1 < signals.rows; ++i)
    if (const RowAndNext row = row_at(i, signals); row.allFinite()) rows.push_back(row);
  if (rows.size() < kFewestPieces * kRowsOfPiece) return 0.0;

  RowAndNext scale = RowAndNext::Zero();
  for (const RowAndNext& row : rows) scale += row.cwiseAbs2();
  scale = (scale.array() > 0.0).select(scale.cwiseSqrt().cwiseInverse(), 1.0);
  Eigen::Matrix<double, 6, 6> moments = Eigen::Matrix<double, 6, 6>::Zero();
  for (RowAndNext& row : rows) {
    row = row.cwiseProduct(scale);
    moments += row * row.transpose();
  }
  Eigen::Matrix<double, 5, 5> known = moments.topLeftCorner<5, 5>();
  known.diagonal().array() += 1.0e-12;  // a voltage that never changes is in no law
  const Eigen::Matrix<double, 5, 1> law = known.ldlt().solve(moments.topRightCorner<5, 1>());

  std::vector<double> variances;
  for (std::size_t first = 0; first + kRowsOfPiece <= rows.size(); first += kRowsOfPiece) {
    double squares = 0.0;
    for (std::size_t i = first; i < first + kRowsOfPiece; ++i) {
      const double left = rows[i](5) - law.dot(rows[i].head<5>());
      squares += left * left;
    }
    variances.push_back(squares / static_cast<double>(kRowsOfPiece));
  }
  return std::sqrt(median_of(variances)) / scale(5);
}

}  // namespace morepro::host
