#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "lib/estimation/feed_filter.hpp"
#include "lib/estimation/ud_covariance.hpp"
#include "lib/identification/learning_mode.hpp"
#include "lib/identification/outlier_gate.hpp"
#include "lib/identification/period_response.hpp"
#include "lib/identification/retraction.hpp"

namespace morepro {

/// Order of the feed axis's parameters in its filter.
enum class FeedParameter : std::uint8_t {
  kMass,
  kContactForce,
  kViscousFriction,  ///< where the mode finds it
};
inline constexpr std::size_t kFeedParameterCount = 2;  ///< on line

/// Extended Kalman filter over [position, speed] of the feed axis and the logarithms of its mass and contact
/// force. Works from a measured speed, a measured position or both. Process noise and UD form as in
/// SpindleParameterFilter. Bounded time; may run in an interrupt. `Mode`: see learning_mode.hpp.
template <class Real, class Mode = OnLine>
class FeedParameterFilter {
 public:
  static constexpr std::size_t kCount = kFeedParameterCount + (Mode::kFindsFriction ? 1 : 0);
  using Values = std::array<Real, kCount>;

  FeedParameterFilter(const MachineParameters& machine, Real period_s, Real start_fraction,
                      Real drift_fraction)
      : viscous_friction_(static_cast<Real>(machine.feed.viscous_friction_ns_m)),
        contact_offset_(static_cast<Real>(machine.feed.contact_offset_n)),
        period_s_(period_s),
        start_variance_(start_fraction * start_fraction),
        drift_variance_(drift_fraction * drift_fraction),
        datasheet_{static_cast<Real>(machine.feed.mass_kg), static_cast<Real>(machine.feed.contact_force_n)} {
    if constexpr (Mode::kFindsFriction) datasheet_[kFriction] = viscous_friction_;
    forget();
  }

  /// Back to the datasheet.
  void forget() {
    anchor_at(datasheet_);
    forget_covariance({Real(1), Real(1)});
  }

  /// As SpindleParameterFilter::anchor_at. A contact force of 0 in the datasheet is no parameter.
  void anchor_at(const Values& values) {
    value_ = values;
    if constexpr (Mode::kFindsFriction) viscous_friction_ = values[kFriction];
    if constexpr (Mode::kIsAnchored)
      for (std::size_t j = 0; j < kCount; ++j)
        deviation_.value[j] = values[j] > Real(0) ? math::log(datasheet_[j] / values[j]) : Real(0);
  }

  /// Position and speed start from the measurement; what is known of the parameters stays.
  void restart_state(const FeedMeasurement<Real>& y) {
    x_ = y.has_position() ? y.position_m : Real(0);
    v_ = y.has_speed() ? y.speed_m_s : Real(0);
    covariance_.restart(0, y.has_position() ? y.position_variance : Real(1));
    covariance_.restart(1, y.has_speed() ? y.speed_variance : Real(1));
    gate_.restart();
    if constexpr (Mode::kIsAnchored) v_regressor() = v_;
  }

  /// As SpindleParameterFilter::hold.
  void hold(bool is_still) requires Mode::kIsAnchored { deviation_.is_still = is_still; }

  /// Over the period that ended with the present frame.
  void predict(const FeedInput<Real>& input, Real speed_variance) {
    const Real mass = value_[0], contact_force = value_[1];
    const Real h = period_s_, per_mass = Real(1) / mass;
    const Real pushed = input.contact * input.engagement * contact_force;
    const Real force = input.force_n - viscous_friction_ * v_ - pushed - input.contact * contact_offset_;
    const FeedResponse<Real> response(viscous_friction_ * per_mass, h);
    const Real acceleration = force * per_mass;
    const Real from_contact = -pushed * per_mass;
    Values slope{-acceleration, from_contact};
    if constexpr (Mode::kIsAnchored) {
      // At rest the force only answers to noise, and friction carries it: beside a held speed it would look
      // like an acceleration.
      if (!deviation_.is_still)
        v_regressor() = v_;
      else if (viscous_friction_ > Real(0))
        slope[0] = Real(0);
    }
    if constexpr (Mode::kFindsFriction) slope[kFriction] = -viscous_friction_ * v_regressor() * per_mass;
    std::array<Values, 2> g;
    for (std::size_t j = 0; j < kCount; ++j) {
      g[0][j] = slope[j] * response.way_per_acceleration;
      g[1][j] = slope[j] * response.per_acceleration;
    }
    covariance_.predict({{{Real(1), response.per_acceleration}, {Real(0), response.kept}}}, g,
                        {speed_variance * h * h, speed_variance});
    x_ += h * v_ + response.way_per_acceleration * acceleration;
    v_ += response.per_acceleration * acceleration;
    if constexpr (Mode::kIsAnchored) {
      for (std::size_t j = 0; j < kCount; ++j) {
        x_ += g[0][j] * deviation_.value[j];
        v_ += g[1][j] * deviation_.value[j];
      }
    }
  }

