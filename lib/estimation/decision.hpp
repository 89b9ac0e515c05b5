#pragma once
#include <array>
#include <cstddef>

#include "lib/math/elementary.hpp"
#include "lib/math/fixed_order_sum.hpp"

namespace morepro {

/// Index of the largest of the first `count` values; the first one where several are equal.
template <class Real, std::size_t kN>
std::size_t index_of_largest(const std::array<Real, kN>& values, std::size_t count) {
  std::size_t best = 0;
  for (std::size_t j = 1; j < count; ++j)
    if (values[j] > values[best]) best = j;
  return best;
}

/// Probabilities of the hypotheses in the log domain: likelihoods are taken relative to the best one, so that
/// a frame that no hypothesis explains cannot make every weight zero. Lanes from `count` on stay at zero.
template <class Real, std::size_t kN>
class HypothesisWeights {
 public:
  using Lanes = std::array<Real, kN>;

  explicit HypothesisWeights(std::size_t count) : count_(count) { reset(); }

  /// All hypotheses equally probable.
  void reset() {
    for (std::size_t j = 0; j < kN; ++j)
      weight_[j] = j < count_ ? Real(1) / static_cast<Real>(count_) : Real(0);
  }

  /// weight_j <- weight_j exp(log_likelihood_j), normalised.
  void multiply(const Lanes& log_likelihood) {
    const Real best = log_likelihood[index_of_largest(log_likelihood, count_)];
    for (std::size_t j = 0; j < kN; ++j) {
      const Real below = log_likelihood[j] - best;
      weight_[j] *= math::exp_of_nonpositive(below < Real(0) ? below : Real(0));
    }
    normalise();
  }

  void normalise() {
    const Real scale = Real(1) / math::fixed_order_sum(weight_);
    for (std::size_t j = 0; j < kN; ++j) weight_[j] *= scale;
  }

  Lanes& lanes() { return weight_; }
  [[nodiscard]] const Lanes& lanes() const { return weight_; }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t best() const { return index_of_largest(weight_, count_); }

 private:
  std::size_t count_;
  Lanes weight_{};
};

/// Multiple-model adaptive estimation: Bayes' rule with a floor, so that a hypothesis can come back. It
/// forgets only as far as the floor lets it.
template <class Real, std::size_t kN>
class BayesianDecision {
 public:
  /// 1 <= count <= kN; 0 < floor < 1/count.
  BayesianDecision(std::size_t count, Real floor) : weights_(count), floor_(floor) {}

  void reset() { weights_.reset(); }

  void step(const std::array<Real, kN>& log_likelihood) {
    weights_.multiply(log_likelihood);
    auto& weight = weights_.lanes();
    for (std::size_t j = 0; j < weights_.count(); ++j) weight[j] = weight[j] > floor_ ? weight[j] : floor_;
    weights_.normalise();
  }

  [[nodiscard]] const std::array<Real, kN>& probability() const { return weights_.lanes(); }
  [[nodiscard]] std::size_t selected() const { return weights_.best(); }

 private:
  HypothesisWeights<Real, kN> weights_;
  Real floor_;
};

/// Bayes' rule for a hypothesis that may change: with probability `switch_probability` per step the truth
/// moves to any other hypothesis. The weights of an interacting-multiple-model filter without its mixing of
/// states.
template <class Real, std::size_t kN>
class MarkovDecision {
 public:
  /// 1 <= count <= kN; 0 < switch_probability < 1.
  MarkovDecision(std::size_t count, Real switch_probability)
      : weights_(count),
        stay_(Real(1) - switch_probability),
        arrive_(count > 1 ? switch_probability / static_cast<Real>(count - 1) : Real(0)) {}

  void reset() { weights_.reset(); }

  void step(const std::array<Real, kN>& log_likelihood) {
    auto& weight = weights_.lanes();
    for (std::size_t j = 0; j < weights_.count(); ++j)
      weight[j] = stay_ * weight[j] + arrive_ * (Real(1) - weight[j]);
    weights_.multiply(log_likelihood);
  }

  [[nodiscard]] const std::array<Real, kN>& probability() const { return weights_.lanes(); }
  [[nodiscard]] std::size_t selected() const { return weights_.best(); }

 private:
  HypothesisWeights<Real, kN> weights_;
  Real stay_;
  Real arrive_;
};

/// The thesis's rule (section 4.4): the hypothesis whose outputs - angular acceleration and current - have
/// the smallest integral of the absolute error since the start. Each error is in units of its noise, or the
/// acceleration alone would decide. It never forgets: a change of the chip load after a long cut is found
/// late or not at all.
template <class Real, std::size_t kN>
class MinimumIntegralDecision {
 public:
  using Lanes = std::array<Real, kN>;

  /// 1 <= count <= kN; standard deviations of the measured outputs [rad/s2], [A] > 0; period [s] > 0.
  MinimumIntegralDecision(std::size_t count, Real acceleration_noise, Real current_noise, Real period_s)
      : count_(count),
        per_acceleration_(period_s / acceleration_noise),
        per_current_(period_s / current_noise) {}

  void reset() { integral_ = Lanes{}; }

  /// Errors: measured minus the output of each filter.
  void step(const Lanes& acceleration_error_rad_s2, const Lanes& current_error_a) {
    for (std::size_t j = 0; j < kN; ++j)
      integral_[j] += math::abs(acceleration_error_rad_s2[j]) * per_acceleration_ +
                      math::abs(current_error_a[j]) * per_current_;
  }

  /// Integrals [s]: not probabilities; the smallest one is selected.
  [[nodiscard]] const Lanes& integral() const { return integral_; }

  [[nodiscard]] std::size_t selected() const {
    std::size_t best = 0;
    for (std::size_t j = 1; j < count_; ++j)
      if (integral_[j] < integral_[best]) best = j;
    return best;
  }

 private:
  std::size_t count_;
  Real per_acceleration_;
  Real per_current_;
  Lanes integral_{};
};

}  // namespace morepro
