#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "lib/c/morepro_plant.h"
#include "lib/plant/built_in_machines.hpp"
#include "lib/plant/integrators.hpp"

namespace morepro {
namespace {

using State = std::array<double, MOREPRO_STATES>;
using Input = std::array<double, MOREPRO_INPUTS>;

constexpr State kState{110.0, 0.03, 21.0};
constexpr Input kInput{31.0, 60.0, 1.0, 0.7, 0.06, 520.0};

const PlantState<double> kCppState{110.0, 0.03, 21.0};
const PlantInput<double> kCppInput{31.0, 60.0, 1.0, 0.7, 0.06, 520.0};

TEST(CPlant, IsThePlant) {
  for (const bool is_thesis : {false, true}) {
    const auto c = is_thesis ? morepro_thesis_machine() : morepro_reference_machine();
    const auto cpp = is_thesis ? thesis_machine() : reference_machine();
    State rate{};
    ASSERT_EQ(morepro_plant_derivative(&c, kState.data(), kInput.data(), rate.data()), MOREPRO_OK);
    const auto wanted = Plant<double>(cpp).derivative(kCppState, kCppInput);
    EXPECT_EQ(rate,
              (State{wanted.acceleration_rad_s2, wanted.feed_acceleration_m_s2, wanted.current_rate_a_s}));
    State next{};
    ASSERT_EQ(morepro_plant_step(&c, 1.0e-4, kState.data(), kInput.data(), next.data()), MOREPRO_OK);
    const auto moved = ExponentialIntegrator<double>(cpp, 1.0e-4).step(kCppState, kCppInput);
    EXPECT_EQ(next, (State{moved.speed_rad_s, moved.feed_speed_m_s, moved.current_a}));
  }
}

TEST(CPlant, WritesNothingWhereItAnswersWithAnError) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const morepro_machine good = morepro_reference_machine();
  morepro_machine massless = good;
  massless.feed.mass_kg = 0.0;
  morepro_machine unknown = good;
  unknown.contact.form = 9;
  morepro_machine frozen = good;
  frozen.thermal.melting_degc = frozen.thermal.reference_degc;
  const State bad_state{0.0, kNan, 0.0};
  Input bad_input = kInput;
  bad_input[MOREPRO_INPUT_CHIP_LOAD_MM] = std::numeric_limits<double>::infinity();
  struct Case {
    const morepro_machine* machine;
    const State& state;
    const Input& input;
    morepro_error error;
  };
  for (const auto& [machine, state, input, error] :
       {Case{nullptr, kState, kInput, MOREPRO_ERROR_NULL_POINTER},
        Case{&massless, kState, kInput, MOREPRO_ERROR_NOT_POSITIVE},
        Case{&frozen, kState, kInput, MOREPRO_ERROR_THERMAL_RANGE},
        Case{&unknown, kState, kInput, MOREPRO_ERROR_UNKNOWN_CHOICE},
        Case{&good, bad_state, kInput, MOREPRO_ERROR_NOT_FINITE},
        Case{&good, kState, bad_input, MOREPRO_ERROR_NOT_FINITE}}) {
    State result{1.0, 2.0, 3.0};
    EXPECT_EQ(morepro_plant_derivative(machine, state.data(), input.data(), result.data()), error);
    EXPECT_EQ(morepro_plant_step(machine, 1.0e-4, state.data(), input.data(), result.data()), error);
    EXPECT_EQ(result, (State{1.0, 2.0, 3.0}));
  }
  State result{1.0, 2.0, 3.0};
  for (const double step_s : {0.0, -1.0e-4, 1.0, kNan})
    EXPECT_EQ(morepro_plant_step(&good, step_s, kState.data(), kInput.data(), result.data()),
              MOREPRO_ERROR_STEP);
  EXPECT_EQ(morepro_plant_step(&good, 1.0e-4, kState.data(), kInput.data(), nullptr),
            MOREPRO_ERROR_NULL_POINTER);
  EXPECT_EQ(result, (State{1.0, 2.0, 3.0}));
}

}  // namespace
}  // namespace morepro
