#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "lib/gap/feed_observer.hpp"
#include "lib/gap/gap_watch_axis.hpp"
#include "lib/gap/jitter_watch.hpp"
#include "lib/gap/sample_watch.hpp"
#include "lib/gap/spindle_observer.hpp"

namespace morepro::gap {

/// The gap between model and machine, watched on the board: where it lies and which effect causes it, in
/// fixed memory and bounded time. A short stretch of frames is stored; then, a piece per frame, both axes'
/// observers go through it, their rows are worked into the statistics, and these are judged. Then comes the
/// next stretch.
template <class Real>
class GapWatch {
 public:
  using Spindle =
      SpindleObserver<Real, terms_of(kSpindleForms) + MachineForms::kMostParts, 0, kBoardDelaySteps>;
  using Feed = FeedObserver<Real, terms_of(kFeedForms) + MachineForms::kMostParts, 0, kBoardDelaySteps>;
  using SpindleAxis = GapWatchAxis<Real, Spindle, kSpindleParameters, kSpindleForms.size()>;
  using FeedAxis = GapWatchAxis<Real, Feed, kFeedParameters, kFeedForms.size()>;

  /// Frames of a stretch that give a row per axis, of either sensor in turn: those after which the observer's
  /// columns have forgotten how it began.
  static constexpr std::size_t kRowsOfStretch = 128;
  static constexpr std::size_t kSettling = 144;
  static constexpr std::size_t kStretch = kSettling + kRowsOfStretch;
  /// Frames from the beginning of a stretch to that of the next one: long enough for all pieces, all columns
  /// of the rows and the judgement, 8.6 k frames. A stretch of 27 ms every 1.13 s at 10 kHz: more would not
  /// fit beside the monitor.
  static constexpr std::size_t kShortestCycle = 9272;

  /// step_s > 0: sampling interval of the frames. Cold: small instead of fast.
  [[gnu::cold]] GapWatch(const MachineParameters& machine, const ReferencePoint& point, double step_s,
                         const GapSettings& settings)
      : spindle_(machine, point, step_s, noise_of(settings.noise), kSpindleForms,
                 {Real(1), Real(1), Real(1), Real(1), Real(1), Real(1)}, settings.spindle),
        feed_(machine, point, step_s, noise_of(settings.noise), kFeedForms,
              {Real(1), Real(1), load(machine), load(machine)}, settings.feed),
        samples_(settings.samples),
        known_jitter_(square(static_cast<Real>(settings.samples.clock_jitter_s) / static_cast<Real>(step_s))),
        step_s_(static_cast<Real>(step_s)) {}

  /// Is the next frame one of those that are not stored? Then rest() is enough.
  [[nodiscard]] bool is_resting() const { return phase_ >= kStretch; }

  /// One frame; frames follow each other by one interval.
  void step(const GapFrame<Real>& frame) {
    if (frame.has_speed) speed_rad_s_ = frame.speed_rad_s;
    if (frame.has_feed_speed) feed_speed_m_s_ = frame.feed_speed_m_s;
    if (is_resting()) return rest(speed_rad_s_, feed_speed_m_s_, frame.input.contact);
    if (frame.has_angle) angle_rad_ = frame.angle_rad;
    if (frame.has_feed_position && !has_origin_) count_positions_near(frame.feed_position_m);
    stretch_[phase_] = located(frame);
    if (phase_ >= kSettling) samples_.see(stretch_[phase_], stretch_[phase_ - 1], stretch_[phase_ - 2]);
    move_on(frame.input.contact);
  }

  /// The same for a frame that is not stored: `speed_rad_s` and `feed_speed_m_s` as last measured.
  void rest(Real speed_rad_s, Real feed_speed_m_s, Real contact) {
    speed_rad_s_ = speed_rad_s;
    feed_speed_m_s_ = feed_speed_m_s;
    work();
    move_on(contact);
  }

  /// Frames were lost now and then, not by a sensor or a link that is away for a while.
  void count_lost(std::uint32_t frames) { samples_.lose(frames); }

  /// What comes next does not follow what came last: a stretch that has begun begins anew.
  void interrupt() {
    if (!is_resting()) begin_stretch();
  }

  /// What was stored last is not to be trusted: it is not used as far as it was not used yet. No row of a
  /// stretch is used within the first 2 x 144 frames after it.
  void abandon() {
    if (is_resting())
      seen_ = kPieces;
    else
      begin_stretch();
  }

  /// Uses what was stored, at once, and begins a stretch with the next frame: a recording need not wait.
  /// Takes long, not for an interrupt.
  void begin_anew() {
    if (!is_resting()) seen_ = kPieces;
    while (has_rows_to_use()) work();
    begin_stretch();
  }

