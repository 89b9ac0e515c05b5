#include "sim_host/diagnose/outcome/detection_limits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "lib/gap/effect_catalogue.hpp"
#include "lib/gap/effect_size.hpp"
#include "sim_host/diagnose/fit/linear_fit.hpp"
#include "sim_host/diagnose/fit/noise_fit.hpp"
#include "sim_host/diagnose/outcome/name_checks.hpp"
#include "sim_host/diagnose/search/candidate_forms.hpp"
#include "sim_host/diagnose/search/effect_family.hpp"
#include "sim_host/diagnose/search/effect_trial.hpp"
#include "sim_host/diagnose/search/winding_heat.hpp"

namespace morepro::host {
namespace {

using gap::Effect;

constexpr double kNotShown = std::numeric_limits<double>::infinity();
constexpr double kFarFromTried = 1.1;  // of a lag, as a logarithm: three times the longest that is tried

/// Follows a signal that was recorded; not looked for where that never changes.
struct Follower {
  Effect effect;
  Channel channel;
};
constexpr std::array kFollowers{Follower{Effect::kContactChipLoadDependence, Channel::kChipLoad},
                                Follower{Effect::kContactTemperatureDependence, Channel::kToolTemperature},
                                Follower{Effect::kViscousTemperatureDependence, Channel::kWindingTemperature},
                                Follower{Effect::kResistanceTemperatureDrift, Channel::kWindingTemperature},
                                Follower{Effect::kMagnetTemperatureDrift, Channel::kWindingTemperature}};

/// Expects as much at random as observers usually do. What something small does would be taken for that where
/// less had to be expected without it.
AxisFit beside_usual_noise(AxisFit fit) {
  const gap::GapNoise<double> fitted = fit.model().noise;
  fit.expect_noise(kUsualNoiseShare);
  gap::GapNoise<double>& noise = fit.change_model().noise;
  noise.speed_step = std::max(noise.speed_step, fitted.speed_step);
  noise.current_step = std::max(noise.current_step, fitted.current_step);
  noise.feed_step = std::max(noise.feed_step, fitted.feed_step);
  return fit;
}

class Limits {
 public:
  Limits(const AxisOutcome& outcome, std::span<const EffectResult> named, std::span<const Effect> excluded,
         const ScalesOfEffects& scales)
      : outcome_(outcome),
        fit_(beside_usual_noise(outcome.diagnosis.fit)),
        scales_(scales),
        left_out_(excluded.begin(), excluded.end()) {
    for (const gap::AppliedEffect& one : fit_.model().effects) left_out_.push_back(one.form.effect);
    for (const gap::AppliedEffect& one : fit_.model().known) left_out_.push_back(one.form.effect);
    for (const EffectResult& one : named)
      left_out_.insert(left_out_.end(), one.alias_set.begin(), one.alias_set.end());
    left_out_.push_back(Effect::kFeedBacklash);
    left_out_.push_back(Effect::kShaftCompliance);
    if (fit_.datasheet().machine.feed.viscous_friction_ns_m > 0.0)
      left_out_.push_back(Effect::kFeedViscousFriction);
  }

  std::vector<DetectionLimit> all() {
    const auto looked_for = candidate_forms(fit_.axis(), fit_.signals(), fit_.model(), left_out_);
    std::vector<gap::EffectForm> forms;
    for (const gap::EffectForm& form : looked_for)
      if (!has_no_size(form.effect, fit_.signals()) && !is_of_a_found_family(form.effect))
        add(form, looked_for, forms);
    const Eigen::MatrixXd moments = fit_.collect_with_each(forms).total();
    if (moments.cols() == 0) return {};
    const Remainder rest = remainder(moments, fit_.parameter_columns(), fit_.precision(moments.cols()),
                                     fit_.target(moments.cols()));
    auto column = static_cast<Eigen::Index>(parameter_count(fit_.axis()));
    for (const gap::EffectForm& form : forms) {
      take(form, strength_of(form, least_of(form, rest, moments, column)));
      column += form.parts;
    }
    for (std::size_t i = 0; i < limits_.size(); ++i)
      if (gap::size_is_shape(limits_[i].effect) && !(off_[i] < kFarFromTried)) limits_[i].size = kNotShown;
    add_followers(looked_for);
    std::ranges::sort(limits_, {}, [](const DetectionLimit& limit) { return gap::index_of(limit.effect); });
    return std::move(limits_);
  }

 private:
  /// Part of one cause with what was found, and mostly of its size then.
  [[nodiscard]] bool is_of_a_found_family(Effect effect) const {
    const Family family = family_of(effect);
    return family != Family::kNone &&
           std::ranges::any_of(outcome_.diagnosis.found, [family](const Finding& finding) {
             return family_of(finding.effect.form.effect) == family;
           });
  }

