#include "sim_host/diagnose/balances/balance_rows.hpp"

#include <algorithm>
#include <cmath>

#include "sim_host/diagnose/balances/balance_increments.hpp"
#include "sim_host/diagnose/balances/line_columns.hpp"
#include "sim_host/diagnose/balances/noise_floor.hpp"
#include "sim_host/diagnose/fit/linear_fit.hpp"

namespace morepro::host {
namespace {

constexpr double kPieceS = 2.0;
constexpr double kFewestPieces = 6.0;
constexpr double kSizeSpread = 0.1;

/// Rows of one window: [band and phase] x [columns of the increments].
struct Window {
  std::size_t first = 0;
  bool in_contact = false;
  std::size_t piece = 0;
  Eigen::MatrixXd rows;
};

/// Does the spindle stand in the cut? What holds it changes its side within the noise of its speed, so that
/// the speed that is measured does not tell the torque.
class StandingInCut {
 public:
  StandingInCut(gap::Balance balance, const AxisFit& fit)
      : speed_(fit.signals().value[index_of(Channel::kSpindleSpeed)]) {
    constexpr double kFew = 3.0;
    constexpr double kTellsSide = 0.1;
    const double side_rad_s = fit.model().machine.contact.speed_scale_rad_s;
    const double noise_rad_s = std::sqrt(fit.model().noise.speed_variance);
    const bool is_told = noise_rad_s < kTellsSide * side_rad_s;
    if (balance == gap::Balance::kSpindleTorque && !is_told)
      slow_rad_s_ = kFew * std::max(side_rad_s, noise_rad_s);
  }
  bool operator()(const Window& window) const {
    if (!window.in_contact || !(slow_rad_s_ > 0.0) || speed_.size() < window.first + kWindowLength)
      return false;
    double sum = 0.0;
    for (std::size_t i = 0; i < kWindowLength; ++i)
      sum += std::fabs(static_cast<double>(speed_[window.first + i]));
    return sum < slow_rad_s_ * static_cast<double>(kWindowLength);
  }

