#include "sim_host/simulate/sampling_effects.hpp"

namespace morepro::host {
namespace {

enum SamplingStream : std::uint64_t { kClockStream = 300, kDropoutStream = 301 };

/// In [0, 1).
double uniform(std::uint64_t seed, std::uint64_t index) {
  return static_cast<double>(mixed(seed, index) >> 11U) * 0x1p-53;
}

}  // namespace

SamplingEffects::SamplingEffects(std::span<const gap::AppliedEffect> effects, std::uint64_t seed)
    : quantum_(source(effects, gap::Effect::kSensorQuantization)),
      jitter_(source(effects, gap::Effect::kClockJitter)),
      dropout_(source(effects, gap::Effect::kSampleDropout)),
      clock_(mixed(seed, kClockStream)),
      dropout_seed_(mixed(seed, kDropoutStream)) {}

SamplingEffects::Source SamplingEffects::source(std::span<const gap::AppliedEffect> effects,
                                                gap::Effect effect) {
  for (const gap::AppliedEffect& one : effects) {
    if (one.form.effect == effect) return {one.coefficient[0], one.onset_s};
  }
  return {};
}

// The first row stays, so that a recording begins where it should.
void SamplingEffects::next(std::uint64_t index, double time_s) {
  late_s_ = jitter_.at(time_s) * clock_.next();
  quantization_ = quantum_.at(time_s);
  is_lost_ = index > 0 && uniform(dropout_seed_, index) < dropout_.at(time_s);
}

}  // namespace morepro::host
