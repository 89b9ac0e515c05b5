#include "sim_host/report/live_model.hpp"

#include "lib/gap/feed_observer.hpp"
#include "lib/gap/spindle_observer.hpp"
#include "sim_host/diagnose/fit/noise_fit.hpp"
#include "sim_host/simulate/operating_point.hpp"

namespace morepro::host {
namespace {

constexpr std::size_t kNoTerms = 1;
/// After so many missing rows the state starts from the next measurement.
constexpr std::uint64_t kMostMissing = 200;

using LiveSpindle = gap::SpindleObserver<double, kNoTerms, kMostApplied, kDelaySteps>;
using LiveFeed = gap::FeedObserver<double, kNoTerms, kMostApplied, kDelaySteps>;

gap::GapNoise<double> noise_of(const MonitorConfiguration& c) {
  gap::GapNoise<double> noise = usual_noise(c.sensors);
  noise.speed_step = c.gap.speed_process_noise_rad_s;
  noise.current_step = c.gap.current_process_noise_a;
  noise.feed_step = c.gap.feed_process_noise_m_s;
  return noise;
}

}  // namespace

struct LiveModel::Observers {
  explicit Observers(const MachineDescription& m)
      : period_s(1.0 / m.configuration.sampling.rate_hz),
        has_spindle(m.has_spindle),
        has_feed(m.has_feed),
        spindle(m.configuration.machine, reference_point_of(m.configuration.machine), period_s,
                noise_of(m.configuration)),
        feed(m.configuration.machine, reference_point_of(m.configuration.machine), period_s,
             noise_of(m.configuration)) {
    frame.winding_degc = kUnmeasuredWindingDegc;
    frame.input.engagement = m.configuration.machine.feed.engagement;
    frame.input.chip_load_mm = m.configuration.machine.tool.chip_load_mm;
    frame.input.tool_temperature_degc = m.configuration.machine.thermal.tool_degc;
    for (const gap::AppliedEffect& effect : m.effects) {
      spindle.terms().apply(effect);
      feed.terms().apply(effect);
    }
  }

  /// Inputs hold; what was sampled does not.
  void load(const SensorFrame& from) {
    seen = static_cast<std::uint16_t>(seen | from.present);
    const auto read = [&](Channel channel, double& value) {
      if (from.has(channel)) value = static_cast<double>(from.get(channel));
      return from.has(channel);
    };
    read(Channel::kArmatureVoltage, frame.input.armature_voltage_v);
    read(Channel::kFeedForce, frame.input.feed_force_n);
    read(Channel::kContact, frame.input.contact);
    read(Channel::kEngagement, frame.input.engagement);
    read(Channel::kChipLoad, frame.input.chip_load_mm);
    read(Channel::kToolTemperature, frame.input.tool_temperature_degc);
    read(Channel::kWindingTemperature, frame.winding_degc);
    frame.has_speed = read(Channel::kSpindleSpeed, frame.speed_rad_s);
    frame.has_current = read(Channel::kArmatureCurrent, frame.current_a);
    frame.has_angle = read(Channel::kSpindleAngle, frame.angle_rad);
    frame.has_feed_speed = read(Channel::kFeedSpeed, frame.feed_speed_m_s);
    frame.has_feed_position = read(Channel::kFeedPosition, frame.feed_position_m);
  }

  template <class Row>
  void report(Axis axis, std::size_t sensor, const Row& result, double measured, const OnSample& on_sample) {
    if (!result.is_measured || !(result.variance > 0.0)) return;
    on_sample(axis,
              {.row = row,
               .sensor = sensor,
               .in_contact = frame.input.contact > 0.5,
               .value = result.innovation,
               .variance = result.variance},
              measured);
  }

  void step(const OnSample& on_sample) {
    frame.time_s = static_cast<double>(row) * period_s;
    if (has_spindle && (seen & bit_of(Channel::kArmatureVoltage)) != 0) {
      spindle.step(frame, spindle_rows);
      report(Axis::kSpindle, 0, spindle_rows.speed, frame.speed_rad_s, on_sample);
      report(Axis::kSpindle, 1, spindle_rows.current, frame.current_a, on_sample);
    }
    if (has_feed && (seen & bit_of(Channel::kFeedForce)) != 0) {
      if (!frame.has_angle) frame.angle_rad += frame.speed_rad_s * period_s;
      feed.step(frame, frame.speed_rad_s, frame.angle_rad, feed_rows);
      report(Axis::kFeed, 0, feed_rows.position, frame.feed_position_m, on_sample);
      report(Axis::kFeed, 1, feed_rows.speed, frame.feed_speed_m_s, on_sample);
    }
    frame.cutting_time_s += frame.input.contact * period_s;
    ++row;
  }

  double period_s;
  bool has_spindle;
  bool has_feed;
  std::uint64_t row = 0;
  std::uint16_t seen = 0;
  gap::GapFrame<double> frame;
  LiveSpindle spindle;
  LiveFeed feed;
  LiveSpindle::Rows spindle_rows;
  LiveFeed::Rows feed_rows;
};

LiveModel::LiveModel(const MachineDescription& machine) : observers_(std::make_unique<Observers>(machine)) {}
LiveModel::~LiveModel() = default;

void LiveModel::take(std::uint64_t row, const SensorFrame& frame, const OnSample& on_sample) {
  Observers& o = *observers_;
  if (row > o.row + kMostMissing) {
    o.spindle.restart();
    o.feed.restart();
    o.row = row;
  }
  while (o.row < row) {
    o.load(SensorFrame{});
    o.step(on_sample);
  }
  o.load(frame);
  o.step(on_sample);
}

}  // namespace morepro::host
