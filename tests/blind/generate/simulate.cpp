#include "simulate.hpp"

#include <algorithm>
#include <cmath>

namespace blind {
namespace {

/// Speed controller with an integral part, feed-forward and a limit that stops the integral.
class Controller {
 public:
  Controller(double gain, double integral_per_s, double forward, double limit, double smoothing_s,
             double sample_s)
      : gain_(gain),
        integral_per_sample_(integral_per_s * sample_s),
        forward_(forward),
        limit_(limit),
        smoothing_(sample_s / smoothing_s) {}

  double output(double wanted, double measured, double dither) {
    reference_ += smoothing_ * (wanted - reference_);
    const double error = reference_ - measured;
    const double free = forward_ * reference_ + gain_ * (error + integral_) + dither;
    const double limited = std::clamp(free, -limit_, limit_);
    if (free == limited) integral_ += integral_per_sample_ * error;
    return limited;
  }

 private:
  double gain_, integral_per_sample_, forward_, limit_, smoothing_;
  double reference_ = 0.0, integral_ = 0.0;
};

/// Ornstein-Uhlenbeck process of unit variance.
class Wander {
 public:
  Wander(double correlation_s, double step_s)
      : keep_(std::exp(-step_s / correlation_s)), kick_(std::sqrt(1.0 - keep_ * keep_)) {}
  double next(Random& random) { return value_ = keep_ * value_ + kick_ * random.quick_normal(); }

 private:
  double keep_, kick_, value_ = 0.0;
};

double rounded(double value, double step) { return step > 0.0 ? step * std::round(value / step) : value; }

double measured(double truth, const Sensor& sensor, Random& random) {
  const double noisy = truth + sensor.noise * random.normal();
  return sensor.lsb > 0.0 ? sensor.lsb * std::round(noisy / sensor.lsb) : noisy;
}

class Loop {
 public:
  Loop(const Scenario& s, const std::vector<ActiveEffect>& effects)
      : s_(s),
        effects_(effects),
        plant_(s.machine, effects, s.excitation.winding_time_s, s.excitation.tool_time_s),
        noise_(s.seed, 11),
        disturbance_(s.seed, 12),
        gains_(s.seed, 13),
        spindle_(spindle_controller()),
        feed_(feed_controller()),
        torque_(s.process.correlation_s, kStep_s),
        force_(s.process.correlation_s, kStep_s),
        voltage_(s.process.correlation_s, kStep_s) {}

  Run run() {
    Run run;
    run.sample_s = s_.excitation.sample_s;
    const std::size_t count = s_.excitation.contact.size();
    run.rows.reserve(count);
    for (std::size_t k = 0; k < count && run.is_finite; ++k) {
      run.rows.push_back(row(k));
      advance(run.rows.back().in);
      run.is_finite = plant_.is_finite();
    }
    return run;
  }

 private:
  Controller spindle_controller() {
    const Machine& m = s_.machine;
    const double gain = m.back_emf_constant * gains_.log_uniform(0.4, 2.0);
    return {gain,
            gains_.uniform(10.0, 50.0),
            m.back_emf_constant,
            m.voltage_limit,
            gains_.uniform(0.01, 0.04),
            s_.excitation.sample_s};
  }
  Controller feed_controller() {
    return {gains_.uniform(100.0, 400.0), gains_.uniform(10.0, 40.0), 0.0, 800.0,
            gains_.uniform(0.005, 0.02),  s_.excitation.sample_s};
  }

  Row row(std::size_t k) {
    Row row = sampled(k);
    const Row* previous = &last_;
    bool repeats = false;
    for (const ActiveEffect& active : effects_) {
      repeats = active.effect->repeats_frame() || repeats;
      row.is_missing = active.effect->drops_row() || row.is_missing;
    }
    if (repeats && k > 0) {
      row.seen = previous->seen;
      row.tool_c = previous->tool_c;
      row.winding_c = previous->winding_c;
    }
    command(k, row);
    return last_ = row;
  }

  Row sampled(std::size_t k) {
    const Point& p = plant_.now();
    const Machine& m = s_.machine;
    Reading r{.w = p.w, .v = p.v, .i = p.i, .angle = p.angle, .x = p.x};
    for (const ActiveEffect& active : effects_)
      if (p.t >= active.onset_s) active.effect->read(p, r);
    Row row;
    row.time_s = static_cast<double>(k) * s_.excitation.sample_s;
    row.seen.w = rounded(measured(r.w, m.speed, noise_), r.w_step);
    row.seen.v = measured(r.v, m.feed, noise_);
    row.seen.i = rounded(measured(r.i, m.current, noise_), r.i_step);
    row.seen.angle = measured(r.angle, m.angle, noise_);
    row.seen.x = measured(r.x, m.position, noise_);
    row.tool_c = measured(p.tool_c, m.tool, noise_);
    row.winding_c = measured(p.winding_c(), m.winding, noise_);
    return row;
  }

  void command(std::size_t k, Row& row) {
    const Excitation& e = s_.excitation;
    const Point& now = plant_.now();
    row.in.voltage_v = spindle_.output(e.spindle_reference[k], s_.controllers_see_state ? now.w : row.seen.w,
                                       e.voltage_dither[k]);
    row.in.force_n =
        feed_.output(e.feed_reference[k], s_.controllers_see_state ? now.v : row.seen.v, e.force_dither[k]);
    row.in.contact = e.contact[k];
    row.in.engagement = e.engagement[k];
    row.in.chip_load_mm = e.chip_load_mm[k];
  }

  void advance(const Inputs& inputs) {
    const ProcessNoise& n = s_.process;
    const double gain = inputs.contact > 0.0 ? n.contact_gain : 1.0;
    for (int step = 0; step < substeps_; ++step) {
      const Disturbance d{gain * n.torque_nm * torque_.next(disturbance_),
                          gain * n.force_n * force_.next(disturbance_),
                          n.voltage_v * voltage_.next(disturbance_)};
      plant_.step(inputs, d, kStep_s);
    }
  }

  const Scenario& s_;
  const int substeps_ = static_cast<int>(std::round(s_.excitation.sample_s / kStep_s));
  const std::vector<ActiveEffect>& effects_;
  Plant plant_;
  Random noise_, disturbance_, gains_;
  Controller spindle_, feed_;
  Wander torque_, force_, voltage_;
  Row last_;
};

}  // namespace

Run simulate(const Scenario& scenario, const std::vector<ActiveEffect>& effects) {
  return Loop(scenario, effects).run();
}

}  // namespace blind