  /// The plain law of each effect, where it is looked for; of a lag all that are tried.
  void add(const gap::EffectForm& form, std::span<const gap::EffectForm> looked_for,
           std::vector<gap::EffectForm>& forms) const {
    gap::EffectForm plain = form;
    const gap::EffectForm usual = gap::applied(form.effect, 1.0, scales_.stated).form;
    const bool is_looked_for = std::ranges::any_of(looked_for, [&usual](const gap::EffectForm& one) {
      return one.effect == usual.effect && one.kind == usual.kind;
    });
    if (!gap::size_is_shape(form.effect) && is_looked_for) plain = usual;
    const auto is_same = [&plain](const gap::EffectForm& one) {
      return one.effect == plain.effect && (!gap::size_is_shape(one.effect) || one.shape == plain.shape);
    };
    if (std::ranges::none_of(forms, is_same)) forms.push_back(plain);
  }

  /// Evidence that a further name needs. What hardly any balance shows has one from `kMuch` per row on only.
  [[nodiscard]] double needed_by(const gap::EffectForm& form, double rows) const {
    double needed = std::max(outcome_.threshold(), kMuch * rows);
    for (const Finding& other : outcome_.diagnosis.found)
      needed =
          std::max(needed, least_share(form.effect, other.effect.form.effect, kLeastShare) * other.evidence);
    return needed + freedom_cost(fit_, {.form = form, .coefficient = {}, .onset_s = 0.0});
  }

  /// The coefficient whose column takes what a name needs, and two standard deviations of chance.
  [[nodiscard]] double least_of(const gap::EffectForm& form, const Remainder& rest,
                                const Eigen::MatrixXd& moments, Eigen::Index column) const {
    constexpr double kChance = 2.0;
    const double rows = fit_.innovations().total_rows();
    const double gain = std::sqrt(rows * std::expm1(needed_by(form, rows) / rows)) + kChance;
    const Eigen::Index first_two = std::min<Eigen::Index>(form.parts, 2);
    const double own = moments.diagonal().segment(column, first_two).mean();
    const double left = rest.moments.diagonal().segment(column, first_two).mean();
    if (!(left > kLeastNew * own)) return kNotShown;
    return gain * std::sqrt(rest.rss / rows / left);
  }

  /// In the catalogue's unit, as it is stated.
  [[nodiscard]] double strength_of(const gap::EffectForm& form, double coefficient) const {
    if (!std::isfinite(coefficient)) return kNotShown;
    if (gap::size_is_shape(form.effect)) return static_cast<double>(form.shape) * coefficient;
    gap::AppliedEffect one{.form = form, .coefficient = {coefficient}, .onset_s = 0.0};
    const gap::EffectScales<double>& to = scales_.stated;
    return std::fabs(gap::size_of(gap::restated(one, scales_.found, to), to));
  }

  /// Of several lags the one that is its own limit.
  void take(const gap::EffectForm& form, double size) {
    const auto same = std::ranges::find(limits_, form.effect, &DetectionLimit::effect);
    const double off = std::log(size / static_cast<double>(form.shape));
    if (same == limits_.end()) {
      limits_.push_back({form.effect, size});
      off_.push_back(off);
      return;
    }
    double& best = off_[static_cast<std::size_t>(same - limits_.begin())];
    if (!(std::fabs(off) < std::fabs(best))) return;
    best = off;
    same->size = size;
  }

  void add_followers(std::span<const gap::EffectForm> looked_for) {
    if (fit_.axis() != Axis::kSpindle) return;
    const bool has_voltage =
        !fit_.signals().is_current_driven && fit_.signals().has(Channel::kArmatureCurrent);
    for (const auto& [effect, channel] : kFollowers) {
      if (gap::info_of(effect).group == gap::EffectGroup::kArmatureVoltage && !has_voltage) continue;
      const bool is_looked_for = std::ranges::count(looked_for, effect, &gap::EffectForm::effect) > 0;
      const bool is_left_out = std::ranges::count(left_out_, effect) > 0;
      if (!is_looked_for && !is_left_out && fit_.signals().has(channel))
        limits_.push_back({effect, kNotShown});
    }
  }

  const AxisOutcome& outcome_;
  AxisFit fit_;
  const ScalesOfEffects& scales_;
  std::vector<Effect> left_out_;
  std::vector<DetectionLimit> limits_;
  std::vector<double> off_;  ///< how far the limit of each is from the lag that it was taken from
};

}  // namespace

std::vector<DetectionLimit> detection_limits(std::span<const AxisOutcome> outcomes,
                                             const DiagnosisResult& found, std::span<const Effect> excluded,
                                             const ScalesOfEffects& scales) {
  std::vector<DetectionLimit> limits;
  if (!is_conclusive(found.verdict)) return limits;
  for (const AxisOutcome& outcome : outcomes) {
    const auto of_axis = Limits(outcome, found.which, excluded, scales).all();
    limits.insert(limits.end(), of_axis.begin(), of_axis.end());
  }
  return limits;
}

}  // namespace morepro::host
