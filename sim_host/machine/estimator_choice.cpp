#include "sim_host/machine/estimator_choice.hpp"

#include <algorithm>
#include <cmath>

#include "lib/plant/contact_law.hpp"

namespace morepro::host {
namespace {

constexpr int kMostHypotheses = 11;
constexpr int kWantedHypotheses = 10;
constexpr int kCoarsestDivision = 5;
constexpr int kFinestDivision = 50;
// Grid values are multiples of the step; a multiple that misses a limit by rounding is inside.
constexpr double kRounding = 1.0e-9;

struct Multiples {
  int first;
  int last;
  [[nodiscard]] int count() const { return last - first + 1; }
};

Multiples multiples_inside_law(const MachineParameters& machine, double step_mm) {
  const double lowest_mm = ContactRange::kLowestFeed / machine.tool.teeth;
  const double highest_mm = ContactRange::kHighestFeed / machine.tool.teeth;
  return {static_cast<int>(std::ceil(lowest_mm / step_mm - kRounding)),
          static_cast<int>(std::floor(highest_mm / step_mm + kRounding))};
}

}  // namespace

HypothesisGrid grid_for(const MachineParameters& machine) {
  const double nominal_mm = machine.tool.chip_load_mm;
  const double widest_step_mm = nominal_mm / kCoarsestDivision;
  // The thesis's law has no range of validity: the thesis's own grid starts at one step.
  if (machine.contact.form == ContactForm::kThesis) {
    return {.first_mm = widest_step_mm, .step_mm = widest_step_mm, .count = kMostHypotheses};
  }
  int division = kCoarsestDivision;
  Multiples inside = multiples_inside_law(machine, widest_step_mm);
  while (inside.count() < kWantedHypotheses && division < kFinestDivision) {
    inside = multiples_inside_law(machine, nominal_mm / ++division);
  }
  const int first = std::clamp(division - kMostHypotheses / 2, inside.first,
                               std::max(inside.first, inside.last - kMostHypotheses + 1));
  const int count = std::min(kMostHypotheses, inside.last - first + 1);
  const double step_mm = nominal_mm / division;
  return {.first_mm = first * step_mm, .step_mm = step_mm, .count = static_cast<std::uint32_t>(count)};
}

FilterTuning tuning_for(const Sensors& sensors, const HypothesisGrid& grid) {
  const auto sigma = [&sensors](Channel channel) { return std::sqrt(sensors[channel].variance()); };
  FilterTuning tuning;
  tuning.speed_process_noise_rad_s = 0.03 * sigma(Channel::kSpindleSpeed);
  tuning.current_process_noise_a = 0.3 * sigma(Channel::kArmatureCurrent);
  tuning.feed_process_noise_m_s = 0.05 * sigma(Channel::kFeedSpeed);
  tuning.chip_load_drift_mm = 0.005 * grid.step_mm;
  return tuning;
}

GapTuning gap_tuning_for(const Sensors& sensors) {
  constexpr double kShare = 0.01;
  const auto sigma = [&sensors](Channel channel) { return std::sqrt(sensors[channel].variance()); };
  GapTuning tuning;
  tuning.speed_process_noise_rad_s = kShare * sigma(Channel::kSpindleSpeed);
  tuning.current_process_noise_a = kShare * sigma(Channel::kArmatureCurrent);
  tuning.feed_process_noise_m_s = kShare * sigma(Channel::kFeedSpeed);
  return tuning;
}

void set_rate(MonitorConfiguration& configuration, double rate_hz) {
  const double steps_ratio = configuration.sampling.rate_hz / rate_hz;
  const double noise_ratio = std::sqrt(steps_ratio);
  FilterTuning& tuning = configuration.tuning;
  tuning.speed_process_noise_rad_s *= noise_ratio;
  tuning.current_process_noise_a *= noise_ratio;
  tuning.feed_process_noise_m_s *= noise_ratio;
  tuning.chip_load_drift_mm *= noise_ratio;
  const double likeliest = std::max(0.1, tuning.switch_probability);
  tuning.switch_probability = std::min(likeliest, tuning.switch_probability * steps_ratio);
  GapTuning& gap = configuration.gap;
  gap.speed_process_noise_rad_s *= noise_ratio;
  gap.current_process_noise_a *= noise_ratio;
  gap.feed_process_noise_m_s *= noise_ratio;
  configuration.sampling.rate_hz = rate_hz;
}

void choose_tuning(MonitorConfiguration& configuration) {
  const double rate_hz = configuration.sampling.rate_hz;
  configuration.tuning = tuning_for(configuration.sensors, configuration.grid);
  configuration.gap = gap_tuning_for(configuration.sensors);
  configuration.sampling = Sampling{};
  set_rate(configuration, rate_hz);
}

MonitorConfiguration chosen_for(MonitorConfiguration configuration, bool has_contact) {
  choose_tuning(configuration);
  if (has_contact) configuration.grid = grid_for(configuration.machine);
  return configuration;
}

}  // namespace morepro::host
