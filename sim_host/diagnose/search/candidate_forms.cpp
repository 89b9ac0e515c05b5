#include "sim_host/diagnose/search/candidate_forms.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>

#include "lib/gap/unnamed_laws.hpp"

namespace morepro::host {
namespace {

using gap::Effect;

/// Has the model an effect in this kind of its law?
bool has(const GapModel& model, Effect effect, std::uint8_t kind) {
  const auto is_it = [=](const gap::AppliedEffect& one) {
    return one.form.effect == effect && one.form.kind == kind;
  };
  return std::any_of(model.known.begin(), model.known.end(), is_it) ||
         std::any_of(model.effects.begin(), model.effects.end(), is_it);
}

class Forms {
 public:
  explicit Forms(std::span<const Effect> excluded) : excluded_(excluded) {}

  void add(Effect effect, std::initializer_list<double> shapes, std::uint8_t parts = 1,
           std::uint8_t kind = 0) {
    if (std::find(excluded_.begin(), excluded_.end(), effect) != excluded_.end()) return;
    for (const double shape : shapes)
      forms.push_back({.effect = effect, .kind = kind, .parts = parts, .shape = static_cast<float>(shape)});
  }
  void add(Effect effect, std::uint8_t parts = 1, std::uint8_t kind = 0) { add(effect, {0.0}, parts, kind); }
  /// A load that passes with the teeth, and where the model has it already, its run-out, which would be taken
  /// for cogging.
  void add_of_teeth(const GapModel& model, Effect effect, std::uint8_t kind = 0) {
    const auto run_out = static_cast<std::uint8_t>(kind + 1);
    add(effect, 4, kind);
    if (has(model, effect, kind) && !has(model, effect, run_out))
      forms.push_back({.effect = effect, .kind = run_out, .parts = 4});
  }
  /// A plain law, and the same with a bend.
  void add_bending(Effect effect, std::uint8_t kind = 0) {
    add(effect, 1, kind);
    add(effect, 2, kind);
  }

  std::vector<gap::EffectForm> forms;

