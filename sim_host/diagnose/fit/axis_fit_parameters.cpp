// Parameters of an axis: what is known of them beforehand, how far they are from the datasheet, how a step
// changes them and the sizes of effects.
#include <algorithm>
#include <array>
#include <cmath>

#include "lib/gap/feed_observer.hpp"
#include "lib/gap/gap_watch_finding.hpp"
#include "lib/gap/spindle_observer.hpp"
#include "sim_host/diagnose/fit/axis_fit.hpp"
#include "sim_host/diagnose/fit/size_columns.hpp"

namespace morepro::host {
namespace {

constexpr double kNotFitted = 1.0e24;  // precision of what the recording tells nothing about

}  // namespace

Eigen::VectorXd AxisFit::precision(Eigen::Index width) const {
  Eigen::VectorXd precision = Eigen::VectorXd::Zero(width);
  const auto count = static_cast<Eigen::Index>(parameter_count(axis_));
  precision.head(count).setConstant(1.0 / (gap::kDatasheetSpread * gap::kDatasheetSpread));
  if (axis_ == Axis::kSpindle && signals_->is_current_driven)
    precision.segment(kTorqueParameters, count - kTorqueParameters).setConstant(kNotFitted);
  if (axis_ == Axis::kFeed) {
    const auto& feed = datasheet_.machine.feed;
    const double load_n = std::max(feed.contact_force_n + feed.contact_offset_n, 1.0e-3);
    precision(2) /= load_n * load_n;
    precision(3) /= load_n * load_n;
  }
  return precision;
}

Eigen::VectorXd AxisFit::deviation() const {
  const auto& s = model_.machine.spindle;
  const auto& s0 = datasheet_.machine.spindle;
  const auto& f = model_.machine.feed;
  const auto& f0 = datasheet_.machine.feed;
  const auto relative = [](double value, double datasheet) {
    return datasheet != 0.0 ? value / datasheet - 1.0 : 0.0;
  };
  Eigen::VectorXd d(static_cast<Eigen::Index>(parameter_count(axis_)));
  if (axis_ == Axis::kSpindle) {
    d << relative(s.torque_constant_nm_a, s0.torque_constant_nm_a),
        relative(s.viscous_friction_nms_rad, s0.viscous_friction_nms_rad),
        relative(s.inertia_kgm2, s0.inertia_kgm2), relative(s.resistance_ohm, s0.resistance_ohm),
        relative(s.back_emf_constant_vs_rad, s0.back_emf_constant_vs_rad),
        relative(s.inductance_h, s0.inductance_h);
  } else {
    d << relative(f.mass_kg, f0.mass_kg), relative(f.viscous_friction_ns_m, f0.viscous_friction_ns_m),
        f.contact_force_n + f.contact_offset_n - f0.contact_force_n - f0.contact_offset_n,
        f.contact_force_n - f0.contact_force_n;
  }
  return d;
}

double AxisFit::farthest_factor() const {
  using Spindle = gap::SpindleColumn;
  static constexpr std::array kOfSpindle{Spindle::kTorqueConstant, Spindle::kInertia, Spindle::kResistance,
                                         Spindle::kBackEmfConstant, Spindle::kInductance};
  const Eigen::VectorXd d = deviation();
  double farthest = 1.0;
  const auto look_at = [&](auto column) {
    const auto j = static_cast<Eigen::Index>(column);
    const double factor = 1.0 + d(j);
    if (tells(j) && factor > 0.0) farthest = std::max({farthest, factor, 1.0 / factor});
  };
  if (axis_ == Axis::kFeed) look_at(gap::FeedColumn::kMass);
  if (axis_ == Axis::kSpindle) std::for_each(kOfSpindle.begin(), kOfSpindle.end(), look_at);
  return farthest;
}

Eigen::VectorXd AxisFit::target(Eigen::Index width) const {
  Eigen::VectorXd target = Eigen::VectorXd::Zero(width);
  const Eigen::VectorXd d = deviation();
  target.head(d.size()) = -d;
  return target;
}

void AxisFit::take_parameters(const Eigen::VectorXd& step) {
  auto& s = change_model().machine.spindle;
  auto& f = change_model().machine.feed;
  if (axis_ == Axis::kSpindle) {
    s.torque_constant_nm_a *= std::exp(step(0));
    s.viscous_friction_nms_rad *= std::exp(step(1));
    s.inertia_kgm2 *= std::exp(step(2));
    s.resistance_ohm *= std::exp(step(3));
    s.back_emf_constant_vs_rad *= std::exp(step(4));
    s.inductance_h *= std::exp(step(5));
    return;
  }
  f.mass_kg *= std::exp(step(0));
  f.viscous_friction_ns_m *= std::exp(step(1));
  f.contact_force_n += step(3);
  f.contact_offset_n += step(2) - step(3);
}

void AxisFit::take_sizes(const Eigen::VectorXd& step) {
  Eigen::Index next = 0;
  for (gap::AppliedEffect& effect : change_model().effects) {
    for (std::size_t part = 0; part < effect.form.parts; ++part) {
      const double change = step(next++);
      if (is_pure_shape(effect.form))
        effect.form.shape *= static_cast<float>(std::clamp(std::exp(change), 0.5, 2.0));
      else
        effect.coefficient[part] += change;
    }
  }
}

bool AxisFit::tells_engaged_load() const {
  const auto& f = model_.machine.feed;
  return standard_error_.size() > 3 && standard_error_(3) < kTold * std::fabs(f.contact_force_n);
}

void AxisFit::attribute_load() {
  const bool is_engaged = model_.machine.feed.engagement > 0.0;
  if (axis_ != Axis::kFeed || tells_engaged_load() || !is_engaged) return;
  auto& f = change_model().machine.feed;
  const double offset_n = datasheet_.machine.feed.contact_offset_n;
  f.contact_force_n += (f.contact_offset_n - offset_n) / f.engagement;
  f.contact_offset_n = offset_n;
}

void AxisFit::take(const Eigen::VectorXd& step) {
  const auto parameters = static_cast<Eigen::Index>(parameter_count(axis_));
  take_parameters(step.head(parameters));
  take_sizes(step.tail(step.size() - parameters));
}

}  // namespace morepro::host
