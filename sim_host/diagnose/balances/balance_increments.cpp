#include "sim_host/diagnose/balances/balance_increments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>

#include "lib/gap/effect_memory.hpp"
#include "lib/plant/contact_law.hpp"
#include "sim_host/diagnose/fit/innovation_pass.hpp"

namespace morepro::host {
namespace {

template <std::size_t kColumns>
using Row = Eigen::RowVector<float, static_cast<int>(kColumns)>;
constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// Share of the interval's first sample in the integral of a current that decays with R/L under a held
/// voltage.
double first_share(double decay) {
  return std::fabs(decay) < 1.0e-3 ? 0.5 - decay / 12.0 : 1.0 / decay - 1.0 / std::expm1(decay);
}

constexpr std::array kSampledChannels{Channel::kSpindleSpeed, Channel::kArmatureCurrent, Channel::kFeedSpeed,
                                      Channel::kFeedPosition};

bool has_holes(const RecordingSignals& signals) {
  return std::any_of(kSampledChannels.begin(), kSampledChannels.end(), [&signals](Channel channel) {
    const auto& column = signals.value[index_of(channel)];
    return std::any_of(column.begin(), column.end(), [](float value) { return std::isnan(value); });
  });
}

/// Straight over short holes: a window needs all of its samples, and a recording that lacks one in thirty has
/// few windows without a hole. Nothing where there is none.
std::optional<RecordingSignals> bridged(const RecordingSignals& with_holes) {
  if (!has_holes(with_holes)) return std::nullopt;
  RecordingSignals signals = with_holes;
  for (const Channel channel : kSampledChannels) {
    auto& column = signals.value[index_of(channel)];
    std::size_t last = column.size();  // that was measured
    for (std::size_t i = 0; i < column.size(); ++i) {
      if (std::isnan(column[i])) continue;
      if (last < i && i - last <= kLongestBridge + 1)
        for (std::size_t k = last + 1; k < i; ++k)
          column[k] =
              std::lerp(column[last], column[i], static_cast<float>(k - last) / static_cast<float>(i - last));
      last = i;
    }
  }
  return signals;
}

GapModel without_findings(GapModel model) {
  model.effects.clear();
  return model;
}

gap::Contribution<double> less(const gap::Contribution<double>& a, const gap::Contribution<double>& b) {
  return {.torque_nm = a.torque_nm - b.torque_nm,
          .force_n = a.force_n - b.force_n,
          .voltage_v = a.voltage_v - b.voltage_v,
          .speed_rad_s = a.speed_rad_s - b.speed_rad_s,
          .current_a = a.current_a - b.current_a,
          .feed_speed_m_s = a.feed_speed_m_s - b.feed_speed_m_s};
}

EffectsOfRow less(const EffectsOfRow& a, const EffectsOfRow& b) {
  return {less(a.added, b.added), less(a.shown, b.shown)};
}

/// What is known of one row.
struct Moment {
  gap::GapFrame<double> frame;
  EffectsOfRow known;
  EffectsOfRow found;  ///< beside the known ones

  [[nodiscard]] double speed() const { return frame.has_speed ? frame.speed_rad_s : kMissing; }
  [[nodiscard]] double current() const { return frame.has_current ? frame.current_a : kMissing; }
  [[nodiscard]] double feed_speed() const { return frame.has_feed_speed ? frame.feed_speed_m_s : kMissing; }
  [[nodiscard]] double position() const { return frame.has_feed_position ? frame.feed_position_m : kMissing; }
};

// Errors of quotients as if both parameters were known by themselves: larger than they are, if anything.
KnownCoefficient known(const AxisFit& fit, double value, std::initializer_list<Eigen::Index> parameters) {
  const Eigen::VectorXd& error = fit.standard_error();
  double square = 0.0;
  for (const Eigen::Index j : parameters) square += j < error.size() ? error(j) * error(j) : 1.0;
  return {.value = value, .error = std::fabs(value) * std::sqrt(square)};
}

std::vector<KnownCoefficient> known_of_torque(const AxisFit& fit) {
  const auto& s = fit.model().machine.spindle;
  return {known(fit, s.torque_constant_nm_a / s.inertia_kgm2, {0, 2}),
          known(fit, -s.viscous_friction_nms_rad / s.inertia_kgm2, {1, 2}),
          known(fit, -1.0 / s.inertia_kgm2, {2})};
}

std::vector<KnownCoefficient> known_of_voltage(const AxisFit& fit) {
  const auto& s = fit.model().machine.spindle;
  return {known(fit, 1.0 / s.inductance_h, {5}), known(fit, -s.resistance_ohm / s.inductance_h, {3, 5}),
          known(fit, -s.back_emf_constant_vs_rad / s.inductance_h, {4, 5})};
}

class Increments {
 public:
  explicit Increments(const AxisDiagnosis& diagnosis)
      : fit_(diagnosis.fit),
        nominal_(diagnosis.nominal),
        bridged_(bridged(fit_.signals())),
        signals_(bridged_ ? *bridged_ : fit_.signals()),
        machine_(fit_.model().machine),
        step_s_(1.0 / signals_.rate_hz),
        first_share_(first_share(step_s_ * machine_.spindle.resistance_ohm / machine_.spindle.inductance_h)) {
  }

