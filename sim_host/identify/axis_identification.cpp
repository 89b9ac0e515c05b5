#include "sim_host/identify/axis_identification.hpp"

#include <algorithm>

#include "sim_host/identify/axis_pass.hpp"

namespace morepro::host {
namespace {

constexpr int kMostPasses = 60;          // a start that is far off, sampled slowly, needs twenty
constexpr double kLargestLogStep = 0.7;  // of a logarithm
constexpr double kSettledStep =
    0.1;  // of a standard error: of steps that shrink by a quarter, the rest is three times that
constexpr double kVague = 0.05;             // what is known no better need not stand still
constexpr double kWorthIt = 3.0;            // log-likelihood that a larger process noise must bring
constexpr std::size_t kNoiseRows = 100000;  // tell the process noise well enough
constexpr double kLeastNoiseShare = 1.0e-8;
constexpr double kMostNoiseShare = 10.0;

using Shares = std::array<double, 2>;

/// The Gauss-Newton passes.
template <class Traits, class Mode>
class Search {
 public:
  using Pass = AxisPass<Traits, Mode>;
  using Values = typename Pass::Values;

  Search(const RecordingSignals& signals, const MonitorConfiguration& configuration, const OnPass& on_pass)
      : signals_(signals), configuration_(configuration), on_pass_(on_pass) {
    for (std::size_t j = 0; j < Pass::kCount; ++j)
      at_[j] = value_in(configuration.machine, Traits::kValues[j]);
  }

  AxisEstimate run() {
    settle();
    if (choose_process_noise()) settle();
    return estimate();
  }

 private:
  using Result = typename Pass::Result;

  /// Linearised at the present values.
  Result pass(const Shares& share, std::size_t rows) {
    ++passes_;
    on_pass_();
    return Pass(signals_, configuration_, rows).run(at_, share);
  }

  /// Gauss-Newton steps until nothing moves. A step may explain less and still be right: shorter ones, tried
  /// on 64 recordings, ended at the same values after up to twice as many passes.
  void settle() {
    found_ = pass(share_, signals_.rows);
    has_settled_ = is_small_step(found_);
    for (int step = 0; step < kMostPasses && !has_settled_; ++step) {
      move_to(found_.value);
      found_ = pass(share_, signals_.rows);
      has_settled_ = is_small_step(found_);
    }
  }

  /// At most by a factor of two.
  void move_to(const Values& values) {
    for (std::size_t j = 0; j < values.size(); ++j)
      if (at_[j] > 0.0)
        at_[j] *= std::exp(std::clamp(std::log(values[j] / at_[j]), -kLargestLogStep, kLargestLogStep));
  }

  bool is_small_step(const Result& next) const {
    for (std::size_t j = 0; j < Pass::kCount; ++j) {
      const auto k = static_cast<Eigen::Index>(j);
      if (!(at_[j] > 0.0)) continue;  // no parameter
      const double step = std::abs(std::log(next.value[j] / at_[j]));
      const double deviation = std::sqrt(next.covariance(k, k));
      if (deviation < kVague && !(step <= kSettledStep * deviation)) return false;
    }
    return true;
  }

  /// Is there more process noise than the least? Climbs in both signals together, then in each alone.
  bool choose_process_noise() {
    const std::size_t rows = std::min(signals_.rows, kNoiseRows);
    const Shares before = share_;
    double likelihood = pass(share_, rows).log_likelihood;
    const auto climb = [&](double factor0, double factor1) {
      for (;;) {
        const Shares share{share_[0] * factor0, share_[1] * factor1};
        if (std::max(share[0], share[1]) > kMostNoiseShare) return;
        const double next = pass(share, rows).log_likelihood;
        if (!(next > likelihood + kWorthIt)) return;
        likelihood = next;
        share_ = share;
      }
    };
    climb(100.0, 100.0);
    climb(10.0, 1.0);
    climb(1.0, 10.0);
    return share_ != before;
  }

  AxisEstimate estimate() const {
    return {.names = {Traits::kValues.begin(), Traits::kValues.begin() + Pass::kCount},
            .value = {found_.value.begin(), found_.value.end()},
            .covariance = found_.covariance,
            .has_settled = has_settled_,
            .ratio = found_.ratio,
            .correlation = found_.correlation,
            .process_share = share_,
            .passes = passes_};
  }

  const RecordingSignals& signals_;
  const MonitorConfiguration& configuration_;
  const OnPass& on_pass_;
  Values at_{};   ///< where the last pass was linearised
  Result found_;  ///< by that pass
  Shares share_{kLeastNoiseShare, kLeastNoiseShare};
  bool has_settled_ = false;
  int passes_ = 0;
};

}  // namespace

template <class Traits>
AxisEstimate identify_axis(const RecordingSignals& signals, const MonitorConfiguration& configuration,
                           const OnPass& on_pass) {
  const bool has_friction = value_in(configuration.machine, Traits::kValues.back()) > 0.0;
  if (has_friction) return Search<Traits, AnchoredWithFriction>(signals, configuration, on_pass).run();
  return Search<Traits, Anchored>(signals, configuration, on_pass).run();
}

template AxisEstimate identify_axis<SpindleTraits>(const RecordingSignals&, const MonitorConfiguration&,
                                                   const OnPass&);
template AxisEstimate identify_axis<FeedTraits>(const RecordingSignals&, const MonitorConfiguration&,
                                                const OnPass&);

}  // namespace morepro::host
