#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "lib/gap/board_forms.hpp"
#include "lib/gap/gap_watch_finding.hpp"
#include "lib/math/elementary.hpp"

namespace morepro::gap {

/// Are samples taken at the instants that they are said to be? Where not, innovations grow with the rate of
/// what is sampled, and know nothing of their neighbours; a wrong law makes some that go with the rates. All
/// sensors share one clock.
template <class Real>
class JitterWatch {
 public:
  static constexpr std::size_t kSensors = 4;

  /// An innovation in its stated unit, and its variance without a jitter; `rate`: what the sensor would see
  /// more of it if it looked one interval later.
  struct Sample {
    Real innovation = 0;
    Real variance = 0;
    Real rate = 0;
    /// Beyond this it counts as that much: a position moves on at the same rate for more than an interval.
    Real most = 0;
  };

  /// What comes next does not follow what came last.
  void interrupt() {
    for (Sums& sums : sensor_) sums.product_before = sums.growth_before = Real(0);
  }

  /// Small instead of fast: a stretch in a second is looked into.
  [[gnu::noinline, gnu::cold]] void see(std::size_t sensor, const Sample& sample) {
    Sums& sums = sensor_[sensor];
    const Real per_variance = Real(1) / sample.variance;
    const Real growth = sample.rate * sample.rate * per_variance;
    const Real value = std::clamp(sample.innovation, -sample.most, sample.most);
    const Real square = value * value * per_variance;
    if (!(growth < kLargest && square < kLargest)) return interrupt();
    const Real product = value * sample.rate * per_variance;
    sums.count += Real(1);
    sums.growth += growth;
    sums.square += square;
    sums.growth_square += growth * growth;
    sums.growth_of_square += growth * square;
    sums.shared += product * sums.product_before;
    sums.sharable += growth * sums.growth_before;
    sums.product_before = product;
    sums.growth_before = growth;
    if (sums.count >= kMostRows) sums.fade();
  }

  void merge(const JitterWatch& other) {
    for (std::size_t k = 0; k < kSensors; ++k) sensor_[k].merge(other.sensor_[k]);
  }

  /// Beside what is known, as a share of an interval: its variance, and chi-square by which it differs from
  /// none; nothing where it is no jitter or too little to matter.
  struct Jitter {
    Real variance = 0;
    Real evidence = 0;
  };
  [[nodiscard]] [[gnu::noinline, gnu::cold]] Jitter jitter() const {
    Jitter jitter;
    Real weight = 0;
    for (const Sums& sums : sensor_) {
      const Real precision = sums.precision();
      weight += precision;
      jitter.variance += precision * sums.slope();
    }
    if (!(weight > Real(0)) || !(jitter.variance > Real(0))) return {};
    jitter.variance /= weight;
    jitter.evidence = jitter.variance * jitter.variance * weight;
    return jitter.evidence > kLeastEvidence && is_by_the_clock(jitter, weight) ? jitter : Jitter{};
  }

  /// kEffect, or kNotEnoughData where there is none.
  [[nodiscard]] [[gnu::noinline, gnu::cold]] GapFinding finding() const {
    GapFinding found;
    found.evidence = static_cast<float>(jitter().evidence);
    if (!(found.evidence > 0.0F)) return found;
    found.verdict = GapVerdict::kEffect;
    found.effect = Effect::kClockJitter;
    found.where = group_of(found.effect);
    found.confidence = kConfidence;
    return found;
  }

 private:
  static constexpr float kConfidence = 0.97F;
  static constexpr Real kLargest = Real(1.0e9);
  static constexpr Real kMostRows = Real(65536);
  static constexpr Real kFewestRows = Real(400);
  static constexpr Real kLeastEvidence = Real(40);

  struct Sums {
    Real count = 0;
    Real growth = 0;
    Real square = 0;
    Real growth_square = 0;
    Real growth_of_square = 0;
    Real shared = 0;
    Real sharable = 0;  ///< what would be shared if innovations were rates times one time
    Real product_before = 0;
    Real growth_before = 0;

    void merge(const Sums& other) {
      count += other.count;
      growth += other.growth;
      square += other.square;
      growth_square += other.growth_square;
      growth_of_square += other.growth_of_square;
      shared += other.shared;
      sharable += other.sharable;
    }
    [[gnu::noinline, gnu::cold]] void fade() {
      for (Real* sum : {&count, &growth, &square, &growth_square, &growth_of_square, &shared, &sharable})
        *sum *= Real(0.5);
    }
    /// Sum of squares of what the growth differs from its mean by.
    [[nodiscard]] Real spread() const { return growth_square - growth * growth / count; }
    [[nodiscard]] [[gnu::noinline, gnu::cold]] Real slope() const {
      return precision() > Real(0) ? (growth_of_square - growth * square / count) / spread() : Real(0);
    }
    /// Of the slope; a square varies by twice the square of its mean. 0: the sensor tells nothing.
    [[nodiscard]] [[gnu::noinline, gnu::cold]] Real precision() const {
      constexpr Real kLeastSpread = Real(1.0e-4);  // of the squares: beyond what sums of floats tell
      if (!(count >= kFewestRows) || !(square > Real(0))) return Real(0);
      const bool is_told = spread() > kLeastSpread * growth_square;
      const Real mean = square / count;
      return is_told ? spread() / (Real(2) * mean * mean) : Real(0);
    }
  };

  /// Of the sensors that tell much of it: does the one whose neighbours share least deny a wrong law, is it
  /// in all of them, and does it matter where it shakes most?
  [[nodiscard]] bool is_by_the_clock(const Jitter& jitter, Real weight) const {
    constexpr Real kMuch = Real(0.1);  // of what all sensors tell
    constexpr Real kMostShared = Real(0.45);
    // The observer takes part of a jitter for a change of the state, which comes back with the other sign.
    constexpr Real kLeastShared = Real(-0.8);
    constexpr Real kLeastSlope = Real(0.3);
    constexpr Real kMatters = Real(0.25);  // of the expected variance
    Real shared = Real(1);
    bool matters = false;
    for (const Sums& sums : sensor_) {
      if (!(sums.precision() >= kMuch * weight)) continue;
      if (!(sums.slope() > kLeastSlope * jitter.variance)) return false;
      const Real own = sums.shared / (jitter.variance * sums.sharable);
      if (math::abs(own) < math::abs(shared)) shared = own;
      matters |= jitter.variance * sums.growth_square > kMatters * sums.growth;
    }
    return matters && shared < kMostShared && shared > kLeastShared;
  }

  std::array<Sums, kSensors> sensor_{};
};

}  // namespace morepro::gap
