#include "sim_host/diagnose/fit/shape_freedom.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "lib/gap/dry_friction.hpp"
#include "lib/gap/effect_form.hpp"
#include "lib/gap/effect_laws.hpp"
#include "sim_host/diagnose/fit/linear_fit.hpp"
#include "sim_host/diagnose/fit/size_columns.hpp"

namespace morepro::host {
namespace {

using gap::Effect;

// Relative, where a law's cause is largest: an exponent of 1.7 or 2.3 for a square bends it by that much at
// twice the speed of its size.
constexpr double kUsualFreedom = 0.3;
constexpr double kLittle = 0.02;  // change of a range that a linearisation is good for
// A part that has three times the range gives a friction a longer tail, as those that approach their end by a
// power have. So far away the difference is taken as it is.
constexpr double kOfTail = 2.0;

/// Is there a range that another machine has another one of? Periods are whole numbers, pitches are standard,
/// a width that is the size is no freedom, and a resonance is known to a hundredth of what it would take.
bool has_range(const gap::EffectForm& form) {
  return form.shape > 0.0F && !gap::size_is_shape(form.effect) && form.effect != Effect::kSpindleCogging &&
         form.effect != Effect::kFeedScrewPeriodic && form.effect != Effect::kShaftCompliance;
}

bool may_bend(const gap::EffectForm& form) { return gap::bends(form.effect) && form.parts == 1; }

/// Is the size that is stated its first coefficient? Sines have an amplitude, a play its width, a shaft a
/// stiffness.
bool has_size_in_front(const gap::EffectForm& form) {
  const bool is_plain = form.parts == 1 || gap::may_be_refined(form.effect);
  return is_plain && form.effect != Effect::kShaftCompliance && form.effect != Effect::kFeedBacklash;
}

/// The columns of a fit, and behind them one for each freedom of a shape, as a share of its size.
class FreeShapes {
 public:
  explicit FreeShapes(const AxisFit& fit)
      : parameters_(static_cast<Eigen::Index>(parameter_count(fit.axis()))), all_(fit.model().effects) {
    for (const gap::AppliedEffect& one : fit.model().effects) sizes_ += one.form.parts;
    Eigen::Index first = parameters_;
    for (const gap::AppliedEffect& one : fit.model().effects) {
      if (may_bend(one.form)) add_bend(one, std::max(1.0, std::fabs(largest_bend(one.form, fit))));
      if (has_range(one.form)) add_other_range(one, first, kLittle);
      if (gap::is_dry_friction(one.form) && !may_bend(one.form)) add_other_range(one, first, kOfTail);
      first += one.form.parts;
    }
  }

  [[nodiscard]] Eigen::Index freedoms() const { return static_cast<Eigen::Index>(free_.size()); }
  [[nodiscard]] const std::vector<gap::AppliedEffect>& effects() const { return all_; }

  /// From moments [parameters | sizes | those of the freedoms | innovation].
  [[nodiscard]] Eigen::MatrixXd of(const Eigen::MatrixXd& moments) const {
    const Eigen::Index fitted = parameters_ + sizes_;
    Eigen::MatrixXd combine = Eigen::MatrixXd::Zero(moments.rows(), fitted + freedoms() + 1);
    combine.topLeftCorner(fitted, fitted).setIdentity();
    combine(moments.rows() - 1, fitted + freedoms()) = 1.0;
    for (Eigen::Index j = 0; j < freedoms(); ++j)
      for (const Share& share : free_[static_cast<std::size_t>(j)])
        combine(share.column, fitted + j) += share.weight;
    return combine.transpose() * moments * combine;
  }

 private:
  struct Share {
    Eigen::Index column;
    double weight;
  };

  Eigen::Index next() const { return parameters_ + sizes_ + added_; }

  void add_bend(gap::AppliedEffect one, double most) {
    one.form.parts = 2;
    free_.push_back({{next() + 1, one.coefficient[0] / most}});
    all_.push_back(one);
    added_ += 2;
  }

  /// As a share of its change.
  void add_other_range(gap::AppliedEffect one, Eigen::Index first, double change) {
    one.form.shape *= 1.0F + static_cast<float>(change);
    std::vector<Share> difference;
    for (Eigen::Index part = 0; part < one.form.parts; ++part) {
      const double weight = one.coefficient[static_cast<std::size_t>(part)] / change;
      difference.push_back({next() + part, weight});
      difference.push_back({first + part, -weight});
    }
    free_.push_back(std::move(difference));
    all_.push_back(one);
    added_ += one.form.parts;
  }

