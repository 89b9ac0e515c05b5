#include <cmath>

#include "effect_parts.hpp"

namespace blind {
namespace {

/// The converter rounds more coarsely than the datasheet says.
class CoarseSteps final : public Effect {
 public:
  CoarseSteps(bool is_speed, const Machine& m)
      : is_speed_(is_speed), step_(is_speed ? m.speed.noise : m.current.noise) {}
  void read(const Point&, Reading& reading) override {
    (is_speed_ ? reading.w_step : reading.i_step) = strength * step_;
  }

 private:
  bool is_speed_;
  double step_;
};

/// All channels are sampled a little too early or too late.
class Jitter final : public Effect {
 public:
  explicit Jitter(Random& random) : random_(random.bits(), 1) {}
  void read(const Point& p, Reading& reading) override {
    const double late_s = strength * random_.normal();
    reading.w += late_s * p.speed_rate;
    reading.v += late_s * p.feed_rate;
    reading.i += late_s * p.current_rate;
    reading.angle += late_s * p.w;
    reading.x += late_s * p.v;
  }

 private:
  Random random_;
};

/// Frames get lost in bursts of a few; the receiver repeats the last one, or the row is missing.
class Dropout final : public Effect {
 public:
  explicit Dropout(Random& random) : random_(random.bits(), 2), leaves_holes_(random.chance(0.25)) {}
  bool repeats_frame() override { return !leaves_holes_ && is_lost(); }
  bool drops_row() override { return leaves_holes_ && is_lost(); }

 private:
  bool is_lost() {
    if (left_ > 0) return --left_ >= 0;
    const double start = random_.uniform();
    const int burst = 1 + random_.pick(3);
    if (start < 0.5 * strength) left_ = burst - 1;
    return start < 0.5 * strength;
  }
  Random random_;
  bool leaves_holes_;
  int left_ = 0;
};

}  // namespace

std::vector<EffectKind> clock_effects() {
  auto coarse = [](Random& random, const Machine& m) {
    return std::make_unique<CoarseSteps>(random.chance(0.5), m);
  };
  auto jitter = [](Random& random, const Machine&) { return std::make_unique<Jitter>(random); };
  auto dropout = [](Random& random, const Machine&) { return std::make_unique<Dropout>(random); };
  auto step_guess = [](const Machine&) { return 4.0; };
  auto jitter_guess = [](const Machine&) { return 1e-5; };
  auto dropout_guess = [](const Machine&) { return 0.01; };
  return {
      {"sensor_quantization", kSpindleTorque, "noise", step_guess, coarse, 10.0, false, false},
      {"clock_jitter", kArmatureVoltage, "s", jitter_guess, jitter, 4.0, false, false},
      {"sample_dropout", kSpindleTorque, "1", dropout_guess, dropout, 10.0, false, false},
  };
}

const std::vector<EffectKind>& catalogue_effects() {
  static const std::vector<EffectKind> kinds = [] {
    std::vector<EffectKind> all;
    for (auto group : {shaft_effects(), cutting_effects(), feed_friction_effects(), feed_drive_effects(),
                       voltage_effects(), sensor_effects(), clock_effects()})
      all.insert(all.end(), group.begin(), group.end());
    return all;
  }();
  return kinds;
}

}  // namespace blind
