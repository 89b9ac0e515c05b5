#pragma once

namespace morepro {

/// Frames arrive one after the other: every step is linearised at the present estimate, behind guards against the false
/// certainty of a first estimate that is far off.
struct OnLine {
  static constexpr bool kIsAnchored = false;
  template <class Values>
  struct Deviation {};
};

/// One more pass over frames that are there already: every step is linearised at the values that an earlier pass found,
/// and the logarithmic deviation from them is estimated linearly. One pass is a Gauss-Newton step of the whole
/// recording, and its covariance that of a linear problem: no direction seems known because the linearisation moved.
struct Anchored {
  static constexpr bool kIsAnchored = true;
  template <class Values>
  using Deviation = Values;
};

}  // namespace morepro
