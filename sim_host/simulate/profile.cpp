#include "sim_host/simulate/profile.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lib/plant/contact_law.hpp"
#include "sim_host/simulate/random_numbers.hpp"

namespace morepro::host {
namespace {

enum ProfileStream : std::uint64_t { kFastVoltageSignal = 1, kSlowVoltageSignal = 2, kForceSignal = 3 };

// +-4 N on the 3 kg axis of the built-in machines moves it visibly against its speed sensor.
constexpr double kForceDitherNKg = 4.0 / 3.0;

double force_noise(std::uint64_t seed, double time_s) {
  return binary_signal(mixed(seed, kForceSignal), time_s, 30.0e-3);
}

/// A fast and a slow part, each +1 or -1.
double voltage_noise(std::uint64_t seed, double time_s) {
  return binary_signal(mixed(seed, kFastVoltageSignal), time_s, 1.0e-3) +
         binary_signal(mixed(seed, kSlowVoltageSignal), time_s, 20.0e-3);
}

bool is_on(double time_s, double on_s, double period_s) { return std::fmod(time_s, period_s) < on_s; }

// +1 for a second, -1 for a second, a tenth of a second from one to the other.
double reversing(double time_s) {
  constexpr double kHoldS = 0.9;
  constexpr double kRampS = 0.1;
  const double phase_s = std::fmod(time_s, 2.0);
  const double side = phase_s < 1.0 ? 1.0 : -1.0;
  const double into_ramp = (std::fmod(phase_s, 1.0) - kHoldS) / kRampS;
  return side * (1.0 - 2.0 * std::clamp(into_ramp, 0.0, 1.0));
}

/// One value after the other, again and again.
template <std::size_t kCount>
double stepped(const std::array<double, kCount>& values, double time_s, double hold_s) {
  // A sample at n hold belongs to the new value even where the division rounds down.
  return values[static_cast<std::size_t>(time_s / hold_s + 1.0e-6) % kCount];
}

// A table has an end: a minute forward, then back to where it was, in the air. Without it the position of a
// long recording outgrows what a float resolves beside the sensor's noise, some 4 m.
void return_table(double time_s, Command& command) {
  constexpr double kForwardS = 60.0;
  constexpr double kReturnS = 5.0;
  constexpr double kCycleS = kForwardS + kReturnS;
  const double returning_s = std::fmod(time_s, kCycleS) - kForwardS;
  if (returning_s < 0.0) return;
  // The mean over the whole cycle is 0, and nothing jumps.
  const double sine = std::sin(std::numbers::pi * returning_s / kReturnS);
  command.feed_speed_m_s *= 1.0 - 2.0 * (kCycleS / kReturnS) * sine * sine;
  command.contact = 0.0;
}

}  // namespace

Profile::Profile(ProfileKind kind, const MachineParameters& machine, double duration_s, std::uint64_t seed)
    : kind_(kind),
      machine_(machine),
      point_(operating_point_of(machine)),
      duration_s_(duration_s),
      spin_up_s_(std::min(0.2, 0.1 * duration_s)),
      force_scale_n_(kForceDitherNKg * machine.feed.mass_kg),
      seed_(seed) {}

Command Profile::at(double time_s) const {
  Command command = asked(time_s);
  if (kind_ != ProfileKind::kRich) return_table(time_s, command);
  return command;
}

Command Profile::asked(double time_s) const {
  switch (kind_) {
    case ProfileKind::kRich:
      return rich(time_s);
    case ProfileKind::kCommissioning:
      return commissioning(time_s);
    case ProfileKind::kProduction:
      return production(time_s);
    case ProfileKind::kCutting:
      return cutting(time_s);
    case ProfileKind::kStep:
      return step(time_s);
    case ProfileKind::kPrbs:
      return prbs(time_s);
  }
  return {};
}

double Profile::stepped_chip_load(double time_s) const {
  constexpr std::array kFractions{1.0, 0.8, 1.2, 0.9, 1.1};
  const double stepped_mm = stepped(kFractions, time_s, 0.5) * point_.chip_load_mm;
  return is_inside_contact_range(machine_, stepped_mm) ? stepped_mm : point_.chip_load_mm;
}

Command Profile::rich(double time_s) const {
  constexpr double kSlow = 0.05;
  constexpr std::array kSpeeds{1.0, 0.7, kSlow, 0.85};
  constexpr std::array kEngagements{1.0, 0.8, 0.6};
  const double direction = reversing(time_s);
  const double speed = stepped(kSpeeds, time_s, 2.0);
  const double chip_load_mm = stepped_chip_load(time_s);
  const bool can_cut = std::fabs(direction) == 1.0 && speed != kSlow;
  return {.is_speed_controlled = false,
          .voltage_v = point_.voltage_v * (direction * speed + 0.125 * voltage_noise(seed_, time_s)),
          .feed_speed_m_s = feed_speed_for(machine_, direction * speed * point_.speed_rad_s, chip_load_mm),
          .force_dither_n = force_scale_n_ * force_noise(seed_, time_s),
          .contact = can_cut && !is_on(time_s, 0.1, 0.2) ? 1.0 : 0.0,
          .chip_load_mm = chip_load_mm,
          .engagement = stepped(kEngagements, time_s, 0.7)};
}

Command Profile::controlled(double time_s, double speed_fraction, double chip_load_mm) const {
  const double ramp = std::min(1.0, time_s / spin_up_s_);
  const double speed_rad_s = ramp * speed_fraction * point_.speed_rad_s;
  return {.speed_rad_s = speed_rad_s,
          .feed_speed_m_s = feed_speed_for(machine_, speed_rad_s, chip_load_mm),
          .chip_load_mm = chip_load_mm};
}

Command Profile::commissioning(double time_s) const {
  constexpr std::array kFractions{1.0, 0.85, 1.1, 0.9, 1.05, 0.8};
  const auto step = static_cast<std::size_t>(time_s) % kFractions.size();
  Command command = controlled(time_s, kFractions[step], point_.chip_load_mm);
  command.voltage_v =
      0.05 * point_.voltage_v * binary_signal(mixed(seed_, kSlowVoltageSignal), time_s, 20.0e-3);
  command.force_dither_n = 0.5 * force_scale_n_ * force_noise(seed_, time_s);
  command.contact = is_on(time_s, 0.5, 1.0) ? 0.0 : 1.0;
  return command;
}

Command Profile::production(double time_s) const {
  Command command = controlled(time_s, 1.0, point_.chip_load_mm);
  command.voltage_v =
      0.002 * point_.voltage_v * binary_signal(mixed(seed_, kSlowVoltageSignal), time_s, 20.0e-3);
  command.contact = time_s >= 1.5 * spin_up_s_ ? 1.0 : 0.0;
  return command;
}

Command Profile::cutting(double time_s) const {
  const double progress = time_s / duration_s_;
  Command command =
      controlled(time_s, 1.0, progress < 0.55 ? point_.chip_load_mm : point_.other_chip_load_mm);
  command.contact = progress >= 0.2 && progress < 0.9 ? 1.0 : 0.0;
  return command;
}

Command Profile::step(double time_s) const {
  const double progress = time_s / duration_s_;
  const double height = progress < 0.1 ? 0.0 : 1.0;
  return {.is_speed_controlled = false,
          .voltage_v = height * point_.voltage_v,
          .feed_speed_m_s = height * feed_speed_for(machine_, point_.speed_rad_s, point_.chip_load_mm),
          .contact = progress < 0.5 ? 0.0 : 1.0,
          .chip_load_mm = point_.chip_load_mm};
}

Command Profile::prbs(double time_s) const {
  return {.is_speed_controlled = false,
          .voltage_v = point_.voltage_v * (1.0 + 0.125 * voltage_noise(seed_, time_s)),
          .feed_speed_m_s = feed_speed_for(machine_, point_.speed_rad_s, point_.chip_load_mm),
          .force_dither_n = force_scale_n_ * force_noise(seed_, time_s),
          .contact = is_on(time_s, 0.1, 0.2) ? 0.0 : 1.0,
          .chip_load_mm = point_.chip_load_mm};
}

}  // namespace morepro::host