 private:
  const std::vector<float>& speed_;
  double slow_rad_s_ = 0.0;  ///< 0: it is told
};

/// Pieces that have windows, counted one after the other: each half of them is fitted to the other.
void number_pieces(std::vector<Window>& windows) {
  std::size_t pieces = 0;
  for (std::size_t i = 0, last = 0; i < windows.size(); ++i) {
    const std::size_t piece = windows[i].piece;
    if (i > 0 && piece != last) ++pieces;
    last = piece;
    windows[i].piece = pieces;
  }
}

std::vector<Window> windows_of(const BalanceIncrements& balance, const AxisFit& fit) {
  const RecordingSignals& signals = fit.signals();
  const Eigen::MatrixXf& phi = test_functions();
  const auto length = static_cast<Eigen::Index>(kWindowLength);
  const double piece_s = std::min(kPieceS, signals.duration_s() / kFewestPieces);
  const auto& contact = signals.value[index_of(Channel::kContact)];
  const StandingInCut stands_in_cut(balance.balance, fit);
  std::vector<Window> windows;
  for (Eigen::Index first = 0; first + length <= balance.columns.rows(); first += length / 2) {
    const auto part = balance.columns.middleRows(first, length);
    Window window;
    window.first = static_cast<std::size_t>(first);
    window.rows = (phi * part).cast<double>();
    if (!window.rows.allFinite()) continue;
    const std::size_t middle = window.first + kWindowLength / 2;
    window.in_contact = middle < contact.size() && contact[middle] > 0.0F;
    window.piece = static_cast<std::size_t>(signals.time_s(middle) / piece_s);
    if (!stands_in_cut(window)) windows.push_back(std::move(window));
  }
  number_pieces(windows);
  return windows;
}

/// Standard deviations of the rows that the model with effects leaves: per band, without and with contact.
using Scales = std::array<std::array<double, 2>, kRowsPerWindow>;

using Coefficients = Eigen::VectorXd;

Eigen::VectorXd residual_of(const Window& window, const Coefficients& coefficient) {
  return window.rows.rightCols(1) - window.rows.leftCols(coefficient.size()) * coefficient;
}

/// Weighted least squares over some windows; without the effect, its coefficient is 0. With it, the others
/// are what they are `known` to be: speed and current are measured, and regressors with noise make
/// coefficients too small.
template <class Chosen>
Coefficients fitted(const std::vector<Window>& windows, const BalanceIncrements& balance, const Scales& scale,
                    bool with_effect, Chosen chosen) {
  const Eigen::Index width = windows.front().rows.cols();
  Eigen::MatrixXd moments = Eigen::MatrixXd::Zero(width, width);
  for (const Window& window : windows) {
    if (!chosen(window)) continue;
    Eigen::MatrixXd rows = window.rows;
    for (Eigen::Index r = 0; r < rows.rows(); ++r)
      rows.row(r) /= scale[static_cast<std::size_t>(r)][window.in_contact];
    moments += rows.transpose() * rows;
  }
  std::vector<Eigen::Index> active;
  for (Eigen::Index j = 0; j + 1 < width; ++j) {
    const bool is_effect = j + 2 == width;
    if (moments(j, j) > 0.0 && (with_effect || !is_effect)) active.push_back(j);
  }
  // A trace of a prior: columns that are combinations of others do not run away.
  Eigen::VectorXd precision = Eigen::VectorXd::Zero(width);
  for (const Eigen::Index j : active) precision(j) = 1.0e-9 * moments(j, j);
  // The effects have the size that the innovations gave them, give or take a tenth.
  Eigen::VectorXd target = Eigen::VectorXd::Zero(width);
  if (with_effect) {
    precision(width - 2) = 1.0 / (kSizeSpread * kSizeSpread);
    target(width - 2) = 1.0;
  }
  const bool acts_here = moments(width - 2, width - 2) > 0.0;
  const auto& known = with_effect ? balance.known : balance.nominal;
  for (std::size_t i = 0; acts_here && i < known.size(); ++i) {
    if (!(known[i].error > 0.0)) continue;
    const auto j = static_cast<Eigen::Index>(i);
    precision(j) = 1.0 / (known[i].error * known[i].error);
    target(j) = known[i].value;
  }
  const LinearFit solution = fit(moments, active, precision, target);
  Coefficients coefficient = Coefficients::Zero(width - 1);
  for (std::size_t i = 0; i < active.size(); ++i)
    coefficient(active[i]) = solution.coefficient(static_cast<Eigen::Index>(i));
  return coefficient;
}

Scales scales_of(const std::vector<Window>& windows, const Coefficients& coefficient) {
  Scales sum{};
  Scales count{};
  for (const Window& window : windows) {
    const Eigen::VectorXd residual = residual_of(window, coefficient);
    for (std::size_t r = 0; r < kRowsPerWindow; ++r) {
      sum[r][window.in_contact] +=
          residual(static_cast<Eigen::Index>(r)) * residual(static_cast<Eigen::Index>(r));
      count[r][window.in_contact] += 1.0;
    }
  }
  for (std::size_t r = 0; r < kRowsPerWindow; ++r)
    for (std::size_t c = 0; c < 2; ++c)
      sum[r][c] = count[r][c] > 0.0 ? std::sqrt(std::max(sum[r][c] / count[r][c], 1.0e-300)) : 1.0;
  return sum;
}

WindowPower power_of(const Window& window, const Coefficients& coefficient, const Scales& scale) {
  const Eigen::VectorXd residual = residual_of(window, coefficient);
  WindowPower power{.first = window.first};
  for (std::size_t r = 0; r < kRowsPerWindow; ++r) {
    const double value = residual(static_cast<Eigen::Index>(r)) / scale[r][window.in_contact];
    power.power[band_of_row(r)] += value * value / rows_of_band(band_of_row(r));
  }
  return power;
}

std::vector<WindowPower> powers_of(const std::vector<Window>& windows, const Coefficients& coefficient,
                                   const Scales& scale) {
  std::vector<WindowPower> powers;
  for (const Window& window : windows) powers.push_back(power_of(window, coefficient, scale));
  return powers;
}

double total_of(const WindowPower& power) {
  double sum = 0.0;
  for (std::size_t band = 0; band < kBands; ++band) sum += rows_of_band(band) * power.power[band];
  return sum;
}

/// Of what the coefficients leave in each row, what is noise.
Scales floor_of(const std::vector<Window>& windows, const Coefficients& coefficient, const Scales& left) {
  std::vector<WindowResidual> residuals;
  for (const Window& window : windows) {
    residuals.push_back({.first = window.first, .in_contact = window.in_contact});
    Eigen::Map<Eigen::VectorXd>(residuals.back().row.data(), kRowsPerWindow) =
        residual_of(window, coefficient);
  }
  const NoiseShares shares = noise_shares(residuals);
  Scales floor = left;
  for (std::size_t r = 0; r < kRowsPerWindow; ++r)
    for (std::size_t c = 0; c < 2; ++c) floor[r][c] *= std::sqrt(shares[band_of_row(r)][c]);
  return floor;
}

void hold_out(const std::vector<Window>& windows, const BalanceIncrements& balance, const Scales& scale,
              BalanceRows& rows) {
  const std::size_t pieces = windows.back().piece + 1;
  rows.held_out_before.assign(pieces, 0.0);
  rows.held_out_after.assign(pieces, 0.0);
  for (std::size_t parity = 0; parity < 2; ++parity) {
    const auto is_training = [parity](const Window& w) { return w.piece % 2 != parity; };
    const Coefficients before = fitted(windows, balance, scale, false, is_training);
    const Coefficients after = fitted(windows, balance, scale, true, is_training);
    for (const Window& window : windows) {
      if (is_training(window)) continue;
      rows.held_out_before[window.piece] += total_of(power_of(window, before, scale));
      rows.held_out_after[window.piece] += total_of(power_of(window, after, scale));
    }
  }
}

/// The same with lines beside the effects in the model, each of what those before it leave.
std::vector<Window> windows_with_lines(BalanceIncrements balance, const AxisFit& fit,
                                       Coefficients coefficient, const std::vector<LeftLine>& lines) {
  coefficient.tail(1).setConstant(1.0);
  for (const LeftLine& line : lines) add_line(line, fit.signals(), coefficient, balance);
  return windows_of(balance, fit);
}

std::vector<LeftLine> lines_of(gap::Balance balance, Axis axis, const Leftover& leftover) {
  std::vector<LeftLine> lines;
  for (const LeftLine& line : leftover.lines)
    if (!line.is_seen_twice && balance_of(axis, line) == balance) lines.push_back(line);
  return lines;
}

BalanceRows rows_of(const BalanceIncrements& balance, const AxisFit& fit, const Leftover* leftover) {
  BalanceRows rows{.balance = balance.balance};
  std::vector<Window> windows = windows_of(balance, fit);
  if (windows.size() < 4) return rows;
  const auto all = [](const Window&) { return true; };
  Scales scale;
  for (auto& pair : scale) pair = {1.0, 1.0};
  Coefficients before;
  Coefficients after;
  for (int round = 0; round < 3; ++round) {
    before = fitted(windows, balance, scale, false, all);
    after = fitted(windows, balance, scale, true, all);
    scale = scales_of(windows, after);
  }
  const auto lines =
      leftover == nullptr ? std::vector<LeftLine>{} : lines_of(balance.balance, fit.axis(), *leftover);
  if (!lines.empty()) {
    windows = windows_with_lines(balance, fit, after, lines);
    after = fitted(windows, balance, scale, true, all);
    scale = scales_of(windows, after);
  }
  if (leftover != nullptr || mean_power(powers_of(windows, before, scale)) > kLeastGap) {
    scale = floor_of(windows, after, scale);
    before = fitted(windows, balance, scale, false, all);
    after = fitted(windows, balance, scale, true, all);
  }
  rows.before = powers_of(windows, before, scale);
  rows.after = powers_of(windows, after, scale);
  if (leftover == nullptr) hold_out(windows, balance, scale, rows);
  return rows;
}

}  // namespace

std::vector<BalanceRows> balance_rows(const AxisDiagnosis& diagnosis, const Leftover* leftover) {
  std::vector<BalanceRows> all;
  for (const BalanceIncrements& balance : balance_increments(diagnosis))
    all.push_back(rows_of(balance, diagnosis.fit, leftover));
  return all;
}

}  // namespace morepro::host
