#pragma once
#include <array>
#include <cstdint>
#include <string_view>

#include "lib/plant/machine_parameters.hpp"
#include "sim_host/simulate/operating_point.hpp"

namespace morepro::host {

/// rich: voltage and force dither, contact on and off, reversals, several speeds, one of them slow and
/// without contact, steps of chip load and engagement: what identification and diagnosis want. commissioning:
/// speed steps under control with moderate dither. production: one long cut, hardly any dither. cutting: spin
/// up, contact, a change of the chip load during the cut, contact off. step: from rest one step of voltage
/// and feed, later one of the contact, between them nothing changes: what the thesis identifies from. prbs:
/// two binary noises on the voltage, one on the force, contact on and off, about one speed. All but rich run
/// forward; after each minute the table returns within five seconds, without contact.
enum class ProfileKind : std::uint8_t { kRich, kCommissioning, kProduction, kCutting, kStep, kPrbs };

inline constexpr std::array<std::string_view, 6> kProfileNames{"rich",    "commissioning", "production",
                                                               "cutting", "step",          "prbs"};

/// What the machine is asked for at one instant.
struct Command {
  bool is_speed_controlled = true;  ///< otherwise voltage_v is applied as it is
  double speed_rad_s = 0.0;
  double voltage_v = 0.0;  ///< added to the speed controller's output where that is in charge
  double feed_speed_m_s = 0.0;
  double force_dither_n = 0.0;
  double contact = 0.0;
  double chip_load_mm = 0.0;
  double engagement = 1.0;  ///< of the machine's
};

/// The commands of one run as a function of time.
class Profile {
 public:
  Profile(ProfileKind kind, const MachineParameters& machine, double duration_s, std::uint64_t seed);

  [[nodiscard]] Command at(double time_s) const;
  [[nodiscard]] const OperatingPoint& operating_point() const { return point_; }

 private:
  [[nodiscard]] Command asked(double time_s) const;
  [[nodiscard]] Command rich(double time_s) const;
  [[nodiscard]] double stepped_chip_load(double time_s) const;
  [[nodiscard]] Command commissioning(double time_s) const;
  [[nodiscard]] Command production(double time_s) const;
  [[nodiscard]] Command cutting(double time_s) const;
  [[nodiscard]] Command step(double time_s) const;
  [[nodiscard]] Command prbs(double time_s) const;
  [[nodiscard]] Command controlled(double time_s, double speed_fraction, double chip_load_mm) const;

  ProfileKind kind_;
  MachineParameters machine_;
  OperatingPoint point_;
  double duration_s_;
  double spin_up_s_;
  double force_scale_n_;
  std::uint64_t seed_;
};

}  // namespace morepro::host
