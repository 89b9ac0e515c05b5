#include "sim_host/diagnose/fit/innovation_pass.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "lib/gap/feed_observer.hpp"
#include "lib/gap/spindle_observer.hpp"
#include "sim_host/diagnose/fit/bristle_lead.hpp"
#include "sim_host/diagnose/fit/interval_parts.hpp"
#include "sim_host/diagnose/signals/current_drive.hpp"
#include "sim_host/support/tiny_numbers.hpp"

namespace morepro::host {
namespace {

/// An observer for so many terms and effects. Most passes are over a model with few effects, without
/// candidates: the smaller one stays in the cache.
template <std::size_t kTerms, std::size_t kApplied>
using Spindle = gap::SpindleObserver<double, kTerms, kApplied, kDelaySteps>;
template <std::size_t kTerms, std::size_t kApplied>
using Feed = gap::FeedObserver<double, kTerms, kApplied, kDelaySteps>;

constexpr std::size_t kFewTerms = 16;
constexpr std::size_t kFewApplied = 4;

std::span<const gap::EffectForm> forms_of(const Disturbances* disturbances) {
  return disturbances == nullptr ? std::span<const gap::EffectForm>{} : disturbances->forms;
}

bool is_small(const GapModel& model, const Disturbances* disturbances) {
  std::size_t terms = 0;
  for (const gap::EffectForm& form : forms_of(disturbances)) terms += form.parts;
  return terms <= kFewTerms && model.known.size() + model.effects.size() <= kFewApplied;
}

/// Speed and angle of the spindle as its sensors show them: what the feed's effects need of it.
struct SpindleMotion {
  explicit SpindleMotion(const RecordingSignals& signals)
      : is_followed(!signals.turned_rad.empty()), period_s(1.0 / signals.rate_hz) {}
  void take(const gap::GapFrame<double>& frame) {
    if (frame.has_speed) speed_rad_s = frame.speed_rad_s;
    const bool is_told = frame.has_angle || is_followed;
    angle_rad = is_told ? frame.angle_rad : angle_rad + speed_rad_s * period_s;
  }
  bool is_followed;
  double period_s;
  double speed_rad_s = 0.0;
  double angle_rad = 0.0;
};

/// The frame of an instant at which nothing is sampled.
gap::GapFrame<double> unseen(gap::GapFrame<double> frame, double later_s) {
  frame.has_speed = frame.has_current = frame.has_angle = frame.has_feed_speed = frame.has_feed_position =
      false;
  frame.time_s += later_s;
  return frame;
}

/// What an observer is told where an interval is integrated in so many parts.
struct PartOfInterval {
  MachineParameters machine;
  gap::GapNoise<double> noise;
  double step_s;

