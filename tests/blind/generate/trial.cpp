#include "trial.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "conditions.hpp"
#include "recording.hpp"
#include "sizing.hpp"

namespace blind {
namespace {

using nlohmann::json;

constexpr const char* kBalanceNames[] = {"spindle_torque", "feed_force", "armature_voltage"};

const EffectKind& kind_of(const std::string& name) {
  for (const auto* kinds : {&catalogue_effects(), &unknown_structures()})
    for (const EffectKind& kind : *kinds)
      if (kind.name == name) return kind;
  throw std::runtime_error("no effect is called " + name);
}

bool needs_place(const TrialSpec& spec) {
  return std::any_of(spec.effects.begin(), spec.effects.end(), [](const std::string& name) {
    return name == "feed_screw_periodic" || name == "feed_spring";
  });
}

Scenario scenario_of(const TrialSpec& spec, Random& random) {
  const Conditions conditions = conditions_of(spec);
  Scenario s;
  const bool hides_friction =
      std::count(spec.effects.begin(), spec.effects.end(), "feed_viscous_friction") > 0;
  s.machine = random_machine(random, random.chance(0.1));
  for (Sensor* sensor : {&s.machine.speed, &s.machine.feed, &s.machine.position, &s.machine.current}) {
    sensor->noise *= conditions.loudness;
    sensor->lsb *= conditions.loudness;
  }
  if (hides_friction) s.machine.feed_viscous = 0.0;
  s.seed = random.bits();
  static constexpr double kShares[] = {0.0, 0.5, 1.0, 2.0};
  const double share = kShares[random.pick(4)], drawn_s = random.log_uniform(2e-4, 3e-3);
  const double correlation_s = conditions.is_white ? kStep_s : drawn_s;
  s.controllers_see_state = conditions.controllers_see_state;
  s.process = process_noise_for(s.machine, share, correlation_s,
                                random.chance(0.3) ? random.uniform(1.3, 2.5) : 1.0, conditions.sample_s);
  s.excitation = spec.set == "rich"
                     ? rich_excitation(s.machine, conditions.duration_s, conditions.sample_s, random)
                     : production_excitation(s.machine, conditions.duration_s, conditions.sample_s, random);
  return s;
}

json ratios_json(const std::array<double, kBalances>& ratios) {
  json result;
  for (std::size_t b = 0; b < ratios.size(); ++b) result[kBalanceNames[b]] = ratios[b];
  return result;
}

json effect_json(const Candidate& c, const SizedRun& sized_run, double wanted) {
  const double magnitude = c.kind->is_inverse ? 1.0 / sized_run.strength : sized_run.strength;
  json balances = json::array();
  for (std::size_t b = 0; b < kBalances; ++b)
    if (sized_run.ratios[b] - 1.0 > 0.2 * (sized_run.largest_ratio() - 1.0))
      balances.push_back(kBalanceNames[b]);
  json effect = {{"name", c.kind->name},
                 {"magnitude", magnitude},
                 {"unit", c.kind->unit},
                 {"onset_s", c.onset_s > 0.0 ? json(c.onset_s) : json(nullptr)},
                 {"wanted_ratio", wanted},
                 {"ratio", sized_run.has_holes ? json(nullptr) : json(sized_run.largest_ratio())},
                 {"balance", kBalanceNames[sized_run.balance()]},
                 {"balances", balances},
                 {"has_holes", sized_run.has_holes},
                 {"reachable", sized_run.is_reachable}};
  return effect;
}

class Trial {
 public:
  Trial(const TrialSpec& spec, const std::string& id)
      : spec_(spec),
        random_(spec.seed, 1),
        scenario_(scenario_of(spec, random_)),
        clean_(simulate(scenario_, {})),
        floor_(floor_of(columns_of(clean_), scenario_.machine)) {
    label_ = {{"id", id},
              {"set", spec.set},
              {"class", spec.kind},
              {"seed", spec.seed},
              {"machine", scenario_.machine.is_thesis ? "thesis" : "reference"},
              {"duration_s", scenario_.duration_s()},
              {"sample_s", scenario_.excitation.sample_s},
              {"controllers_see_state", scenario_.controllers_see_state},
              {"effects", json::array()},
              {"unreachable", false}};
  }

  json make(const std::string& directory) {
    size_effects();
    if (label_["unreachable"]) return label_;
    const Run run = final_run();
    if (!run.is_finite) {
      label_["unreachable"] = true;
      return label_;
    }
    label_["ratios"] = ratios_json(residual_ratios(columns_of(run), scenario_.machine, floor_));
    write(run, directory);
    return label_;
  }

 private:
  void size_effects() {
    for (std::size_t e = 0; e < spec_.effects.size(); ++e) {
      Candidate candidate{&kind_of(spec_.effects[e]), random_.bits(), 0.0};
      const bool starts_late =
          random_.chance(0.15) && candidate.kind->may_start_late && spec_.kind == "single";
      if (starts_late) candidate.onset_s = random_.uniform(0.3, 0.6) * scenario_.duration_s();
      SizedRun result = sized(scenario_, candidate, floor_, spec_.ratios[e]);
      label_["effects"].push_back(effect_json(candidate, result, spec_.ratios[e]));
      if (!result.is_reachable) label_["unreachable"] = true;
      candidates_.push_back(candidate);
      strengths_.push_back(result.strength);
    }
  }

  Run final_run() {
    std::vector<std::unique_ptr<Effect>> effects;
    std::vector<ActiveEffect> active;
    for (std::size_t e = 0; e < candidates_.size(); ++e) {
      effects.push_back(made(candidates_[e], scenario_.machine, strengths_[e]));
      active.push_back({effects.back().get(), candidates_[e].onset_s});
    }
    return simulate(scenario_, active);
  }

  void write(const Run& run, const std::string& directory) {
    const bool has_position = random_.chance(0.8) || needs_place(spec_), has_angle = random_.chance(0.7);
    const bool is_off = spec_.kind == "parameters" || (spec_.kind != "none" && random_.chance(0.7));
    const Machine sheet = datasheet_of(scenario_.machine, is_off ? 0.3 : 0.0, random_);
    label_["datasheet_off"] = is_off;
    std::filesystem::create_directories(directory);
    write_recording(directory + "/recording.csv", run, has_position, has_angle);
    write_text(directory + "/machine.toml",
               machine_toml(sheet, "trial", scenario_.excitation.sample_s, has_position, has_angle));
    const bool leaves_out = spec_.kind == "leave_one_out";
    write_text(directory + "/options.txt", leaves_out ? "--exclude " + spec_.effects.front() + "\n" : "");
  }

  TrialSpec spec_;
  Random random_;
  Scenario scenario_;
  Run clean_;
  Floor floor_;
  json label_;
  std::vector<Candidate> candidates_;
  std::vector<double> strengths_;
};

}  // namespace

nlohmann::json make_trial(const TrialSpec& spec, const std::string& id, const std::string& directory) {
  return Trial(spec, id).make(directory);
}

}  // namespace blind