  std::vector<BalanceIncrements> of_spindle() {
    const bool has_current = signals_.has(Channel::kArmatureCurrent);
    std::vector<BalanceIncrements> balances{empty(gap::Balance::kSpindleTorque, 5)};
    if (has_current) {
      balances.front().known = known_of_torque(fit_);
      balances.front().nominal = known_of_torque(nominal_);
    }
    if (signals_.has_electrics()) {
      balances.push_back(empty(gap::Balance::kArmatureVoltage, 5));
      balances.back().known = known_of_voltage(fit_);
      balances.back().nominal = known_of_voltage(nominal_);
    }
    gap::Lag<double> winding(machine_.spindle.inductance_h / machine_.spindle.resistance_ohm, step_s_);
    for_each_row([&](Eigen::Index i, const Moment&, const Moment& here, const Moment& next) {
      const double voltage_v = winding.mean(here.frame.input.armature_voltage_v);
      balances.front().columns.row(i) =
          torque(here, next, has_current ? std::nullopt : std::optional(voltage_v));
      if (signals_.has_electrics()) balances.back().columns.row(i) = voltage(here, next);
    });
    return balances;
  }
  std::vector<BalanceIncrements> of_feed() {
    const bool has_speed = signals_.has(Channel::kFeedSpeed);
    std::vector<BalanceIncrements> balances{empty(gap::Balance::kFeedForce, 6)};
    for_each_row([&](Eigen::Index i, const Moment& before, const Moment& here, const Moment& next) {
      balances.front().columns.row(i) = has_speed ? force(here, next) : force_by_position(before, here, next);
    });
    return balances;
  }

 private:
  [[nodiscard]] BalanceIncrements empty(gap::Balance balance, Eigen::Index width) const {
    const auto rows = static_cast<Eigen::Index>(signals_.rows);
    BalanceIncrements increments{
        .balance = balance, .columns = Eigen::MatrixXf(rows, width), .known = {}, .nominal = {}};
    increments.columns.row(rows - 1).setConstant(static_cast<float>(kMissing));
    return increments;
  }

  /// visit(row, before, here, next) for every row with a next one; nothing is measured before the first.
  template <class Visit>
  void for_each_row(Visit visit) const {
    FrameSource frames(signals_, machine_, 0);
    const EffectTrace known = trace_effects(fit_.axis(), signals_, without_findings(fit_.model()));
    const bool has_found = !fit_.model().effects.empty();
    const EffectTrace all = has_found ? trace_effects(fit_.axis(), signals_, fit_.model()) : nullptr;
    std::array<Moment, 3> moments;  // before the first row: frames without a measurement
    for (std::size_t i = 0; i < signals_.rows; ++i) {
      Moment& newest = moments[i % 3];
      newest = {.frame = frames.next(), .known = known(), .found = {}};
      if (has_found) newest.found = less(all(), newest.known);
      if (i >= 1) visit(static_cast<Eigen::Index>(i - 1), moments[(i + 1) % 3], moments[(i - 1) % 3], newest);
    }
  }

  template <std::size_t kColumns>
  static Row<kColumns> row(const double (&values)[kColumns]) {
    Row<kColumns> r;
    for (std::size_t j = 0; j < kColumns; ++j)
      r(static_cast<Eigen::Index>(j)) = static_cast<float>(values[j]);
    return r;
  }
  [[nodiscard]] double electrical(double at_start, double at_end) const {
    return step_s_ * (first_share_ * at_start + (1.0 - first_share_) * at_end);
  }
  [[nodiscard]] double mean(double at_start, double at_end) const {
    return 0.5 * step_s_ * (at_start + at_end);
  }
  [[nodiscard]] double contact(const Moment& now, const Moment& then) const {
    const auto& input = now.frame.input;
    if (input.contact == 0.0) return 0.0;
    const double factor = law_.thermal_factor(input.tool_temperature_degc);
    const auto torque = [&](double w) {
      return law_.at_thermal_factor(w, input.chip_load_mm, factor).torque_nm;
    };
    return input.contact * mean(torque(now.speed()), torque(then.speed()));
  }