  PartOfInterval(const RecordingSignals& signals, const GapModel& model, std::size_t parts)
      : machine(model.machine),
        noise(model.noise),
        step_s(1.0 / (static_cast<double>(parts) * signals.rate_hz)) {
    if (signals.is_current_driven) {
      CurrentSource source = current_source(machine, noise);
      machine = source.machine;
      noise = source.noise;
    }
    const double root = std::sqrt(static_cast<double>(parts));
    noise.speed_step /= root;
    noise.current_step /= root;
    noise.feed_step /= root;
  }
};

/// Without disturbances there are no columns either. An interval has so many `parts`.
template <class Observer>
std::unique_ptr<Observer> make(const RecordingSignals& signals, const GapModel& model,
                               const Disturbances* disturbances, std::size_t parts = 1) {
  const PartOfInterval part(signals, model, parts);
  auto observer = std::make_unique<Observer>(part.machine, model.point, part.step_s, part.noise);
  if (disturbances == nullptr) observer->leave_out_columns();
  const auto apply = [&] {
    for (const gap::AppliedEffect& effect : model.known) observer->terms().apply(effect);
    for (const gap::AppliedEffect& effect : model.effects) observer->terms().apply(effect);
  };
  const bool are_compared = disturbances != nullptr && disturbances->are_compared;
  if (are_compared) apply();
  for (std::size_t i = 0; disturbances != nullptr && i < disturbances->forms.size(); ++i)
    observer->terms().add(disturbances->forms[i],
                          disturbances->onset_s.empty() ? 0.0 : disturbances->onset_s[i]);
  if (!are_compared) apply();
  observer->terms().look_back([&signals](double time_s) { return signals.cutting_time_at(time_s); });
  return observer;
}

template <class Row>
void report(const Row& row, std::size_t columns, Innovation& innovation, const OnInnovation& on_innovation) {
  if (!row.is_measured) return;
  innovation.value = row.innovation;
  innovation.variance = row.variance;
  innovation.columns = std::span(row.column).first(columns);
  on_innovation(innovation);
}

template <class Observer>
void run_spindle(const RecordingSignals& signals, const GapModel& model, const Disturbances* disturbances,
                 std::size_t first, std::size_t last, const OnInnovation& on_innovation) {
  const IntervalParts interval(Axis::kSpindle, signals, model, forms_of(disturbances));
  std::size_t parts = interval.most();
  const auto observer = make<Observer>(signals, model, disturbances, parts);
  const auto rows = std::make_unique<typename Observer::Rows>();
  const std::size_t columns = disturbances != nullptr ? observer->columns() : 0;
  FrameSource frames(signals, model.machine, lead_of_bristles(Axis::kSpindle, signals, model, first));
  while (frames.row() < last) {
    Innovation innovation{.row = frames.row()};
    const auto frame = frames.next();
    innovation.in_contact = frame.input.contact != 0.0;
    if (frames.has_lost_track()) observer->restart();
    observer->see(frame, *rows);
    if (innovation.row >= first) {
      innovation.sensor = 0;
      report(rows->speed, columns, innovation, on_innovation);
      innovation.sensor = 1;
      if (!signals.is_current_driven) report(rows->current, columns, innovation, on_innovation);
    }
    if (const std::size_t now = interval.at(observer->speed_rad_s()); now != parts) {
      parts = now;
      const PartOfInterval part(signals, model, parts);
      observer->change_step(part.step_s, part.noise);
      if (parts == 1) observer->spread_noise(interval.most());
    }
    const double part_s = 1.0 / (static_cast<double>(parts) * signals.rate_hz);
    // All parts of an interval share one input: what is not known of it adds up.
    const double lost = frames.has_lost_inputs() ? static_cast<double>(parts) * signals.lost_voltage_v2 : 0.0;
    observer->move_on(frame);
    observer->blur_input(lost);
    for (std::size_t i = 1; i < parts; ++i) {
      observer->step(unseen(frame, static_cast<double>(i) * part_s), *rows);
      observer->blur_input(lost);
    }
  }
}

template <class Observer>
void run_feed(const RecordingSignals& signals, const GapModel& model, const Disturbances* disturbances,
              std::size_t first, std::size_t last, const OnInnovation& on_innovation) {
  const std::size_t parts = IntervalParts(Axis::kFeed, signals, model, {}).most();
  const double part_s = 1.0 / (static_cast<double>(parts) * signals.rate_hz);
  const auto observer = make<Observer>(signals, model, disturbances, parts);
  const auto rows = std::make_unique<typename Observer::Rows>();
  const std::size_t columns = disturbances != nullptr ? observer->columns() : 0;
  observer->count_positions_from(signals.first_position_m());
  FrameSource frames(signals, model.machine, lead_of_bristles(Axis::kFeed, signals, model, first));
  SpindleMotion spindle(signals);
  while (frames.row() < last) {
    Innovation innovation{.row = frames.row()};
    const auto frame = frames.next();
    innovation.in_contact = frame.input.contact != 0.0;
    spindle.take(frame);
    if (frames.has_lost_track()) observer->restart();
    observer->step(frame, spindle.speed_rad_s, spindle.angle_rad, *rows);
    if (innovation.row >= first) {
      innovation.sensor = 0;
      report(rows->position, columns, innovation, on_innovation);
      innovation.sensor = 1;
      report(rows->speed, columns, innovation, on_innovation);
    }
    const double lost = frames.has_lost_inputs() ? static_cast<double>(parts) * signals.lost_force_n2 : 0.0;
    observer->blur_input(lost);
    for (std::size_t i = 1; i < parts; ++i) {
      observer->step(unseen(frame, static_cast<double>(i) * part_s), spindle.speed_rad_s, spindle.angle_rad,
                     *rows);
      observer->blur_input(lost);
    }
  }
}

void run(Axis axis, const RecordingSignals& signals, const GapModel& model, const Disturbances* disturbances,
         std::size_t first, std::size_t last, const OnInnovation& on_innovation) {
  const NoTinyNumbers guard;
  const bool is_spindle = axis == Axis::kSpindle;
  const auto small =
      is_spindle ? run_spindle<Spindle<kFewTerms, kFewApplied>> : run_feed<Feed<kFewTerms, kFewApplied>>;
  const auto large =
      is_spindle ? run_spindle<Spindle<kMostTerms, kMostApplied>> : run_feed<Feed<kMostTerms, kMostApplied>>;
  (is_small(model, disturbances) ? small : large)(signals, model, disturbances, first, last, on_innovation);
}

}  // namespace

EffectTrace trace_effects(Axis axis, const RecordingSignals& signals, const GapModel& model) {
  if (model.known.empty() && model.effects.empty()) return [] { return EffectsOfRow{}; };
  FrameSource frames(signals, model.machine, 0);
  if (axis == Axis::kSpindle) {
    using Observer = Spindle<0, kMostApplied>;
    const std::shared_ptr<Observer> observer = make<Observer>(signals, model, nullptr);
    return [observer, frames, rows = typename Observer::Rows{}]() mutable {
      const auto frame = frames.next();
      if (frames.has_lost_track()) observer->restart();
      observer->step(frame, rows);
      return EffectsOfRow{observer->added(), observer->shown()};
    };
  }
  using Observer = Feed<0, kMostApplied>;
  const std::shared_ptr<Observer> observer = make<Observer>(signals, model, nullptr);
  return [observer, frames, rows = typename Observer::Rows{}, spindle = SpindleMotion(signals)]() mutable {
    const auto frame = frames.next();
    spindle.take(frame);
    if (frames.has_lost_track()) observer->restart();
    observer->step(frame, spindle.speed_rad_s, spindle.angle_rad, rows);
    return EffectsOfRow{observer->added(), observer->shown()};
  };
}

std::size_t parameter_count(Axis axis) {
  return axis == Axis::kSpindle ? gap::kSpindleParameters : gap::kFeedParameters;
}

void run_observer(Axis axis, const RecordingSignals& signals, const GapModel& model, std::size_t first,
                  std::size_t last, const OnInnovation& on_innovation) {
  run(axis, signals, model, nullptr, first, last, on_innovation);
}

void run_observer(Axis axis, const RecordingSignals& signals, const GapModel& model,
                  const Disturbances& disturbances, std::size_t first, std::size_t last,
                  const OnInnovation& on_innovation) {
  run(axis, signals, model, &disturbances, first, last, on_innovation);
}

}  // namespace morepro::host
