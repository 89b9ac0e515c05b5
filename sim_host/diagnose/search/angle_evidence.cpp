#include "sim_host/diagnose/search/angle_evidence.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace morepro::host {
namespace {

constexpr std::size_t kPieces = 48;
constexpr Eigen::Index kFewestPieces = 12;

/// One line of the regression: what the sensor shows beyond the angle over a piece, in rad/s, and the columns
/// that may explain it.
struct Piece {
  double excess_rad_s = 0.0;
  Eigen::Vector3d columns = Eigen::Vector3d::Zero();  ///< bias, scale, lag
};

/// Rows [first, last], less the pairs of which a sample is missing; absent where most of them are.
std::optional<Piece> piece_of(const RecordingSignals& signals, std::size_t first, std::size_t last,
                              double onset_s) {
  const auto& speeds = signals.value[index_of(Channel::kSpindleSpeed)];
  const auto& angles = signals.value[index_of(Channel::kSpindleAngle)];
  const double interval_s = 1.0 / signals.rate_hz;
  double pairs = 0.0, late_pairs = 0.0;
  double by_angle_rad = 0.0, excess_rad = 0.0, change_rad_s = 0.0;
  for (std::size_t row = first; row < last; ++row) {
    const auto now_rad_s = static_cast<double>(speeds[row]);
    const auto next_rad_s = static_cast<double>(speeds[row + 1]);
    const double step_rad = 0.5 * interval_s * (now_rad_s + next_rad_s);
    const double turned_rad = static_cast<double>(angles[row + 1]) - static_cast<double>(angles[row]);
    // An angle may begin anew with each turn.
    const double beyond_rad = std::remainder(step_rad - turned_rad, 2.0 * std::numbers::pi);
    if (!std::isfinite(beyond_rad)) continue;
    pairs += 1.0;
    late_pairs += signals.time_s(row) >= onset_s ? 1.0 : 0.0;
    excess_rad += beyond_rad;
    by_angle_rad += step_rad - beyond_rad;
    change_rad_s += next_rad_s - now_rad_s;
  }
  if (pairs < 0.5 * static_cast<double>(last - first)) return std::nullopt;
  const double length_s = interval_s * pairs;
  return Piece{excess_rad / length_s, {late_pairs / pairs, by_angle_rad / length_s, change_rad_s / length_s}};
}

/// What the machine file states of it.
double known_bias_rad_s(const GapModel& model) {
  double sum = 0.0;
  for (const gap::AppliedEffect& known : model.known)
    if (known.form.effect == gap::Effect::kSpindleSpeedBias) sum += known.coefficient[0];
  return sum;
}

}  // namespace

std::optional<ToldBias> bias_told_by_angle(const RecordingSignals& signals, double onset_s) {
  if (!signals.has(Channel::kSpindleAngle) || !signals.has(Channel::kSpindleSpeed)) return std::nullopt;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  Eigen::Vector3d products = Eigen::Vector3d::Zero();
  double squares = 0.0;
  Eigen::Index count = 0;
  const std::size_t length = signals.rows / kPieces;
  for (std::size_t first = 0; length > 0 && first + length < signals.rows; first += length) {
    const auto piece = piece_of(signals, first, first + length, onset_s);
    if (!piece) continue;
    moments += piece->columns * piece->columns.transpose();
    products += piece->excess_rad_s * piece->columns;
    squares += piece->excess_rad_s * piece->excess_rad_s;
    ++count;
  }
  if (count < kFewestPieces) return std::nullopt;
  // Of a spindle that never changes its speed nothing tells its lag, and nothing asks for it.
  moments.diagonal() *= 1.0 + 1.0e-9;
  const Eigen::LDLT<Eigen::Matrix3d> solver(moments);
  const Eigen::Vector3d found = solver.solve(products);
  const double left = std::max(squares - found.dot(products), 0.0) / static_cast<double>(count - 3);
  const double variance = left * solver.solve(Eigen::Vector3d::Unit(0).eval())(0);
  if (!std::isfinite(found(0)) || !(variance > 0.0)) return std::nullopt;
  return ToldBias{found(0), std::sqrt(variance)};
}

double angle_evidence(const AxisFit& fit, double evidence) {
  const gap::AppliedEffect& newest = fit.model().effects.back();
  if (newest.form.effect != gap::Effect::kSpindleSpeedBias || !(evidence > 0.0)) return 0.0;
  const auto told = bias_told_by_angle(fit.signals(), newest.onset_s);
  if (!told) return 0.0;
  const double beyond_known = told->bias_rad_s - known_bias_rad_s(fit.model());
  const double without = beyond_known / told->standard_error_rad_s;
  const double with = (beyond_known - newest.coefficient[0]) / told->standard_error_rad_s;
  return std::min(without * without - with * with, 2.0 * evidence);
}

}  // namespace morepro::host
