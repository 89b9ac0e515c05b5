#pragma once
#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "sim_host/diagnose/leftover/leftover.hpp"
#include "sim_host/diagnose/outcome/diagnosis_options.hpp"
#include "sim_host/diagnose/outcome/effect_naming.hpp"
#include "sim_host/diagnose/search/axis_diagnosis.hpp"
#include "sim_host/diagnose/search/bootstrap.hpp"
#include "sim_host/diagnose/signals/sampling_checks.hpp"

namespace morepro::host {

/// Evidence below which nothing is looked at, whatever chance makes of the recording.
inline constexpr double kFixedThreshold = 40.0;
/// Chance reached 70 once in eighty recordings of machines like their model; causes that are in no catalogue
/// 500 and more.
inline constexpr double kLeastUnnamed = 150.0;

/// What is certain of one axis: effects that chance does not explain, and what is left without a name.
struct AxisOutcome {
  AxisDiagnosis diagnosis;
  Leftover leftover{};
  ChanceEvidence chance{};
  double noise_evidence = 0.0;      ///< what noise that lasts may be worth to a name that is not there
  bool is_datasheet_wrong = false;  ///< its values, where the structure is right

  /// Evidence that a name needs here that noise which lasts may have made.
  [[nodiscard]] double threshold() const;
  /// Evidence below which chance makes names: those between the two are judged beside such noise.
  [[nodiscard]] double least_name() const;
  /// What this one, which was found, has needed: beside noise that lasts it may have been judged already.
  [[nodiscard]] double threshold_of(const Finding& finding) const;
  /// The same for one of the functions without a name, which count together.
  [[nodiscard]] double least_function() const;
  /// That of the most evidence; there has to be one.
  [[nodiscard]] const Finding& strongest() const;
  /// What the name of one that was found is judged by, where `unnamed_share` of the axis' excess has none.
  [[nodiscard]] NamingContext context_of(const Finding& finding, double unnamed_share) const;
  /// Deviance that structure without a name needs.
  [[nodiscard]] double least_unnamed() const { return std::max(kLeastUnnamed, noise_evidence); }
  /// Deviance of what has no name; 0 where chance may do as much.
  [[nodiscard]] double unnamed_deviance() const {
    return leftover.is_beside_noise() || leftover.gain >= least_unnamed() ? leftover.gain : 0.0;
  }
  /// As much of it as sits in one balance of the axis.
  [[nodiscard]] double unnamed_deviance_in(gap::Balance balance) const;
  /// What more than noise may be worth is there, and has no name. `torque_share`: as in Leftover.
  void keep_without_name(double deviance, double torque_share = 0.5);
  /// Deviance that all names together take.
  [[nodiscard]] double named_deviance() const { return diagnosis.named_deviance(); }
};

/// Does it come and go by itself?
inline bool wanders(const AxisOutcome& outcome) { return outcome.leftover.wanders; }

/// Did it pass for random forces or for outliers, which no balance shows?
inline bool passed_for_noise(const AxisOutcome& outcome) { return outcome.leftover.is_beside_noise(); }

/// Is it values of the machine that are others from a time on?
inline bool has_changed(const AxisOutcome& outcome) { return !outcome.leftover.changed_values.empty(); }

/// Nothing where no row of the axis can be used.
std::optional<AxisOutcome> outcome_of(Axis axis, const RecordingSignals& signals, const GapModel& datasheet,
                                      const DiagnosisOptions& options);

/// Deviance that all names of all axes take.
inline double named_deviance_of(std::span<const AxisOutcome> outcomes) {
  double sum = 0.0;
  for (const AxisOutcome& outcome : outcomes) sum += outcome.named_deviance();
  return sum;
}

/// The last of it, for both axes together. What shakes one of them shakes the other: of nine names that were
/// worth enough for their own axis's noise only, none was right.
void conclude(std::span<AxisOutcome> outcomes);

}  // namespace morepro::host
