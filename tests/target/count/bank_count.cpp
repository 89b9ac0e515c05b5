#include <array>
#include <cstddef>
#include <cstdint>

#include "lib/estimation/bank.hpp"
#include "lib/estimation/chip_load_filter.hpp"
#include "lib/estimation/decision.hpp"
#include "lib/estimation/feed_filter.hpp"
#include "lib/identification/feed_parameter_filter.hpp"
#include "lib/identification/spindle_parameter_filter.hpp"
#include "lib/monitor/monitor_configuration.hpp"
#include "tests/target/count/count.hpp"

namespace morepro::count {
namespace {

constexpr double kPeriod_s = 1.0e-4;
constexpr SpindleInput<float> kCutting{48.0F, 1.0F, 0.72F};

/// Measurements of a steady cut with a deterministic noise of one and 0.05 units.
SpindleMeasurement<float> next_measurement() {
  static std::uint32_t random = 1;
  const auto noise = [] {
    random = random * 1664525U + 1013904223U;
    return static_cast<float>(static_cast<std::int32_t>(random)) * 8.0e-10F;
  };
  return {577.7F + noise(), 2.226F + 0.05F * noise(), 1.0F, 0.0025F};
}

SpindleMeasurement<float> measurement{};
void measure() { measurement = next_measurement(); }

template <std::size_t kN>
std::array<float, kN> chip_loads() {
  std::array<float, kN> lanes;
  for (std::size_t j = 0; j < kN; ++j)
    lanes[j] = 0.02F + 0.09F * static_cast<float>(j) / static_cast<float>(kN);
  return lanes;
}

/// Bank and the feed speed's filter, which is common to all hypotheses: the three-state filter of the bank.
template <std::size_t kN>
struct CountedBank {
  Bank<float, kN> bank{reference_machine(),
                       make_spindle_step<float>(reference_machine().spindle, kPeriod_s),
                       chip_loads<kN>(),
                       {4.0e-4F, 1.0e-4F}};
  FeedFilter<float> feed{reference_machine().feed, kPeriod_s, 1.0e-8F};
  MarkovDecision<float, kN> decision{kN, 1.0e-4F};
  CountedBank() { bank.start(577.0F, 2.2F, 1.0F, 0.0025F); }
};

template <std::size_t kN>
CountedBank<kN>& counted() {
  static CountedBank<kN> instance;
  return instance;
}

template <std::size_t kN>
void step_bank() {
  auto& c = counted<kN>();
  c.bank.step(kCutting, measurement);
  keep(c.bank.log_likelihood());
}

template <std::size_t kN>
void step_decision() {
  auto& c = counted<kN>();
  c.decision.step(c.bank.log_likelihood());
  keep(c.decision.probability());
}

/// The safety gates of one step: two per lane, loop and loads included.
void step_gates() {
  static std::array<float, 32> lanes{};
  LaneGate<float> domain;
  WindowGate<float> series{1.484375F, 1.515625F};
  for (float lane : lanes) {
    domain.see(23.0F, lane);
    series.see(lane);
  }
  keep(domain);
  keep(series);
}

void step_feed() {
  auto& feed = counted<8>().feed;
  feed.predict({26.0F, 1.0F, 1.0F});
  keep(feed.update({0.02F, 0.0F, 4.0e-6F, kUnmeasured}));
}

void step_chip_load() {
  static ChipLoadFilter<float> filter(reference_machine(),
                                      make_spindle_step<float>(reference_machine().spindle, kPeriod_s),
                                      {0.065F, 0.05F, 0.0F, 0.22F, 5.0e-5F}, 4.0e-4F, 1.0e-4F);
  filter.predict(kCutting);
  keep(filter.update(measurement));
}

void step_spindle_parameters() {
  static SpindleParameterFilter<float> filter(reference_machine(), 1.0e-4F, 0.3F, 2.0e-5F);
  filter.predict(kCutting, 0.05F, 1.0F, 0.0025F);
  keep(filter.update(measurement));
}

void step_feed_parameters() {
  static FeedParameterFilter<float> filter(reference_machine(), 1.0e-4F, 0.3F, 2.0e-5F);
  filter.predict({26.0F, 1.0F, 1.0F}, 4.0e-8F);
  keep(filter.update({0.02F, 0.0F, 4.0e-6F, kUnmeasured}));
}

const Entry kBank8{"bank_filter_step_n8", 8, measure, step_bank<8>};
const Entry kBank32{"bank_filter_step_n32", 32, measure, step_bank<32>};
const Entry kGates32{"bank_gates_n32", 32, measure, step_gates};
const Entry kDecision11{"decision_n11", 1, measure, step_decision<11>};
const Entry kFeed{"feed_filter_step", 1, measure, step_feed};
const Entry kChipLoad{"chip_load_filter_step", 1, measure, step_chip_load};
const Entry kSpindleParameters{"spindle_parameter_step", 1, measure, step_spindle_parameters};
const Entry kFeedParameters{"feed_parameter_step", 1, measure, step_feed_parameters};

}  // namespace
}  // namespace morepro::count