  /// Does all that waits at once: takes long, not for an interrupt.
  void finish() {
    if (!is_resting()) seen_ = kPieces;
    while (is_busy()) work();
    find();
  }

  /// Takes everything that a watch of the same machine has collected elsewhere; it counts from the next
  /// finding on.
  void merge(const GapWatch& other) {
    spindle_.merge(other.spindle_);
    feed_.merge(other.feed_);
    samples_.merge(other.samples_);
    jitter_.merge(other.jitter_);
  }

  /// The most important one of both axes and the samples.
  [[nodiscard]] const GapFinding& finding() const { return finding_; }
  /// Standard deviation of the sampling instants beside what is known; 0: none is seen.
  [[nodiscard]] Real clock_jitter_s() const { return step_s_ * math::sqrt(jitter_.jitter().variance); }
  [[nodiscard]] const SpindleAxis& spindle() const { return spindle_; }
  [[nodiscard]] const FeedAxis& feed() const { return feed_; }

 private:
  static constexpr std::size_t kPieces = 4 * kStretch;  ///< two halves of each frame for each of two axes
  // The rest is of random length, or a machine that repeats itself would show the same moment of its cycle
  // again and again.
  static constexpr unsigned kRandomRestBits = 12;
  static constexpr Real kTurnRad = Real(6.2831853);

  // Of any sign: values that were fitted without an effect may be of another one.
  static Real load(const MachineParameters& machine) {
    return math::abs(static_cast<Real>(machine.feed.contact_force_n)) +
           math::abs(static_cast<Real>(machine.feed.contact_offset_n));
  }

  static GapNoise<Real> noise_of(const GapNoise<double>& n) {
    GapNoise<Real> noise;
    noise.speed_variance = static_cast<Real>(n.speed_variance);
    noise.current_variance = static_cast<Real>(n.current_variance);
    noise.feed_speed_variance = static_cast<Real>(n.feed_speed_variance);
    noise.feed_position_variance = static_cast<Real>(n.feed_position_variance);
    noise.speed_step = static_cast<Real>(n.speed_step);
    noise.current_step = static_cast<Real>(n.current_step);
    noise.feed_step = static_cast<Real>(n.feed_step);
    return noise;
  }

  GapFrame<Real> located(const GapFrame<Real>& frame) const {
    GapFrame<Real> here = frame;
    here.angle_rad = angle_rad_;
    here.cutting_time_s = step_s_ * static_cast<Real>(cutting_frames_);
    here.speed_rad_s = speed_rad_s_;
    if (!frame.has_feed_position) here.feed_position_m = position_m_;
    return here;
  }

  // From one place for all stretches, of other watches of the machine too, wherever they begin: the screw's
  // turn is the same one then. Not from zero: far from there a float is coarser than a sensor.
  void count_positions_near(Real position_m) {
    constexpr Real kTurns = 64;
    constexpr Real kFewCells = 1.0e6;  // as whole numbers and as floats
    const Real turn_rad_m = feed_.observer().terms().scales().per_screw_turn_rad_m;
    const Real cell_m = turn_rad_m > Real(0) ? kTurns * kTurnRad / turn_rad_m : Real(0.5);
    const Real cells = position_m / cell_m;
    const bool is_near = math::abs(cells) < kFewCells;
    feed_.observer().count_positions_from(is_near ? cell_m * static_cast<Real>(static_cast<int>(cells))
                                                  : position_m);
    has_origin_ = true;
  }

  [[nodiscard]] bool has_rows_to_use() const {
    return seen_ < kPieces || spindle_.is_turning() || feed_.is_turning();
  }
  [[nodiscard]] bool is_busy() const {
    return has_rows_to_use() || spindle_.is_unjudged() || feed_.is_unjudged();
  }

  /// One piece of what is to be done.
  void work() {
    if (spindle_.is_turning()) return spindle_.turn();
    if (feed_.is_turning()) return feed_.turn();
    if (seen_ < kPieces) return observe(seen_++);
    if (spindle_.is_unjudged()) return find_if(spindle_.judge());
    if (feed_.is_unjudged()) find_if(feed_.judge());
  }

  void observe(std::size_t piece) {
    const std::size_t index = piece % (2 * kStretch) / 2;
    const bool is_spindle = piece < 2 * kStretch;
    const bool is_second_half = piece % 2 != 0;
    const GapFrame<Real>& frame = stretch_[index];
    if (is_second_half)
      return is_spindle ? move_on(spindle_.observer(), frame) : move_on(feed_.observer(), frame);
    if (is_spindle)
      see_spindle(frame, index);
    else
      see_feed(frame, index);
  }

