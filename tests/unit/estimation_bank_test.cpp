#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "lib/estimation/bank.hpp"
#include "tests/support/spindle_simulation.hpp"

namespace morepro {
namespace {

constexpr std::size_t kBankLanes = 8;
constexpr double kPeriod_s = 1.0e-4;
constexpr float kThermalFactor = 0.72F;  // some 500 degC

template <class Real>
std::array<Real, kBankLanes> grid(const MonitorConfiguration& c) {
  std::array<Real, kBankLanes> lanes;
  for (std::size_t j = 0; j < kBankLanes; ++j) lanes[j] = static_cast<Real>(c.grid.value_mm(j));
  return lanes;
}

template <class Real>
Bank<Real, kBankLanes> make_bank(const MonitorConfiguration& c) {
  return {c.machine,
          make_spindle_step<Real>(c.machine.spindle, kPeriod_s),
          grid<Real>(c),
          {Real(4.0e-4), Real(1.0e-4)}};
}

/// The same filter, one hypothesis at a time, straight from the equations in double and without any shortcut.
class PlainFilter {
 public:
  PlainFilter(const MonitorConfiguration& c, double chip_load_mm)
      : law_(c.machine),
        step_(make_spindle_step<double>(c.machine.spindle, kPeriod_s)),
        chip_load_(chip_load_mm) {}

  double w = 0.0, i = 0.0, pww = 1.0, pwi = 0.0, pii = 1.0, nis = 0.0, log_det = 0.0;

  void step(const SpindleInput<double>& u, double yw, double yi, double rw, double ri) {
    const auto contact = law_.at_thermal_factor(w, chip_load_, u.thermal_factor);
    const double torque = u.contact * contact.torque_nm, slope = u.contact * contact.per_speed;
    const double change =
        step_.ww * w + step_.wi * i + step_.w_per_v * u.armature_voltage_v + step_.w_per_nm * torque - w;
    const double wp = w + change * (1.0 + 0.5 * step_.w_per_nm * slope);
    const double ip =
        step_.iw * w + step_.ii * i + step_.i_per_v * u.armature_voltage_v + step_.i_per_nm * torque;
    const double f = step_.ww + step_.w_per_nm * slope, g = step_.iw + step_.i_per_nm * slope;
    Eigen::Matrix2d phi, p, r;
    phi << f, step_.wi, g, step_.ii;
    p << pww, pwi, pwi, pii;
    r << rw, 0.0, 0.0, ri;
    p = phi * p * phi.transpose() + Eigen::Vector2d(4.0e-4, 1.0e-4).asDiagonal().toDenseMatrix();
    const Eigen::Matrix2d s = p + r;
    const Eigen::Vector2d e(yw - wp, yi - ip);
    const Eigen::Matrix2d k = p * s.inverse();
    const Eigen::Vector2d x = Eigen::Vector2d(wp, ip) + k * e;
    p = p - k * s * k.transpose();
    w = x(0), i = x(1), pww = p(0, 0), pwi = p(0, 1), pii = p(1, 1);
    nis = e.dot(s.inverse() * e);
    log_det = std::log(s.determinant());
  }

