#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <memory>
#include <random>

#include "lib/identification/derivative_identification.hpp"
#include "lib/plant/built_in_machines.hpp"
#include "lib/plant/dynamics.hpp"

namespace morepro {
namespace {

constexpr int kParameterColumns = static_cast<int>(kParameterCount);
using Theta = std::array<double, kParameterCount>;
using Rows = Eigen::Matrix<double, 3, kParameterColumns>;

MachineParameters machine_with(MachineParameters machine, const Theta& theta) {
  auto& s = machine.spindle;
  s.torque_constant_nm_a = theta[0];
  s.inertia_kgm2 = theta[1];
  machine.feed.mass_kg = theta[2];
  machine.feed.contact_force_n = theta[3];
  s.inductance_h = theta[4];
  s.resistance_ohm = theta[5];
  s.back_emf_constant_vs_rad = theta[6];
  return machine;
}

DerivativeInput<double> random_input(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  return {.speed_rad_s = 300.0 * (unit(random) + 1.2),
          .feed_speed_m_s = 0.1 * unit(random),
          .current_a = 30.0 * unit(random),
          .armature_voltage_v = 50.0 + 20.0 * unit(random),
          .feed_force_n = 20.0 * unit(random),
          .contact = unit(random) > 0.0 ? 1.0 : 0.0,
          .engagement = 1.0 + 0.5 * unit(random),
          .contact_torque_nm = 0.2 * unit(random)};
}

std::array<double, 3> derivatives(const MachineParameters& machine, const DerivativeInput<double>& u) {
  const DerivativeParameterFilter<double> filter(machine, 0.3);
  return {filter.torque_row(u).derivative, filter.force_row(u).derivative, filter.voltage_row(u).derivative};
}

/// The rows of equation 22 in one matrix, zeros included.
Rows rows_of(const MachineParameters& machine, const DerivativeInput<double>& u) {
  const DerivativeParameterFilter<double> filter(machine, 0.3);
  Rows rows = Rows::Zero();
  const auto torque = filter.torque_row(u), force = filter.force_row(u);
  const auto voltage = filter.voltage_row(u);
  for (int j = 0; j < 2; ++j) rows(0, j) = torque.slope[static_cast<std::size_t>(j)];
  for (int j = 0; j < 2; ++j) rows(1, 2 + j) = force.slope[static_cast<std::size_t>(j)];
  for (int j = 0; j < 3; ++j) rows(2, 4 + j) = voltage.slope[static_cast<std::size_t>(j)];
  return rows;
}

// 1e-7 of the largest change that any parameter makes: the differences' own error is 1e-10 (third order in a
// step of 1e-5) plus 1e-16/1e-5 of rounding.
TEST(DerivativeRows, MatchCentralDifferences) {
  std::mt19937_64 random(1);
  for (const MachineParameters& machine : {thesis_machine(), reference_machine()}) {
    const Theta theta = Plant<double>(machine).theta();
    int signs_that_matter = 0;
    Eigen::Array<bool, 3, kParameterColumns> sign_matters =
        Eigen::Array<bool, 3, kParameterColumns>::Constant(false);
    for (int k = 0; k < 200; ++k) {
      const auto u = random_input(random);
      const Rows rows = rows_of(machine, u);
      for (int j = 0; j < kParameterColumns; ++j) {
        const auto at = static_cast<std::size_t>(j);
        constexpr double kStep = 1.0e-5;
        Theta above = theta, below = theta;
        above[at] *= 1.0 + kStep;
        below[at] *= 1.0 - kStep;
        const auto high = derivatives(machine_with(machine, above), u);
        const auto low = derivatives(machine_with(machine, below), u);
        for (int r = 0; r < 3; ++r) {
          const auto row = static_cast<std::size_t>(r);
          const double expected = (high[row] - low[row]) / (2.0 * kStep);
          const double scale = std::abs(high[row]) + std::abs(expected) + 1.0;
          EXPECT_NEAR(rows(r, j) * theta[at], expected, 1.0e-7 * scale) << r << " " << j;
          const double flipped = -rows(r, j) * theta[at];
          sign_matters(r, j) = sign_matters(r, j) || std::abs(flipped - expected) > 1.0e-7 * scale;
        }
      }
    }
    for (std::size_t j = 0; j < kParameterCount; ++j) {
      const int row = static_cast<int>(balance_of(static_cast<Parameter>(j)));
      signs_that_matter += sign_matters(row, static_cast<int>(j)) ? 1 : 0;
    }
    EXPECT_EQ(signs_that_matter, kParameterColumns);  // a flipped sign in any entry would have been seen
  }
}

TEST(DerivativeRows, AreThoseOfThePlant) {
  std::mt19937_64 random(2);
  const MachineParameters machine = reference_machine();
  const Plant<double> plant(machine);
  for (int k = 0; k < 100; ++k) {
    auto u = random_input(random);
    const PlantInput<double> input{.armature_voltage_v = u.armature_voltage_v,
                                   .feed_force_n = u.feed_force_n,
                                   .contact = u.contact,
                                   .engagement = u.engagement,
                                   .chip_load_mm = 0.05,
                                   .tool_temperature_degc = 500.0};
    u.contact_torque_nm = u.contact * plant.contact_law()(u.speed_rad_s, 0.05, 500.0).torque_nm;
    const PlantState<double> x{u.speed_rad_s, u.feed_speed_m_s, u.current_a};
    const auto expected = plant.derivative(x, input);
    const auto found = derivatives(machine, u);
    EXPECT_NEAR(found[0], expected.acceleration_rad_s2,
                1.0e-9 * (1.0 + std::abs(expected.acceleration_rad_s2)));
    EXPECT_NEAR(found[1], expected.feed_acceleration_m_s2,
                1.0e-12 * (1.0 + std::abs(expected.feed_acceleration_m_s2)));
    EXPECT_NEAR(found[2], expected.current_rate_a_s, 1.0e-9 * (1.0 + std::abs(expected.current_rate_a_s)));
    EXPECT_LE((rows_of(machine, u) - Rows(plant.parameter_jacobian(x, input))).cwiseAbs().maxCoeff(),
              1.0e-12 * plant.parameter_jacobian(x, input).cwiseAbs().maxCoeff());
  }
}

TEST(UdBlock, UpdatesAsTheDenseFilter) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 100; ++k) {
    Eigen::Matrix3d root;
    for (double& x : root.reshaped()) x = normal(random);
    Eigen::Matrix3d p = root * root.transpose() + 0.1 * Eigen::Matrix3d::Identity();
    UdBlock<double, 3>::Matrix rows{};
    for (int i = 0; i < 9; ++i)
      rows[static_cast<std::size_t>(i / 3)][static_cast<std::size_t>(i % 3)] = p(i / 3, i % 3);
    auto ud = UdBlock<double, 3>::of(rows);
    const Eigen::Vector3d h(normal(random), normal(random), normal(random));
    ud.add_variance(1, 0.3);
    p(1, 1) += 0.3;
    const auto update = ud.update({h(0), h(1), h(2)}, 0.5);
    const double s = h.dot(p * h) + 0.5;
    EXPECT_NEAR(update.innovation_variance, s, 1.0e-12 * s);
    EXPECT_NEAR(update.inverse_variance * s, 1.0, 1.0e-12);
    const Eigen::Matrix3d after = p - p * h * h.transpose() * p / s;
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(update.direction[static_cast<std::size_t>(i)], (p * h)(i), 1.0e-12 * p.norm());
      for (int j = 0; j < 3; ++j)
        EXPECT_NEAR(ud.covariance(static_cast<std::size_t>(i), static_cast<std::size_t>(j)), after(i, j),
                    1.0e-12 * p.norm());
    }
  }
}

