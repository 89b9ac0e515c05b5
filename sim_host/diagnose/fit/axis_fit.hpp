#pragma once
#include <Eigen/Core>
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "sim_host/diagnose/fit/gap_model.hpp"
#include "sim_host/diagnose/fit/gap_statistics.hpp"
#include "sim_host/diagnose/fit/input_news.hpp"
#include "sim_host/diagnose/fit/lasting_noise.hpp"
#include "sim_host/diagnose/fit/linear_fit.hpp"
#include "sim_host/diagnose/fit/noise_fit.hpp"

namespace morepro::host {

/// A parameter that the recording leaves uncertain by this share was not found in it.
inline constexpr double kTold = 0.1;
/// By more than this factor hardly any datasheet is wrong about a mass, an inertia or a motor.
inline constexpr double kFarthestDatasheet = 2.0;

/// One axis of the machine with the model that fits it best so far.
class AxisFit {
 public:
  static constexpr double kNone = std::numeric_limits<double>::infinity();

  /// `datasheet`: where the parameters start, and what they are drawn to where nothing is known about them.
  AxisFit(Axis axis, const RecordingSignals& signals, const GapModel& datasheet);

  /// From now on process noise may be fitted far below what observers usually assume: where nothing but the
  /// controller's answer to the sensors' noise excites an axis, an observer that expects more noise than
  /// there is takes a wrong mass for the better one.
  void allow_little_noise() { noise_bounds_.least_share = kLittleNoiseShare; }

  /// From now on no more process noise may be fitted than this share of the sensors': where impacts pass for
  /// noise that is always there, and the controller answers the sensors' noise, an observer that trusts its
  /// sensors finds that answer in its own error, as the work of a mass that is tens of times lighter.
  void allow_noise_up_to(double share) { noise_bounds_.most_share = share; }
  [[nodiscard]] double most_noise_share() const { return noise_bounds_.most_share; }
  /// The least and the most as in another fit.
  void allow_noise_like(const AxisFit& other) { noise_bounds_ = other.noise_bounds_; }

  /// This process noise to begin with, as a share of the sensors', or as much of it as may be fitted.
  void expect_noise(double share);
  /// The least that may be fitted, to begin with.
  void expect_little_noise() { expect_noise(noise_bounds_.least_share); }

  /// From now on the fit sees a quarter of a long recording, or all of it again: how likely it is on the
  /// other is not known then.
  void narrow_down() { look_at(quarter_); }
  void widen() { look_at(all_of(*signals_)); }
  [[nodiscard]] bool is_narrow() const { return stretches_.size() > 1; }
  /// The same for what comes after a time.
  void look_at_the_end(double from_s) { look_at({after(*signals_, from_s)}); }
  /// The same for what comes before it.
  void look_until(double time_s) { look_at({{0, after(*signals_, time_s).first}}); }
  /// Fits the process noise alone.
  void match_noise();
  /// Takes the model as it stands for the fitted one.
  void stay() { unlikeliness_ = unlikeliness_as_it_is(); }
  /// How likely another model is: on everything and on the part that comes first.
  struct Rival {
    double everywhere = kNone;
    double in_part = kNone;
    double far_behind = kNone;  ///< on everything: from where on a trial is not sharpened
  };
  /// This model as others' rival.
  [[nodiscard]] Rival as_rival() const;

  /// Fits process noise, parameters and the sizes of the model's effects, in turns, first to a part of the
  /// recording.
  void settle(int most_rounds = 6);
  /// Its first half, on the part; no longer than it takes to see that it will not become likelier than
  /// `rival`.
  void settle_roughly(int most_rounds, const Rival& rival);
  /// Its second half; not likely at all where the first one has seen that it is hopeless.
  void finish(const Rival& rival);
  /// The same from near the end, with all that is looked at.
  void polish(double rival = kNone);
  /// The same without the process noise; `in_vain`: what a linearisation promised to a model close by without
  /// a step that kept any of it. About as much gets one step, without any that are damped.
  void refit(double in_vain = 0.0);
  /// What it promises to the refitted model in vain.
  [[nodiscard]] double promised_in_vain() const { return promised_in_vain_; }
  /// The same without the whitening either: what is compared must be judged alike. Returns what is left to
  /// be made smaller.
  double refit_with_this_noise();
  /// The same beside noise that lasts: parameters, sizes and their covariance; nothing else changes. Returns
  /// twice the negative logarithm of the likelihood there. `news`: of the input, weighed along.
  double refit_beside_lasting_noise(Memory memory, const InputNews* news = nullptr);
  /// The same likelihood of the model as it stands.
  [[nodiscard]] double deviance_beside_lasting_noise(Memory memory) const;

