#include "sim_host/diagnose/balances/share_closed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "sim_host/simulate/random_numbers.hpp"

namespace morepro::host {
namespace {

constexpr double kOneSided95 = 1.645;
// No catalogue has a machine's exact shapes. Of the excess an effect of another shape leaves this much on
// average, and hardly ever more than that.
constexpr double kUsualMisfit = 0.02;
constexpr double kLargestMisfit = 0.10;
using Chosen = std::vector<std::size_t>;

/// `floor`: the noise floor of each balance as a share of what the effects leave.
double share_of(std::span<const BalanceRows> balances, std::span<const double> floor,
                const std::vector<Chosen>& chosen) {
  double closed = 0.0;
  double open = 0.0;
  for (std::size_t b = 0; b < balances.size(); ++b) {
    for (const std::size_t i : chosen[b]) {
      const double before = balances[b].held_out_before[i];
      const double after = balances[b].held_out_after[i];
      closed += before - after;
      open += before - after * floor[b];
    }
  }
  return open > 0.0 ? std::clamp(closed / open, -1.0, 1.0) : 0.0;
}

/// Of what the refitted model predicts worse than `floor`, how much is gone with the effects.
double share_beyond(double floor, const ModelComparison& models) {
  if (!std::isfinite(models.with_effect.value)) return -std::numeric_limits<double>::infinity();
  const auto excess = [floor](const ModelError& error) { return error.value * error.value - floor * floor; };
  const double before = excess(models.refit);
  return before > 0.0 ? 1.0 - excess(models.with_effect) / before : 1.0;
}

/// Does an effect act on what these predict?
bool is_acted_on(const std::optional<ModelComparison>& models) {
  return models && models->refit.value != models->with_effect.value;
}

/// Is a model that runs free beyond noise, and as far with the effects as without them, wherever they act?
bool runs_as_far(const Comparisons& free_run) {
  constexpr double kBeyondNoise = 1.05;
  constexpr double kAsFar = 0.05;
  bool is_any = false;
  for (const std::optional<ModelComparison>& models : free_run) {
    if (!is_acted_on(models)) continue;
    if (!(models->refit.interval90[0] > kBeyondNoise * models->noise_floor)) continue;
    if (share_beyond(models->noise_floor, *models) > kAsFar) return false;
    is_any = true;
  }
  return is_any;
}

}  // namespace

double share_predicted(const std::optional<ModelComparison>& models) {
  return models ? share_beyond(models->sensor_floor, *models) : 1.0;
}

void share_closed(std::span<const BalanceRows> balances, std::span<const UnnamedPower> unnamed,
                  std::uint64_t seed, Shrinkage& shrinkage) {
  std::vector<double> likely;
  std::vector<double> lowest;
  std::vector<double> highest;
  std::vector<Chosen> chosen(balances.size());
  for (std::size_t b = 0; b < balances.size(); ++b) {
    const double rows = std::max(static_cast<double>(balances[b].after.size() * kRowsPerWindow), 1.0);
    const bool has_gap = !(unnamed[b].unseen == 0.0);
    const double chance = has_gap ? kOneSided95 * std::sqrt(2.0 / (kOverlap * rows)) : 0.0;
    // Structure without a name may be in the rows, too.
    const double left =
        std::max(has_gap ? mean_power(balances[b].after) : 1.0, 1.0 + unnamed[b].found / rows);
    likely.push_back(1.0 / left);
    lowest.push_back((1.0 - chance) / (left + unnamed[b].unseen / rows));
    highest.push_back(likely.back() * (1.0 + chance));
    chosen[b].resize(balances[b].held_out_before.size());
    std::iota(chosen[b].begin(), chosen[b].end(), 0);
  }
  shrinkage.share_closed = (1.0 - kUsualMisfit) * share_of(balances, likely, chosen);
  constexpr int kDraws = 400;
  std::vector<double> low;
  std::vector<double> high;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    std::uint64_t counter = 0;
    for (Chosen& pieces : chosen)
      for (std::size_t& piece : pieces) piece = mixed(mixed(seed, draw), counter++) % pieces.size();
    low.push_back(share_of(balances, lowest, chosen));
    high.push_back(share_of(balances, highest, chosen));
  }
  std::sort(low.begin(), low.end());
  std::sort(high.begin(), high.end());
  const double lowest_share = (1.0 - kLargestMisfit) * low[kDraws / 20];
  shrinkage.interval90 = {std::min(lowest_share, shrinkage.share_closed),
                          std::max(high[kDraws - 1 - kDraws / 20], shrinkage.share_closed)};
}