/// A machine whose derivatives are measured with noise, as the literal filter sees it.
template <class Real>
class MeasuredMachine {
 public:
  explicit MeasuredMachine(bool is_thesis, std::uint64_t seed)
      : is_thesis_(is_thesis),
        machine_(is_thesis ? thesis_machine() : reference_machine()),
        plant_(machine_),
        random_(seed) {
    speed_noise_ = is_thesis ? 0.5 : 1.0;
    current_noise_ = is_thesis ? 0.1 : 0.05;
    for (int k = 0; k < 20000; ++k) move();
  }

  /// Voltage with a 1 ms and a 20 ms random part, feed force with a 30 ms one, contact on and off every 100
  /// ms.
  void excite(int k) {
    const auto sign = [&] { return (random_() & 1U) != 0 ? 1.0 : -1.0; };
    if (k % 10 == 0) fast_ = 6.0 * sign();
    if (k % 200 == 0) slow_ = 6.0 * sign();
    if (k % 300 == 0) force_ = 4.0 * sign();
    input_.armature_voltage_v = 48.0 + fast_ + slow_;
    input_.feed_force_n = (is_thesis_ ? 8.0 : 26.0) + force_;
    input_.contact = (k / 1000) % 2;
  }

  void show(DerivativeIdentification<Real>& filter) {
    const auto rate = plant_.derivative(x_, input_);
    const double torque =
        input_.contact * plant_.contact_law()(x_.speed_rad_s, input_.chip_load_mm, 500.0).torque_nm;
    const auto noisy = [&](double value, double noise) {
      return static_cast<Real>(value + noise * normal_(random_));
    };
    const Real acceleration_noise = is_thesis_ ? Real(1000) : Real(200),
               rate_noise = is_thesis_ ? Real(20000) : Real(2000);
    filter.step({noisy(x_.speed_rad_s, speed_noise_), noisy(x_.feed_speed_m_s, 0.002),
                 noisy(x_.current_a, current_noise_), Real(input_.armature_voltage_v),
                 Real(input_.feed_force_n), Real(input_.contact), Real(1), Real(torque)},
                {noisy(rate.acceleration_rad_s2, double(acceleration_noise)),
                 noisy(rate.feed_acceleration_m_s2, 0.3), noisy(rate.current_rate_a_s, double(rate_noise)),
                 acceleration_noise * acceleration_noise, Real(0.09), rate_noise * rate_noise});
  }

