#pragma once
#include <algorithm>
#include <array>
#include <cstddef>

#include "lib/math/matrix_exponential.hpp"

namespace morepro::gap {

/// Share of an estimate by which the sum of a state's driven changes is drawn to it at every sample.
inline constexpr float kDrivenLeak = 0.01F;

/// One measurement against its prediction, divided by the standard deviation that the observer expects; and
/// what a disturbance of each column, of size one since the start, would have added to it.
template <class Real, std::size_t kMostColumns>
struct InnovationRow {
  bool is_measured = false;
  Real innovation = 0;
  Real variance = 1;  ///< in the sensor's unit, squared
  std::array<Real, kMostColumns> column{};
};

/// Kalman filter of two states that carries, for every disturbance that might act, how far the true state
/// would be from the estimated one (generalised likelihood ratio, Willsky and Jones 1976). Innovations of a
/// right model are white and uncorrelated with everything before, in closed loop and with process noise too;
/// rows of increments over windows are not: the controller feeds back what the window holds. Measurements are
/// taken one by one, so that those of one instant come out uncorrelated.
template <class Real, std::size_t kMostColumns>
class TwoStateObserver {
 public:
  using Row = InnovationRow<Real, kMostColumns>;
  using Columns = std::array<Real, kMostColumns>;
  using Matrix = math::BasicMatrix2<Real>;

  void set_columns(std::size_t count) { columns_ = std::min(count, kMostColumns); }
  [[nodiscard]] std::size_t columns() const { return columns_; }

  void start(Real x0, Real x1, Real variance0, Real variance1) {
    mean_ = {x0, x1};
    p00_ = variance0;
    p01_ = Real(0);
    p11_ = variance1;
    error0_.fill(Real(0));
    error1_.fill(Real(0));
  }

  [[nodiscard]] Real mean(std::size_t state) const { return mean_[state]; }
  [[nodiscard]] Real variance(std::size_t state) const { return state == 0 ? p00_ : p11_; }

  /// Takes `residual` = measurement - prediction of state `kState`; `sensor_error[j]` is what column j adds
  /// to the sensor itself.
  template <std::size_t kState>
  void update(Real residual, Real sensor_variance, const Columns& sensor_error, Row& row) {
    const Real own = kState == 0 ? p00_ : p11_;
    row.is_measured = true;
    row.innovation = residual;
    row.variance = own + sensor_variance;
    const Real gain0 = (kState == 0 ? p00_ : p01_) / row.variance;
    const Real gain1 = (kState == 0 ? p01_ : p11_) / row.variance;
    mean_[0] += gain0 * residual;
    mean_[1] += gain1 * residual;
    const Columns& error = kState == 0 ? error0_ : error1_;
    for (std::size_t j = 0; j < columns_; ++j) row.column[j] = error[j] + sensor_error[j];
    for (std::size_t j = 0; j < columns_; ++j) {
      error0_[j] -= gain0 * row.column[j];
      error1_[j] -= gain1 * row.column[j];
    }
    shrink<kState>(gain0, gain1, row.variance, sensor_variance);
  }

  /// Moves on: the mean to where the caller's model puts it, covariance and sensitivities by its
  /// linearisation. `rate0[j]`, `rate1[j]`: what column j adds to the derivatives of the states. `noise`:
  /// covariance that the interval adds; a01 is read, a10 is its mirror.
  void predict(Real x0, Real x1, const Matrix& phi, const Matrix& integral, const Matrix& noise,
               const Columns& rate0, const Columns& rate1) {
    mean_ = {x0, x1};
    for (std::size_t j = 0; j < columns_; ++j) {
      const Real e0 = error0_[j];
      const Real e1 = error1_[j];
      error0_[j] = phi.a00 * e0 + phi.a01 * e1 + integral.a00 * rate0[j] + integral.a01 * rate1[j];
      error1_[j] = phi.a10 * e0 + phi.a11 * e1 + integral.a10 * rate0[j] + integral.a11 * rate1[j];
    }
    const Real a = phi.a00 * p00_ + phi.a01 * p01_;
    const Real b = phi.a00 * p01_ + phi.a01 * p11_;
    const Real c = phi.a10 * p00_ + phi.a11 * p01_;
    const Real d = phi.a10 * p01_ + phi.a11 * p11_;
    p00_ = a * phi.a00 + b * phi.a01 + noise.a00;
    p01_ = a * phi.a10 + b * phi.a11 + noise.a01;
    p11_ = c * phi.a10 + d * phi.a11 + noise.a11;
  }

  /// Adds to what column j has made of the states.
  void add(std::size_t j, const std::array<Real, 2>& change) {
    error0_[j] += change[0];
    error1_[j] += change[1];
  }

  /// Adds the covariance of an input of variance `variance` that moves the states by `gain0` and `gain1`.
  void blur(Real gain0, Real gain1, Real variance) {
    p00_ += gain0 * gain0 * variance;
    p01_ += gain0 * gain1 * variance;
    p11_ += gain1 * gain1 * variance;
  }

 private:
  // own * sensor / sum cannot become negative.
  template <std::size_t kState>
  void shrink(Real gain0, Real gain1, Real sum, Real sensor_variance) {
    const Real other = kState == 0 ? gain1 * gain1 * sum : gain0 * gain0 * sum;
    const Real kept = sensor_variance / sum;
    p01_ *= kept;
    if (kState == 0) {
      p00_ *= kept;
      p11_ = std::max(p11_ - other, Real(0));
    } else {
      p11_ *= kept;
      p00_ = std::max(p00_ - other, Real(0));
    }
  }

  std::size_t columns_ = 0;
  std::array<Real, 2> mean_{};
  Real p00_ = 0;
  Real p01_ = 0;
  Real p11_ = 0;
  Columns error0_{};
  Columns error1_{};
};

}  // namespace morepro::gap
