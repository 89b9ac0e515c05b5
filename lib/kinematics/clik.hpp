#pragma once
#include <cstdint>

#include "lib/kinematics/damped_inverse.hpp"
#include "lib/kinematics/differential.hpp"
#include "lib/kinematics/segment.hpp"

namespace morepro::kinematics {

enum class ClikError : std::uint8_t {
  kNone = 0,
  kPeriod = 1,  ///< the period is not positive and finite
  kGain = 2,    ///< the gain is outside 0 < K < 2/period: the error would grow from step to step
  kRows = 3,    ///< no row is asked for, or a bit beyond the sixth is set
};

/// Closed-loop inverse kinematics (thesis equation 10). The error shrinks by (1 - K h) a step: it does not
/// overshoot up to K = 1/h, alternates above, and grows from 2/h on. At a constant acceleration a the error
/// settles at h a / (2 K).
struct ClikSettings {
  double gain_per_s = 50.0;
  double period_s = 1.0e-3;
  TaskRows rows = kRollRows;

  [[nodiscard]] constexpr ClikError validate() const {
    if (!(period_s > 0.0 && period_s <= 1.0e3)) return ClikError::kPeriod;
    if (!(gain_per_s > 0.0 && gain_per_s * period_s < 2.0)) return ClikError::kGain;
    return rows == 0 || rows > kAllRows ? ClikError::kRows : ClikError::kNone;
  }
};

/// What the joints must do now.
template <class Real>
struct ClikStep {
  Twist<Real> error = Twist<Real>::Zero();  ///< wanted minus actual, m and rad
  JointVector<Real> rate{};                 ///< m/s, rad/s
  Real damping = 0;                         ///< 0 away from singularities
};

/// Follows a moving tool with the joints of any chain. Fixed memory; a step may run in an interrupt. With
/// joint values that are not finite nothing is promised.
template <class Real>
class Clik {
 public:
  /// Settings and table must have been validated.
  Clik(const Chain<Real>& chain, const ClikSettings& settings, const JointVector<Real>& start)
      : chain_(chain),
        mobility_(chain, settings.rows),
        gain_per_s_(Real(settings.gain_per_s)),
        period_s_(Real(settings.period_s)),
        home_(chain.frames({}).tool().rotation),
        joints_(start) {}

  [[nodiscard]] const JointVector<Real>& joints() const { return joints_; }

  /// q' = J^-1 (x' + K e), for the joints as they are.
  [[nodiscard]] ClikStep<Real> solve(const ToolState<Real>& wanted) const {
    const Place place(*this, wanted);
    return {place.error, place.inverse.rates(in_task(wanted.speed + place.error * gain_per_s_)),
            place.inverse.damping()};
  }

  /// The derivative of that rate, m/s2 and rad/s2: q'' = J^-1 (x'' + K e' - J' q'), for the joints as they
  /// are. The motion does not need it.
  [[nodiscard]] JointVector<Real> acceleration(const ToolState<Real>& wanted) const {
    const Place place(*this, wanted);
    const JointVector<Real> rate = place.inverse.rates(in_task(wanted.speed + place.error * gain_per_s_));
    const Twist<Real> error_rate = wanted.speed - tool_speed(chain_, place.jacobian, rate);
    const Twist<Real> bias = rate_of_jacobian_times_rate(chain_, place.frames, rate);
    return place.inverse.rates(in_task(wanted.acceleration + error_rate * gain_per_s_ - bias));
  }

  /// Solves, then moves the joints on by one period (explicit Euler).
  ClikStep<Real> step(const ToolState<Real>& wanted) {
    const ClikStep<Real> result = solve(wanted);
    for (std::size_t i = 0; i < chain_.count(); ++i) joints_[i] += period_s_ * result.rate[i];
    return result;
  }

 private:
  /// Everything that follows from where the joints are.
  struct Place {
    Place(const Clik& clik, const ToolState<Real>& wanted)
        : frames(clik.chain_.frames(clik.joints_)),
          jacobian(clik.chain_.jacobian(frames)),
          inverse(clik.mobility_, clik.chain_.count(), jacobian),
          error(task_error(clik.mobility_.rows(), wanted.position_m, product(wanted.turn, clik.home_),
                           frames.tool())) {}

    ChainFrames<Real> frames;
    Jacobian<Real> jacobian;
    DampedInverse<Real> inverse;
    Twist<Real> error;
  };

  Twist<Real> in_task(Twist<Real> v) const {
    for (int row = 0; row < 6; ++row) {
      if (!has_row(mobility_.rows(), row)) v(row) = Real(0);
    }
    return v;
  }

  Chain<Real> chain_;
  Mobility<Real> mobility_;
  Real gain_per_s_;
  Real period_s_;
  Matrix3<Real> home_;
  JointVector<Real> joints_;
};

}  // namespace morepro::kinematics