  // What effects add to the increment of each balance, from one row to the next.
  using Effects = EffectsOfRow Moment::*;
  [[nodiscard]] double on_torque(Effects effects, const Moment& now, const Moment& then,
                                 bool has_current) const {
    const auto& s = machine_.spindle;
    const auto& added = (now.*effects).added;
    const auto& here = (now.*effects).shown;
    const auto& next = (then.*effects).shown;
    const double shown_w = mean(here.speed_rad_s, next.speed_rad_s);
    const double shown_i = electrical(here.current_a, next.current_a);
    const double electric = has_current ? 0.0
                                        : step_s_ * added.voltage_v * s.torque_constant_nm_a /
                                              (s.resistance_ohm * s.inertia_kgm2);
    return step_s_ * added.torque_nm / s.inertia_kgm2 + next.speed_rad_s - here.speed_rad_s +
           s.viscous_friction_nms_rad / s.inertia_kgm2 * shown_w -
           s.torque_constant_nm_a / s.inertia_kgm2 * shown_i + electric;
  }
  [[nodiscard]] double on_voltage(Effects effects, const Moment& now, const Moment& then) const {
    const auto& s = machine_.spindle;
    const auto& here = (now.*effects).shown;
    const auto& next = (then.*effects).shown;
    return step_s_ * (now.*effects).added.voltage_v / s.inductance_h + next.current_a - here.current_a +
           s.resistance_ohm / s.inductance_h * electrical(here.current_a, next.current_a) +
           s.back_emf_constant_vs_rad / s.inductance_h * mean(here.speed_rad_s, next.speed_rad_s);
  }
  [[nodiscard]] double on_force(Effects effects, const Moment& now, const Moment& then) const {
    const auto& f = machine_.feed;
    const auto& here = (now.*effects).shown;
    const auto& next = (then.*effects).shown;
    return step_s_ * (now.*effects).added.force_n / f.mass_kg + next.feed_speed_m_s - here.feed_speed_m_s +
           f.viscous_friction_ns_m / f.mass_kg * mean(here.feed_speed_m_s, next.feed_speed_m_s);
  }
  // A machine whose file has no viscous friction has no such parameter: it is an effect there.
  [[nodiscard]] double if_viscous(double travel_m) const {
    return fit_.datasheet().machine.feed.viscous_friction_ns_m > 0.0 ? travel_m : 0.0 * travel_m;
  }
  [[nodiscard]] double on_position(Effects effects, const Moment& before, const Moment& now) const {
    return 0.5 * step_s_ * ((before.*effects).added.force_n + (now.*effects).added.force_n) /
           machine_.feed.mass_kg;
  }

  /// `voltage_v`: without a current, what of the voltage the winding lets through.
  [[nodiscard]] Row<5> torque(const Moment& now, const Moment& then, std::optional<double> voltage_v) const {
    const bool has_current = !voltage_v;
    const double drive = has_current ? electrical(now.current(), then.current()) : step_s_ * *voltage_v;
    return row({drive, mean(now.speed(), then.speed()), contact(now, then),
                on_torque(&Moment::found, now, then, has_current),
                then.speed() - now.speed() - on_torque(&Moment::known, now, then, has_current)});
  }
  [[nodiscard]] Row<5> voltage(const Moment& now, const Moment& then) const {
    return row({step_s_ * now.frame.input.armature_voltage_v, electrical(now.current(), then.current()),
                mean(now.speed(), then.speed()), on_voltage(&Moment::found, now, then),
                then.current() - now.current() - on_voltage(&Moment::known, now, then)});
  }
  [[nodiscard]] Row<6> force(const Moment& now, const Moment& then) const {
    const auto& input = now.frame.input;
    return row({step_s_ * input.feed_force_n, step_s_ * input.contact * input.engagement,
                step_s_ * input.contact, if_viscous(mean(now.feed_speed(), then.feed_speed())),
                on_force(&Moment::found, now, then),
                then.feed_speed() - now.feed_speed() - on_force(&Moment::known, now, then)});
  }
  // The increment of a speed that was not recorded: a second difference of the position, with the inputs of
  // both intervals that it spans.
  [[nodiscard]] Row<6> force_by_position(const Moment& before, const Moment& now, const Moment& then) const {
    const auto& a = before.frame.input;
    const auto& b = now.frame.input;
    const double half = 0.5 * step_s_;
    return row({half * (a.feed_force_n + b.feed_force_n),
                half * (a.contact * a.engagement + b.contact * b.engagement), half * (a.contact + b.contact),
                if_viscous(0.5 * (then.position() - before.position())),
                on_position(&Moment::found, before, now),
                (then.position() - 2.0 * now.position() + before.position()) / step_s_ -
                    on_position(&Moment::known, before, now)});
  }

  const AxisFit& fit_;
  const AxisFit& nominal_;
  std::optional<RecordingSignals> bridged_;
  const RecordingSignals& signals_;
  const MachineParameters& machine_;
  double step_s_;
  double first_share_;
  ContactLaw<double> law_{machine_};
};

}  // namespace

std::vector<BalanceIncrements> balance_increments(const AxisDiagnosis& diagnosis) {
  Increments increments(diagnosis);
  return diagnosis.fit.axis() == Axis::kSpindle ? increments.of_spindle() : increments.of_feed();
}

}  // namespace morepro::host
