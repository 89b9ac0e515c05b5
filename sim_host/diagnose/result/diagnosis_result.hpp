#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lib/gap/applied_effect.hpp"
#include "lib/gap/effect.hpp"
#include "lib/monitor/monitor_configuration.hpp"

namespace morepro::host {

enum class Verdict : std::uint8_t {
  kNoGap = 0,
  kParameterError,
  kEffect,
  kUnexplained,
  kInsufficientExcitation
};

inline constexpr std::array<std::string_view, 5> kVerdictNames{"no_gap", "parameter_error", "effect",
                                                               "unexplained", "insufficient_excitation"};
constexpr std::string_view name_of(Verdict verdict) {
  return kVerdictNames[static_cast<std::size_t>(verdict)];
}

/// Is everything in the recording accounted for?
constexpr bool is_conclusive(Verdict verdict) { return verdict < Verdict::kUnexplained; }

/// What a verdict says; empty for insufficient excitation, of which there are several.
constexpr std::string_view meaning_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNoGap:
      return "the datasheet's model explains the recording to its noise";
    case Verdict::kParameterError:
      return "the structure of the model is right, values of the datasheet are not: see the parameters (a "
             "wrong gain of a sensor would look the same)";
    case Verdict::kEffect:
      return "the named effects explain what the datasheet's model leaves";
    case Verdict::kUnexplained:
      return "there is structure that no effect of the catalogue explains";
    case Verdict::kInsufficientExcitation:
      break;
  }
  return "";
}

/// A part of a recording in which a balance is looked at for itself.
struct GapCell {
  std::string_view by;  ///< contact, speed, direction, temperature, frequency, order or time
  double from = 0.0;
  double to = 0.0;
  double residual_ratio = 1.0;
  double p_value = 1.0;  ///< corrected for the number of cells
};

struct BalanceResult {
  gap::Balance balance = gap::Balance::kSpindleTorque;
  bool is_evaluated = false;
  std::string reason{};  ///< why it is not evaluated
  double residual_ratio = 1.0;
  double residual_ratio_after = 1.0;
  bool is_significant = false;
  std::vector<GapCell> cells{};
  std::optional<double> onset_s{};
};

struct EffectResult {
  gap::AppliedEffect applied{};
  gap::Effect effect = gap::Effect::kSpindleCoulombFriction;
  double confidence = 0.0;
  double magnitude = 0.0;  ///< NaN where the recording does not tell it
  double standard_error = 0.0;
  double evidence = 0.0;
  std::vector<gap::Effect> alias_set{};
};

/// Root mean square error of a model as a share of what moves; NaN where it runs away.
struct ModelError {
  double value = 0.0;
  std::array<double, 2> interval90{};  ///< NaN where the recording has too few pieces
};

/// The same figure for three models, and what noise alone would leave.
struct ModelComparison {
  ModelError datasheet;
  ModelError refit;
  ModelError with_effect;
  /// What an observer expects: of the sensors, and of what the machine does at random.
  double noise_floor = 0.0;
  /// Of a free run, the sensor's alone: what a model does not know may look random. Of one step, the same.
  double sensor_floor = 0.0;
};

/// Balance by balance, of those that are watched.
using Comparisons = std::array<std::optional<ModelComparison>, gap::kBalanceCount>;

struct Shrinkage {
  double share_closed = 0.0;
  std::array<double, 2> interval90{};
  double horizon_s = 1.0;
  Comparisons one_step_nrmse;
  Comparisons free_run_nrmse;
};

struct ParameterResult {
  std::string name;
  double datasheet = 0.0;
  double refit = 0.0;
  double standard_error = 0.0;
  bool is_identifiable = false;
  std::string reason;
};

/// From which size on an effect that has no name would have been found; infinite: not at any.
struct DetectionLimit {
  gap::Effect effect = gap::Effect::kSpindleCoulombFriction;
  double size = 0.0;  ///< in the catalogue's unit
};

/// A signal of which a function stands in for structure without a name.
struct FollowedSignal {
  gap::Balance balance = gap::Balance::kSpindleTorque;  ///< that the function is added to
  std::string signal;                                   ///< in words

  bool operator==(const FollowedSignal&) const = default;
};

struct DiagnosisResult {
  std::string file;
  std::size_t rows = 0;
  double rate_hz = 0.0;
  double duration_s = 0.0;
  std::size_t missing_rows = 0;
  Verdict verdict = Verdict::kInsufficientExcitation;
  std::string explanation;  ///< one sentence
  std::vector<std::string> notices;
  std::vector<BalanceResult> where;
  std::vector<EffectResult> which;
  Shrinkage shrinkage;
  std::vector<ParameterResult> parameters;
  double unexplained_evidence = 0.0;  ///< of structure without a name
  /// Of what the datasheet's model leaves beyond noise; all of it where a model that runs free is lost, or
  /// where none follows.
  double unexplained_share = 0.0;
  std::vector<FollowedSignal> unexplained_follows;  ///< by that structure, in each balance the best first
  std::vector<DetectionLimit> not_found;            ///< where nothing is unexplained that may hide it
  double threshold_evidence = 0.0;
  double temperature = 1.0;
  int bootstrap_runs = 0;
  GapTuning for_board;    ///< what a board needs to know to find the same
  gap::GapFinding board;  ///< what it then says about this recording
  bool board_agrees = false;

  /// Is there a balance that shows a gap?
  [[nodiscard]] bool has_place() const {
    return std::any_of(where.begin(), where.end(), [](const BalanceResult& b) { return b.is_significant; });
  }
};

}  // namespace morepro::host
