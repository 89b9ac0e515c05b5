#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "sim_host/diagnose/signals/recording_signals.hpp"
#include "sim_host/identify/axis_traits.hpp"

namespace morepro::host {

/// What one pass of a parameter filter over a recording found.
template <std::size_t kCount>
struct PassResult {
  std::array<double, kCount> value{};
  Eigen::Matrix<double, kCount, kCount> covariance;  ///< of the logarithms of the values
  /// Of all innovations, with the sensors' noise scaled to what fits best.
  double log_likelihood = -std::numeric_limits<double>::infinity();
  double ratio = 1.0;        ///< mean squared normalised innovation, 1: as the sensors' noise says
  double correlation = 0.0;  ///< of neighbouring innovations, the larger of the two signals'; 0: white
  std::size_t innovations = 0;
};

/// Mean square, likelihood and whiteness of innovations that are normalised already.
class InnovationTally {
 public:
  void take(std::size_t element, double normalised, double log_variance) {
    ++count_;
    const double square = normalised * normalised;
    sum_ += square;
    log_variance_ += log_variance;
    square_[element] += square;
    product_[element] += normalised * last_[element];
    last_[element] = normalised;
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] double ratio() const { return count_ > 0 ? sum_ / static_cast<double>(count_) : 1.0; }
  [[nodiscard]] double log_likelihood() const {
    return -0.5 * (static_cast<double>(count_) * std::log(ratio()) + log_variance_);
  }
  [[nodiscard]] double correlation() const {
    double largest = 0.0;
    for (std::size_t k = 0; k < 2; ++k)
      if (square_[k] > 0.0) largest = std::max(largest, product_[k] / square_[k]);
    return largest;
  }

 private:
  std::size_t count_ = 0;
  double sum_ = 0.0, log_variance_ = 0.0;
  std::array<double, 2> square_{}, product_{}, last_{};
};

/// One pass over the first `rows` rows.
template <class Traits, class Mode>
class AxisPass {
 public:
  static constexpr std::size_t kCount = Traits::template Filter<Mode>::kCount;
  using Result = PassResult<kCount>;
  using Values = std::array<double, kCount>;

  AxisPass(const RecordingSignals& signals, const MonitorConfiguration& configuration, std::size_t rows)
      : signals_(signals), configuration_(configuration), rows_(rows), traits_(configuration) {}

  /// Linearised at `anchor`. `process_share`: process noise per step as a share of each sensor's
  /// variance.
  Result run(const Values& anchor, const std::array<double, 2>& process_share) {
    Filter filter(configuration_.machine, 1.0 / signals_.rate_hz, kDatasheetFraction, 0.0);
    filter.anchor_at(anchor);
    std::array<double, 2> process{};
    for (std::size_t k = 0; k < 2; ++k) process[k] = process_share[k] * traits_.variance[k];
    FrameSource source(signals_, configuration_.machine, 0);
    std::optional<typename Traits::Motion> motion;
    InnovationTally tally;
    PlantInput<double> held{};
    std::size_t unmeasured = kMostUnmeasured;
    for (std::size_t row = 0; row < rows_; ++row) {
      const gap::GapFrame<double> frame = source.next();
      const bool moves = is_moving(motion, frame);
      if (unmeasured < kMostUnmeasured) {
        filter.hold(!moves);
        traits_.template predict<Mode>(filter, held, process);
        unmeasured = update(filter, frame, tally) ? 0 : unmeasured + 1;
      } else if (Traits::is_complete(frame)) {
        filter.restart_state(traits_.measurement(frame));
        unmeasured = 0;
      }
      held = frame.input;
    }
    return result_of(filter, tally);
  }

 private:
  using Filter = typename Traits::template Filter<Mode>;

  /// After so many frames without a sample the state starts anew.
  static constexpr std::size_t kMostUnmeasured = 20;

  /// A recording rests until it is seen to move.
  bool is_moving(std::optional<typename Traits::Motion>& motion, const gap::GapFrame<double>& frame) const {
    if (!motion && !Traits::is_complete(frame)) return false;
    if (!motion) motion.emplace(frame);
    if (Traits::is_complete(frame)) motion->take(traits_, frame);
    return motion->is_moving();
  }

  bool update(Filter& filter, const gap::GapFrame<double>& frame, InnovationTally& tally) const {
    const auto measured = Traits::measured(frame);
    if (!measured[0] && !measured[1]) return false;
    filter.update(traits_.measurement(frame));
    for (std::size_t k = 0; k < 2; ++k)
      if (measured[k]) tally.take(k, filter.record().normalised[k], filter.record().log_variance[k]);
    return true;
  }

  static Result result_of(const Filter& filter, const InnovationTally& tally) {
    Result result;
    for (std::size_t i = 0; i < kCount; ++i) {
      result.value[i] = filter.value(static_cast<typename Traits::Name>(i));
      for (std::size_t j = 0; j < kCount; ++j)
        result.covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            filter.covariance(static_cast<typename Traits::Name>(i), static_cast<typename Traits::Name>(j));
    }
    result.log_likelihood = tally.log_likelihood();
    result.ratio = tally.ratio();
    result.correlation = tally.correlation();
    result.innovations = tally.count();
    return result;
  }

  const RecordingSignals& signals_;
  const MonitorConfiguration& configuration_;
  std::size_t rows_;
  Traits traits_;
};

}  // namespace morepro::host
