#include <cmath>
#include <vector>

#include "effect_parts.hpp"

namespace blind {
namespace {

using Channel = double Reading::*;

class Bias final : public Effect {
 public:
  Bias(Channel channel, Random& random)
      : channel_(channel),
        sign_(random.sign()),
        ripple_(random.uniform(0.0, 0.04)),
        rate_(random.uniform(0.3, 1.0)) {}
  void read(const Point& p, Reading& reading) override {
    reading.*channel_ += sign_ * strength * (1.0 + ripple_ * std::sin(rate_ * p.t));
  }

 private:
  Channel channel_;
  double sign_, ripple_, rate_;
};

double truth_of(const Point& p, Channel channel) {
  return channel == &Reading::w ? p.w : channel == &Reading::v ? p.v : p.i;
}

/// The value of `strength` seconds ago, also between integration steps.
class Delay final : public Effect {
 public:
  explicit Delay(Channel channel) : channel_(channel), past_(4096, 0.0) {}
  void track(const Point& p, double step_s) override {
    step_s_ = step_s;
    past_[++newest_ % past_.size()] = truth_of(p, channel_);
  }
  void read(const Point&, Reading& reading) override {
    const double steps = std::min(strength / step_s_, 4000.0);
    const auto whole = static_cast<std::size_t>(steps);
    const double part = steps - static_cast<double>(whole);
    reading.*channel_ = (1.0 - part) * at(whole) + part * at(whole + 1);
  }

 private:
  double at(std::size_t age) const { return newest_ < age ? 0.0 : past_[(newest_ - age) % past_.size()]; }
  Channel channel_;
  std::vector<double> past_;
  std::size_t newest_ = 0;
  double step_s_ = 1e-5;
};

/// One or two poles; the strength is the total time constant.
class Bandwidth final : public Effect {
 public:
  Bandwidth(Channel channel, bool is_second_order) : channel_(channel), poles_(is_second_order ? 2 : 1) {}
  void track(const Point& p, double step_s) override {
    const double gain = 1.0 - std::exp(-step_s * poles_ / (strength + 1e-9));
    first_ += gain * (truth_of(p, channel_) - first_);
    second_ += gain * (first_ - second_);
  }
  void read(const Point&, Reading& reading) override { reading.*channel_ = poles_ == 2 ? second_ : first_; }

 private:
  Channel channel_;
  int poles_;
  double first_ = 0.0, second_ = 0.0;
};

class Eccentricity final : public Effect {
 public:
  explicit Eccentricity(Random& random)
      : phase_(random.uniform(0.0, 6.28)), second_(random.uniform(0.1, 0.3)) {}
  void read(const Point& p, Reading& reading) override {
    const double a = p.angle + phase_;
    reading.w *= 1.0 + strength * (std::cos(a) + second_ * std::cos(2.0 * a + 0.9));
    reading.angle += strength * (std::sin(a) + 0.5 * second_ * std::sin(2.0 * a + 0.9));
  }

 private:
  double phase_, second_;
};

class BentCurrent final : public Effect {
 public:
  explicit BentCurrent(Random& random) : sign_(random.sign()), power_(random.uniform(0.85, 1.2)) {}
  void read(const Point& p, Reading& reading) override {
    const double reference = p.machine.working_current();
    reading.i += sign_ * strength * reference * p.i * std::pow(std::abs(p.i) / reference, power_);
  }

 private:
  double sign_, power_;
};

template <typename Kind>
EffectKind fault(const char* name, Balance balance, const char* unit, Kind kind, double guess, double limit) {
  return {name, balance, unit, [guess](const Machine&) { return guess; }, kind, limit, false, false};
}

auto bias(Channel channel) {
  return [channel](Random& random, const Machine&) { return std::make_unique<Bias>(channel, random); };
}
auto delay(Channel channel) {
  return [channel](Random&, const Machine&) { return std::make_unique<Delay>(channel); };
}
auto bandwidth(Channel channel) {
  return [channel](Random& random, const Machine&) {
    return std::make_unique<Bandwidth>(channel, random.chance(0.5));
  };
}

}  // namespace

std::vector<EffectKind> sensor_effects() {
  auto eccentricity = [](Random& random, const Machine&) { return std::make_unique<Eccentricity>(random); };
  auto bent = [](Random& random, const Machine&) { return std::make_unique<BentCurrent>(random); };
  return {
      fault("spindle_speed_bias", kArmatureVoltage, "rad/s", bias(&Reading::w), 3.0, 25.0),
      fault("current_bias", kSpindleTorque, "A", bias(&Reading::i), 0.2, 25.0),
      fault("spindle_speed_delay", kSpindleTorque, "s", delay(&Reading::w), 3e-4, 40.0),
      fault("current_delay", kArmatureVoltage, "s", delay(&Reading::i), 5e-5, 40.0),
      fault("feed_speed_delay", kFeedForce, "s", delay(&Reading::v), 5e-4, 20.0),
      fault("spindle_speed_bandwidth", kSpindleTorque, "s", bandwidth(&Reading::w), 3e-4, 40.0),
      fault("current_bandwidth", kArmatureVoltage, "s", bandwidth(&Reading::i), 5e-5, 40.0),
      fault("encoder_eccentricity", kSpindleTorque, "1", eccentricity, 0.003, 25.0),
      fault("current_nonlinearity", kArmatureVoltage, "1/A", bent, 0.003, 40.0),
  };
}

}  // namespace blind