double share_kept(const BalanceResult& balance, double visible) {
  const double left = balance.residual_ratio_after - 1.0;
  if (!balance.is_evaluated || !(left > visible - 1.0)) return 0.0;
  return left / std::max(balance.residual_ratio - 1.0, left);
}

bool keeps_a_gap(const Shrinkage& shrinkage, std::span<const BalanceResult> where) {
  constexpr double kOfShapes = 0.1;
  constexpr double kRunsRight = 0.95;
  constexpr double kFaint = 1.15;  // residual ratio
  constexpr double kMuch = 0.25;
  constexpr double kRunsBetter = 0.6;
  return std::any_of(where.begin(), where.end(), [&](const BalanceResult& balance) {
    const auto& free_run = shrinkage.free_run_nrmse[static_cast<std::size_t>(balance.balance)];
    const double predicted = share_predicted(free_run);
    return (share_kept(balance) > kOfShapes && predicted < kRunsRight) ||
           (share_kept(balance, kFaint) > kMuch && predicted < kRunsBetter);
  });
}

bool is_hardly_closed(const Shrinkage& shrinkage, std::span<const BalanceResult> where) {
  constexpr double kClosed = 0.7;
  constexpr double kPredicted = 0.5;
  constexpr double kVisible = 1.15;  // residual ratio
  constexpr double kHardly = 1.03;   // where names act and nothing is better with them
  constexpr double kNothing = 0.3;   // whatever is predicted of what little a step has to predict
  const double most_closed = shrinkage.interval90[1];
  const auto is_predicted = [](const Comparisons& errors, const BalanceResult& balance) {
    return share_predicted(errors[static_cast<std::size_t>(balance.balance)]) >= kPredicted;
  };
  const auto shows_much = [&](const BalanceResult& balance) {
    const bool is_nothing = most_closed < kNothing && !is_predicted(shrinkage.free_run_nrmse, balance);
    const auto& free_run = shrinkage.free_run_nrmse[static_cast<std::size_t>(balance.balance)];
    return balance.residual_ratio_after > (is_nothing && is_acted_on(free_run) ? kHardly : kVisible) &&
           (is_nothing || !is_predicted(shrinkage.one_step_nrmse, balance));
  };
  if (most_closed >= kClosed) return false;
  return runs_as_far(shrinkage.free_run_nrmse) || std::any_of(where.begin(), where.end(), shows_much);
}

bool closes_nothing(const Shrinkage& shrinkage) {
  constexpr double kNothing = 0.05;
  const auto is_nearer = [](const std::optional<ModelComparison>& models) {
    return models && models->with_effect.value < (1.0 - kNothing) * models->refit.value;
  };
  return shrinkage.interval90[1] < kNothing && std::ranges::none_of(shrinkage.free_run_nrmse, is_nearer);
}

bool is_lost(const std::optional<ModelComparison>& free_run) {
  constexpr double kBeyondRandomForces = 4.0;
  constexpr double kBeyondDatasheet = 1.25;
  if (!free_run) return false;
  const ModelError& refit = free_run->refit;
  if (!std::isfinite(refit.value)) return std::isfinite(free_run->datasheet.value);
  return refit.interval90[0] > kBeyondRandomForces * free_run->noise_floor ||
         refit.interval90[0] > kBeyondDatasheet * free_run->datasheet.interval90[1];
}

}  // namespace morepro::host
