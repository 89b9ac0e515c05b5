#pragma once
#include <cmath>
#include <functional>
#include <span>
#include <vector>

#include "sim_host/diagnose/fit/axis_fit.hpp"
#include "sim_host/diagnose/search/effect_search.hpp"

namespace morepro::host {

/// Of the evidence of everything that was found: what is worth less may be what shapes leave that are not
/// quite the machine's. On tests/blind 11 of 12 second names of an axis below 0.05 were not there, nor four
/// of five between that and 0.08; of eight up to 0.1 three were.
inline constexpr double kLeastShare = 0.08;

/// An effect that is in the model now, and what else would have done nearly as well in its place.
struct Finding {
  gap::AppliedEffect effect;
  double evidence = 0.0;          ///< how much less likely the recording is without it, as a deviance
  std::vector<Candidate> rivals;  ///< as they stood when it was chosen, itself first
  double kept = 1.0;              ///< share of the evidence that is left beside noise that may last
  bool has_inherited = false;     ///< its rivals, from what it has replaced
};

/// What was chosen later than `dropped`, beside it, and does its work alone now, has had its rivals: a
/// bristle that was found beside Coulomb friction may be Coulomb friction. For relatives of one family only.
void inherit_rivals(const Finding& dropped, Finding& left);

/// What was found out about one axis.
struct AxisDiagnosis {
  AxisFit fit;      ///< the model with the effects
  AxisFit nominal;  ///< the model with refitted parameters only
  std::vector<Finding> found{};
  double known_evidence = 0.0;          ///< of the machine file's effects, all together
  double least_evidence = 0.0;          ///< that an effect needed to be looked at
  double cost_of_two = AxisFit::kNone;  ///< `cost_of` with the first two effects; infinite where one was all
  std::vector<gap::EffectForm> others{};  ///< candidates beside the findings,
  GapStatistics rest{};                   ///< and the moments of what is left with them

  /// Evidence that a finding needs to stay, where `usual` is what any other needs: an offset that turned out
  /// to grow with the speed is still there, if less of it.
  [[nodiscard]] double needed(const Finding& finding, double usual) const;
  /// Are its first two effects no better than those of another search, with a `cost_of_two` of `to_beat`?
  /// Then it leads where that one did.
  [[nodiscard]] bool is_behind(double to_beat) const {
    return std::isfinite(cost_of_two) && cost_of_two > to_beat - least_evidence;
  }
  /// Has no model been found that follows the axis? What the machine file states drives it away.
  [[nodiscard]] bool runs_away() const { return !std::isfinite(fit.unlikeliness()); }
  /// Deviance that all names together take.
  [[nodiscard]] double named_deviance() const;
  /// The findings as they are in the fitted model now.
  void take_sizes();
};

/// Looks for the effects of one axis, one after another, each with the parameters refitted; at most four.
/// `start`: a fit of the nominal model to begin with; `nominal`: the best one that is known. `to_beat`:
/// `cost_of_two` of another search; one that is behind ends there, and nothing of it is pruned.
AxisDiagnosis search_effects(
    const AxisFit& start, const AxisFit& nominal, std::span<const gap::Effect> excluded,
    double least_evidence, double to_beat = AxisFit::kNone,
    const std::function<void(double share)>& on_progress = [](double) {});

}  // namespace morepro::host
