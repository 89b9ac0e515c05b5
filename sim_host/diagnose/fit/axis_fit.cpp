#include "sim_host/diagnose/fit/axis_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "lib/gap/feed_observer.hpp"
#include "lib/gap/spindle_observer.hpp"
#include "sim_host/diagnose/fit/lasting_noise.hpp"
#include "sim_host/diagnose/fit/noise_fit.hpp"
#include "sim_host/diagnose/fit/size_columns.hpp"
#include "sim_host/diagnose/fit/standstill.hpp"

namespace morepro::host {
namespace {

constexpr int kMostImprovements = 8;
constexpr std::array kDampings{0.0, 1.0, 30.0};
constexpr double kSettledRound = 5.0;         // deviance that a round of noise and parameters gains
constexpr double kSettled = 4.0;              // chi-square that a further step would gain
constexpr double kBeyondAnotherRound = 0.01;  // deviance per row that another round does not make up for
constexpr double kAsMuch = 1.2;               // times a promise that was in vain
constexpr double kCrawl = 0.005;      // share of its promise that a step keeps where another one is no use
constexpr double kLongestStep = 0.3;  // relative: beyond, the linearisation is worth little

/// Eigenvalues of a covariance, in units of the prior's, that are below a hundredth.
int directions_known(const Eigen::MatrixXd& covariance, const Eigen::VectorXd& precision) {
  const Eigen::VectorXd root = precision.cwiseSqrt();
  const Eigen::MatrixXd relative = root.asDiagonal() * covariance * root.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(relative, Eigen::EigenvaluesOnly);
  return static_cast<int>((solver.eigenvalues().array() < 0.01).count());
}

std::vector<Eigen::Index> all_columns(Eigen::Index count) {
  std::vector<Eigen::Index> columns(static_cast<std::size_t>(count));
  std::iota(columns.begin(), columns.end(), 0);
  return columns;
}

}  // namespace

AxisFit::AxisFit(Axis axis, const RecordingSignals& signals, const GapModel& datasheet)
    : axis_(axis),
      signals_(&signals),
      quarter_(telling_quarter_of(axis, signals)),
      stretches_(all_of(signals)),
      datasheet_(datasheet),
      model_(datasheet) {}

std::vector<Eigen::Index> AxisFit::parameter_columns() const {
  return all_columns(static_cast<Eigen::Index>(parameter_count(axis_)));
}

// Every block has half a megabyte of moments where all candidates are tried: an hour in quarters of a second
// needed seven gigabytes.
double AxisFit::block_s() const {
  constexpr double kUsual = 0.25;
  constexpr double kMostBlocks = 500.0;
  return std::max(kUsual, signals_->duration_s() / kMostBlocks);
}

GapStatistics AxisFit::collect_with(const Disturbances& candidates) const {
  return collect(axis_, *signals_, stretches_, model_, candidates, whitening_, block_s());
}

GapStatistics AxisFit::collect_with_each(const Disturbances& candidates) const {
  return collect(axis_, *signals_, stretches_, model_, candidates, whitening_, block_s(),
                 Moments::kFormByForm);
}

GapStatistics AxisFit::new_innovations() const {
  return collect(axis_, *signals_, stretches_, model_, Disturbances{}, whitening_, block_s(),
                 Moments::kOfInnovations);
}

const GapStatistics& AxisFit::innovations() const {
  if (!innovations_) innovations_ = std::make_shared<const GapStatistics>(new_innovations());
  return *innovations_;
}

double AxisFit::unlikeliness_as_it_is() const {
  const GapStatistics innovations = new_innovations();
  return unlikeliness_of(innovations, whitening_of(innovations));
}

std::optional<AxisFit::KnownSize> AxisFit::known_size_of(gap::Effect effect) const {
  auto column = static_cast<Eigen::Index>(parameter_count(axis_));
  for (const gap::AppliedEffect& one : model_.effects) {
    const auto parts = static_cast<Eigen::Index>(one.form.parts);
    if (one.form.effect != effect) {
      column += parts;
      continue;
    }
    if (column + parts > covariance_.cols()) return std::nullopt;
    KnownSize known{.column = column,
                    .size = Eigen::VectorXd::Ones(parts),
                    .covariance = covariance_.block(column, column, parts, parts)};
    if (!is_pure_shape(one.form))
      known.size = Eigen::Map<const Eigen::VectorXd>(one.coefficient.data(), parts);
    return known;
  }
  return std::nullopt;
}

double AxisFit::relative_error_of(gap::Effect effect) const {
  const auto known = known_size_of(effect);
  return known ? relative_error_of(*known) : 0.0;
}

double AxisFit::relative_error_beside_inertia_of(gap::Effect effect) const {
  auto known = known_size_of(effect);
  if (!known) return 0.0;
  const auto column = static_cast<Eigen::Index>(axis_ == Axis::kSpindle
                                                    ? static_cast<std::size_t>(gap::SpindleColumn::kInertia)
                                                    : static_cast<std::size_t>(gap::FeedColumn::kMass));
  const Eigen::VectorXd along = covariance_.block(known->column, column, known->size.size(), 1);
  const double variance = covariance_(column, column);
  if (variance > 0.0) known->covariance -= along * along.transpose() / variance;
  return relative_error_of(*known);
}

double AxisFit::relative_error_of(const KnownSize& known) {
  const double square = known.size.dot(known.covariance.ldlt().solve(known.size));
  return square > 0.0 ? 1.0 / std::sqrt(square) : 0.0;
}

double AxisFit::relative_size_error_of(gap::Effect effect) const {
  const auto known = known_size_of(effect);
  if (!known || !gap::may_be_refined(effect)) return relative_error_of(effect);
  return std::sqrt(known->covariance(0, 0)) / std::max(std::fabs(known->size(0)), 1.0e-300);
}

Eigen::VectorXd AxisFit::parameters_along(gap::Effect effect) const {
  const auto parameters = static_cast<Eigen::Index>(parameter_count(axis_));
  const auto known = known_size_of(effect);
  if (!known) return Eigen::VectorXd::Zero(parameters);
  return covariance_.block(0, known->column, parameters, known->size.size()) *
         known->covariance.ldlt().solve(known->size);
}

AxisFit::Trial AxisFit::tried() const {
  const SizeColumns sizes(model_.effects);
  Trial trial;
  if (memory_) {
    NewParts parts = look_beside_lasting_noise(axis_, *signals_, stretches_, model_, sizes.disturbances(),
                                               whitening_, *memory_, news_);
    trial.moments = std::move(parts.moments);
    trial.rows = parts.rows;
    trial.cost = parts.deviance;
  } else {
    trial.statistics = collect_with(sizes.disturbances());
    trial.moments = trial.statistics.total();
    trial.rows = trial.statistics.total_rows();
  }
  if (trial.moments.cols() == 0) return trial;
  trial.moments = sizes.of(trial.moments, parameter_count(axis_));
  const Eigen::Index width = trial.moments.cols();
  const double of_prior = precision(width).dot(target(width).cwiseAbs2());
  trial.squares = trial.moments(width - 1, width - 1) + of_prior;
  trial.cost = memory_ ? trial.cost + of_prior : trial.squares;
  return trial;
}

// One Gauss-Newton step, damped until it helps; false where there is nothing to gain.
bool AxisFit::improve(Trial& best, double in_vain) {
  const Eigen::Index width = best.moments.cols();
  if (width == 0) return false;
  const std::vector<Eigen::Index> active = all_columns(width - 1);
  const LinearFit solution = fit(best.moments, active, precision(width), target(width));
  const double unit = std::max(solution.rss / std::max(best.rows, 1.0), 1.0e-12);
  covariance_ = unit * solution.covariance;
  standard_error_ = covariance_.diagonal().cwiseSqrt();
  const auto parameters = static_cast<Eigen::Index>(parameter_count(axis_));
  known_directions_ = directions_known(unit * solution.covariance.topLeftCorner(parameters, parameters),
                                       precision(width).head(parameters));
  const double promised = best.squares - solution.rss;
  promised_in_vain_ = 0.0;
  if (!(promised > kSettled * unit)) return false;
  const bool is_in_vain = promised < kAsMuch * in_vain;
  const std::size_t last = is_in_vain ? best.damping + 1 : kDampings.size();
  const GapModel start = model_;
  for (; best.damping < last; ++best.damping) {
    change_model() = start;
    take(step_of(best.moments, active, kDampings[best.damping]));
    Trial trial = tried();
    if (!(trial.cost < best.cost) && best.damping == 0 && !is_in_vain) follow_bend(best, trial);
    const double gained = best.cost - trial.cost;
    if (!(gained > 0.0)) continue;
    // Where the linearisation held, the next step may be bolder.
    const bool has_held = gained > 0.5 * promised;
    trial.damping = has_held && best.damping > 0 ? best.damping - 1 : best.damping;
    best = std::move(trial);
    return gained > std::max(kSettled * unit, kCrawl * promised);
  }
  change_model() = start;
  promised_in_vain_ = promised;
  return false;
}

// Along a valley that bends a whole step ends on its slope, from where the next one leads back to its floor;
// damped ones would crawl.
void AxisFit::follow_bend(const Trial& best, Trial& trial) {
  const Eigen::Index width = trial.moments.cols();
  const std::vector<Eigen::Index> active = all_columns(width - 1);
  const bool may_be_better =
      std::isfinite(trial.cost) &&
      fit(trial.moments, active, precision(width), target(width)).rss + trial.cost - trial.squares <
          best.cost;
  if (!may_be_better) return;
  take(step_of(trial.moments, active, 0.0));
  trial = tried();
}

/// Damped after Levenberg and Marquardt, and not longer than the linearisation is worth.
Eigen::VectorXd AxisFit::step_of(const Eigen::MatrixXd& moments, const std::vector<Eigen::Index>& active,
                                 double damping) const {
  const Eigen::Index width = moments.cols();
  const Eigen::VectorXd prior = precision(width);
  const Eigen::VectorXd stiff = prior + damping * moments.diagonal();
  const Eigen::VectorXd pull = prior.cwiseProduct(target(width));
  const Eigen::VectorXd damped_target = (stiff.array() > 0.0).select(pull.array() / stiff.array(), 0.0);
  return shortened(fit(moments, active, stiff, damped_target).coefficient);
}

Eigen::VectorXd AxisFit::shortened(const Eigen::VectorXd& step) const {
  const Eigen::Index relative =
      axis_ == Axis::kSpindle ? static_cast<Eigen::Index>(parameter_count(axis_)) : 2;
  const double longest = step.head(relative).cwiseAbs().maxCoeff();
  return std::min(1.0, kLongestStep / std::max(longest, 1.0e-12)) * step;
}

// A part that the pieces do not show stays about as large as the whole recording shows it.
Eigen::VectorXd AxisFit::size_precision() const {
  std::vector<double> precision;
  for (const gap::AppliedEffect& effect : model_.effects) {
    double size = 1.0;
    if (!is_pure_shape(effect.form))
      for (std::size_t part = 0; part < effect.form.parts; ++part)
        size = std::max(part > 0 ? size : 1.0e-12, std::fabs(effect.coefficient[part]));
    precision.insert(precision.end(), effect.form.parts, 1.0 / (size * size));
  }
  return Eigen::Map<const Eigen::VectorXd>(precision.data(), static_cast<Eigen::Index>(precision.size()));
}

std::array<GapModel, 2> AxisFit::cross_fitted(double block_s, std::size_t blocks) const {
  const SizeColumns sizes(model_.effects);
  const GapStatistics all =
      collect(axis_, *signals_, stretches_, model_, sizes.disturbances(), whitening_, block_s);
  std::array<GapModel, 2> models{model_, model_};
  for (std::size_t parity = 0; parity < models.size(); ++parity) {
    GapStatistics seen = all;
    for (std::size_t b = 0; b < seen.block.size(); ++b)
      if (b / blocks % 2 == parity) seen.block[b].setZero();
    Eigen::MatrixXd moments = seen.total();
    if (moments.cols() == 0) continue;
    moments = sizes.of(moments, parameter_count(axis_));
    const Eigen::Index width = moments.cols();
    const Eigen::VectorXd of_sizes = size_precision();
    Eigen::VectorXd prior = precision(width);
    prior.segment(width - 1 - of_sizes.size(), of_sizes.size()) = of_sizes;
    AxisFit one = *this;
    one.take(shortened(fit(moments, all_columns(width - 1), prior, target(width)).coefficient));
    models[parity] = one.model_;
  }
  return models;
}

void AxisFit::expect_noise(double share) {
  expect_process_noise(std::min(share, noise_bounds_.most_share), change_model().noise);
}

void AxisFit::refit(double in_vain) {
  Trial best = tried();
  for (int i = 0; i < kMostImprovements && improve(best, in_vain); ++i) {
  }
  take_rest(best.statistics);
}

void AxisFit::match_noise() {
  fit_noise(axis_, *signals_, looked_at(), datasheet_.noise, noise_bounds_, is_narrow(), change_model());
  take_rest(tried().statistics);
}

void AxisFit::take_rest(const GapStatistics& statistics) {
  set_whitening(whitening_of(statistics));
  unlikeliness_ = unlikeliness_of(statistics, whitening_);
}

double AxisFit::refit_with_this_noise() {
  Trial best = tried();
  for (int i = 0; i < kMostImprovements && improve(best); ++i) {
  }
  return best.cost;
}

double AxisFit::refit_beside_lasting_noise(Memory memory, const InputNews* news) {
  memory_ = memory;
  news_ = news;
  const double deviance = refit_with_this_noise();
  memory_.reset();
  news_ = nullptr;
  return deviance;
}

double AxisFit::deviance_beside_lasting_noise(Memory memory) const {
  AxisFit fit = *this;
  fit.memory_ = memory;
  return fit.tried().cost;
}

AxisFit::Rival AxisFit::as_rival() const {
  AxisFit narrow = *this;
  narrow.narrow_down();
  return {.everywhere = unlikeliness_, .in_part = narrow.unlikeliness_as_it_is()};
}

// What the part was fitted with may be no model of the rest: a load that grows with the speed so steeply that
// its steps run away.
void AxisFit::settle(int most_rounds) {
  const AxisFit before = *this;
  narrow_down();
  take_turns(most_rounds, kNone);
  if (before.is_narrow()) return;
  finish({});
  if (std::isfinite(unlikeliness_)) return;
  *this = before;
  polish();
}

// With the noise that there is first: what the model had is not lost where a round makes it worse.
void AxisFit::settle_roughly(int most_rounds, const Rival& rival) {
  narrow_down();
  refit();
  take_turns(most_rounds, rival.in_part);
}

void AxisFit::finish(const Rival& rival) {
  if (!is_narrow()) return;
  const bool is_hopeless = is_hopeless_beside(rival.in_part);
  widen();
  if (!is_hopeless) polish(rival.everywhere);
}

bool AxisFit::is_hopeless_beside(double rival) const {
  return unlikeliness_ > rival + kBeyondAnotherRound * static_cast<double>(signals_->rows);
}

void AxisFit::polish(double rival) {
  constexpr int kFewRounds = 3;
  refit();
  take_turns(kFewRounds, rival);
}

// Noise that was fitted to wrong parameters hides how wrong they are: in turns, until nothing is gained.
// The noise is searched for on some stretches only, so that a round may make it worse; the best one counts.
void AxisFit::take_turns(int most_rounds, double rival) {
  constexpr int kMostInVain = 2;
  AxisFit best = *this;
  int in_vain = 0;
  for (int round = 0; round < most_rounds && in_vain < kMostInVain; ++round) {
    const bool has_changed = fit_noise(axis_, *signals_, looked_at(), datasheet_.noise, noise_bounds_,
                                       is_narrow(), change_model());
    if (!has_changed && std::isfinite(best.unlikeliness_)) break;
    refit();
    if (!std::isfinite(unlikeliness_)) break;
    in_vain = unlikeliness_ < best.unlikeliness_ - kSettledRound ? 0 : in_vain + 1;
    if (unlikeliness_ < best.unlikeliness_) best = *this;
    if (best.is_hopeless_beside(rival)) break;
  }
  *this = std::move(best);
}

}  // namespace morepro::host
