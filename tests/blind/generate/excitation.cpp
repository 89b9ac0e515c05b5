#include "excitation.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace blind {
namespace {

/// Levels held for a random time; `next` gives (level, seconds).
std::vector<double> levels(std::size_t count, double sample_s,
                           const std::function<std::pair<double, double>()>& next) {
  std::vector<double> values;
  values.reserve(count);
  while (values.size() < count) {
    const auto [level, seconds] = next();
    const auto samples = static_cast<std::size_t>(std::max(1.0, std::round(seconds / sample_s)));
    values.insert(values.end(), std::min(samples, count - values.size()), level);
  }
  return values;
}

/// A pseudo-random binary signal plus a few sines.
std::vector<double> dither(std::size_t count, double sample_s, double amplitude, double hold_s,
                           Random& random) {
  auto values = levels(count, sample_s,
                       [&] { return std::pair(random.sign() * amplitude, hold_s * (1 + random.pick(4))); });
  for (int tone = 0; tone < 4; ++tone) {
    const double rate = 6.2832 * random.log_uniform(3.0, 400.0) * sample_s, phase = random.uniform(0.0, 6.28);
    for (std::size_t k = 0; k < count; ++k)
      values[k] += 0.4 * amplitude * std::sin(rate * static_cast<double>(k) + phase);
  }
  return values;
}

std::pair<double, double> chip_range(const Machine& m) {
  return m.is_thesis ? std::pair(0.15, 1.0) : std::pair(0.022, 0.11);
}

/// Feed speeds between random places, so that the axis stays within its travel.
std::vector<double> rich_feed(std::size_t count, double sample_s, Random& random) {
  double place = 0.0;
  return levels(count, sample_s, [&] {
    const double goal = random.uniform(-0.08, 0.08), speed = random.log_uniform(0.03, 0.25);
    const double seconds = std::max(0.06, std::abs(goal - place) / speed);
    const double velocity = (goal - place) / seconds;
    place = goal;
    return std::pair(velocity, seconds);
  });
}

/// Cuts of about two seconds; every cut is followed by a gap in which the axis returns.
void production_cycle(const Machine& m, Excitation& e, std::size_t count, Random& random) {
  std::size_t filled = 0;
  auto phase = [&](double seconds, double contact, double feed, double engagement, double chip) {
    const auto end = std::min(count, filled + static_cast<std::size_t>(seconds / e.sample_s));
    for (; filled < end; ++filled) {
      e.contact.push_back(contact);
      e.feed_reference.push_back(feed);
      e.engagement.push_back(engagement);
      e.chip_load_mm.push_back(chip);
    }
  };
  phase(random.uniform(0.6, 0.9), 0.0, 0.0, 1.0, m.chip_load_mm);
  while (filled < count) {
    const double feed = random.uniform(0.02, 0.05), cut_s = random.uniform(1.6, 2.4);
    const double back = random.uniform(0.2, 0.35), engagement = random.uniform(0.9, 1.1);
    const double chip = m.chip_load_mm * random.uniform(0.8, 1.2);
    phase(0.1, 0.0, feed, engagement, chip);
    phase(cut_s, 1.0, feed, engagement, chip);
    phase(feed * (cut_s + 0.1) / back, 0.0, -back, engagement, chip);
  }
}

}  // namespace

Excitation rich_excitation(const Machine& m, double duration_s, double sample_s, Random& random) {
  const auto count = static_cast<std::size_t>(std::round(duration_s / sample_s));
  const double top = m.working_speed();
  const auto [chip_low, chip_high] = chip_range(m);
  Excitation e;
  e.sample_s = sample_s;
  e.spindle_reference = levels(count, sample_s, [&] {
    return std::pair(random.sign() * top * random.uniform(0.25, 1.0), random.uniform(0.15, 0.8));
  });
  e.feed_reference = rich_feed(count, sample_s, random);
  e.voltage_dither = dither(count, sample_s, random.uniform(1.5, 4.0), 0.001, random);
  e.force_dither = dither(count, sample_s, random.uniform(8.0, 25.0), 0.003, random);
  bool cuts = true;
  e.contact = levels(count, sample_s, [&] {
    cuts = !cuts;
    return std::pair(cuts ? 1.0 : 0.0, random.uniform(0.08, cuts ? 0.6 : 0.4));
  });
  e.engagement =
      levels(count, sample_s, [&] { return std::pair(random.uniform(0.4, 1.4), random.uniform(0.1, 0.5)); });
  e.chip_load_mm = levels(count, sample_s, [&] {
    return std::pair(random.uniform(chip_low, chip_high), random.uniform(0.1, 0.5));
  });
  e.winding_time_s = random.uniform(1.5, 4.0);
  e.tool_time_s = random.uniform(0.3, 1.0);
  return e;
}

Excitation production_excitation(const Machine& m, double duration_s, double sample_s, Random& random) {
  const auto count = static_cast<std::size_t>(std::round(duration_s / sample_s));
  Excitation e;
  e.sample_s = sample_s;
  e.spindle_reference.assign(count, m.working_speed() * random.uniform(0.75, 1.0));
  e.voltage_dither = dither(count, sample_s, random.uniform(0.02, 0.15), 0.001, random);
  e.force_dither = dither(count, sample_s, random.uniform(0.1, 0.6), 0.003, random);
  production_cycle(m, e, count, random);
  e.winding_time_s = random.uniform(1.5, 4.0);
  e.tool_time_s = random.uniform(0.4, 1.5);
  return e;
}

}  // namespace blind