 private:
  ContactLaw<double> law_;
  SpindleStep<double> step_;
  double chip_load_;
};

struct BankCase {
  const char* name;
  MonitorConfiguration configuration;
  double voltage_v = 48.0;
  // Speeds of 600 rad/s have a last bit of 6e-5, 6e-5 of a standard deviation; it enters twice the distance.
  double float_likelihood = 2.0e-3;
};

/// Chip loads so far apart that the lanes leave the cubics' domain and some have no friction at all.
MonitorConfiguration wide_grid() {
  auto c = thesis_configuration();
  c.grid.step_mm = 0.5;
  return c;
}

/// At 100 V the friction of these chip loads ends at the speed that the spindle reaches.
MonitorConfiguration ending_friction() {
  auto c = thesis_configuration();
  c.grid = {.first_mm = 0.9, .step_mm = 0.05, .count = 8};
  c.machine.tool.chip_load_mm = 1.1;
  return c;
}

class EveryMachine : public testing::TestWithParam<BankCase> {};

/// Runs a bank and plain filters side by side through spin-up, air and cut; largest relative differences.
struct Difference {
  double state = 0.0, covariance = 0.0, likelihood = 0.0;
};

template <class Real>
Difference compare_with_plain(const BankCase& test_case) {
  const auto& c = test_case.configuration;
  const double voltage_v = test_case.voltage_v;
  auto bank = make_bank<Real>(c);
  std::vector<PlainFilter> plain;
  for (std::size_t j = 0; j < kBankLanes; ++j) plain.emplace_back(c, static_cast<double>(grid<Real>(c)[j]));
  bank.start(Real(0), Real(0), Real(1), Real(1));
  test::SpindleSimulation machine(c, 5);
  machine.input = {.armature_voltage_v = voltage_v,
                   .contact = 0.0,
                   .chip_load_mm = c.machine.tool.chip_load_mm,
                   .tool_temperature_degc = 500.0};
  Difference worst;
  for (int k = 0; k < 3000; ++k) {
    machine.input.contact = k >= 1000 && k < 2600 ? 1.0 : 0.0;
    const auto held = machine.held();
    machine.step();
    const auto y = machine.measure();
    bank.step({Real(held.armature_voltage_v), Real(held.contact), Real(held.thermal_factor)},
              {Real(y.speed_rad_s), Real(y.current_a), Real(y.speed_variance), Real(y.current_variance)});
    for (auto& filter : plain)
      filter.step({voltage_v, static_cast<double>(held.contact), static_cast<double>(held.thermal_factor)},
                  static_cast<double>(y.speed_rad_s), static_cast<double>(y.current_a),
                  static_cast<double>(y.speed_variance), static_cast<double>(y.current_variance));
    for (std::size_t j = 0; j < kBankLanes; ++j) {
      worst.state = std::max(worst.state, std::abs(static_cast<double>(bank.speed_rad_s(j)) - plain[j].w) /
                                              (1.0 + std::abs(plain[j].w)));
      worst.covariance = std::max(worst.covariance,
                                  std::abs(static_cast<double>(bank.speed_variance(j)) / plain[j].pww - 1.0));
      const double expected = -0.5 * (plain[j].nis - plain[0].nis + plain[j].log_det - plain[0].log_det);
      const double actual = static_cast<double>(bank.log_likelihood()[j] - bank.log_likelihood()[0]);
      worst.likelihood = std::max(worst.likelihood, std::abs(actual - expected) / (1.0 + plain[j].nis));
    }
  }
  return worst;
}

TEST_P(EveryMachine, BankInDoubleEqualsPlainFilters) {
  const Difference worst = compare_with_plain<double>(GetParam());
  // The cubic's 6e-7 of the torque, over the filters' memory of some ten steps.
  EXPECT_LE(worst.state, 2.0e-6);
  // Its slope's 6e-5, which is 4 % of F at most.
  EXPECT_LE(worst.covariance, 1.0e-5);
  // The state's error against a standard deviation of 1/200 of the speed, twice the distance; the logarithm's
  // 5e-6.
  EXPECT_LE(worst.likelihood, 2.0e-4);
}

TEST_P(EveryMachine, BankInFloatFollowsPlainFilters) {
  const Difference worst = compare_with_plain<float>(GetParam());
  // Some hundred roundings of 6e-8 per step, over the filters' memory of some ten steps.
  EXPECT_LE(worst.state, 5.0e-6);
  EXPECT_LE(worst.covariance, 2.0e-5);
  EXPECT_LE(worst.likelihood, GetParam().float_likelihood);
}

INSTANTIATE_TEST_SUITE_P(
    Bank, EveryMachine,
    testing::Values(BankCase{"reference", reference_configuration()},
                    BankCase{"reference_backwards", reference_configuration(), -48.0},
                    BankCase{"thesis", thesis_configuration()},
                    BankCase{"thesis_backwards", thesis_configuration(), -48.0},
                    BankCase{"wide_grid", wide_grid()},
                    // A rounding decides on which side of the law's kink a float lane is.
                    BankCase{"ending_friction", ending_friction(), 100.0, 0.05}),
    [](const auto& instance) { return instance.param.name; });

TEST(Bank, AllHypothesesAgreeWithoutContact) {
  const auto c = thesis_configuration();
  auto bank = make_bank<float>(c);
  bank.start(0.0F, 0.0F, 1.0F, 1.0F);
  for (int k = 0; k < 500; ++k)
    bank.step({48.0F, 0.0F, kThermalFactor}, {static_cast<float>(k), 10.0F, 0.25F, 0.01F});
  for (std::size_t j = 1; j < kBankLanes; ++j) {
    EXPECT_EQ(bank.speed_rad_s(j), bank.speed_rad_s(0));
    EXPECT_EQ(bank.log_likelihood()[j], bank.log_likelihood()[0]);
  }
}

TEST(Bank, MissingChannelsLeaveThePredictionAsItIs) {
  const auto c = reference_configuration();
  auto bank = make_bank<float>(c), blind = make_bank<float>(c);
  bank.start(577.0F, 2.2F, 1.0F, 0.01F);
  blind.start(577.0F, 2.2F, 1.0F, 0.01F);
  bank.step({48.0F, 1.0F, kThermalFactor}, {0.0F, 0.0F, kUnmeasured, kUnmeasured});
  blind.step({48.0F, 1.0F, kThermalFactor}, {1.0e6F, -1.0e5F, kUnmeasured, kUnmeasured});
  const auto step = make_spindle_step<double>(c.machine.spindle, kPeriod_s);
  const double variance = step.ww * step.ww + step.wi * step.wi * 0.01;
  for (std::size_t j = 0; j < kBankLanes; ++j) {
    EXPECT_EQ(bank.speed_rad_s(j), blind.speed_rad_s(j)) << "the value of a missing channel was used";
    EXPECT_NEAR(static_cast<double>(bank.speed_variance(j)), variance, 2.0e-3 * variance)
        << "variance must grow";
  }
}

TEST(Bank, RepairsALaneWhoseMemoryHoldsNoNumber) {
  const auto c = reference_configuration();
  auto bank = make_bank<float>(c);
  bank.start(577.0F, 2.2F, 1.0F, 0.01F);
  bank.step({48.0F, 1.0F, kThermalFactor}, {std::numeric_limits<float>::quiet_NaN(), 2.2F, 1.0F, 0.0025F});
  for (int k = 0; k < 3; ++k) bank.step({48.0F, 1.0F, kThermalFactor}, {577.5F, 2.2F, 1.0F, 0.0025F});
  for (std::size_t j = 0; j < kBankLanes; ++j) {
    EXPECT_NEAR(bank.speed_rad_s(j), 577.5F, 3.0F);
    EXPECT_GT(bank.speed_variance(j), 0.0F);
    EXPECT_TRUE(std::isfinite(bank.log_likelihood()[j]));
  }
  EXPECT_GE(bank.repaired(), kBankLanes);
}

TEST(Bank, FollowsReversalsThroughStandstill) {
  const auto c = reference_configuration();
  auto bank = make_bank<float>(c);
  bank.start(0.0F, 0.0F, 1.0F, 0.01F);
  test::SpindleSimulation machine(c, 9);
  machine.input = {
      .armature_voltage_v = 30.0, .contact = 1.0, .chip_load_mm = 0.05, .tool_temperature_degc = 500.0};
  for (int k = 0; k < 8000; ++k) {
    machine.input.armature_voltage_v = (k / 1000) % 2 == 0 ? 30.0 : -30.0;
    const auto held = machine.held();
    machine.step();
    bank.step(held, machine.measure());
    for (std::size_t j = 0; j < kBankLanes; ++j)
      ASSERT_TRUE(bank.speed_variance(j) > 0.0F && bank.current_variance(j) > 0.0F) << k;
    ASSERT_NEAR(static_cast<double>(bank.speed_rad_s(3)), machine.state().speed_rad_s, 8.0) << k;
  }
}

}  // namespace
}  // namespace morepro