  /// As SpindleParameterFilter::drift.
  void drift(FeedParameter parameter, Real frames) {
    const std::size_t j = index_of(parameter);
    const Real known = covariance_.variance(2 + j);
    if (has_left(learnt_from_[j], value_[j], known, start_variance_))
      return forget_covariance({covariance_.variance(0), covariance_.variance(1)});
    const Real q = drift_variance_ * frames;
    if (known + q < Real(kKnown) * start_variance_) covariance_.add_variance(2 + j, q);
  }

  /// Uses the measurements; returns the normalised innovation squared.
  Real update(const FeedMeasurement<Real>& y) {
    Real of_speed{}, of_position{};
    if (y.has_speed()) of_speed = update_one<1>(y.speed_m_s - v_, y.speed_variance);
    if (y.has_position()) of_position = update_one<0>(y.position_m - x_, y.position_variance);
    gate_.step(of_speed > of_position ? of_speed : of_position);
    return of_speed + of_position;
  }
  /// As SpindleParameterFilter::has_lost_the_state.
  [[nodiscard]] bool has_lost_the_state() const { return gate_.has_lost_the_state(); }

  [[nodiscard]] Real value(FeedParameter parameter) const {
    const std::size_t j = index_of(parameter);
    if constexpr (Mode::kIsAnchored)
      return moved(value_[j], deviation_.value[j], datasheet_[j]);
    else
      return value_[j];
  }
  /// Relative variance of one parameter, and relative covariance of two.
  [[nodiscard]] Real covariance(FeedParameter a, FeedParameter b) const {
    return covariance_.covariance(index_of(a) + 2, index_of(b) + 2);
  }
  [[nodiscard]] Real start_variance() const { return start_variance_; }
  /// Of the last update; empty in OnLine.
  [[nodiscard]] const typename Mode::template Record<Real>& record() const { return record_; }

 private:
  using Covariance = UdCovariance<Real, 2 + kCount>;

  static constexpr std::size_t kFriction = kFeedParameterCount;

  /// Parameters whose standard deviation fell below a sixth of the datasheet's may drift.
  static constexpr double kKnown = 1.0 / 36.0;

  Real& v_regressor() requires Mode::kIsAnchored { return deviation_.held; }

  static constexpr std::size_t index_of(FeedParameter parameter) {
    return static_cast<std::size_t>(parameter);
  }

  /// As SpindleParameterFilter::forget_covariance.
  void forget_covariance(const std::array<Real, 2>& state_variance) {
    learnt_from_ = value_;
    typename Covariance::Vector start;
    start.fill(start_variance_);
    if constexpr (Mode::kFindsFriction)
      start[2 + kFriction] = Real(Mode::kFrictionFraction * Mode::kFrictionFraction);
    start[0] = state_variance[0];
    start[1] = state_variance[1];
    covariance_.restart(start);
  }

  template <std::size_t kElement>
  Real update_one(Real innovation, Real variance) {
    const auto update = covariance_.template update<kElement>(variance);
    record_.take(kElement, innovation, update.innovation_variance);
    const Real nis = innovation * innovation / update.innovation_variance;
    if (!Mode::kIsAnchored && nis > Real(OutlierGate<Real>::kLargest)) return nis;
    x_ += update.gain[0] * innovation;
    v_ += update.gain[1] * innovation;
    for (std::size_t j = 0; j < kCount; ++j) {
      if constexpr (Mode::kIsAnchored)
        deviation_.value[j] += update.gain[2 + j] * innovation;
      else
        value_[j] = moved(value_[j], update.gain[2 + j] * innovation, datasheet_[j]);
    }
    return nis;
  }

  Real viscous_friction_;
  Real contact_offset_;
  Real period_s_;
  Real start_variance_;
  Real drift_variance_;
  Values datasheet_;
  Values value_{};
  Values learnt_from_{};  ///< values at which the covariance began
  Real x_{}, v_{};
  OutlierGate<Real> gate_;
  Covariance covariance_{{}};
  [[no_unique_address]] typename Mode::template Record<Real> record_{};
  [[no_unique_address]] typename Mode::template Deviation<Values> deviation_{};
};

}  // namespace morepro
