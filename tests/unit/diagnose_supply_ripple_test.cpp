// A supply's ripple that nobody records is no gap, whatever the current's controller makes of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/unit/diagnose_support.hpp"

namespace morepro::diagnose_test {
namespace {

using host::ParameterResult;
using host::Verdict;

constexpr double kRateHz = 20000.0;
constexpr double kDurationS = 4.0;
constexpr double kSpeedNoise = 2.0;
constexpr double kCurrentNoise = 0.03;

/// A small fast spindle: a tenth of a volt moves its current by a third of an ampere within a millisecond.
MachineDescription router() {
  MachineDescription machine = datasheet(0.0);
  auto& s = machine.configuration.machine.spindle;
  s.torque_constant_nm_a = s.back_emf_constant_vs_rad = 0.04;
  s.resistance_ohm = 0.3;
  s.inductance_h = 1.4e-4;
  s.inertia_kgm2 = 2.0e-5;
  s.viscous_friction_nms_rad = 4.0e-6;
  machine.configuration.sensors[Channel::kSpindleSpeed] = {kSpeedNoise, 0.0};
  machine.configuration.sensors[Channel::kArmatureCurrent] = {kCurrentNoise, 0.0};
  return machine;
}

/// Random force of a unit's size that is forgotten after a time.
class Ripple {
 public:
  Ripple(double memory_s, double step_s) : kept_(std::exp(-step_s / memory_s)) {}
  double next(double news) { return value_ = kept_ * value_ + std::sqrt(1.0 - kept_ * kept_) * news; }

 private:
  double kept_;
  double value_ = 0.0;
};

/// What an axis does, and who makes it.
struct Drive {
  double ripple_v;
  double memory_s;    ///< of the ripple
  bool sees_current;  ///< speed and current in cascade; or the voltage follows from the speed alone
};

/// To another speed every 0.3 s, a sine of four frequencies on top.
RecordingSignals with_ripple(const MachineParameters::Spindle& m, const Drive& drive) {
  constexpr int kSteps = 10;
  constexpr double kSampleS = 1.0 / kRateHz;
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> level(-800.0, 800.0);
  Ripple ripple(drive.memory_s, kSampleS);
  const double current_bandwidth = 2.0 * std::numbers::pi * 150.0;
  const double speed_gain = m.inertia_kgm2 * 2.0 * std::numbers::pi * 8.0 / m.torque_constant_nm_a;
  RecordingSignals signals;
  signals.rate_hz = kRateHz;
  signals.rows = static_cast<std::size_t>(kDurationS * kRateHz);
  double speed = 0.0, current = 0.0, wanted = 0.0, integral = 0.0;
  for (std::size_t row = 0; row < signals.rows; ++row) {
    const double t = static_cast<double>(row) * kSampleS;
    if (drive.sees_current && row % static_cast<std::size_t>(0.3 * kRateHz) == 0) wanted = level(random);
    if (!drive.sees_current) wanted = 400.0 + 500.0 * std::sin(2.0 * t) + 250.0 * std::sin(7.0 * t);
    const double seen_speed = speed + kSpeedNoise * normal(random);
    const double seen_current = current + kCurrentNoise * normal(random);
    double voltage = m.back_emf_constant_vs_rad * (drive.sees_current ? seen_speed : wanted);
    const double ampere = std::clamp(speed_gain * (wanted - seen_speed), -8.0, 8.0);
    if (drive.sees_current) {
      integral += m.resistance_ohm * current_bandwidth * (ampere - seen_current) * kSampleS;
      voltage += m.inductance_h * current_bandwidth * (ampere - seen_current) + integral;
    } else {
      voltage += m.resistance_ohm * ampere;
    }
    for (const double hz : {23.0, 71.0, 167.0, 310.0})
      voltage += 0.1 * std::sin(2.0 * std::numbers::pi * hz * t);
    show(signals, Channel::kArmatureVoltage, voltage);
    show(signals, Channel::kContact, 0.0);
    show(signals, Channel::kSpindleSpeed, seen_speed);
    show(signals, Channel::kArmatureCurrent, seen_current);
    const double supplied =
        static_cast<double>(static_cast<float>(voltage)) + drive.ripple_v * ripple.next(normal(random));
    for (int i = 0; i < kSteps; ++i) {
      // By the middle of a step.
      const auto rates = [&](double w, double a) {
        return std::pair{(m.torque_constant_nm_a * a - m.viscous_friction_nms_rad * w) / m.inertia_kgm2,
                         (supplied - m.resistance_ohm * a - m.back_emf_constant_vs_rad * w) / m.inductance_h};
      };
      const double step_s = kSampleS / kSteps;
      const auto [w1, a1] = rates(speed, current);
      const auto [w2, a2] = rates(speed + 0.5 * step_s * w1, current + 0.5 * step_s * a1);
      speed += step_s * w2;
      current += step_s * a2;
    }
  }
  host::count_cutting_time(signals);
  return signals;
}

class SupplyRipple : public testing::TestWithParam<Drive> {};

// It drives the current, and the controller answers: what it leaves goes with rates, as a wrong law does, and
// with what the controller was asked to follow. Five standard errors, because a little of it bends values
// still. The inductance came out as twice its value, "parameter_error" or "unexplained".
TEST_P(SupplyRipple, IsNoGap) {
  const MachineDescription machine = router();
  const DiagnosisResult result =
      diagnosed(with_ripple(machine.configuration.machine.spindle, GetParam()), machine);
  EXPECT_EQ(result.verdict, Verdict::kNoGap) << said(result);
  for (const ParameterResult& one : result.parameters)
    if (one.name == "inductance_h") {
      EXPECT_NEAR(one.refit, one.datasheet, 5.0 * one.standard_error);
    }
}
INSTANTIATE_TEST_SUITE_P(Volts, SupplyRipple,
                         testing::Values(Drive{0.1, 1.0e-3, true}, Drive{0.2, 1.0e-3, true},
                                         Drive{0.3, 2.0e-3, true}, Drive{0.1, 1.0e-3, false},
                                         Drive{0.2, 1.0e-3, false}));

}  // namespace
}  // namespace morepro::diagnose_test
