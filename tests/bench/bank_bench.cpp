// The bank beside a straightforward filter of the same problem in Eigen: three states, two measurements, the
// contact law evaluated per filter and step, Joseph's update. Time per filter-step; the ratio of the two is
// printed last.
#include <benchmark/benchmark.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "lib/estimation/bank.hpp"
#include "lib/estimation/decision.hpp"
#include "lib/estimation/feed_filter.hpp"
#include "lib/monitor/monitor_configuration.hpp"

namespace morepro {
namespace {

constexpr std::size_t kMeasurements = 4096;

struct Measurements {
  std::vector<float> speed, current, feed_speed;
};

/// A steady cut of the reference machine at 48 V: 577.7 rad/s, 2.226 A.
const Measurements& measurements() {
  static const Measurements all = [] {
    Measurements m;
    std::mt19937 random(1);
    std::normal_distribution<float> normal;
    for (std::size_t k = 0; k < kMeasurements; ++k) {
      m.speed.push_back(577.7F + normal(random));
      m.current.push_back(2.226F + 0.05F * normal(random));
      m.feed_speed.push_back(0.02F + 0.002F * normal(random));
    }
    return m;
  }();
  return all;
}

template <std::size_t kN>
std::array<float, kN> chip_loads() {
  std::array<float, kN> lanes;
  for (std::size_t j = 0; j < kN; ++j)
    lanes[j] = 0.02F + 0.09F * static_cast<float>(j) / static_cast<float>(kN);
  return lanes;
}

/// Per filter-step, so that every variant can be compared with every other.
template <std::size_t kN>
void report(benchmark::State& state) {
  state.counters["per_filter_step"] = benchmark::Counter(
      static_cast<double>(kN), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <std::size_t kN>
void bank(benchmark::State& state) {
  const auto c = reference_configuration();
  const auto step = make_spindle_step<float>(c.machine.spindle, 1.0e-4);
  auto filters = std::make_unique<Bank<float, kN>>(c.machine, step, chip_loads<kN>(),
                                                   typename Bank<float, kN>::ProcessNoise{4.0e-4F, 1.0e-4F});
  FeedFilter<float> feed(c.machine.feed, 1.0e-4, 1.0e-8F);
  filters->start(577.0F, 2.2F, 1.0F, 0.0025F);
  const auto& m = measurements();
  std::size_t k = 0;
  for (auto _ : state) {
    feed.predict({26.0F, 1.0F, 1.0F});
    benchmark::DoNotOptimize(feed.update({m.feed_speed[k], 0.0F, 4.0e-6F, kUnmeasured}));
    filters->step({48.0F, 1.0F, 0.72F}, {m.speed[k], m.current[k], 1.0F, 0.0025F});
    benchmark::DoNotOptimize(filters->log_likelihood().data());
    benchmark::ClobberMemory();
    k = (k + 1) % kMeasurements;
  }
  report<kN>(state);
}

template <std::size_t kN>
void markov(benchmark::State& state) {
  MarkovDecision<float, kN> decision(kN, 1.0e-4F);
  std::array<float, kN> log_likelihood{};
  for (std::size_t j = 0; j < kN; ++j) log_likelihood[j] = -0.01F * static_cast<float>(j);
  for (auto _ : state) {
    benchmark::DoNotOptimize(log_likelihood.data());
    decision.step(log_likelihood);
    benchmark::DoNotOptimize(decision.probability().data());
    benchmark::ClobberMemory();
  }
  report<kN>(state);
}

/// What an engineer writes first: dense 3x3 matrices, std::pow and std::tanh, a 2x2 inverse.
class EigenFilter {
 public:
  EigenFilter(const MachineParameters& machine, float chip_load_mm) : m_(machine), chip_load_(chip_load_mm) {
    x_ << 577.0F, 0.02F, 2.2F;
    p_.setIdentity();
    q_ = Eigen::Vector3f(4.0e-4F, 1.0e-8F, 1.0e-4F).asDiagonal();
    r_ = Eigen::Vector2f(1.0F, 0.0025F).asDiagonal();
    h_ << 1.0F, 0.0F, 0.0F, 0.0F, 0.0F, 1.0F;
  }

  float step(float voltage, float force, float speed, float current) {
    const float dt = 1.0e-4F;
    const auto& s = m_.spindle;
    const auto f32 = [](double x) { return static_cast<float>(x); };
    const float vc = std::clamp(0.03F * f32(m_.tool.diameter_mm) * std::abs(x_(0)), 70.0F, 230.0F);
    const float thermal = 1.0F - std::pow(0.1F, f32(m_.thermal.exponent));
    const float speed_term = 3.32F * std::pow(vc, -0.45F);
    const float beta = std::max(0.0F, (speed_term - 0.24F * f32(m_.tool.teeth) * chip_load_) * thermal);
    const float lever = (f32(m_.contact.edge_force_n) + f32(m_.contact.chip_force_n_mm) * chip_load_) *
                        f32(m_.contact.radius_m);
    const float side = std::tanh(x_(0));
    const float torque = beta * lever * side;
    const float slope =
        -0.45F * speed_term * thermal / x_(0) * lever * side + beta * lever * (1.0F - side * side);
    Eigen::Matrix3f a = Eigen::Matrix3f::Zero();
    a(0, 0) = -(f32(s.viscous_friction_nms_rad) + slope) / f32(s.inertia_kgm2);
    a(0, 2) = f32(s.torque_constant_nm_a) / f32(s.inertia_kgm2);
    a(1, 1) = -f32(m_.feed.viscous_friction_ns_m) / f32(m_.feed.mass_kg);
    a(2, 0) = -f32(s.back_emf_constant_vs_rad) / f32(s.inductance_h);
    a(2, 2) = -f32(s.resistance_ohm) / f32(s.inductance_h);
    const Eigen::Vector3f rate(
        (f32(s.torque_constant_nm_a) * x_(2) - f32(s.viscous_friction_nms_rad) * x_(0) - torque) /
            f32(s.inertia_kgm2),
        (force - f32(m_.feed.viscous_friction_ns_m) * x_(1) - 22.0F) / f32(m_.feed.mass_kg),
        (voltage - f32(s.resistance_ohm) * x_(2) - f32(s.back_emf_constant_vs_rad) * x_(0)) /
            f32(s.inductance_h));
    const Eigen::Matrix3f z = dt * a;
    const Eigen::Matrix3f phi = Eigen::Matrix3f::Identity() + z + 0.5F * z * z;
    x_ += dt * rate + 0.5F * dt * (z * rate);
    p_ = phi * p_ * phi.transpose() + q_;
    const Eigen::Vector2f e = Eigen::Vector2f(speed, current) - h_ * x_;
    const Eigen::Matrix2f innovation = h_ * p_ * h_.transpose() + r_;
    const Eigen::Matrix2f inverse = innovation.inverse();
    const Eigen::Matrix<float, 3, 2> k = p_ * h_.transpose() * inverse;
    x_ += k * e;
    const Eigen::Matrix3f rest = Eigen::Matrix3f::Identity() - k * h_;
    p_ = rest * p_ * rest.transpose() + k * r_ * k.transpose();
    return -0.5F * (e.dot(inverse * e) + std::log(innovation.determinant()));
  }

 private:
  MachineParameters m_;
  float chip_load_;
  Eigen::Vector3f x_;
  Eigen::Matrix3f p_, q_;
  Eigen::Matrix2f r_;
  Eigen::Matrix<float, 2, 3> h_;
};

template <std::size_t kN>
void eigen_by_hand(benchmark::State& state) {
  std::vector<EigenFilter> filters;
  for (float chip_load : chip_loads<kN>()) filters.emplace_back(reference_machine(), chip_load);
  const auto& m = measurements();
  std::size_t k = 0;
  for (auto _ : state) {
    for (auto& filter : filters)
      benchmark::DoNotOptimize(filter.step(48.0F, 26.0F, m.speed[k], m.current[k]));
    k = (k + 1) % kMeasurements;
  }
  report<kN>(state);
}

BENCHMARK(bank<32>);
BENCHMARK(eigen_by_hand<32>);
BENCHMARK(bank<8>);
BENCHMARK(bank<11>);
BENCHMARK(bank<64>);
BENCHMARK(markov<32>);
BENCHMARK(markov<11>);

}  // namespace
}  // namespace morepro
