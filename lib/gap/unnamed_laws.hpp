#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "lib/gap/effect_scales.hpp"
#include "lib/gap/effect_signals.hpp"
#include "lib/math/elementary.hpp"

/// Smooth functions of what is measured, without a cause: what they explain of a residual is structure,
/// whatever it is. Of order one at the reference point, so that one threshold serves all.
namespace morepro::gap::laws {

inline constexpr std::uint8_t kUnnamedSpindleLaws = 26;
inline constexpr std::uint8_t kUnnamedBeforePlaces = 16;  ///< of the feed, that know no single place
inline constexpr std::uint8_t kUnnamedPlaces = 8;  ///< bells along the way of the axis, of three laws each
inline constexpr std::uint8_t kUnnamedFeedLaws = kUnnamedBeforePlaces + 3 * kUnnamedPlaces;

template <class Real>
[[gnu::always_inline]] inline Real unnamed_spindle(std::uint8_t law, const EffectSignals<Real>& s,
                                                   const EffectScales<Real>& k) {
  const Real w = s.speed_rad_s / k.speed_rad_s;
  const Real i = s.current_a / k.current_a;
  const Real v = s.feed_speed_m_s / k.feed_speed_m_s;
  const Real cut = s.contact;
  const Real hot = (s.winding_degc - k.winding_degc) * Real(0.02);
  switch (law) {
    case 0:
      return Real(1);
    case 1:
      return w;
    case 2:
      return w * w;
    case 3:
      return w * math::abs(w);
    case 4:
      return w * w * w;
    case 5:
      return math::tanh(Real(20) * w);
    case 6:
      return i;
    case 7:
      return i * i;
    case 8:
      return i * math::abs(i);
    case 9:
      return i * i * i;
    case 10:
      return math::tanh(Real(4) * i);
    case 11:
      return w * i;
    case 12:
      return w * w * i;
    case 13:
      return w * i * i;
    case 14:
      return cut * w;
    case 15:
      return cut * i;
    case 16:
      return cut * w * w;
    case 17:
      return v * w;
    case 18:
      return hot * i;
    case 19:
      return hot * w;
    case 20:
      return cut * (s.tool_degc - k.tool_degc) * Real(0.01);
    case 21:
      return v;
    case 22:
      return v * math::abs(v);
    case 23:
      return s.feed_force_n / k.feed_force_n;
    case 24:
      return cut;
    default:
      return s.acceleration_rad_s2 * Real(1.0e-3);
  }
}

/// One of the bells along the way: 0 .. kUnnamedPlaces - 1, over one scale of travel.
template <class Real>
Real bell(Real place, int number) {
  const Real away =
      (place - (static_cast<Real>(number) + Real(0.5)) / Real(kUnnamedPlaces)) * Real(kUnnamedPlaces);
  return math::exp_of_nonpositive(-std::min(away * away, Real(40)));
}

template <class Real>
[[gnu::always_inline]] inline Real unnamed_feed(std::uint8_t law, const EffectSignals<Real>& s,
                                                const EffectScales<Real>& k) {
  const Real v = s.feed_speed_m_s / k.feed_speed_m_s;
  const Real w = s.speed_rad_s / k.speed_rad_s;
  const Real f = s.feed_force_n / k.feed_force_n;
  const Real x = (s.feed_position_m - k.travel_from_m) / k.travel_m;
  const Real cut = s.contact;
  switch (law) {
    case 0:
      return Real(1);
    case 1:
      return v;
    case 2:
      return math::abs(v);
    case 3:
      return v * math::abs(v);
    case 4:
      return math::tanh(Real(10) * v);
    case 5:
      return v * math::exp_of_nonpositive(-v * v);
    case 6:
      return f;
    case 7:
      return f * math::abs(f);
    case 8:
      return f * v;
    case 9:
      return x * v;
    case 10:
      return x * math::tanh(Real(10) * v);
    case 11:
      return cut * v;
    case 12:
      return cut * w;
    case 13:
      return v * w;
    case 14:
      return w;
    case 15:  // a mass that is not the same everywhere, of which a little is seen by one number only
      return x * f;
    default: {  // in one place: a force, a guide that is tight, a mass or a drive that is another one
      const int place = law - kUnnamedBeforePlaces;
      const Real here = bell(x, place % kUnnamedPlaces);
      if (place < kUnnamedPlaces) return here;
      return here * (place < 2 * kUnnamedPlaces ? math::tanh(Real(10) * v) : f);
    }
  }
}

/// Every one of them at one instant: together they cost little more than a few by themselves.
template <class Real>
struct UnnamedValues {
  std::array<Real, std::max(kUnnamedSpindleLaws, kUnnamedFeedLaws)> value{};

  void follow_spindle(const EffectSignals<Real>& s, const EffectScales<Real>& k) {
    [&]<std::uint8_t... law>(std::integer_sequence<std::uint8_t, law...>) {
      ((value[law] = unnamed_spindle(law, s, k)), ...);
    }
    (std::make_integer_sequence<std::uint8_t, kUnnamedSpindleLaws>{});
  }
  void follow_feed(const EffectSignals<Real>& s, const EffectScales<Real>& k) {
    [&]<std::uint8_t... law>(std::integer_sequence<std::uint8_t, law...>) {
      ((value[law] = unnamed_feed(law, s, k)), ...);
    }
    (std::make_integer_sequence<std::uint8_t, kUnnamedFeedLaws>{});
  }
};

}  // namespace morepro::gap::laws
