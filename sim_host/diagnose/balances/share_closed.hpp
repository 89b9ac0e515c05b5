#pragma once
#include <cstdint>
#include <optional>
#include <span>

#include "sim_host/diagnose/balances/balance_rows.hpp"
#include "sim_host/diagnose/result/diagnosis_result.hpp"

namespace morepro::host {

/// Structure without a name in one balance, as a deviance.
struct UnnamedPower {
  double found = 0.0;
  double unseen = 0.0;  ///< so much may be there without being found; 0 where the effects do not act
};

/// Structure that may hide in the noise, as a deviance.
inline constexpr double kUnseen = 60.0;

/// Share closed over all balances with its 90 % interval: pieces are drawn anew, and the noise floor is no
/// better known than its rows and what cannot be seen in them allow. `unnamed[i]`: of balance i.
void share_closed(std::span<const BalanceRows> balances, std::span<const UnnamedPower> unnamed,
                  std::uint64_t seed, Shrinkage& shrinkage);

/// Of what the refitted model predicts worse than its `sensor_floor`, how much is gone with the effects; all
/// of it where nothing was to be gained, less than nothing where the errors run away.
double share_predicted(const std::optional<ModelComparison>& models);

/// Is so little left of the gap, in pieces that were not fitted to, that names explain it, whatever
/// likelihood makes of their exact shapes? Causes without a name close up to 0.53 of theirs.
inline bool is_nearly_closed(const Shrinkage& shrinkage) { return shrinkage.interval90[0] > 0.8; }

/// Is so much left of it that the names are not what makes it? In pieces that were not fitted to, neither do
/// rows show less than `where` still shows, nor does a model predict a step much better. Right names of three
/// other simulators closed up to 0.82 of their gap at least, or predicted 0.45 of it, but for a backlash.
/// Where not a third can have been closed, it is no matter how little there was to predict within a step;
/// what runs free is no nearer then, and a gap of 1.03 times the noise is enough. Nor does it matter how much
/// rows still show where a model that runs free is beyond noise, random forces included, and no nearer with
/// the effects. Beyond the sensors' noise alone, 0.11 is the least that right names gained, and 0.01 the most
/// that a saturating force did, which three slides were said to have whose mass depends on the place.
bool is_hardly_closed(const Shrinkage& shrinkage, std::span<const BalanceResult> where);

/// Is surely nothing of the gap closed, and no model that runs free nearer with the effects? Names that a
/// fault of the samples seems to excuse are none then.
bool closes_nothing(const Shrinkage& shrinkage);

/// Share of its gap that a balance keeps with the effects; 0 where it is within `visible` times the noise.
double share_kept(const BalanceResult& balance, double visible = 1.3);

/// Does a balance keep more than a tenth of its gap, and a model that runs free a twentieth of its own, which
/// is no matter of how rows are integrated? Of 400 right names of two simulators none left more than 0.05 in
/// rows, and two whose rows at 1 kHz were off 0.034 at most of a free run; of eighteen wrong or incomplete
/// answers none left less than 0.14 in rows and 0.09 of a free run. Where less is to be seen, within 1.3 but
/// not 1.15 times the noise, it has to be a quarter of the gap and four tenths of a free run: of 1470 right
/// names none left as much (0.17 and 0.44 the most).
bool keeps_a_gap(const Shrinkage& shrinkage, std::span<const BalanceResult> where);

/// Is a refitted model lost that runs free, in pieces that it was not fitted to? Then it is far beyond what
/// the random forces make that an observer took the rest for, or farther off than the datasheet's model. What
/// comes back at a place or with every turn passes for random forces where an observer may follow it. Of 215
/// machines without a gap none was beyond 2.9 times the noise, nor beyond 1.02 of the datasheet's.
bool is_lost(const std::optional<ModelComparison>& free_run);

}  // namespace morepro::host
