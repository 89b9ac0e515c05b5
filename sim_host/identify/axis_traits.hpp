#pragma once
#include <array>
#include <cmath>
#include <cstddef>

#include "lib/gap/gap_frame.hpp"
#include "lib/identification/excitation.hpp"
#include "lib/identification/feed_parameter_filter.hpp"
#include "lib/identification/spindle_parameter_filter.hpp"
#include "lib/monitor/monitor_configuration.hpp"
#include "sim_host/identify/machine_value.hpp"

namespace morepro::host {

/// Standard deviation of a datasheet's values, relative: a factor of two either way is no surprise.
inline constexpr double kDatasheetFraction = 0.7;

constexpr double datasheet_fraction(MachineValue value) {
  return is_friction(value) ? AnchoredWithFriction::kFrictionFraction : kDatasheetFraction;
}

/// What the passes over a recording need to know of the spindle's filter: measured elements 0 speed, 1
/// current.
struct SpindleTraits {
  template <class Mode>
  using Filter = SpindleParameterFilter<double, Mode>;
  using Name = SpindleParameter;
  /// In the filter's order.
  static constexpr std::array kValues{MachineValue::kTorqueConstant,  MachineValue::kInertia,
                                      MachineValue::kInductance,      MachineValue::kResistance,
                                      MachineValue::kBackEmfConstant, MachineValue::kSpindleFriction};

  explicit SpindleTraits(const MonitorConfiguration& c)
      : law(c.machine),
        variance{c.sensors[Channel::kSpindleSpeed].variance(),
                 c.sensors[Channel::kArmatureCurrent].variance()} {}

  static std::array<bool, 2> measured(const gap::GapFrame<double>& frame) {
    return {frame.has_speed, frame.has_current};
  }
  /// A state may start from this frame.
  static bool is_complete(const gap::GapFrame<double>& frame) { return frame.has_speed && frame.has_current; }

  SpindleMeasurement<double> measurement(const gap::GapFrame<double>& frame) const {
    return {frame.speed_rad_s, frame.current_a, frame.has_speed ? variance[0] : double(kUnmeasured),
            frame.has_current ? variance[1] : double(kUnmeasured)};
  }

  template <class Mode>
  void predict(Filter<Mode>& filter, const PlantInput<double>& u,
               const std::array<double, 2>& process) const {
    filter.predict({u.armature_voltage_v, u.contact, law.thermal_factor(u.tool_temperature_degc)},
                   u.chip_load_mm, process[0], process[1]);
  }

  /// Does something move that a filter may learn from?
  struct Motion {
    explicit Motion(const gap::GapFrame<double>& rest) : speed(rest.speed_rad_s), current(rest.current_a) {}
    void take(const SpindleTraits& traits, const gap::GapFrame<double>& frame) {
      speed.step(frame.speed_rad_s, std::sqrt(traits.variance[0]));
      current.step(frame.current_a, std::sqrt(traits.variance[1]));
    }
    [[nodiscard]] bool is_moving() const { return !(speed.is_at_rest() && current.is_at_rest()); }

    RestDetector<double> speed, current;
  };

  ContactLaw<double> law;
  std::array<double, 2> variance;
};

/// The same of the feed axis: measured elements 0 position, 1 speed.
struct FeedTraits {
  template <class Mode>
  using Filter = FeedParameterFilter<double, Mode>;
  using Name = FeedParameter;
  static constexpr std::array kValues{MachineValue::kMass, MachineValue::kContactForce,
                                      MachineValue::kFeedFriction};

  explicit FeedTraits(const MonitorConfiguration& c)
      : variance{c.sensors[Channel::kFeedPosition].variance(), c.sensors[Channel::kFeedSpeed].variance()} {}

  static std::array<bool, 2> measured(const gap::GapFrame<double>& frame) {
    return {frame.has_feed_position, frame.has_feed_speed};
  }
  static bool is_complete(const gap::GapFrame<double>& frame) {
    return frame.has_feed_position || frame.has_feed_speed;
  }

  FeedMeasurement<double> measurement(const gap::GapFrame<double>& frame) const {
    return {frame.feed_speed_m_s, frame.feed_position_m,
            frame.has_feed_speed ? variance[1] : double(kUnmeasured),
            frame.has_feed_position ? variance[0] : double(kUnmeasured)};
  }

  template <class Mode>
  static void predict(Filter<Mode>& filter, const PlantInput<double>& u,
                      const std::array<double, 2>& process) {
    filter.predict({u.feed_force_n, u.contact, u.engagement}, process[1]);
  }

  struct Motion {
    explicit Motion(const gap::GapFrame<double>& rest)
        : force(rest.input.feed_force_n), contact(rest.input.contact), path(way(rest)) {}
    void take(const FeedTraits& traits, const gap::GapFrame<double>& frame) {
      force.step(frame.input.feed_force_n, kForceBand);
      contact.step(frame.input.contact, kContactBand);
      path.step(way(frame), std::sqrt(traits.variance[frame.has_feed_speed ? 1 : 0]));
    }
    [[nodiscard]] bool is_moving() const {
      return !(force.is_at_rest() && contact.is_at_rest() && path.is_at_rest());
    }

    static constexpr double kForceBand = 0.05;  // N
    static constexpr double kContactBand = 0.01;
    RestDetector<double> force, contact, path;

   private:
    static double way(const gap::GapFrame<double>& frame) {
      return frame.has_feed_speed ? frame.feed_speed_m_s : frame.feed_position_m;
    }
  };

  std::array<double, 2> variance;
};

}  // namespace morepro::host