 private:
  std::span<const Effect> excluded_;
};

bool varies(const RecordingSignals& signals, Channel channel) {
  const auto& column = signals.value[index_of(channel)];
  float lowest = 1.0e30F;
  float highest = -1.0e30F;
  for (const float value : column) {
    if (!(value == value)) continue;
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
  return highest > lowest;
}

/// Does the tool cut while the spindle turns one way, and while it turns the other way?
bool cuts_both_ways(const RecordingSignals& signals) {
  constexpr std::size_t kSome = 20;  // one row of so many that are in contact
  const auto& contact = signals.value[index_of(Channel::kContact)];
  const auto& speed = signals.value[index_of(Channel::kSpindleSpeed)];
  std::size_t forwards = 0;
  std::size_t backwards = 0;
  for (std::size_t k = 0; k < std::min(contact.size(), speed.size()); ++k) {
    if (!(contact[k] > 0.5F)) continue;
    forwards += speed[k] > 0.0F ? 1 : 0;
    backwards += speed[k] < 0.0F ? 1 : 0;
  }
  return std::min(forwards, backwards) * kSome > forwards + backwards;
}

constexpr double kFastestResonance = 0.2;  // of the sampling rate

// Of ball and lead screws, where the machine file knows none. A position alone, over strokes that repeat
// themselves, is explained by some period whatever is missing.
constexpr std::initializer_list<double> kUsualPitchesM = {1.0e-3,  1.25e-3, 1.5e-3,  2.0e-3,  2.5e-3,
                                                          3.0e-3,  4.0e-3,  5.0e-3,  6.0e-3,  8.0e-3,
                                                          10.0e-3, 12.0e-3, 16.0e-3, 20.0e-3, 25.0e-3};

void add_torques(Forms& forms, const RecordingSignals& signals, const GapModel& model) {
  forms.add(Effect::kSpindleCoulombFriction, {0.002, 0.01});
  forms.add(Effect::kSpindleStribeckFriction, {0.02, 0.06, 0.15});
  forms.add_bending(Effect::kSpindleWindage);
  forms.add(Effect::kSpindleCogging, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 14, 15, 16, 18, 20, 24}, 2);
  if (signals.has(Channel::kContact)) {
    forms.add_of_teeth(model, Effect::kToothPassingTorque);
    if (cuts_both_ways(signals)) forms.add_of_teeth(model, Effect::kToothPassingTorque, 2);
    forms.add_bending(Effect::kContactSpeedDependence);
    forms.add_bending(Effect::kToolWearRamp);
    if (varies(signals, Channel::kChipLoad)) forms.add_bending(Effect::kContactChipLoadDependence);
    if (varies(signals, Channel::kToolTemperature)) forms.add_bending(Effect::kContactTemperatureDependence);
  }
  if (varies(signals, Channel::kWindingTemperature)) forms.add(Effect::kViscousTemperatureDependence);
  if (varies(signals, Channel::kToolTemperature)) forms.add(Effect::kViscousTemperatureDependence, 1, 1);
  if (signals.has(Channel::kArmatureCurrent)) forms.add_bending(Effect::kTorqueConstantSaturation);
  // Faster resonances cannot be told from how the samples lie. In a production the cut alone makes a shaft
  // swing, which loads its far end.
  const std::uint8_t ends = tells_second_part(Effect::kShaftCompliance, signals) ? 2 : 1;
  for (const double frequency_hz : {42, 60, 85, 120, 170, 240, 340, 480, 680, 960})
    if (frequency_hz < kFastestResonance * signals.rate_hz)
      forms.add(Effect::kShaftCompliance, {frequency_hz}, ends);
}

void add_voltages(Forms& forms, const RecordingSignals& signals, double step_s) {
  if (signals.is_current_driven) return;
  forms.add(Effect::kBrushVoltageDrop, {0.02, 0.2});
  forms.add(Effect::kSupplyVoltageOffset);
  forms.add(Effect::kDriveLag, {0.5 * step_s, 1.0e-4, 2.0e-4, 4.0e-4, 8.0e-4, 1.6e-3, 3.2e-3});
  // What depends on a current that nobody measured could be anything.
  if (!signals.has(Channel::kArmatureCurrent)) return;
  forms.add(Effect::kInductanceSaturation);
  forms.add(Effect::kArmatureReaction, 1, 0);
  forms.add(Effect::kArmatureReaction, 1, 1);
  if (!varies(signals, Channel::kWindingTemperature) && signals.calm_winding_degc.empty()) return;
  forms.add(Effect::kResistanceTemperatureDrift);
  forms.add(Effect::kMagnetTemperatureDrift, 1, 0);
  forms.add(Effect::kMagnetTemperatureDrift, 1, 1);
}

void add_spindle_sensors(Forms& forms, const RecordingSignals& signals, double step_s) {
  const std::initializer_list<double> delays{0.5 * step_s, 1.0 * step_s,  2.0 * step_s, 4.0 * step_s,
                                             8.0 * step_s, 16.0 * step_s, 32.0 * step_s};
  forms.add(Effect::kSpindleSpeedBias);
  forms.add(Effect::kSpindleSpeedDelay, delays);
  forms.add(Effect::kSpindleSpeedBandwidth, delays);
  // A disc that is not round beside its bearing: once and twice a turn.
  forms.add(Effect::kEncoderEccentricity, 2);
  forms.add(Effect::kEncoderEccentricity, 4);
  if (!signals.has(Channel::kArmatureCurrent)) return;
  forms.add(Effect::kCurrentBias);
  // Of a current that nothing predicts, how late it is shown is what acts later: a shaft, a lag of the speed.
  if (!signals.is_current_driven) {
    forms.add(Effect::kCurrentDelay, delays);
    forms.add(Effect::kCurrentBandwidth, delays);
  }
  forms.add(Effect::kCurrentNonlinearity, 1, 0);
  forms.add(Effect::kCurrentNonlinearity, 1, 1);
}

void add_forces(Forms& forms, const RecordingSignals& signals, const GapModel& model, double step_s) {
  forms.add(Effect::kFeedCoulombFriction, {0.002, 0.01, 0.05});
  forms.add(Effect::kFeedViscousFriction);
  forms.add(Effect::kFeedStribeckFriction, {0.05, 0.15, 0.4});
  forms.add(Effect::kFeedAsymmetricFriction);
  forms.add(Effect::kFeedForceOffset);
  if (model.machine.feed.screw_pitch_m > 0.0) {
    forms.add(Effect::kFeedScrewPeriodic, 2);
    forms.add(Effect::kFeedScrewPeriodic, 4);  // and twice per turn
  } else if (signals.has(Channel::kFeedSpeed))
    forms.add(Effect::kFeedScrewPeriodic, kUsualPitchesM, 2);
  forms.add(Effect::kFeedSpring);
  forms.add(Effect::kFeedSpring, 2);  // that rests elsewhere
  forms.add_bending(Effect::kFeedForceSaturation);
  // Shorter ones cannot be told from how a force's means lie, longer ones no axis could be controlled with.
  if (!signals.is_thinned)
    forms.add(Effect::kFeedDriveLag, {0.5 * step_s, 2.0e-4, 4.0e-4, 8.0e-4, 1.6e-3, 3.2e-3, 6.4e-3, 1.28e-2});
  // When the slide meets the end of a wide play depends on the width so much that each shows its own only.
  forms.add(Effect::kFeedBacklash,
            {1.0e-6, 3.0e-6, 1.0e-5, 3.0e-5, 5.0e-5, 7.0e-5, 1.0e-4, 1.4e-4, 2.0e-4, 2.8e-4, 4.0e-4, 5.6e-4},
            2);
  const std::initializer_list<double> yields_m{2.0e-6, 1.0e-5, 5.0e-5, 2.0e-4, 1.0e-3};
  forms.add(Effect::kFeedPresliding, yields_m);
  if (tells_second_part(Effect::kFeedPresliding, signals)) forms.add(Effect::kFeedPresliding, yields_m, 2);
  if (signals.has(Channel::kFeedSpeed))
    forms.add(Effect::kFeedSpeedDelay, {0.5 * step_s, step_s, 2.0 * step_s, 4.0 * step_s, 8.0 * step_s,
                                        16.0 * step_s, 32.0 * step_s, 64.0 * step_s});
  if (!signals.has(Channel::kContact)) return;
  forms.add_bending(Effect::kFeedContactDrift);
  forms.add_bending(Effect::kFeedCuttingSpeedDependence, 1);
  if (!signals.has(Channel::kSpindleSpeed)) return;
  forms.add_bending(Effect::kFeedCuttingSpeedDependence, 0);
  forms.add_of_teeth(model, Effect::kFeedToothPassingForce);
}

}  // namespace

bool tells_second_part(Effect effect, const RecordingSignals& signals) {
  if (effect == Effect::kFeedPresliding) return !signals.is_thinned;
  if (effect == Effect::kShaftCompliance) return signals.has_been_in_contact();
  return gap::may_be_refined(effect);
}

std::vector<gap::EffectForm> candidate_forms(Axis axis, const RecordingSignals& signals,
                                             const GapModel& model, std::span<const gap::Effect> excluded) {
  const double step_s = 1.0 / signals.rate_hz;
  Forms forms(excluded);
  if (axis == Axis::kFeed) {
    add_forces(forms, signals, model, step_s);
  } else {
    add_torques(forms, signals, model);
    add_voltages(forms, signals, step_s);
    add_spindle_sensors(forms, signals, step_s);
  }
  return std::move(forms.forms);
}

std::vector<gap::EffectForm> unnamed_forms(Axis axis, const RecordingSignals& signals) {
  std::vector<gap::EffectForm> forms;
  const auto add = [&forms](Effect effect, std::uint8_t laws, std::initializer_list<double> lags) {
    for (const double lag_s : lags)
      for (std::uint8_t law = 0; law < laws; ++law)
        forms.push_back({.effect = effect, .kind = law, .parts = 1, .shape = static_cast<float>(lag_s)});
  };
  if (axis == Axis::kFeed) {
    add(Effect::kUnnamedForce, gap::laws::kUnnamedFeedLaws, {0.0, 0.02});
  } else {
    add(Effect::kUnnamedTorque, gap::laws::kUnnamedSpindleLaws, {0.0, 0.01});
    if (!signals.is_current_driven) add(Effect::kUnnamedVoltage, gap::laws::kUnnamedSpindleLaws, {0.0, 0.01});
  }
  return forms;
}

}  // namespace morepro::host
