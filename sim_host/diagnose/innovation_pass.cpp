#include "sim_host/diagnose/innovation_pass.hpp"

#include <memory>

#include "lib/gap/feed_observer.hpp"
#include "lib/gap/spindle_observer.hpp"
#include "sim_host/support/tiny_numbers.hpp"

namespace morepro::host {
namespace {

using Spindle = gap::SpindleObserver<double, kMostTerms, kMostApplied, kDelaySteps>;
using Feed = gap::FeedObserver<double, kMostTerms, kMostApplied, kDelaySteps>;

/// Speed and angle of the spindle as its sensors show them: what the feed's effects need of it.
struct SpindleMotion {
  explicit SpindleMotion(double rate_hz) : period_s(1.0 / rate_hz) {}
  void take(const gap::GapFrame<double>& frame) {
    if (frame.has_speed) speed_rad_s = frame.speed_rad_s;
    angle_rad = frame.has_angle ? frame.angle_rad : angle_rad + speed_rad_s * period_s;
  }
  double period_s;
  double speed_rad_s = 0.0;
  double angle_rad = 0.0;
};

template <class Observer>
std::unique_ptr<Observer> make(const RecordingSignals& signals, const GapModel& model,
                               const Disturbances& disturbances) {
  auto observer = std::make_unique<Observer>(model.machine, model.point, 1.0 / signals.rate_hz, model.noise);
  for (std::size_t i = 0; i < disturbances.forms.size(); ++i)
    observer->terms().add(disturbances.forms[i],
                          disturbances.onset_s.empty() ? 0.0 : disturbances.onset_s[i]);
  for (const gap::AppliedEffect& effect : model.known) observer->terms().apply(effect);
  for (const gap::AppliedEffect& effect : model.effects) observer->terms().apply(effect);
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

void run_spindle(const RecordingSignals& signals, const GapModel& model, const Disturbances& disturbances,
                 std::size_t first, std::size_t last, const OnInnovation& on_innovation) {
  const auto observer = make<Spindle>(signals, model, disturbances);
  const auto rows = std::make_unique<Spindle::Rows>();
  const std::size_t columns = gap::kSpindleParameters + observer->terms().size();
  FrameSource frames(signals, model.machine, first);
  while (frames.row() < last) {
    Innovation innovation{.row = frames.row()};
    const auto frame = frames.next();
    innovation.in_contact = frame.input.contact != 0.0;
    observer->step(frame, *rows);
    innovation.sensor = 0;
    report(rows->speed, columns, innovation, on_innovation);
    innovation.sensor = 1;
    report(rows->current, columns, innovation, on_innovation);
  }
}

void run_feed(const RecordingSignals& signals, const GapModel& model, const Disturbances& disturbances,
              std::size_t first, std::size_t last, const OnInnovation& on_innovation) {
  const auto observer = make<Feed>(signals, model, disturbances);
  const auto rows = std::make_unique<Feed::Rows>();
  const std::size_t columns = gap::kFeedParameters + observer->terms().size();
  FrameSource frames(signals, model.machine, first);
  SpindleMotion spindle(signals.rate_hz);
  while (frames.row() < last) {
    Innovation innovation{.row = frames.row()};
    const auto frame = frames.next();
    innovation.in_contact = frame.input.contact != 0.0;
    spindle.take(frame);
    observer->step(frame, spindle.speed_rad_s, spindle.angle_rad, *rows);
    innovation.sensor = 0;
    report(rows->position, columns, innovation, on_innovation);
    innovation.sensor = 1;
    report(rows->speed, columns, innovation, on_innovation);
  }
}

}  // namespace

EffectTrace trace_effects(Axis axis, const RecordingSignals& signals, const GapModel& model) {
  EffectTrace trace;
  const auto keep = [&trace](const auto& observer) {
    trace.added.push_back(observer.added());
    trace.shown.push_back(observer.shown());
  };
  FrameSource frames(signals, model.machine, 0);
  if (axis == Axis::kSpindle) {
    const auto observer = make<Spindle>(signals, model, {});
    const auto rows = std::make_unique<Spindle::Rows>();
    for (std::size_t i = 0; i < signals.rows; ++i, keep(*observer)) observer->step(frames.next(), *rows);
  } else {
    const auto observer = make<Feed>(signals, model, {});
    const auto rows = std::make_unique<Feed::Rows>();
    SpindleMotion spindle(signals.rate_hz);
    for (std::size_t i = 0; i < signals.rows; ++i, keep(*observer)) {
      const auto frame = frames.next();
      spindle.take(frame);
      observer->step(frame, spindle.speed_rad_s, spindle.angle_rad, *rows);
    }
  }
  return trace;
}

std::size_t parameter_count(Axis axis) {
  return axis == Axis::kSpindle ? gap::kSpindleParameters : gap::kFeedParameters;
}

void run_observer(Axis axis, const RecordingSignals& signals, const GapModel& model,
                  const Disturbances& disturbances, std::size_t first, std::size_t last,
                  const OnInnovation& on_innovation) {
  const NoTinyNumbers guard;
  const auto run = axis == Axis::kSpindle ? run_spindle : run_feed;
  run(signals, model, disturbances, first, last, on_innovation);
}

}  // namespace morepro::host
