#include "sim_host/boards/simulated_board.hpp"

#include <gtest/gtest.h>

namespace morepro::host {
namespace {

constexpr std::uint32_t kFrames = 100'000;

SimulatedBoard::FrameSource counting(std::uint32_t count) {
  return [next = 0U, count](SensorFrame& frame) mutable {
    frame.sequence = next;
    return next++ < count;
  };
}

struct Seen {
  std::uint32_t frames = 0, corrupt = 0, nothing = 0, repeated = 0, backwards = 0;
};

Seen run(LinkFaults faults) {
  SimulatedBoard board(
      counting(kFrames), [](auto) {}, faults);
  Seen seen;
  SensorFrame frame;
  for (std::int64_t last = -1;;) {
    const hal::ReadStatus status = board.read_frame(frame);
    if (status == hal::ReadStatus::kEnd) return seen;
    if (status == hal::ReadStatus::kCorrupt) ++seen.corrupt;
    if (status == hal::ReadStatus::kNothing) ++seen.nothing;
    if (status != hal::ReadStatus::kFrame) continue;
    ++seen.frames;
    seen.repeated += frame.sequence == last;
    seen.backwards += frame.sequence < last;
    last = frame.sequence;
  }
}

/// Four standard deviations of a share of 10 % over 100,000 frames are 380.
constexpr double kExpected = 0.1 * kFrames;
constexpr double kFourSigma = 400;

TEST(SimulatedBoard, PassesEveryFrameOnOverAGoodLink) {
  const Seen seen = run({});
  EXPECT_EQ(seen.frames, kFrames);
  EXPECT_EQ(seen.corrupt + seen.nothing + seen.repeated + seen.backwards, 0U);
}

TEST(SimulatedBoard, DropsTheShareThatWasAsked) {
  const Seen seen = run({.drop = 0.1});
  EXPECT_NEAR(seen.nothing, kExpected, kFourSigma);
  EXPECT_EQ(seen.frames + seen.nothing, kFrames);
}

TEST(SimulatedBoard, CorruptsTheShareThatWasAsked) {
  const Seen seen = run({.corrupt = 0.1});
  EXPECT_NEAR(seen.corrupt, kExpected, kFourSigma);
  EXPECT_EQ(seen.frames + seen.corrupt, kFrames);
}

TEST(SimulatedBoard, DuplicatesTheShareThatWasAsked) {
  const Seen seen = run({.duplicate = 0.1});
  EXPECT_NEAR(seen.repeated, kExpected, kFourSigma);
  EXPECT_EQ(seen.frames, kFrames + seen.repeated);
}

TEST(SimulatedBoard, ReordersWithoutLosingAnything) {
  const Seen seen = run({.reorder = 0.1});
  EXPECT_NEAR(seen.backwards, kExpected / 1.1, kFourSigma);  // a pair takes two frames of one draw
  EXPECT_EQ(seen.frames, kFrames);
}

TEST(SimulatedBoard, FailsTheSameWayForTheSameSeed) {
  const LinkFaults faults{.drop = 0.1, .duplicate = 0.1, .reorder = 0.1, .corrupt = 0.1, .seed = 5};
  const Seen first = run(faults), second = run(faults);
  EXPECT_EQ(first.frames, second.frames);
  EXPECT_EQ(first.backwards, second.backwards);
}

}  // namespace
}  // namespace morepro::host
