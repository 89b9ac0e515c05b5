#include "sim_host/identify/axis_identification.hpp"

#include <algorithm>

#include "sim_host/replay/names.hpp"

namespace morepro::host {
namespace {

constexpr int kMostSteps = 6;
constexpr double kSmallStep = 0.1;          // of a standard error
constexpr double kWorthIt = 3.0;            // log-likelihood that a larger process noise must bring
constexpr std::size_t kNoiseRows = 100000;  // tell the process noise well enough
constexpr double kLeastShare = 1.0e-8;
constexpr double kMostShare = 10.0;

/// The steps of the search, so that each of them stays a few lines.
template <class Traits>
class Search {
 public:
  using Result = PassResult<Traits::kCount>;

  Search(const RecordingSignals& signals, const MonitorConfiguration& configuration, const OnPass& on_pass)
      : signals_(signals), configuration_(configuration), on_pass_(on_pass) {}

  AxisIdentification<Traits::kCount> run() {
    start();
    settle();
    if (choose_process_noise()) settle();
    return found_;
  }

 private:
  typename AxisPass<Traits, Anchored>::Values datasheet() const {
    typename AxisPass<Traits, Anchored>::Values values{};
    for (std::size_t j = 0; j < values.size(); ++j)
      values[j] = datasheet_value(configuration_.machine, Traits::kParameters[j]);
    return values;
  }

  void count_pass() {
    ++found_.passes;
    on_pass_();
  }

  void start() {
    count_pass();
    const double share = Traits::kOnLineShare;
    found_.last = AxisPass<Traits, OnLine>(signals_, configuration_, signals_.rows).run(datasheet(), {share, share});
    found_.process_share = {kLeastShare, kLeastShare};
  }

  Result pass(const std::array<double, 2>& share, std::size_t rows) {
    count_pass();
    return AxisPass<Traits, Anchored>(signals_, configuration_, rows).run(found_.last.value, share);
  }

  void settle() {
    found_.has_settled = false;
    for (int step = 0; step < kMostSteps && !found_.has_settled; ++step) {
      Result next = pass(found_.process_share, signals_.rows);
      found_.has_settled = is_small_step(next);
      found_.last = std::move(next);
    }
  }

  bool is_small_step(const Result& next) const {
    for (std::size_t j = 0; j < Traits::kCount; ++j) {
      const auto k = static_cast<Eigen::Index>(j);
      const double before = found_.last.value[j];
      if (before > 0.0 &&
          std::abs(std::log(next.value[j] / before)) > kSmallStep * std::sqrt(next.covariance(k, k)))
        return false;
    }
    return true;
  }

  /// Is there more process noise than the least? Climbs in both signals together, then in each alone.
  bool choose_process_noise() {
    const std::size_t rows = std::min(signals_.rows, kNoiseRows);
    auto best = found_.process_share;
    double likelihood = pass(best, rows).log_likelihood;
    const auto climb = [&](double factor0, double factor1) {
      for (;;) {
        const std::array<double, 2> share{best[0] * factor0, best[1] * factor1};
        if (std::max(share[0], share[1]) > kMostShare) return;
        const double next = pass(share, rows).log_likelihood;
        if (!(next > likelihood + kWorthIt)) return;
        likelihood = next;
        best = share;
      }
    };
    climb(100.0, 100.0);
    climb(10.0, 1.0);
    climb(1.0, 10.0);
    const bool has_changed = best != found_.process_share;
    found_.process_share = best;
    return has_changed;
  }

  const RecordingSignals& signals_;
  const MonitorConfiguration& configuration_;
  const OnPass& on_pass_;
  AxisIdentification<Traits::kCount> found_;
};

}  // namespace

template <class Traits>
AxisIdentification<Traits::kCount> identify_axis(const RecordingSignals& signals,
                                                 const MonitorConfiguration& configuration, const OnPass& on_pass) {
  return Search<Traits>(signals, configuration, on_pass).run();
}

template AxisIdentification<SpindleTraits::kCount> identify_axis<SpindleTraits>(const RecordingSignals&,
                                                                                const MonitorConfiguration&,
                                                                                const OnPass&);
template AxisIdentification<FeedTraits::kCount> identify_axis<FeedTraits>(const RecordingSignals&,
                                                                          const MonitorConfiguration&, const OnPass&);

}  // namespace morepro::host