  /// Twice the negative logarithm of the likelihood of the fitted model; infinite before.
  [[nodiscard]] double unlikeliness() const { return unlikeliness_; }
  /// The same of the model as it stands, nothing fitted.
  [[nodiscard]] double unlikeliness_as_it_is() const;

  /// Second moments with these disturbances as candidates, at the fitted model, in blocks of `block_s()`.
  [[nodiscard]] GapStatistics collect_with(const Disturbances& candidates) const;
  [[nodiscard]] double block_s() const;
  /// The same for candidates that are tried one by one.
  [[nodiscard]] GapStatistics collect_with_each(const Disturbances& candidates) const;
  /// The innovations of the model as it stands, and the moment of these alone; they are kept until it
  /// changes, and for its copies. Not for two threads at once.
  [[nodiscard]] const GapStatistics& innovations() const;
  /// Columns of the parameters.
  [[nodiscard]] std::vector<Eigen::Index> parameter_columns() const;
  /// Precision of the prior on the parameter columns and where it draws them, for `width` columns of moments.
  [[nodiscard]] Eigen::VectorXd precision(Eigen::Index width) const;
  [[nodiscard]] Eigen::VectorXd target(Eigen::Index width) const;

  /// Relative deviation of each parameter from the datasheet; the contact loads' in N.
  [[nodiscard]] Eigen::VectorXd deviation() const;
  /// By what factor, at least 1, a value that the recording tells is off the datasheet's, up or down: the
  /// farthest one of motor, inertia and mass. The contact torque of a machine file that is wrong counts as
  /// another motor: it alone fixes the common factor of torque constant and inertia.
  [[nodiscard]] double farthest_factor() const;
  /// Has it left its machine? Hardly any datasheet is off by that much.
  [[nodiscard]] bool has_gone_astray() const { return farthest_factor() > kFarthestDatasheet; }
  /// Does the recording tell this parameter?
  [[nodiscard]] bool tells(Eigen::Index parameter) const {
    return parameter < standard_error_.size() && standard_error_(parameter) < kTold;
  }
  /// Their standard errors, as shares of the model's values, and the share of them that the recording does
  /// not tell (1: nothing known).
  [[nodiscard]] const Eigen::VectorXd& standard_error() const { return standard_error_; }
  /// Theirs, and behind them that of the sizes of effects.
  [[nodiscard]] const Eigen::MatrixXd& covariance() const { return covariance_; }

  /// By how many times its standard error an effect of the model differs from none, all its parts together,
  /// as one over it; 0 where it is not known.
  [[nodiscard]] double relative_error_of(gap::Effect effect) const;
  /// The same for a known inertia or mass: a spindle without a load that is known turns the same with all its
  /// torques larger, and has friction all the same.
  [[nodiscard]] double relative_error_beside_inertia_of(gap::Effect effect) const;
  /// Standard error of the size that is stated for it, as a share of the size; 0 where it is not known.
  [[nodiscard]] double relative_size_error_of(gap::Effect effect) const;

  /// By how much the parameters change, in the units of their standard errors, where an effect of the model
  /// is made larger by all of its size: what of them a wrong size takes along. Zeros where that is not known.
  [[nodiscard]] Eigen::VectorXd parameters_along(gap::Effect effect) const;

  /// Combinations of parameters that the recording tells at least ten times better than a datasheet does.
  [[nodiscard]] int known_directions() const { return known_directions_; }

  /// Is the part of the feed's contact load that goes with the engagement told apart from the rest?
  [[nodiscard]] bool tells_engaged_load() const;
  /// Where it is not, the offset is taken for the datasheet's, and the force for what remains of the load.
  void attribute_load();

