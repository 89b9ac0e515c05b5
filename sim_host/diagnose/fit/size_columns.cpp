#include "sim_host/diagnose/fit/size_columns.hpp"

namespace morepro::host {

bool is_pure_shape(const gap::EffectForm& form) { return gap::size_is_shape(form.effect) && form.parts == 1; }

SizeColumns::SizeColumns(const std::vector<gap::AppliedEffect>& effects) {
  for (const gap::AppliedEffect& effect : effects) {
    if (is_pure_shape(effect.form)) {
      add_difference(effect);
      continue;
    }
    add(effect.form, effect.onset_s);
    for (int part = 0; part < effect.form.parts; ++part) weights_.push_back({1.0});
  }
}

Eigen::MatrixXd SizeColumns::of(const Eigen::MatrixXd& moments, std::size_t parameters) const {
  const auto first = static_cast<Eigen::Index>(parameters);
  const auto sizes = static_cast<Eigen::Index>(weights_.size());
  Eigen::MatrixXd combine = Eigen::MatrixXd::Zero(moments.rows(), first + sizes + 1);
  combine.topLeftCorner(first, first).setIdentity();
  combine(moments.rows() - 1, first + sizes) = 1.0;
  Eigen::Index row = first;
  for (Eigen::Index j = 0; j < sizes; ++j)
    for (const double weight : weights_[static_cast<std::size_t>(j)]) combine(row++, first + j) = weight;
  return combine.transpose() * moments * combine;
}

void SizeColumns::add(const gap::EffectForm& form, double onset_s) {
  forms_.push_back(form);
  onset_s_.push_back(onset_s);
}

void SizeColumns::add_difference(const gap::AppliedEffect& effect) {
  constexpr float kLittle = 0.05F;
  for (const float factor : {1.0F + kLittle, 1.0F - kLittle}) {
    gap::EffectForm form = effect.form;
    form.shape *= factor;
    add(form, effect.onset_s);
  }
  const double per_change = 0.5 / static_cast<double>(kLittle);
  weights_.push_back({per_change, -per_change});
}

}  // namespace morepro::host
