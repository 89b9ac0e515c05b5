#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "lib/gap/board_forms.hpp"
#include "sim_host/diagnose/fit/innovation_pass.hpp"
#include "tests/unit/diagnose_support.hpp"

namespace morepro::host {
namespace {

using diagnose_test::effect;
using diagnose_test::gap_model;
using diagnose_test::record;
using gap::Effect;

constexpr std::size_t kSettling = 100;

struct SensedParameter {
  Axis axis;
  const char* name;
  double& (*of)(MachineParameters&);
};

const SensedParameter kSpindleParameters[] = {
    {Axis::kSpindle, "torque constant",
     [](MachineParameters& m) -> double& { return m.spindle.torque_constant_nm_a; }},
    {Axis::kSpindle, "viscous friction",
     [](MachineParameters& m) -> double& { return m.spindle.viscous_friction_nms_rad; }},
    {Axis::kSpindle, "inertia", [](MachineParameters& m) -> double& { return m.spindle.inertia_kgm2; }},
    {Axis::kSpindle, "resistance", [](MachineParameters& m) -> double& { return m.spindle.resistance_ohm; }},
    {Axis::kSpindle, "back-EMF constant",
     [](MachineParameters& m) -> double& { return m.spindle.back_emf_constant_vs_rad; }},
    {Axis::kSpindle, "inductance", [](MachineParameters& m) -> double& { return m.spindle.inductance_h; }},
};
const SensedParameter kFeedParameters[] = {
    {Axis::kFeed, "mass", [](MachineParameters& m) -> double& { return m.feed.mass_kg; }},
    {Axis::kFeed, "viscous friction",
     [](MachineParameters& m) -> double& { return m.feed.viscous_friction_ns_m; }},
};

struct Innovations {
  std::vector<double> value;  ///< over the observer's standard deviation
  std::vector<double> column;
};

Innovations innovations(Axis axis, const RecordingSignals& signals, const GapModel& model,
                        std::size_t column) {
  Innovations all;
  run_observer(axis, signals, model, {}, 0, signals.rows, [&](const Innovation& v) {
    if (v.row < kSettling) return;
    all.value.push_back(v.value / std::sqrt(v.variance));
    all.column.push_back(v.columns[column] / std::sqrt(v.variance));
  });
  return all;
}

/// How a column compares with the central difference of the innovations by its parameter, relative.
struct Likeness {
  double cosine = 0.0;
  double slope = 0.0;  ///< of the difference on the column
};

Likeness likeness(const SensedParameter& parameter, std::size_t column, const RecordingSignals& signals,
                  const GapModel& model) {
  constexpr double kStep = 0.01;
  const auto at = [&](double factor) {
    GapModel moved = model;
    parameter.of(moved.machine) *= factor;
    return innovations(parameter.axis, signals, moved, column);
  };
  const Innovations here = at(1.0), more = at(1.0 + kStep), less = at(1.0 - kStep);
  double together = 0.0, differences = 0.0, columns = 0.0;
  for (std::size_t i = 0; i < here.value.size(); ++i) {
    // A larger parameter predicts more, so that the innovation is smaller by the column.
    const double difference = (less.value[i] - more.value[i]) / (2.0 * kStep);
    together += difference * here.column[i];
    differences += difference * difference;
    columns += here.column[i] * here.column[i];
  }
  return {together / std::sqrt(differences * columns), together / columns};
}

class Sensitivity : public testing::TestWithParam<gap::AppliedEffect> {};

// The steps of every fit, and every standard error, rest on these columns. What an effect of the model does
// to the rates belongs to them: without that, an inductance behind the lag of its drive seemed three times as
// well known as it is, and fits ended beside the truth. 1 %: a period's exponentials are taken to first order
// in the parameter; resistance acts on a current that changes meanwhile, 2 %.
TEST_P(Sensitivity, IsTheDerivativeOfTheInnovationsWithAnEffectInTheModel) {
  const gap::AppliedEffect one = GetParam();
  const RecordingSignals signals = record({.effects = {one}, .duration_s = 2.0});
  GapModel model = gap_model(built_in_machine("reference"), signals);
  model.effects.push_back(one);
  const auto check = [&](const auto& parameters) {
    for (std::size_t j = 0; j < std::size(parameters); ++j) {
      const Likeness found = likeness(parameters[j], j, signals, model);
      EXPECT_GT(found.cosine, 0.995) << parameters[j].name;
      EXPECT_NEAR(found.slope, 1.0, 0.02) << parameters[j].name;
    }
  };
  check(kSpindleParameters);
  check(kFeedParameters);
}

INSTANTIATE_TEST_SUITE_P(
    WithAnEffect, Sensitivity,
    testing::Values(effect(Effect::kDriveLag, 1.0e-3), effect(Effect::kSupplyVoltageOffset, 2.0),
                    effect(Effect::kSpindleCoulombFriction, 0.02), effect(Effect::kFeedForceOffset, 6.0),
                    effect(Effect::kFeedDriveLag, 2.0e-3), effect(Effect::kFeedCoulombFriction, 2.0)),
    [](const auto& param) { return std::string(gap::name_of(param.param.form.effect)); });

/// The same of one part of the size of the model's only effect, a friction of that axis; rows that are beyond
/// five times what they are like are left out: when an axis breaks away tells its friction without an end.
Likeness likeness_of_size(Axis axis, std::size_t part, const RecordingSignals& signals,
                          const GapModel& model) {
  constexpr double kStep = 1.0e-3;
  const std::vector forms{model.effects.front().form};
  const double size = model.effects.front().coefficient[0];
  struct Rows {
    std::vector<double> value, deviation, column;
  };
  const auto at = [&](double factor) {
    GapModel moved = model;
    moved.effects.front().coefficient[part] += (factor - 1.0) * size;
    Rows rows;
    run_observer(axis, signals, moved, Disturbances(forms), 0, signals.rows, [&](const Innovation& v) {
      if (v.row < kSettling) return;
      rows.value.push_back(v.value);
      rows.deviation.push_back(std::sqrt(v.variance));
      rows.column.push_back(size * v.columns[parameter_count(axis) + part]);
    });
    return rows;
  };
  const Rows here = at(1.0), more = at(1.0 + kStep), less = at(1.0 - kStep);
  double together = 0.0, differences = 0.0, columns = 0.0, square = 0.0;
  const auto column = [&](std::size_t i) { return here.column[i] / here.deviation[i]; };
  for (std::size_t i = 0; i < here.column.size(); ++i) square += column(i) * column(i);
  const double most = 5.0 * std::sqrt(square / static_cast<double>(here.column.size()));
  for (std::size_t i = 0; i < here.column.size(); ++i) {
    const double difference = (less.value[i] - more.value[i]) / (2.0 * kStep * here.deviation[i]);
    if (std::fabs(column(i)) > most || std::fabs(difference) > most) continue;
    together += difference * column(i);
    differences += difference * difference;
    columns += column(i) * column(i);
  }
  return {together / std::sqrt(differences * columns), together / columns};
}

struct OneFriction {
  Effect effect;
  double size;
  std::size_t part;
  double least_cosine;
};
class OwnFriction : public testing::TestWithParam<OneFriction> {};

// Of a friction that holds its axis at times, and of one that falls with the speed, the law's value in the
// middle of an interval is no derivative (a cosine of 0.76 and 0.96): fits crawled, and sizes and parameters
// ended beside the truth. What is left is what a size changes of the observer's gain.
TEST_P(OwnFriction, HasTheDerivativeOfTheInnovationsAsItsColumn) {
  const OneFriction& friction = GetParam();
  gap::AppliedEffect one = effect(friction.effect, friction.size);
  const RecordingSignals signals = record({.effects = {one}, .duration_s = 4.0});
  GapModel model = gap_model(built_in_machine("reference"), signals);
  one.coefficient[0] *= 0.98;  // as a fit is on its way there
  one.form.parts = gap::is_stribeck(friction.effect) ? 2 : 1;
  model.effects.push_back(one);
  const Axis axis = gap::is_of_feed(friction.effect) ? Axis::kFeed : Axis::kSpindle;
  const Likeness found = likeness_of_size(axis, friction.part, signals, model);
  EXPECT_GT(found.cosine, friction.least_cosine);
  EXPECT_NEAR(found.slope, 1.0, 0.25);
}

INSTANTIATE_TEST_SUITE_P(OfTheModel, OwnFriction,
                         testing::Values(OneFriction{Effect::kFeedCoulombFriction, 12.0, 0, 0.97},
                                         OneFriction{Effect::kFeedStribeckFriction, 12.0, 0, 0.93},
                                         OneFriction{Effect::kFeedStribeckFriction, 12.0, 1, 0.93},
                                         OneFriction{Effect::kSpindleCoulombFriction, 0.02, 0, 0.97},
                                         OneFriction{Effect::kSpindleStribeckFriction, 0.05, 0, 0.97},
                                         OneFriction{Effect::kSpindleStribeckFriction, 0.05, 1, 0.97}),
                         [](const auto& param) {
                           return std::string(gap::name_of(param.param.effect)) +
                                  (param.param.part == 0 ? "" : "_bend");
                         });

// Kt, b and J times the same factor move a spindle without a load just the same: what their columns left
// together was found in noise, Kt at a quarter of its size and known to 3 %.
TEST(SensitivityWithoutALoad, IsNoneForTheCommonFactorOfTheTorques) {
  RecordingSignals signals = record({.duration_s = 1.0});
  std::fill(signals.value[index_of(Channel::kContact)].begin(),
            signals.value[index_of(Channel::kContact)].end(), 0.0F);
  const GapModel model = gap_model(built_in_machine("reference"), signals);
  double common = 0.0, alone = 0.0;
  run_observer(Axis::kSpindle, signals, model, {}, 0, signals.rows, [&](const Innovation& v) {
    const double sum = v.columns[0] + v.columns[1] + v.columns[2];
    common += sum * sum;
    alone += v.columns[0] * v.columns[0];
  });
  ASSERT_GT(alone, 0.0);
  EXPECT_LT(std::sqrt(common / alone), 1.0e-9);  // rounding
}

}  // namespace
}  // namespace morepro::host
