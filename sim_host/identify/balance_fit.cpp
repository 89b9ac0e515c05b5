#include "sim_host/identify/balance_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "sim_host/identify/axis_traits.hpp"
#include "sim_host/identify/derivative_source.hpp"

namespace morepro::host {
namespace {

constexpr int kMostBalanceSteps = 20;
constexpr std::size_t kPieces = 50;
constexpr double kSmallBalanceStep = 0.1;  // of a standard error
constexpr double kLargestBalanceStep = 0.7;

template <class Balance>
class Fit {
 public:
  Fit(DerivativeBalance balance, const RecordingSignals& signals, const MonitorConfiguration& c,
      const OnPass& on_pass)
      : balance_(balance), signals_(signals), machine_(c.machine), on_pass_(on_pass) {
    for (std::size_t j = 0; j < kAll; ++j) value_[j] = value_in(machine_, Balance::kValues[j]);
  }

  AxisEstimate run() {
    bool has_settled = false;
    for (int step = 0; step < kMostBalanceSteps && !has_settled; ++step) {
      on_pass_();
      pass();
      has_settled = move();
    }
    if (balance_ == DerivativeBalance::kVoltage) {
      const double error = mean_current_error(value_[1] / (value_[0] * signals_.rate_hz));
      covariance_(0, 0) += error * error;
    }
    return {.names = {Balance::kValues.begin(), Balance::kValues.end()},
            .value = {value_.begin(), value_.end()},
            .covariance = covariance_,
            .has_settled = has_settled,
            .correlation = correlation_};
  }

 private:
  static constexpr int kAll = static_cast<int>(Balance::kValues.size());
  using Vector = Eigen::Matrix<double, kAll, 1>;
  using Matrix = Eigen::Matrix<double, kAll, kAll>;

  /// The sums of one pass: what the residuals have in common with the slopes, and how that would change.
  void pass() {
    sensitivity_ = Matrix::Zero();
    sum_ = Vector::Zero();
    spread_ = Matrix::Zero();
    Matrix own = Matrix::Zero(), shared = Matrix::Zero();
    DerivativeSource source(signals_, machine_, balance_);
    Vector piece = Vector::Zero(), last_z = Vector::Zero();
    double square = 0.0, neighbour = 0.0, product = 0.0;
    std::size_t count = 0;
    std::array<double, 2> last{};
    const std::size_t length = signals_.rows / kPieces + 1;
    for (std::size_t row = 0; source.next(); ++row) {
      if (row % length == length - 1) close(piece);
      const auto sample = source.sample();
      const auto before = source.before();
      if (!sample || !before) continue;
      const auto now = Balance::row(value_, machine_, sample->input);
      const auto instrument = Balance::row(value_, machine_, *before);
      const double residual = sample->derivative - now.derivative;
      const Eigen::Map<const Vector> z(instrument.slope.data()), slope(now.slope.data());
      sensitivity_ += z * slope.transpose();
      piece += z * residual;
      own += z * z.transpose();
      shared += z * last_z.transpose() + last_z * z.transpose();
      last_z = z;
      ++count;
      square += residual * residual;
      neighbour += residual * last[0];
      product += residual * last[1];  // differences have noise in common with their neighbours
      last = {residual, last[0]};
    }
    close(piece);
    if (count > 0) widen((square * own + neighbour * shared) / static_cast<double>(count));
    correlation_ = square > 0.0 ? std::max(product / square, 0.0) : 0.0;
  }

  void close(Vector& piece) {
    sum_ += piece;
    spread_ += piece * piece.transpose();
    piece.setZero();
  }

  /// Where a few rows hold all of the information they fit by construction and show no spread: at least that
  /// of residuals as large as all of them, of which only neighbours have noise in common.
  void widen(const Matrix& least) {
    const Eigen::SelfAdjointEigenSolver<Matrix> more(least - spread_);
    for (int k = 0; k < kAll; ++k) {
      const Vector direction = more.eigenvectors().col(k);
      spread_ += std::max(more.eigenvalues()(k), 0.0) * direction * direction.transpose();
    }
  }

  /// A step in the combinations that the recording tells better than the datasheet does. Returns whether it
  /// was small.
  bool move() {
    const Matrix datasheet = datasheet_deviations().asDiagonal();
    const Matrix scaled = sensitivity_ * datasheet;
    const Eigen::JacobiSVD<Matrix> svd(scaled, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Matrix inverse = Matrix::Zero();
    covariance_ = Matrix::Zero();
    for (int k = 0; k < kAll; ++k) {
      const Vector u = svd.matrixU().col(k), v = datasheet * svd.matrixV().col(k);
      const double size = svd.singularValues()(k);
      if (std::sqrt(u.dot(spread_ * u)) < size)
        inverse += v * u.transpose() / size;
      else
        covariance_ += v * v.transpose();
    }
    const Matrix told = inverse * spread_ * inverse.transpose();
    covariance_ += told;
    const Vector step = inverse * sum_;
    bool is_small = true;
    for (int j = 0; j < kAll; ++j) {
      value_[static_cast<std::size_t>(j)] *=
          std::exp(std::clamp(step(j), -kLargestBalanceStep, kLargestBalanceStep));
      is_small = is_small && std::abs(step(j)) <= kSmallBalanceStep * std::sqrt(told(j, j));
    }
    return is_small;
  }

  static Vector datasheet_deviations() {
    Vector deviations;
    for (int j = 0; j < kAll; ++j)
      deviations(j) = datasheet_fraction(Balance::kValues[static_cast<std::size_t>(j)]);
    return deviations;
  }

  DerivativeBalance balance_;
  const RecordingSignals& signals_;
  MachineParameters machine_;
  const OnPass& on_pass_;
  typename Balance::Values value_{};
  Matrix sensitivity_, spread_, covariance_;
  Vector sum_;
  double correlation_ = 0.0;
};

}  // namespace

template <class Balance>
AxisEstimate fit_balance(DerivativeBalance balance, const RecordingSignals& signals,
                         const MonitorConfiguration& configuration, const OnPass& on_pass) {
  return Fit<Balance>(balance, signals, configuration, on_pass).run();
}

template AxisEstimate fit_balance<TorqueBalance>(DerivativeBalance, const RecordingSignals&,
                                                 const MonitorConfiguration&, const OnPass&);
template AxisEstimate fit_balance<ForceBalance>(DerivativeBalance, const RecordingSignals&,
                                                const MonitorConfiguration&, const OnPass&);
template AxisEstimate fit_balance<VoltageBalance>(DerivativeBalance, const RecordingSignals&,
                                                  const MonitorConfiguration&, const OnPass&);

}  // namespace morepro::host
