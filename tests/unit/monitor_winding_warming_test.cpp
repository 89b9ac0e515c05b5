// A winding without a sensor is as warm as its current makes it.
#include <gtest/gtest.h>

#include <cmath>

#include "lib/monitor/held_inputs.hpp"

namespace morepro {
namespace {

constexpr double kRateHz = 1000.0;
constexpr double kTimeS = 2.0;
constexpr double kRiseKA2 = 0.5;
constexpr float kCurrentA = 8.0F;

MachineParameters warmed() {
  MachineParameters machine;
  machine.spindle.winding_time_constant_s = kTimeS;
  machine.spindle.winding_rise_k_a2 = kRiseKA2;
  return machine;
}

SensorFrame frame_of(float current_a) {
  SensorFrame frame;
  frame.set(Channel::kArmatureCurrent, current_a);
  return frame;
}

void hold(HeldInputs& held, const SensorFrame& frame, int frames) {
  for (int i = 0; i < frames; ++i) held.take({frame, frame.present});
}

TEST(WindingWarming, FollowsTheSquareOfTheCurrent) {
  HeldInputs held(warmed(), kRateHz);
  EXPECT_EQ(held.winding_degc(), 25.0F);
  hold(held, frame_of(kCurrentA), 1 + static_cast<int>(kTimeS * kRateHz));
  const double end_k = kRiseKA2 * static_cast<double>(kCurrentA) * static_cast<double>(kCurrentA);
  // One step of 1/2000 of the time constant goes along the tangent.
  EXPECT_NEAR(static_cast<double>(held.winding_degc()), 25.0 + end_k * -std::expm1(-1.0), 1.0e-3 * end_k);
  hold(held, frame_of(0.0F), static_cast<int>(20.0 * kTimeS * kRateHz));
  EXPECT_FLOAT_EQ(held.winding_degc(), 25.0F);
}

// A step is a hundredth of the last bit of the sum then.
TEST(WindingWarming, LosesNothingOfASlowOne) {
  MachineParameters machine = warmed();
  machine.spindle.winding_time_constant_s = 6000.0;
  HeldInputs held(machine, kRateHz);
  hold(held, frame_of(kCurrentA), 1 + 600'000);
  const double end_k = kRiseKA2 * static_cast<double>(kCurrentA) * static_cast<double>(kCurrentA);
  EXPECT_NEAR(static_cast<double>(held.winding_degc()), 25.0 + end_k * -std::expm1(-0.1), 1.0e-5 * end_k);
}

TEST(WindingWarming, IsNothingBesideASensor) {
  HeldInputs held(warmed(), kRateHz);
  SensorFrame frame = frame_of(kCurrentA);
  frame.set(Channel::kWindingTemperature, 40.0F);
  hold(held, frame, 1);
  hold(held, frame_of(kCurrentA), 1000);
  EXPECT_EQ(held.winding_degc(), 40.0F);
}

TEST(WindingWarming, NeedsATimeConstantAndARise) {
  for (const bool has_time : {false, true}) {
    MachineParameters machine = warmed();
    (has_time ? machine.spindle.winding_rise_k_a2 : machine.spindle.winding_time_constant_s) = 0.0;
    HeldInputs held(machine, kRateHz);
    hold(held, frame_of(kCurrentA), 1000);
    EXPECT_EQ(held.winding_degc(), 25.0F);
  }
}

}  // namespace
}  // namespace morepro