  void see_spindle(const GapFrame<Real>& frame, std::size_t index) {
    if (index == 0) spindle_.observer().restart();
    auto& [speed, current] = spindle_rows_;
    spindle_.observer().see(frame, spindle_rows_);
    see_jitter(index, 0, speed);
    see_jitter(index, 1, current);
    if (index >= kSettling) spindle_.take(index % 2 == 0 ? speed : current, index % 2 == 0 ? current : speed);
  }

  void see_feed(const GapFrame<Real>& frame, std::size_t index) {
    if (index == 0) feed_.observer().restart();
    auto& [position, speed] = feed_rows_;
    feed_.observer().see(frame, frame.speed_rad_s, frame.angle_rad, feed_rows_);
    see_jitter(index, 2, position);
    see_jitter(index, 3, speed);
    if (index >= kSettling) feed_.take(index % 2 == 0 ? speed : position, index % 2 == 0 ? position : speed);
  }

  /// What the states change by up to the next sample, as the model tells it: the sample itself knows nothing
  /// of that.
  template <class Observer>
  void move_on(Observer& observer, const GapFrame<Real>& frame) {
    const std::array<Real, 2> before{observer.state(0), observer.state(1)};
    observer.move_on(frame);
    rate_ = {observer.state(0) - before[0], observer.state(1) - before[1]};
  }

  /// `sensor`: of either axis in its observer's order. A jitter that is known is a part of the noise.
  template <class Row>
  void see_jitter(std::size_t index, std::size_t sensor, Row& row) {
    if (index == kSettling) jitter_.interrupt();
    if (index >= kSettling && row.is_measured)
      row.variance = see_jitter(sensor, row.innovation, row.variance);
  }
  /// Returns the variance with what is known of it.
  [[gnu::noinline, gnu::cold]] Real see_jitter(std::size_t sensor, Real innovation, Real variance) {
    constexpr Real kDeviations = 6;
    constexpr std::size_t kPosition = 2;
    const Real rate = rate_[sensor % 2];
    variance += known_jitter_ * rate * rate;
    const Real most = kDeviations * math::sqrt(variance);
    jitter_.see(sensor, {.innovation = innovation,
                         .variance = variance,
                         .rate = rate,
                         .most = sensor == kPosition ? std::max(most, math::abs(rate)) : most});
    return variance;
  }

  static Real square(Real x) { return x * x; }

  void move_on(Real contact) {
    if (contact > Real(0.5)) ++cutting_frames_;
    angle_rad_ += step_s_ * speed_rad_s_;
    if (math::abs(angle_rad_) > kTurnRad) angle_rad_ -= angle_rad_ > Real(0) ? kTurnRad : -kTurnRad;
    position_m_ += step_s_ * feed_speed_m_s_;
    if (++phase_ < cycle_) return;
    random_ = random_ * 1664525U + 1013904223U;
    cycle_ = kShortestCycle + (random_ >> (32U - kRandomRestBits));
    begin_stretch();
  }

  [[gnu::noinline, gnu::cold]] void begin_stretch() {
    samples_.count(phase_);
    samples_.end();
    phase_ = seen_ = 0;
  }

  void find_if(bool is_new) {
    if (is_new) find();
  }

  void find() {
    const auto& a = spindle_.evaluation();
    const auto& b = feed_.evaluation();
    const bool is_feed = a.finding().verdict != b.finding().verdict
                             ? b.finding().verdict > a.finding().verdict
                             : b.surplus() > a.surplus();
    finding_ = is_feed ? b.finding() : a.finding();
    consider(samples_.finding());
    consider(jitter_.finding());
  }

  [[gnu::noinline, gnu::cold]] void consider(const GapFinding& fault) {
    const bool is_lesser = finding_.verdict < fault.verdict || finding_.evidence < fault.evidence;
    if (fault.verdict == GapVerdict::kEffect && is_lesser) finding_ = fault;
  }

  SpindleAxis spindle_;
  FeedAxis feed_;
  SampleWatch<Real> samples_;
  JitterWatch<Real> jitter_;
  std::array<Real, 2> rate_{};  ///< of an axis's states, per interval
  Real known_jitter_;           ///< variance, in intervals
  std::array<GapFrame<Real>, kStretch> stretch_{};
  typename Spindle::Rows spindle_rows_{};
  typename Feed::Rows feed_rows_{};
  GapFinding finding_;
  Real step_s_;
  Real speed_rad_s_ = 0;
  Real feed_speed_m_s_ = 0;
  Real angle_rad_ = 0;
  Real position_m_ = 0;
  bool has_origin_ = false;
  std::uint32_t cutting_frames_ = 0;
  std::uint32_t random_ = 1;
  std::size_t cycle_ = kShortestCycle;
  std::size_t phase_ = 0;
  std::size_t seen_ = 0;  ///< pieces of the stretch
};

}  // namespace morepro::gap
