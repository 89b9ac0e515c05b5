#include "sim_host/bench/units.hpp"

#include <array>
#include <memory>
#include <span>
#include <variant>

#include "lib/estimation/bank.hpp"
#include "lib/estimation/chip_load_filter.hpp"
#include "lib/estimation/decision.hpp"
#include "lib/gap/gap_watch.hpp"
#include "lib/identification/feed_parameter_filter.hpp"
#include "lib/identification/spindle_parameter_filter.hpp"
#include "lib/monitor/monitor.hpp"
#include "lib/plant/integrators.hpp"
#include "lib/wire/decoder.hpp"
#include "sim_host/simulate/simulation.hpp"

namespace morepro::host {
namespace {

constexpr double kPeriodS = 1.0e-4;
constexpr std::size_t kFrames = 8192;
constexpr std::size_t kHypotheses = 11;
constexpr SpindleInput<float> kCut{48.0F, 1.0F, 0.72F};

/// What a unit gives must not be optimised away.
template <class Value>
void keep(const Value& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

/// The reference machine in the air and in the cut.
const std::vector<SensorFrame>& frames() {
  static const std::vector<SensorFrame> all = [] {
    std::vector<SensorFrame> made;
    SimulationOptions options{.duration_s = kFrames * kPeriodS};
    Simulation simulation(reference_configuration(), options);
    for (SensorFrame frame; made.size() < kFrames && simulation.next(frame);) made.push_back(frame);
    return made;
  }();
  return all;
}

SpindleMeasurement<float> spindle_sample(std::uint32_t call) {
  const SensorFrame& frame = frames()[call % frames().size()];
  return {577.7F + 0.001F * frame.value[index_of(Channel::kSpindleSpeed)],
          2.226F + 0.01F * frame.value[index_of(Channel::kArmatureCurrent)], 1.0F, 0.0025F};
}

/// A unit whose state lives as long as the list: `step(state, call)` is one call.
template <class State, class Step>
BenchUnit unit(std::string_view name, std::string_view what, std::shared_ptr<State> state, Step step) {
  return {name, what, sizeof(State), [state, step, next = std::uint32_t{0}](std::uint32_t calls) mutable {
            for (std::uint32_t i = 0; i < calls; ++i) step(*state, next++);
          }};
}

BenchUnit monitor() {
  return unit("monitor", "everything that runs at every frame", std::make_shared<BoardMonitor>(),
              [](BoardMonitor& monitor, std::uint32_t call) {
                SensorFrame frame = frames()[call % frames().size()];
                frame.sequence = call;
                frame.time_us = 100 * call;
                keep(monitor.step(frame));
              });
}

BenchUnit bank() {
  using TheBank = Bank<float, kHypotheses>;
  std::array<float, kHypotheses> lanes;
  for (std::size_t j = 0; j < kHypotheses; ++j) lanes[j] = 0.02F + 0.008F * static_cast<float>(j);
  auto state = std::make_shared<TheBank>(reference_machine(),
                                         make_spindle_step<float>(reference_machine().spindle, kPeriodS),
                                         lanes, TheBank::ProcessNoise{4.0e-4F, 1.0e-4F});
  state->start(577.0F, 2.2F, 1.0F, 0.0025F);
  return unit("bank", "11 filters over chip-load hypotheses", state, [](TheBank& b, std::uint32_t call) {
    b.step(kCut, spindle_sample(call));
    keep(b.log_likelihood());
  });
}

BenchUnit decision() {
  using Decision = MarkovDecision<float, kHypotheses>;
  return unit("decision", "probabilities of 11 hypotheses", std::make_shared<Decision>(kHypotheses, 1.0e-4F),
              [](Decision& d, std::uint32_t call) {
                std::array<float, kHypotheses> likelihood{};
                likelihood[call % kHypotheses] = 0.1F;
                d.step(likelihood);
                keep(d.probability());
              });
}

BenchUnit chip_load() {
  using Filter = ChipLoadFilter<float>;
  const ChipLoadPrior<float> prior{0.065F, 0.05F, 0.0F, 0.22F, 5.0e-5F};
  auto state = std::make_shared<Filter>(reference_machine(),
                                        make_spindle_step<float>(reference_machine().spindle, kPeriodS),
                                        prior, 4.0e-4F, 1.0e-4F);
  return unit("chip_load", "continuous chip load", state, [](Filter& f, std::uint32_t call) {
    f.predict(kCut);
    keep(f.update(spindle_sample(call)));
  });
}

BenchUnit spindle_parameters() {
  using Filter = SpindleParameterFilter<float>;
  auto state = std::make_shared<Filter>(reference_machine(), static_cast<float>(kPeriodS), 0.3F, 2.0e-5F);
  return unit("spindle_parameters", "identification of five spindle values", state,
              [](Filter& f, std::uint32_t call) {
                f.predict(kCut, 0.05F, 1.0F, 0.0025F);
                keep(f.update(spindle_sample(call)));
              });
}

BenchUnit feed_parameters() {
  using Filter = FeedParameterFilter<float>;
  auto state = std::make_shared<Filter>(reference_machine(), static_cast<float>(kPeriodS), 0.3F, 2.0e-5F);
  return unit("feed_parameters", "identification of mass and contact force", state,
              [](Filter& f, std::uint32_t call) {
                const SensorFrame& frame = frames()[call % frames().size()];
                f.predict({frame.value[index_of(Channel::kFeedForce)], 1.0F, 1.0F}, 4.0e-8F);
                keep(f.update({frame.value[index_of(Channel::kFeedSpeed)], 0.0F, 4.0e-6F, kUnmeasured}));
              });
}

BenchUnit gap_watch() {
  using Watch = gap::GapWatch<float>;
  constexpr gap::ReferencePoint kPoint{577.0, 2.2, 0.02, 0.05, 500.0};
  constexpr gap::GapSettings kSettings{
      .noise = {1.0, 0.0025, 4.0e-6, 1.0e-12, 1.0e30, 0.01, 0.0005, 2.0e-5}, .spindle = {}, .feed = {}};
  auto state = std::make_shared<Watch>(reference_machine(), kPoint, kPeriodS, kSettings);
  return unit("gap_watch", "gap between model and machine", state, [](Watch& w, std::uint32_t call) {
    const SensorFrame& frame = frames()[call % frames().size()];
    const float speed_rad_s = frame.value[index_of(Channel::kSpindleSpeed)];
    const float feed_speed_m_s = frame.value[index_of(Channel::kFeedSpeed)];
    if (w.is_resting()) return w.rest(speed_rad_s, feed_speed_m_s, 1.0F);
    gap::GapFrame<float> seen;
    seen.input = {frame.value[index_of(Channel::kArmatureVoltage)],
                  frame.value[index_of(Channel::kFeedForce)],
                  1.0F,
                  1.0F,
                  0.05F,
                  500.0F};
    seen.winding_degc = 30.0F;
    seen.speed_rad_s = speed_rad_s;
    seen.current_a = frame.value[index_of(Channel::kArmatureCurrent)];
    seen.feed_speed_m_s = feed_speed_m_s;
    seen.has_speed = seen.has_current = seen.has_feed_speed = true;
    w.step(seen);
  });
}

BenchUnit plant() {
  struct Machine {
    ExponentialIntegrator<float> integrator{reference_machine(), kPeriodS};
    PlantState<float> state{};
  };
  return unit("plant_step", "the plant over one period", std::make_shared<Machine>(),
              [](Machine& m, std::uint32_t) {
                m.state = m.integrator.step(m.state, {48.0F, 26.0F, 1.0F, 1.0F, 0.05F, 500.0F});
                keep(m.state);
              });
}

struct Link {
  std::array<std::uint8_t, wire::kMaxEncodedSize<SensorFrame>> bytes{};
  wire::Decoder decoder{};
};

BenchUnit encode() {
  return unit("encode", "one frame into bytes", std::make_shared<Link>(), [](Link& l, std::uint32_t call) {
    keep(wire::encode(frames()[call % frames().size()], std::span(l.bytes)));
  });
}

BenchUnit decode() {
  auto link = std::make_shared<Link>();
  const std::size_t size = wire::encode(frames()[kFrames / 2], std::span(link->bytes));
  return unit("decode", "one frame from bytes, checked", link, [size](Link& l, std::uint32_t) {
    std::span<const std::uint8_t> rest(l.bytes.data(), size);
    while (l.decoder.next(rest) == wire::DecodeEvent::kRecord) keep(l.decoder.record());
  });
}

}  // namespace

std::vector<BenchUnit> bench_units() {
  return {monitor(),         bank(),      decision(), chip_load(), spindle_parameters(),
          feed_parameters(), gap_watch(), plant(),    encode(),    decode()};
}

}  // namespace morepro::host