  /// Models for judging pieces that they have not seen: number k is fitted without every second run of
  /// `blocks` blocks of `block_s`, those of parity k. One linear step from the model that fits everything.
  [[nodiscard]] std::array<GapModel, 2> cross_fitted(double block_s, std::size_t blocks) const;

  [[nodiscard]] Axis axis() const { return axis_; }
  [[nodiscard]] const RecordingSignals& signals() const { return *signals_; }
  /// To be changed, before the innovations are asked for again.
  GapModel& change_model() {
    innovations_.reset();
    return model_;
  }
  [[nodiscard]] const GapModel& model() const { return model_; }
  [[nodiscard]] const GapModel& datasheet() const { return datasheet_; }
  [[nodiscard]] const Whitening& whitening() const { return whitening_; }
  void set_whitening(const Whitening& whitening) {
    innovations_.reset();
    whitening_ = whitening;
  }

 private:
  struct Trial {
    GapStatistics statistics;
    Eigen::MatrixXd moments;
    double rows = 0.0;
    double squares = 0.0;     ///< of the innovations and of the prior
    double cost = 0.0;        ///< that is to become smaller
    std::size_t damping = 0;  ///< that the next step begins with
  };
  /// What the parts of an effect of the model are multiplied by, 1 where the shape is the size, and how well
  /// they are known.
  struct KnownSize {
    Eigen::Index column;  ///< first of its covariance
    Eigen::VectorXd size;
    Eigen::MatrixXd covariance;
  };
  [[nodiscard]] std::optional<KnownSize> known_size_of(gap::Effect effect) const;
  [[nodiscard]] static double relative_error_of(const KnownSize& known);
  [[nodiscard]] GapStatistics new_innovations() const;
  [[nodiscard]] Trial tried() const;
  /// What a pass over all that is looked at has left: its whitening, and how likely the model is.
  void take_rest(const GapStatistics& statistics);
  void look_at(std::vector<Stretch> stretches) {
    stretches_ = std::move(stretches);
    innovations_.reset();
    unlikeliness_ = kNone;
  }
  /// Where the noise is looked for: all of a recording of which a part stands for the rest.
  [[nodiscard]] Stretch looked_at() const {
    return is_narrow() ? all_of(*signals_).front() : stretches_.front();
  }
  void take_turns(int most_rounds, double rival);
  [[nodiscard]] bool is_hopeless_beside(double rival) const;
  bool improve(Trial& best, double in_vain = 0.0);
  void follow_bend(const Trial& best, Trial& trial);
  [[nodiscard]] Eigen::VectorXd step_of(const Eigen::MatrixXd& moments,
                                        const std::vector<Eigen::Index>& active, double damping) const;
  void take(const Eigen::VectorXd& step);
  [[nodiscard]] Eigen::VectorXd shortened(const Eigen::VectorXd& step) const;
  [[nodiscard]] Eigen::VectorXd size_precision() const;
  void take_parameters(const Eigen::VectorXd& step);
  void take_sizes(const Eigen::VectorXd& step);

  Axis axis_;
  const RecordingSignals* signals_;
  std::vector<Stretch> quarter_;    ///< of the recording that are looked at first,
  std::vector<Stretch> stretches_;  ///< and now
  GapModel datasheet_;
  GapModel model_;
  Whitening whitening_;
  NoiseBounds noise_bounds_;
  double unlikeliness_ = kNone;
  double promised_in_vain_ = 0.0;
  std::optional<Memory> memory_{};   ///< of past innovations, beside noise that lasts
  const InputNews* news_ = nullptr;  ///< that are weighed along
  int known_directions_ = 0;
  mutable std::shared_ptr<const GapStatistics> innovations_;  ///< of the model as it stands, if asked for
  Eigen::MatrixXd covariance_;                                ///< of parameters and sizes
  Eigen::VectorXd standard_error_;
};

/// Of the spindle's parameters those of the torque balance; the others are the voltage balance's.
inline constexpr Eigen::Index kTorqueParameters = 3;

}  // namespace morepro::host