  Eigen::Index parameters_;
  Eigen::Index sizes_ = 0;
  Eigen::Index added_ = 0;               ///< columns
  std::vector<gap::AppliedEffect> all_;  ///< the model's, then those that have another shape
  std::vector<std::vector<Share>> free_;
};

/// Of parameters and sizes, by one more pass over all that the fit looks at; empty where no shape is free.
/// How far a value moves is one of the shifts that are possible, and counts as their deviation.
Eigen::VectorXd errors_of_columns(const AxisFit& fit) {
  const FreeShapes shapes(fit);
  if (shapes.freedoms() == 0) return {};
  const SizeColumns sizes(shapes.effects());
  Disturbances disturbances = sizes.disturbances();
  disturbances.are_compared = true;
  const GapStatistics statistics = fit.collect_with(disturbances);
  Eigen::MatrixXd moments = statistics.total();
  if (moments.cols() == 0) return {};
  moments = shapes.of(sizes.of(moments, parameter_count(fit.axis())));
  const Eigen::Index width = moments.cols();
  Eigen::VectorXd precision = fit.precision(width);
  precision.segment(width - 1 - shapes.freedoms(), shapes.freedoms())
      .setConstant(1.0 / (kUsualFreedom * kUsualFreedom));
  std::vector<Eigen::Index> all(static_cast<std::size_t>(width - 1));
  std::iota(all.begin(), all.end(), Eigen::Index{0});
  const std::vector<Eigen::Index> fitted(all.begin(), all.end() - shapes.freedoms());
  const LinearFit as_it_is = morepro::host::fit(moments, fitted, precision, fit.target(width));
  const LinearFit freed = morepro::host::fit(moments, all, precision, fit.target(width));
  const auto columns = static_cast<Eigen::Index>(fitted.size());
  const double unit = as_it_is.rss / std::max(statistics.total_rows(), 1.0);
  const Eigen::VectorXd moved = freed.coefficient.head(columns) - as_it_is.coefficient;
  const Eigen::VectorXd unknown =
      (freed.covariance.diagonal().head(columns) - as_it_is.covariance.diagonal()).cwiseMax(0.0);
  return (moved.cwiseAbs2() + unit * unknown).cwiseSqrt();
}

}  // namespace

double largest_bend(const gap::EffectForm& form, const AxisFit& fit) {
  const RecordingSignals& signals = fit.signals();
  gap::EffectSignals<double> s;
  s.speed_rad_s = signals.largest(Channel::kSpindleSpeed);
  s.current_a = signals.largest(Channel::kArmatureCurrent);
  s.feed_speed_m_s = signals.largest(Channel::kFeedSpeed);
  s.feed_force_n = signals.largest(Channel::kFeedForce);
  s.chip_load_mm = signals.largest(Channel::kChipLoad);
  s.tool_degc = signals.largest(Channel::kToolTemperature);
  s.cutting_time_s = signals.cutting_time_s.empty() ? 0.0 : signals.cutting_time_s.back();
  const gap::EffectScales<double> scales(fit.model().machine, fit.model().point);
  return gap::laws::bend(form, s, scales);
}

FreeShapeErrors error_by_free_shapes(const AxisFit& fit) {
  const auto parameters = static_cast<Eigen::Index>(parameter_count(fit.axis()));
  const std::vector<gap::AppliedEffect>& effects = fit.model().effects;
  FreeShapeErrors errors{.of_parameter = Eigen::VectorXd::Zero(parameters),
                         .of_effect = std::vector<double>(effects.size(), 0.0)};
  const Eigen::VectorXd of_column = errors_of_columns(fit);
  if (of_column.size() == 0) return errors;
  errors.of_parameter = of_column.head(parameters);
  Eigen::Index column = parameters;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const double size = is_pure_shape(effects[i].form) ? 1.0 : std::fabs(effects[i].coefficient[0]);
    if (has_size_in_front(effects[i].form) && size > 0.0) errors.of_effect[i] = of_column(column) / size;
    column += effects[i].form.parts;
  }
  return errors;
}

}  // namespace morepro::host
