#include <cstdint>

#include "lib/gap/gap_watch.hpp"
#include "lib/plant/built_in_machines.hpp"
#include "tests/target/count/count.hpp"

namespace morepro::count {
namespace {

using Watch = gap::GapWatch<float>;

Watch* watch = nullptr;
gap::GapFrame<float> frame;

constexpr gap::ReferencePoint kPoint{577.0, 2.2, 0.02, 0.05, 500.0};
constexpr gap::GapSettings kSettings{
    .noise = {1.0, 0.0025, 4.0e-6, 1.0e-12, 1.0e30, 0.01, 0.0005, 2.0e-5}, .spindle = {}, .feed = {}};

/// A cut that swings a little, with a deterministic noise of one and 0.05 units.
void next_frame() {
  watch = InTurn<Watch>::get(reference_machine(), kPoint, 1.0e-4, kSettings);
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

/// A cycle takes about 11,300 frames: five of them.
constexpr std::uint32_t kManyFrames = 56000;

void step_watch() {
  if (watch->is_resting())
    watch->rest(frame.speed_rad_s, frame.feed_speed_m_s, frame.input.contact);
  else
    watch->step(frame);
}

const Entry kStep{"gap_watch_step", 1, next_frame, step_watch, kManyFrames};

}  // namespace
}  // namespace morepro::count
