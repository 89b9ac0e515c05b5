#include "sim_host/thesis/bank_trial.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "lib/monitor/spindle_tracker.hpp"
#include "lib/plant/integrators.hpp"
#include "sim_host/simulate/random_numbers.hpp"

namespace morepro::host::thesis {
namespace {

constexpr std::size_t kLanes = 11;
constexpr int kContact = 500, kCut = 2000, kLongCut = 3000, kAfterChange = 2500, kEnd = 500;
constexpr double kPeriodS = 1.0e-4;
constexpr int kIntegrationSteps = 5;
constexpr double kToolDegc = 500.0;

/// What of the real machine is not as stated.
using Change = void (*)(MachineParameters& machine, double& tool_degc);

struct Condition {
  double noise = 1.0;
  std::string_view mismatch;
  Change change = nullptr;
  int cut_frames = kCut;  ///< with the first chip load

  [[nodiscard]] constexpr int change_frame() const { return kContact + cut_frames; }
  [[nodiscard]] constexpr int frames() const { return change_frame() + kAfterChange; }
};

constexpr std::array kConditions{
    Condition{1.0, "", nullptr},
    Condition{10.0, "", nullptr, kLongCut},
    Condition{30.0, "", nullptr, kLongCut},
    Condition{1.0, "Kt + 1 %", [](MachineParameters& m, double&) { m.spindle.torque_constant_nm_a *= 1.01; }},
    Condition{1.0, "Kt + 5 %", [](MachineParameters& m, double&) { m.spindle.torque_constant_nm_a *= 1.05; }},
    Condition{1.0, "R + 5 %", [](MachineParameters& m, double&) { m.spindle.resistance_ohm *= 1.05; }},
    Condition{1.0, "Kv + 2 %",
              [](MachineParameters& m, double&) { m.spindle.back_emf_constant_vs_rad *= 1.02; }},
    Condition{1.0, "Att + 1 %",
              [](MachineParameters& m, double&) { m.spindle.viscous_friction_nms_rad *= 1.01; }},
    Condition{1.0, "Att + 5 %",
              [](MachineParameters& m, double&) { m.spindle.viscous_friction_nms_rad *= 1.05; }},
    Condition{1.0, "In + 20 %", [](MachineParameters& m, double&) { m.spindle.inertia_kgm2 *= 1.2; }},
    Condition{1.0, "tool + 5 K, unmeasured", [](MachineParameters&, double& degc) { degc += 5.0; }},
    Condition{1.0, "tool + 20 K, unmeasured", [](MachineParameters&, double& degc) { degc += 20.0; }}};

/// A built-in machine with its chip loads before and after the change, on the grid.
struct Subject {
  std::string_view name;
  MonitorConfiguration configuration;
  double voltage_v;
  double first_mm;
  double second_mm;
};

constexpr std::array kSubjects{Subject{"thesis", thesis_configuration(), 54.0, 0.6, 0.3},
                               Subject{"reference", reference_configuration(), 48.0, 0.05, 0.04}};

constexpr std::array<std::string_view, 4> kRules{"thesis, integral", "Bayes, floor", "Markov", "continuous"};
constexpr std::size_t kContinuous = 3;

MonitorConfiguration configuration_of(const Subject& subject, const Condition& condition) {
  MonitorConfiguration c = subject.configuration;
  for (SensorNoise& sensor : c.sensors.by_channel) sensor.noise *= condition.noise;
  return c;
}

/// The real machine: integrated below the sampling period, with the noise of its sensors.
class RealMachine {
 public:
  RealMachine(const MonitorConfiguration& c, std::uint64_t seed)
      : sensors_(c.sensors), integrator_(c.machine, kPeriodS / kIntegrationSteps), noise_(seed) {}

  PlantInput<double> input{.armature_voltage_v = 0.0,
                           .feed_force_n = 0.0,
                           .contact = 0.0,
                           .engagement = 1.0,
                           .chip_load_mm = 0.0,
                           .tool_temperature_degc = kToolDegc};

  void step() {
    for (int k = 0; k < kIntegrationSteps; ++k) state_ = integrator_.step(state_, input);
  }
  SpindleMeasurement<float> measure() {
    const auto& speed = sensors_[Channel::kSpindleSpeed];
    const auto& current = sensors_[Channel::kArmatureCurrent];
    return {static_cast<float>(state_.speed_rad_s + speed.noise * noise_.next()),
            static_cast<float>(state_.current_a + current.noise * noise_.next()),
            static_cast<float>(speed.variance()), static_cast<float>(current.variance())};
  }
  float acceleration() {
    const double rate = integrator_.plant().derivative(state_, input).acceleration_rad_s2;
    return static_cast<float>(rate + sensors_[Channel::kSpindleAcceleration].noise * noise_.next());
  }

 private:
  Sensors sensors_;
  ExponentialIntegrator<double> integrator_;
  NormalNumbers noise_;
  PlantState<double> state_;
};

/// Counts of one rule over the runs of one condition.
struct Score {
  std::vector<int> right;
  double error_sum_mm = 0.0;
};

class Trial {
 public:
  Trial(const Subject& subject, const Condition& condition, const BankTrialOptions& options)
      : subject_(subject),
        condition_(condition),
        options_(options),
        stated_(configuration_of(subject, condition)) {
    for (Score& score : score_) score.right.resize(static_cast<std::size_t>(condition.frames()), 0);
  }

