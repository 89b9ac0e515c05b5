#include <cstdint>

#include "lib/gap/gap_watch.hpp"
#include "lib/plant/built_in_machines.hpp"
#include "tests/target/count/count.hpp"

namespace morepro::count {
namespace {

gap::GapFrame<float> frame;

/// A cut that swings a little, with a deterministic noise of one and 0.05 units.
void next_frame() {
  static std::uint32_t random = 1;
  const auto noise = [] {
    random = random * 1664525U + 1013904223U;
    return static_cast<float>(static_cast<std::int32_t>(random)) * 8.0e-10F;
  };
  frame.input = {48.0F + noise(), 26.0F + noise(), 1.0F, 1.0F, 0.05F, 500.0F};
  frame.winding_degc = 30.0F;
  frame.speed_rad_s = 577.7F + noise();
  frame.current_a = 2.226F + 0.05F * noise();
  frame.feed_speed_m_s = 0.02F + 0.002F * noise();
  frame.has_speed = frame.has_current = frame.has_feed_speed = true;
}

constexpr gap::ReferencePoint kPoint{577.0, 2.2, 0.02, 0.05, 500.0};
constexpr gap::GapSettings kSettings{
    .noise = {1.0, 0.0025, 4.0e-6, 1.0e-12, 1.0e30, 0.01, 0.0005, 2.0e-5}, .spindle = {}, .feed = {}};

/// A cycle takes about 11,300 frames: the 2000 counted calls see five of them.
constexpr std::uint32_t kFramesPerCall = 28;

gap::GapWatch<float>& watch() {
  static gap::GapWatch<float> the_watch(reference_machine(), kPoint, 1.0e-4, kSettings);
  return the_watch;
}

void step_watch_once() {
  if (watch().is_resting())
    watch().rest(frame.speed_rad_s, frame.feed_speed_m_s, frame.input.contact);
  else
    watch().step(frame);
}

void step_watch() {
  for (std::uint32_t i = 0; i < kFramesPerCall; ++i) step_watch_once();
}

const Entry kStep{"gap_watch_step", kFramesPerCall, next_frame, step_watch};
const Entry kOneStep{"gap_watch_one_step", 1, next_frame, step_watch_once};

}  // namespace
}  // namespace morepro::count
