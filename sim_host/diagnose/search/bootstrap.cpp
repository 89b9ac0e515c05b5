#include "sim_host/diagnose/search/bootstrap.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "sim_host/simulate/random_numbers.hpp"

namespace morepro::host {
namespace {

/// Scores of the candidates in every block, freed of what the parameters explain.
struct Scores {
  Eigen::MatrixXd of_block;  ///< candidates x blocks
  Eigen::MatrixXd moments;   ///< Schur complement of the parameters
  double rss = 0.0;
  double rows = 0.0;
};

Scores scores_of(const AxisFit& fit, const GapStatistics& statistics) {
  const Eigen::MatrixXd total = statistics.total();
  const Eigen::Index width = total.cols();
  const auto active = fit.parameter_columns();
  const auto parameters = static_cast<Eigen::Index>(active.size());
  const Eigen::Index candidates = width - 1 - parameters;
  const Eigen::VectorXd precision = fit.precision(width);
  Eigen::MatrixXd a = total.topLeftCorner(parameters, parameters);
  a.diagonal() += precision.head(parameters);
  const Eigen::MatrixXd across = total.block(0, parameters, parameters, candidates);
  const Eigen::MatrixXd projection = a.ldlt().solve(across);
  Scores scores;
  scores.rows = statistics.total_rows();
  scores.rss = total(width - 1, width - 1);
  scores.moments =
      total.block(parameters, parameters, candidates, candidates) - across.transpose() * projection;
  scores.of_block.resize(candidates, static_cast<Eigen::Index>(statistics.block.size()));
  for (std::size_t b = 0; b < statistics.block.size(); ++b) {
    const Eigen::MatrixXd block = statistics.block[b].selfadjointView<Eigen::Lower>();
    const Eigen::VectorXd y = block.col(width - 1);
    scores.of_block.col(static_cast<Eigen::Index>(b)) =
        y.segment(parameters, candidates) - projection.transpose() * y.head(parameters);
  }
  return scores;
}

double gain_of_form(const Scores& scores, const Eigen::VectorXd& score, Eigen::Index first,
                    Eigen::Index parts) {
  Eigen::MatrixXd a = scores.moments.block(first, first, parts, parts);
  if (!(a.diagonal().minCoeff() > 0.0)) return 0.0;
  a.diagonal() *= 1.0 + 1.0e-9;
  const double gain = score.segment(first, parts).dot(a.ldlt().solve(score.segment(first, parts)));
  return std::isfinite(gain) ? std::max(gain, 0.0) : 0.0;
}

double best_evidence(const Scores& scores, const Eigen::VectorXd& score,
                     const std::vector<gap::EffectForm>& forms) {
  double best = 0.0;
  Eigen::Index column = 0;
  const double unit = scores.rss / scores.rows;
  for (const gap::EffectForm& form : forms) {
    const double gain = gain_of_form(scores, score, column, form.parts) / unit;
    best = std::max(best, gain - (form.parts + 1.0) * std::log(scores.rows));
    column += form.parts;
  }
  return best;
}

double temperature_of(const Scores& scores) {
  const double unit = scores.rss / scores.rows;
  std::vector<double> ratio;
  for (Eigen::Index j = 0; j < scores.of_block.rows(); ++j) {
    const double expected = unit * scores.moments(j, j);
    if (expected > 0.0) ratio.push_back(scores.of_block.row(j).squaredNorm() / expected);
  }
  if (ratio.empty()) return 1.0;
  const auto upper = ratio.begin() + static_cast<std::ptrdiff_t>(ratio.size() * 3 / 4);
  std::nth_element(ratio.begin(), upper, ratio.end());
  return std::max(1.0, *upper);
}

}  // namespace

ChanceEvidence chance_evidence(const AxisFit& fit, const GapStatistics& statistics,
                               const std::vector<gap::EffectForm>& forms, int runs, std::uint64_t seed,
                               const std::function<void()>& on_run) {
  ChanceEvidence chance{.runs = runs};
  if (statistics.block.empty() || forms.empty()) return chance;
  const Scores scores = scores_of(fit, statistics);
  chance.temperature = temperature_of(scores);
  std::vector<double> evidence;
  for (int run = 0; run < runs; ++run) {
    Eigen::VectorXd sign(scores.of_block.cols());
    for (Eigen::Index b = 0; b < sign.size(); ++b)
      sign(b) = (mixed(mixed(seed, static_cast<std::uint64_t>(run)), static_cast<std::uint64_t>(b)) & 1U) != 0
                    ? 1.0
                    : -1.0;
    evidence.push_back(best_evidence(scores, scores.of_block * sign, forms));
    on_run();
  }
  if (evidence.empty()) return chance;
  std::sort(evidence.begin(), evidence.end());
  chance.quantile99 =
      evidence[static_cast<std::size_t>(0.99 * static_cast<double>(evidence.size() - 1) + 0.5)];
  return chance;
}

}  // namespace morepro::host
