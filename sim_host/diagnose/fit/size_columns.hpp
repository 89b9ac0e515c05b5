#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "lib/gap/applied_effect.hpp"
#include "sim_host/diagnose/fit/innovation_pass.hpp"

namespace morepro::host {

/// An effect whose size is a lag or a delay and nothing else: it changes by factors.
bool is_pure_shape(const gap::EffectForm& form);

/// Columns of the effects in a model: what a little more of each part would change. Of a lag or a delay that
/// is the difference of a longer and a shorter one, relative to its length: what the whole of it does has
/// another shape, and steps along it crawl.
class SizeColumns {
 public:
  explicit SizeColumns(const std::vector<gap::AppliedEffect>& effects);

  [[nodiscard]] Disturbances disturbances() const { return {forms_, onset_s_}; }

  /// Moments [parameters | one column per size | innovation] from those of the disturbances.
  [[nodiscard]] Eigen::MatrixXd of(const Eigen::MatrixXd& moments, std::size_t parameters) const;

 private:
  void add(const gap::EffectForm& form, double onset_s);
  void add_difference(const gap::AppliedEffect& effect);

  std::vector<gap::EffectForm> forms_;
  std::vector<double> onset_s_;
  std::vector<std::vector<double>> weights_;  ///< of each size's disturbances
};

}  // namespace morepro::host
