#pragma once
#include <array>
#include <cstddef>

#include "lib/math/elementary.hpp"

namespace morepro {

/// Frames arrive one after the other: every step is linearised at the present estimate, behind guards against
/// the false certainty of a first estimate that is far off.
struct OnLine {
  static constexpr bool kIsAnchored = false;
  static constexpr bool kFindsFriction = false;
  template <class Values>
  struct Deviation {};
  template <class Real>
  struct Record {
    void take(std::size_t /*element*/, Real /*innovation*/, Real /*variance*/) {}
  };
};

/// One more pass over frames that are there already: every step is linearised at the values that an earlier
/// pass found, and the logarithmic deviation from them is estimated linearly. One pass is a Gauss-Newton step
/// of the whole recording, and its covariance that of a linear problem: no direction seems known because the
/// linearisation moved.
struct Anchored {
  static constexpr bool kIsAnchored = true;
  static constexpr bool kFindsFriction = false;
  template <class Values>
  struct Deviation {
    Values value{};                                        ///< of the logarithms from those of the anchor
    bool is_still = false;                                 ///< what the slopes are made of is held
    typename Values::value_type held{};                    ///< the feed speed that a rest holds
    std::array<typename Values::value_type, 2> at_rest{};  ///< the spindle's speed and current that it holds
  };
  /// What the last update saw of each measured element.
  template <class Real>
  struct Record {
    void take(std::size_t element, Real innovation, Real variance) {
      normalised[element] = innovation / math::sqrt(variance);
      log_variance[element] = math::log(variance);
    }
    std::array<Real, 2> normalised{};  ///< innovation in standard deviations
    std::array<Real, 2> log_variance{};
  };
};

/// The same with the axis's viscous friction (> 0 in the datasheet) as one more parameter, the last: where it
/// is wrong, all that it is balanced with would be wrong by as much, and sure of it.
struct AnchoredWithFriction : Anchored {
  static constexpr bool kFindsFriction = true;
  /// Standard deviation of the datasheet's friction, relative. Where the frames do not tell it, what is
  /// balanced with it is known no better: in a steady cut of the thesis machine 4 % of the torque constant.
  static constexpr double kFrictionFraction = 0.1;
};

}  // namespace morepro
