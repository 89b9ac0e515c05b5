#include "sim_host/diagnose/outcome/verdict.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "lib/gap/effect_catalogue.hpp"
#include "sim_host/diagnose/fit/standstill.hpp"
#include "sim_host/diagnose/outcome/causes.hpp"
#include "sim_host/diagnose/outcome/effect_naming.hpp"
#include "sim_host/diagnose/outcome/parameter_report.hpp"

namespace morepro::host {
namespace {

bool is_of_samples(const EffectResult& one) {
  return one.effect == gap::Effect::kSensorQuantization ||
         gap::info_of(one.effect).group == gap::EffectGroup::kSampling;
}

}  // namespace

double excess_of(double deviance, std::size_t rows) {
  return std::expm1(deviance / static_cast<double>(rows));
}

std::string meaning_of_effects(const DiagnosisResult& result) {
  constexpr double kLeft = 1.05;  // residual ratio; noise that lasts alone reaches 1.03
  constexpr double kPercent = 100.0;
  std::vector<std::string> left;
  for (const BalanceResult& balance : result.where)
    if (balance.is_evaluated && balance.residual_ratio_after > kLeft)
      left.push_back(
          fmt::format("{} ({:.3g} times)", gap::name_of(balance.balance), balance.residual_ratio_after));
  const std::string rest = fmt::format("more than noise remains in {}", fmt::join(left, ", "));
  if (std::ranges::all_of(result.which, is_of_samples))
    return left.empty()
               ? "the samples have the named faults; beside them a model with the refitted parameters "
                 "explains the recording"
               : "the samples have the named faults; " + rest;
  if (left.empty()) return std::string(meaning_of(Verdict::kEffect));
  return fmt::format(
      "the named effects explain {:.0f} % of what refitted parameters leave; {}: another shape than the "
      "catalogue's, or something without a name",
      kPercent * std::max(result.shrinkage.share_closed, 0.0), rest);
}

std::string meaning_of_lost(std::span<const std::string_view> balances) {
  return fmt::format(
      "a model that runs free is lost in {}: it is farther off than the datasheet's, or than random forces "
      "make it",
      fmt::join(balances, ", "));
}

void judge(std::span<const AxisOutcome> outcomes, const std::vector<SamplingFault>& faults, std::size_t rows,
           DiagnosisResult& result) {
  double named = 0.0, known = 0.0, unnamed = 0.0;
  double deviance = 0.0;  // of what is unnamed
  std::size_t causes = 0;
  bool has_wrong_parameters = false, has_excitation = false, has_moved = false, is_away = false;
  for (const AxisOutcome& outcome : outcomes) {
    if (outcome.diagnosis.runs_away()) {  // and has no likelihood that may be added to the other axis's
      is_away = true;
      continue;
    }
    result.threshold_evidence = std::max(result.threshold_evidence, outcome.threshold());
    result.temperature = std::max(result.temperature, outcome.chance.temperature);
    const double leftover = outcome.unnamed_deviance();
    deviance += leftover;
    unnamed += excess_of(leftover, rows);
    result.unexplained_evidence += outcome.leftover.gain;
    named += excess_of(leftover + outcome.named_deviance(), rows) - excess_of(leftover, rows);
    known += excess_of(std::max(outcome.diagnosis.known_evidence, 0.0), rows);
    causes = std::max(causes, causes_of(outcome.diagnosis.found));
    has_wrong_parameters |= outcome.is_datasheet_wrong;
    has_excitation |= is_excited(outcome.diagnosis.fit);
    has_moved |= !stands_still(outcome.diagnosis.fit.axis(), outcome.diagnosis.fit.signals(),
                               outcome.diagnosis.fit.datasheet().noise);
  }
  result.unexplained_share = unnamed > 0.0 ? unnamed / (known + named + unnamed) : 0.0;
  if (deviance < structure_left_by(faults) * static_cast<double>(rows)) unnamed = 0.0;
  if (is_away) {
    result.verdict = Verdict::kUnexplained;
    result.unexplained_share = 1.0;
  } else if (outcomes.empty() || !has_excitation)
    result.verdict = Verdict::kInsufficientExcitation;
  else if (unnamed > most_unnamed(causes) * (known + named + unnamed))
    result.verdict = Verdict::kUnexplained;
  else if (causes > 0 || !faults.empty())
    result.verdict = Verdict::kEffect;
  else if (!has_moved)  // what stands still hardly shows friction, nor what follows a speed
    result.verdict = Verdict::kInsufficientExcitation;
  else
    result.verdict = has_wrong_parameters ? Verdict::kParameterError : Verdict::kNoGap;
}

}  // namespace morepro::host
