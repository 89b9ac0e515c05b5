#pragma once
#include "sim_host/diagnose/leftover/leftover.hpp"
#include "sim_host/diagnose/search/axis_diagnosis.hpp"

namespace morepro::host {

/// Deviance per row that noise that lasts may be worth to a name: right names had 0.005 and more in 623 of
/// 633 cases on tests/blind, names that random forces of 1 ms had made 0.004 and less.
inline constexpr double kMostOfNoise = 0.005;

/// More than noise of any kind is worth, even where it keeps next to nothing beside noise that lasts.
inline constexpr double kMuch = 0.02;

/// Share of its evidence that a right name usually keeps beside noise that may last.
inline constexpr double kUsuallyKept = 0.33;

// Each takes the names that something else explains out of the model, fits what is left anew, and says
// whether there were any.

/// This one, whatever it is worth.
void drop(AxisDiagnosis& diagnosis, std::size_t index);

/// Names that are worth less than `threshold`.
bool drop_what_chance_explains(AxisDiagnosis& diagnosis, double threshold);

/// Names that are worth hardly anything any more where the innovations before, of both sensors, may predict
/// the next one with any weights. What comes and goes by itself is noise that lasts, or has a cause that is
/// not in the catalogue; a law of what was measured is worth nearly as much as before. Names below
/// `noise_evidence`, what such noise may be worth, stay where they are surely no such thing.
bool drop_what_lasting_noise_explains(AxisDiagnosis& diagnosis, double noise_evidence);

/// Lags and delays that are worth hardly anything any more where what is new in the input may correct the
/// state. A controller that sees the state itself, not the samples, knows of random forces before these do,
/// and the drive seems late.
bool drop_what_input_news_explain(AxisDiagnosis& diagnosis);

/// Names of an axis that are worth little per row and that none of its balances shows: where random forces
/// are none, what a solver does differently within a step is worth as much. A lag of more than a step is not.
bool drop_what_no_balance_shows(AxisDiagnosis& diagnosis);

/// Does what a model leaves remember itself for longer than random forces do?
bool remembers_for_long(const AxisFit& fit);

/// Are the functions without a name, as names may be, worth hardly anything any more where the innovations
/// before may predict the next one? Lines are not: noise has none.
bool is_lasting_noise(const AxisFit& fit, const Leftover& leftover);

}  // namespace morepro::host
