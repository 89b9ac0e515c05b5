#include "methods.hpp"

#include <algorithm>
#include <cmath>

#include "ratio.hpp"

namespace blind {
namespace {

using nlohmann::json;

constexpr const char* kBalanceNames[] = {"spindle_torque", "feed_force", "armature_voltage"};
// A term must move the rows by this share of the sensor noise; smaller ones are thrown out.
constexpr double kLeastContribution = 0.15;
constexpr double kLeastEvidence = 30.0;

/// Rows in units of the sensors' noise: the nominal columns first, then the library.
struct Whitened {
  Eigen::MatrixXd x;
  Eigen::VectorXd y;
  Eigen::Index nominal = 0;
  std::vector<Term> terms;
};

Whitened whitened(const Measured& measured, const Machine& sheet, Balance balance) {
  Whitened w;
  SampleColumns samples = nominal_columns(measured.columns, sheet, balance);
  w.nominal = static_cast<Eigen::Index>(samples.regressors.size());
  w.terms = term_library(measured, sheet, balance);
  const bool has_viscous = balance == kFeedForce && sheet.feed_viscous > 0.0;
  if (has_viscous)
    std::erase_if(w.terms, [](const Term& term) { return term.effect == "feed_viscous_friction"; });
  for (const Term& term : w.terms) samples.regressors.push_back(term.integrated);
  const BalanceRows rows = windowed(samples, measured.columns.contact);
  const GroupPower floor = sensor_floor(sheet, balance, measured.columns.sample_s);
  w.x = rows.x;
  w.y = rows.y;
  for (Eigen::Index r = 0; r < w.y.size(); ++r) {
    const double scale =
        1.0 / std::sqrt(floor[static_cast<std::size_t>(rows.group[static_cast<std::size_t>(r)])]);
    w.x.row(r) *= scale;
    w.y(r) *= scale;
  }
  return w;
}

Eigen::VectorXd datasheet_values(const Machine& m, Balance balance, Eigen::Index count) {
  Eigen::VectorXd values(count);
  if (balance == kSpindleTorque)
    values << m.torque_constant / m.inertia, -m.viscous / m.inertia, -1.0 / m.inertia;
  else if (balance == kArmatureVoltage)
    values << 1.0 / m.inductance, -m.resistance / m.inductance, -m.back_emf_constant / m.inductance;
  else {
    values.head(3) << 1.0 / m.mass, -m.contact_force / m.mass, -m.contact_offset / m.mass;
    if (count == 4) values(3) = -m.feed_viscous / m.mass;
  }
  return values;
}

struct Found {
  std::string effect;
  double evidence = 0.0;
};

json answer(const json& where, std::vector<Found> found) {
  std::sort(found.begin(), found.end(),
            [](const Found& a, const Found& b) { return a.evidence > b.evidence; });
  json which = json::array();
  for (const Found& f : found)
    which.push_back({{"effect", f.effect.empty() ? "term without a name" : f.effect},
                     {"confidence", 1.0},
                     {"evidence", f.evidence},
                     {"alias_set", json::array()}});
  return {{"schema", "morepro.baseline/1"},
          {"verdict", found.empty() ? "no_gap" : "effect"},
          {"where", where},
          {"which", which}};
}

json place(Balance balance, double before, double after, Eigen::Index rows) {
  const auto count = static_cast<double>(std::max<Eigen::Index>(1, rows));
  return {{"balance", kBalanceNames[balance]},
          {"evaluated", true},
          {"significant", false},
          {"residual_ratio", before / count},
          {"residual_ratio_after", after / count}};
}

Found best_term(const Whitened& w, const Eigen::VectorXd& residual) {
  Found best;
  const double power = residual.squaredNorm(), count = static_cast<double>(w.y.size());
  for (std::size_t t = 0; t < w.terms.size(); ++t) {
    const Eigen::VectorXd column = w.x.col(w.nominal + static_cast<Eigen::Index>(t));
    const double gain = std::pow(column.dot(residual), 2) / std::max(1e-300, column.squaredNorm());
    const double evidence = -count * std::log(std::max(1e-12, 1.0 - gain / power));
    if (evidence > best.evidence) best = {w.terms[t].effect, evidence};
  }
  return best;
}

/// The columns that survive repeated fitting and throwing out; the nominal ones always stay.
struct Sparse {
  std::vector<Eigen::Index> columns;
  Eigen::VectorXd contribution;
  Eigen::VectorXd gain;  ///< residual power that returns when the column alone is thrown out
  double power = 0.0;
};

Sparse fitted(const Whitened& w, const std::vector<Eigen::Index>& columns) {
  Eigen::MatrixXd x(w.y.size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t c = 0; c < columns.size(); ++c) x.col(static_cast<Eigen::Index>(c)) = w.x.col(columns[c]);
  const Eigen::VectorXd norms = x.colwise().norm().cwiseMax(1e-300);
  x = x * norms.cwiseInverse().asDiagonal();
  // A whisper of ridge keeps columns that repeat each other from failing the factorisation.
  const Eigen::MatrixXd gram = x.transpose() * x + 1e-9 * Eigen::MatrixXd::Identity(x.cols(), x.cols());
  const Eigen::LDLT<Eigen::MatrixXd> factor(gram);
  const Eigen::VectorXd fit = factor.solve(x.transpose() * w.y);
  const Eigen::VectorXd spread = factor.solve(Eigen::MatrixXd::Identity(x.cols(), x.cols())).diagonal();
  return {columns, fit.cwiseAbs(), fit.cwiseAbs2().cwiseQuotient(spread), (w.y - x * fit).squaredNorm()};
}

Sparse thresholded(const Whitened& w) {
  std::vector<Eigen::Index> columns(static_cast<std::size_t>(w.x.cols()));
  for (std::size_t c = 0; c < columns.size(); ++c) columns[c] = static_cast<Eigen::Index>(c);
  const double least = kLeastContribution * std::sqrt(static_cast<double>(w.y.size()));
  for (int pass = 0; pass < 12; ++pass) {
    const Sparse now = fitted(w, columns);
    std::vector<Eigen::Index> kept;
    for (std::size_t c = 0; c < columns.size(); ++c)
      if (columns[c] < w.nominal || now.contribution(static_cast<Eigen::Index>(c)) >= least)
        kept.push_back(columns[c]);
    if (kept.size() == columns.size()) return now;
    columns = kept;
  }
  return fitted(w, columns);
}

void merge(std::vector<Found>& found, const Found& one) {
  for (Found& f : found)
    if (f.effect == one.effect) {
      f.evidence = std::max(f.evidence, one.evidence);
      return;
    }
  found.push_back(one);
}

}  // namespace

json best_single_term(const Measured& measured, const Machine& sheet) {
  json where = json::array();
  Found best;
  for (int b = 0; b < kBalances; ++b) {
    const auto balance = static_cast<Balance>(b);
    const Whitened w = whitened(measured, sheet, balance);
    const Eigen::VectorXd residual =
        w.y - w.x.leftCols(w.nominal) * datasheet_values(sheet, balance, w.nominal);
    const Found here = best_term(w, residual);
    const double power = residual.squaredNorm();
    where.push_back(place(balance, power, power * std::exp(-here.evidence / static_cast<double>(w.y.size())),
                          w.y.size()));
    if (here.evidence > best.evidence) best = here;
  }
  return answer(where, best.evidence > kLeastEvidence ? std::vector<Found>{best} : std::vector<Found>{});
}

json thresholded_least_squares(const Measured& measured, const Machine& sheet) {
  json where = json::array();
  std::vector<Found> found;
  for (int b = 0; b < kBalances; ++b) {
    const auto balance = static_cast<Balance>(b);
    const Whitened w = whitened(measured, sheet, balance);
    std::vector<Eigen::Index> nominal;
    for (Eigen::Index c = 0; c < w.nominal; ++c) nominal.push_back(c);
    const Sparse sparse = thresholded(w);
    where.push_back(place(balance, fitted(w, nominal).power, sparse.power, w.y.size()));
    for (std::size_t c = 0; c < sparse.columns.size(); ++c)
      if (sparse.columns[c] >= w.nominal)
        merge(found, {w.terms[static_cast<std::size_t>(sparse.columns[c] - w.nominal)].effect,
                      sparse.gain(static_cast<Eigen::Index>(c))});
  }
  return answer(where, found);
}

}  // namespace blind