  void move() {
    constexpr double kStep = 2.0e-5;
    for (int k = 0; k < 5; ++k) {
      const auto rate = plant_.derivative(x_, input_);
      x_.speed_rad_s += kStep * rate.acceleration_rad_s2;
      x_.current_a += kStep * rate.current_rate_a_s;
      x_.feed_speed_m_s += kStep * rate.feed_acceleration_m_s2;
    }
  }

  [[nodiscard]] RegressorNoise<Real> noise() const {
    return {Real(speed_noise_ * speed_noise_), Real(4.0e-6), Real(current_noise_ * current_noise_)};
  }
  [[nodiscard]] const MachineParameters& machine() const { return machine_; }

 private:
  bool is_thesis_;
  MachineParameters machine_;
  Plant<double> plant_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  double speed_noise_, current_noise_;
  double fast_ = 6.0, slow_ = 6.0, force_ = 4.0;
  PlantState<double> x_{};
  PlantInput<double> input_{.armature_voltage_v = 48.0,
                            .feed_force_n = 8.0,
                            .contact = 1.0,
                            .engagement = 1.0,
                            .chip_load_mm = 0.05,
                            .tool_temperature_degc = 500.0};
};

MachineParameters wrong_by(const MachineParameters& machine, double factor) {
  Theta theta = Plant<double>(machine).theta();
  for (std::size_t j = 0; j < kParameterCount; ++j) theta[j] *= j % 2 == 0 ? factor : 1.0 / factor;
  return machine_with(machine, theta);
}

// Regressors with noise pull the parameters of a derivative by the square of noise over signal: up to 1 %.
TEST(DerivativeIdentification, FindsAllSevenParameters) {
  for (const bool is_thesis : {true, false}) {
    MeasuredMachine<float> machine(is_thesis, 5);
    const auto wrong = wrong_by(machine.machine(), 1.3);
    auto found = std::make_unique<DerivativeIdentification<float>>(wrong, machine.noise(), 0.3F, 0.0F);
    for (int k = 0; k < 20000; ++k) {
      machine.excite(k);
      machine.show(*found);
      machine.move();
    }
    const Theta truth = Plant<double>(machine.machine()).theta();
    for (std::size_t j = 0; j < kParameterCount; ++j) {
      const auto parameter = static_cast<Parameter>(j);
      EXPECT_NEAR(double(found->filter().value(parameter)) / truth[j], 1.0, 0.02) << is_thesis << " " << j;
      EXPECT_EQ(found->information(parameter), Information::kAlone) << is_thesis << " " << j;
    }
  }
}

// The thesis's own excitation: everything is constant.
TEST(DerivativeIdentification, ConstantInputsTellCombinationsOnlyAndNothingDrifts) {
  MeasuredMachine<float> machine(true, 6);
  auto found = std::make_unique<DerivativeIdentification<float>>(wrong_by(machine.machine(), 1.3),
                                                                 machine.noise(), 0.3F, 2.0e-5F);
  const auto run = [&](int frames) {
    for (int k = 0; k < frames; ++k) machine.show(*found);
  };
  run(100000);
  Theta before{};
  for (std::size_t j = 0; j < kParameterCount; ++j)
    before[j] = double(found->filter().value(static_cast<Parameter>(j)));
  EXPECT_NEAR(before[index_of(Parameter::kTorqueConstant)], 1.5, 0.015);
  EXPECT_EQ(found->information(Parameter::kTorqueConstant), Information::kAlone);
  EXPECT_EQ(found->information(Parameter::kInertia), Information::kNone);
  EXPECT_EQ(found->information(Parameter::kInductance), Information::kNone);
  EXPECT_EQ(found->information(Parameter::kResistance), Information::kPair);
  EXPECT_EQ(found->information(Parameter::kBackEmfConstant), Information::kPair);
  EXPECT_EQ(found->partner(Parameter::kResistance), Parameter::kBackEmfConstant);
  EXPECT_EQ(found->partner(Parameter::kBackEmfConstant), Parameter::kResistance);
  EXPECT_NE(found->information(Parameter::kMass), Information::kAlone);
  EXPECT_NE(found->information(Parameter::kContactForce), Information::kAlone);
  EXPECT_EQ(found->partner(Parameter::kMass), Parameter::kContactForce);
  run(10000000);
  for (std::size_t j = 0; j < kParameterCount; ++j)
    EXPECT_NEAR(double(found->filter().value(static_cast<Parameter>(j))) / before[j], 1.0, 0.01) << j;
}

}  // namespace
}  // namespace morepro
