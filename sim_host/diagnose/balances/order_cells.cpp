#include "sim_host/diagnose/balances/order_cells.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "sim_host/diagnose/balances/significance.hpp"
#include "sim_host/support/turn.hpp"

namespace morepro::host {
namespace {

// So long that an order is told from its neighbours at any speed worth the name.
constexpr std::size_t kRowsPerPiece = 2048;
constexpr double kFewestTurns = 4.0;

/// In ascending order.
std::vector<int> orders_of(const MachineParameters& machine) {
  std::vector<int> orders{1, 2, 3, 4, 5, 6, 7, 8};
  const auto teeth = static_cast<int>(machine.tool.teeth);
  for (const int order : {teeth, 2 * teeth})
    if (order > orders.back()) orders.push_back(order);
  return orders;
}

std::vector<double> angles_of(const RecordingSignals& signals, const MachineParameters& machine) {
  std::vector<double> angles(signals.rows);
  FrameSource frames(signals, machine, 0);
  double angle = 0.0;
  double speed = 0.0;
  for (double& value : angles) {
    const auto frame = frames.next();
    if (frame.has_speed) speed = frame.speed_rad_s;
    angle = frame.has_angle ? frame.angle_rad : angle + speed / signals.rate_hz;
    value = angle;
  }
  return angles;
}

std::size_t sensor_of(gap::Balance balance, const RecordingSignals& signals) {
  if (balance == gap::Balance::kSpindleTorque) return 0;
  if (balance == gap::Balance::kArmatureVoltage) return 1;
  return signals.has(Channel::kFeedSpeed) ? 1 : 0;
}

struct OrderPowers {
  std::vector<double> power;
  double pieces = 0.0;
};

/// Power of the innovations of one sensor at every order, in pieces in which the spindle turns.
OrderPowers powers(const AxisFit& fit, const GapModel& model, std::size_t sensor,
                   const std::vector<double>& angles, const std::vector<int>& orders) {
  OrderPowers result{.power = std::vector<double>(orders.size(), 0.0)};
  std::vector<std::complex<double>> sum(orders.size());
  std::size_t filled = 0;
  run_observer(fit.axis(), fit.signals(), model, 0, fit.signals().rows, [&](const Innovation& v) {
    if (v.sensor != sensor) return;
    const std::complex<double> turn = std::polar(1.0, -angles[v.row]);
    std::complex<double> rotated = v.value / std::sqrt(v.variance);
    int order = 0;
    for (std::size_t k = 0; k < orders.size(); ++k) {
      for (; order < orders[k]; ++order) rotated *= turn;
      sum[k] += rotated;
    }
    if (++filled < kRowsPerPiece) return;
    const double turned = std::fabs(angles[v.row] - angles[v.row - std::min(v.row, kRowsPerPiece)]) / kTurn;
    if (turned >= kFewestTurns) {
      for (std::size_t k = 0; k < orders.size(); ++k) result.power[k] += std::norm(sum[k]);
      result.pieces += 1.0;
    }
    std::fill(sum.begin(), sum.end(), 0.0);
    filled = 0;
  });
  return result;
}

}  // namespace

std::vector<GapCell> order_cells(gap::Balance balance, const AxisDiagnosis& diagnosis) {
  const AxisFit& fit = diagnosis.fit;
  const RecordingSignals& signals = fit.signals();
  std::vector<GapCell> cells;
  if (diagnosis.found.empty()) return cells;  // before is after
  if (!signals.has(Channel::kSpindleSpeed) && !signals.has(Channel::kSpindleAngle)) return cells;
  const std::vector<double> angles = angles_of(signals, fit.model().machine);
  const std::vector<int> orders = orders_of(fit.model().machine);
  const std::size_t sensor = sensor_of(balance, signals);
  GapModel nominal = diagnosis.nominal.model();
  nominal.noise = fit.model().noise;
  const OrderPowers before = powers(fit, nominal, sensor, angles, orders);
  const OrderPowers after = powers(fit, fit.model(), sensor, angles, orders);
  if (after.pieces < 2.0) return cells;
  for (std::size_t k = 0; k < orders.size(); ++k) {
    const double ratio = after.power[k] > 0.0 ? before.power[k] / after.power[k] : 1.0;
    const auto order = static_cast<double>(orders[k]);
    cells.push_back({"order", order, order, ratio, p_value_of(ratio, 2.0 * after.pieces)});
  }
  return cells;
}

}  // namespace morepro::host