  std::vector<BankTrialRow> rows() {
    for (int run = 0; run < options_.runs; ++run)
      run_once(mixed(options_.seed, static_cast<std::uint64_t>(run)));
    std::vector<BankTrialRow> rows;
    for (std::size_t rule = 0; rule < kRules.size(); ++rule) rows.push_back(row_of(rule));
    return rows;
  }

 private:
  using Tracker = SpindleTracker<kLanes>;

  /// The rules see the same frames.
  void run_once(std::uint64_t seed) {
    MonitorConfiguration real = stated_;
    double tool_degc = kToolDegc;
    if (condition_.change != nullptr) condition_.change(real.machine, tool_degc);
    RealMachine machine(real, seed);
    machine.input.armature_voltage_v = subject_.voltage_v;
    machine.input.tool_temperature_degc = tool_degc;
    const auto trackers = trackers_for(machine.measure());
    const float thermal = ContactLaw<float>(stated_.machine).thermal_factor(static_cast<float>(kToolDegc));
    for (int k = 0; k < condition_.frames(); ++k) {
      if (k == kContact)
        for (const auto& tracker : trackers) tracker->start_cut();
      machine.input.contact = k < kContact ? 0.0 : 1.0;
      machine.input.chip_load_mm = k < condition_.change_frame() ? subject_.first_mm : subject_.second_mm;
      machine.step();
      const SpindleMeasurement<float> y = machine.measure();
      const float acceleration = machine.acceleration();
      const SpindleInput<float> held{static_cast<float>(subject_.voltage_v),
                                     static_cast<float>(machine.input.contact), thermal};
      for (const auto& tracker : trackers) {
        SpindleMeasurement<float> own = y;
        (void)tracker->step(held, own, acceleration);
      }
      for (std::size_t rule = 0; rule < kRules.size(); ++rule)
        judge(k, rule, chosen(trackers, rule), machine.input.chip_load_mm);
    }
  }

  /// One per rule of the bank.
  std::array<std::unique_ptr<Tracker>, 3> trackers_for(const SpindleMeasurement<float>& start) const {
    std::array<std::unique_ptr<Tracker>, 3> trackers;
    constexpr std::array kBankRules{DecisionRule::kThesis, DecisionRule::kBayesian, DecisionRule::kMarkov};
    for (std::size_t rule = 0; rule < trackers.size(); ++rule) {
      MonitorConfiguration c = stated_;
      c.rule = kBankRules[rule];
      trackers[rule] = std::make_unique<Tracker>(c);
      trackers[rule]->restart(start);
    }
    return trackers;
  }

  [[nodiscard]] double chosen(const std::array<std::unique_ptr<Tracker>, 3>& trackers,
                              std::size_t rule) const {
    if (rule == kContinuous) return double{trackers.front()->chip_load().chip_load_mm()};
    return stated_.grid.value_mm(trackers[rule]->selected());
  }

  /// Right: nearer to the truth than to any other hypothesis.
  void judge(int k, std::size_t rule, double chosen_mm, double truth_mm) {
    const double error = chosen_mm - truth_mm;
    score_[rule].right[static_cast<std::size_t>(k)] += std::abs(error) < 0.5 * stated_.grid.step_mm ? 1 : 0;
    if (k >= condition_.frames() - kEnd) score_[rule].error_sum_mm += error;
  }

  /// Milliseconds after `first` from which at least 95 % of the runs are right until `last`.
  [[nodiscard]] double settled_ms(const Score& score, int first, int last) const {
    int settled = first;
    for (int k = first; k < last; ++k)
      if (score.right[static_cast<std::size_t>(k)] < 0.95 * options_.runs) settled = k + 1;
    return settled < last ? (settled + 1 - first) * kPeriodS * 1000.0
                          : std::numeric_limits<double>::infinity();
  }

  [[nodiscard]] BankTrialRow row_of(std::size_t rule) const {
    const Score& score = score_[rule];
    double right = 0.0;
    for (int k = condition_.frames() - kEnd; k < condition_.frames(); ++k)
      right += score.right[static_cast<std::size_t>(k)];
    const double counted = static_cast<double>(options_.runs) * kEnd;
    return {.machine = std::string(subject_.name),
            .noise = condition_.noise,
            .mismatch = std::string(condition_.mismatch),
            .rule = std::string(kRules[rule]),
            .contact_ms = settled_ms(score, kContact, condition_.change_frame()),
            .switch_ms = settled_ms(score, condition_.change_frame(), condition_.frames()),
            .right_share = right / counted,
            .mean_error_mm = score.error_sum_mm / counted};
  }

  const Subject& subject_;
  const Condition& condition_;
  const BankTrialOptions& options_;
  MonitorConfiguration stated_;
  std::array<Score, kRules.size()> score_{};
};

}  // namespace

std::vector<BankTrialRow> run_bank_trial(const BankTrialOptions& options) {
  std::vector<BankTrialRow> rows;
  double done = 0.0;
  for (const Subject& subject : kSubjects) {
    for (const Condition& condition : kConditions) {
      if (!options.with_mismatch && condition.change != nullptr) continue;
      for (BankTrialRow& row : Trial(subject, condition, options).rows()) rows.push_back(std::move(row));
      done += 1.0;
      if (options.on_progress)
        options.on_progress(subject.name, done / static_cast<double>(kSubjects.size() * kConditions.size()));
    }
  }
  return rows;
}

}  // namespace morepro::host::thesis
