#include "suite.hpp"

#include <stdexcept>

#include "effect_parts.hpp"

namespace blind {
namespace {

class Plan {
 public:
  explicit Plan(std::uint64_t seed) : random_(seed, 31) {}

  void add(const std::string& set, const std::string& kind, std::vector<std::string> effects,
           std::vector<double> ratios) {
    trials_.push_back(
        {set, kind, std::move(effects), std::move(ratios), random_.bits() >> 12, duration_s_, is_varied_});
  }
  void add_plain(const std::string& set, const std::string& kind, int count) {
    for (int k = 0; k < count; ++k) add(set, kind, {}, {});
  }
  void add_singles(const std::string& set, std::initializer_list<double> ratios) {
    for (const EffectKind& kind : catalogue_effects())
      for (double ratio : ratios) add(set, "single", {kind.name}, {ratio});
  }
  void add_some_singles(const std::string& set, std::initializer_list<const char*> names, double ratio) {
    for (const char* name : names) add(set, "single", {name}, {ratio});
  }
  void add_pairs(const std::string& set, int count) {
    for (int k = 0; k < count; ++k) {
      const int first = random_.pick(effects()), step = 1 + random_.pick(effects() - 1);
      add(set, "pair", {name(first), name((first + step) % effects())},
          {random_.log_uniform(1.6, 5.0), random_.log_uniform(1.6, 5.0)});
    }
  }
  void add_unknown(const std::string& set, int count) {
    std::vector<EffectKind> kinds = unknown_structures();
    // At a constant speed these two are a brush drop and a contact torque: nothing to tell them from.
    if (set == "production")
      std::erase_if(kinds, [](const EffectKind& kind) {
        return kind.name == "speed_square_voltage" || kind.name == "current_hysteresis";
      });
    for (int k = 0; k < count; ++k)
      add(set, "unknown", {kinds[static_cast<std::size_t>(k) % kinds.size()].name},
          {random_.log_uniform(2.0, 6.0)});
  }
  void add_left_out(const std::string& set, int count) {
    for (int k = 0; k < count; ++k) {
      // The clock's faults look like noise: without their names nothing is left to be explained.
      const int first = random_.pick(effects() - static_cast<int>(clock_effects().size()));
      add(set, "leave_one_out", {name(first)}, {random_.log_uniform(2.0, 6.0)});
    }
  }

  Random random_;
  double duration_s_ = 10.0;
  bool is_varied_ = false;
  std::vector<TrialSpec> trials_;

 private:
  static int effects() { return static_cast<int>(catalogue_effects().size()); }
  static std::string name(int index) { return catalogue_effects()[static_cast<std::size_t>(index)].name; }
};

void plan_small(Plan& plan) {
  plan.duration_s_ = 5.0;
  plan.add_plain("rich", "none", 2);
  plan.add_plain("rich", "parameters", 2);
  plan.add_some_singles("rich",
                        {"feed_coulomb_friction", "spindle_coulomb_friction", "brush_voltage_drop",
                         "feed_backlash", "current_delay", "spindle_cogging"},
                        3.0);
  plan.add("rich", "pair", {"feed_coulomb_friction", "brush_voltage_drop"}, {3.0, 3.0});
  plan.add_unknown("rich", 2);
  plan.add_plain("production", "none", 1);
  plan.add_plain("production", "parameters", 1);
  plan.add_some_singles("production", {"tool_wear_ramp"}, 3.0);
}

void plan_full(Plan& plan) {
  for (const char* kind : {"none", "parameters"}) plan.add_plain("rich", kind, 50);
  plan.add_singles("rich", {1.1, 1.3, 2.0, 10.0});
  plan.add_pairs("rich", 40);
  plan.add_unknown("rich", 36);
  plan.add_left_out("rich", 24);
  for (const char* kind : {"none", "parameters"}) plan.add_plain("production", kind, 20);
  plan.add_singles("production", {1.3, 2.0, 10.0});
  plan.add_pairs("production", 40);
  plan.add_unknown("production", 24);
  plan.add_left_out("production", 24);
}

void plan_development(Plan& plan, const std::string& set, int none, int unknown, int singles) {
  plan.add_plain(set, "none", none);
  plan.add_plain(set, "parameters", none);
  plan.add_unknown(set, unknown);
  const auto& kinds = catalogue_effects();
  for (int k = 0; k < singles; ++k)
    plan.add(set, "single", {kinds[static_cast<std::size_t>(k) % kinds.size()].name}, {2.0});
}

}  // namespace

std::vector<TrialSpec> suite(const std::string& name, std::uint64_t seed) {
  Plan plan(seed);
  if (name == "small")
    plan_small(plan);
  else if (name == "full" || name == "varied") {
    plan.is_varied_ = name == "varied";
    plan_full(plan);
  } else if (name == "dev_rich")
    plan_development(plan, "rich", 8, 6, static_cast<int>(catalogue_effects().size()));
  else if (name == "dev_production")
    plan_development(plan, "production", 5, 4, static_cast<int>(catalogue_effects().size()));
  else
    throw std::runtime_error("no suite is called " + name +
                             ": small, full, varied, dev_rich or dev_production");
  return plan.trials_;
}

std::vector<TrialSpec> trials_of_class(const std::string& set, const std::string& kind,
                                       const std::string& effect, double ratio, int count,
                                       std::uint64_t seed) {
  Plan plan(seed);
  for (int k = 0; k < count; ++k) {
    if (kind == "none" || kind == "parameters")
      plan.add_plain(set, kind, 1);
    else if (!effect.empty())
      plan.add(set, kind, {effect}, {ratio > 1.0 ? ratio : 2.0});
    else if (kind == "pair")
      plan.add_pairs(set, 1);
    else if (kind == "leave_one_out")
      plan.add_left_out(set, 1);
    else if (kind == "unknown")
      plan.add_unknown(set, k + 1);
    else
      plan.add_singles(set, {ratio > 1.0 ? ratio : 2.0});
  }
  if (static_cast<int>(plan.trials_.size()) > count) plan.trials_.resize(static_cast<std::size_t>(count));
  return plan.trials_;
}

}  // namespace blind
