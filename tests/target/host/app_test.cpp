#include "firmware/app.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "sim_host/boards/simulated_board.hpp"

namespace morepro::firmware {
namespace {

using host::SimulatedBoard;

/// What a run leaves on the link.
struct ReceivingEnd {
  std::vector<wire::Record> records;

  void take(std::span<const std::uint8_t> message) {
    wire::Decoder decoder;
    ASSERT_EQ(decoder.next(message), wire::DecodeEvent::kRecord);
    records.push_back(decoder.record());
  }
  template <class T>
  [[nodiscard]] std::vector<T> all() const {
    std::vector<T> found;
    for (const auto& record : records)
      if (const auto* value = std::get_if<T>(&record)) found.push_back(*value);
    return found;
  }
};

SimulatedBoard::FrameSource frames(std::uint32_t count) {
  return [next = 0U, count](SensorFrame& frame) mutable {
    frame.sequence = next;
    frame.time_us = next * 100;
    frame.set(Channel::kSpindleSpeed, 100.0F);
    return next++ < count;
  };
}

SimulatedBoard board_with(std::uint32_t count, ReceivingEnd& link, host::LinkFaults faults = {}) {
  return SimulatedBoard(
      frames(count), [&link](auto message) { link.take(message); }, faults);
}

std::vector<std::uint8_t> encoded(const MonitorConfiguration& configuration) {
  std::vector<std::uint8_t> bytes(wire::kMaxEncodedSize<MonitorConfiguration>);
  bytes.resize(wire::encode(configuration, bytes));
  return bytes;
}

TEST(App, SaysReadyThenAnswersEveryFrameThenSaysEnd) {
  ReceivingEnd link;
  auto board = board_with(50, link);
  App<SimulatedBoard> app(board, {.build_id = 0xABCD});
  ASSERT_TRUE(app.run());
  ASSERT_TRUE(std::holds_alternative<wire::Ready>(link.records.front()));
  EXPECT_EQ(link.all<wire::Ready>().front().build_id, 0xABCDU);
  const auto answers = link.all<Health>();
  ASSERT_EQ(answers.size(), 50U);
  for (std::uint32_t i = 0; i < 50; ++i) EXPECT_EQ(answers[i].sequence, i);
  ASSERT_TRUE(std::holds_alternative<wire::End>(link.records.back()));
  EXPECT_EQ(link.all<wire::End>().front().frames, 50U);
}

TEST(App, AnswersEveryNthFrameWhenAsked) {
  ReceivingEnd link;
  auto board = board_with(100, link);
  App<SimulatedBoard> app(board, {.health_every_frames = 10});
  ASSERT_TRUE(app.run());
  EXPECT_EQ(link.all<Health>().size(), 10U);
  EXPECT_EQ(app.counters().frames, 100U);
}

TEST(App, TakesTheStoredConfiguration) {
  ReceivingEnd link;
  auto board = board_with(1, link);
  ASSERT_TRUE(board.store(encoded(thesis_configuration())));
  App<SimulatedBoard> app(board);
  ASSERT_TRUE(app.run());
  EXPECT_EQ(app.monitor().configuration().machine.tool.diameter_mm, thesis_machine().tool.diameter_mm);
  EXPECT_EQ(link.all<wire::Text>().front().view(), "configuration: stored");
}

TEST(App, FallsBackToTheBuiltInConfigurationAndSaysSo) {
  ReceivingEnd link;
  auto board = board_with(1, link);
  auto damaged = encoded(thesis_configuration());
  damaged[20] ^= 0x40;
  ASSERT_TRUE(board.store(damaged));
  App<SimulatedBoard> app(board);
  ASSERT_TRUE(app.run());
  EXPECT_EQ(app.monitor().configuration().machine.tool.diameter_mm, reference_machine().tool.diameter_mm);
  EXPECT_EQ(link.all<wire::Text>().front().view(), "configuration: built-in, the stored one was refused");
}

/// Takes no configuration at all.
struct RefusingMonitor : BoardMonitor {
  [[nodiscard]] ConfigurationResult configure(const MonitorConfiguration&) {
    return {.error = ConfigurationError::kNotPositive, .key = "spindle.inertia_kgm2"};
  }
};

TEST(App, GoesToTheSafeStateWithoutAnyConfiguration) {
  ReceivingEnd link;
  auto board = board_with(10, link);
  App<SimulatedBoard, RefusingMonitor> app(board);
  EXPECT_FALSE(app.run());
  EXPECT_TRUE(board.is_safe());
  EXPECT_EQ(board.kicks(), 0U);
  EXPECT_TRUE(link.all<Health>().empty());
}

TEST(App, CountsWhatTheLinkCorruptedInTheHealth) {
  ReceivingEnd link;
  auto board = board_with(1000, link, {.corrupt = 0.25});
  App<SimulatedBoard> app(board);
  ASSERT_TRUE(app.run());
  EXPECT_GT(app.counters().corrupt, 100U);
  EXPECT_EQ(app.counters().corrupt + app.counters().frames, 1000U);
  EXPECT_GE(link.all<Health>().back().frames_rejected, app.counters().corrupt - 5);
}

TEST(App, CountsMessagesThatTheLinkRefusedAndGoesOn) {
  ReceivingEnd link;
  auto board = board_with(100, link);
  board.block_link(true);
  App<SimulatedBoard> app(board);
  ASSERT_TRUE(app.run());
  EXPECT_EQ(app.counters().frames, 100U);
  EXPECT_EQ(app.counters().dropped_sends, 100U + 3U);  // Ready, the configuration's text, End
}

std::uint64_t kicks_seen_by_step;

/// Looks at the watchdog from within a step.
struct WatchingMonitor : BoardMonitor {
  static inline const SimulatedBoard* board;
  const Health& step(const SensorFrame& frame) {
    EXPECT_EQ(board->kicks(), kicks_seen_by_step++);
    return BoardMonitor::step(frame);
  }
};

TEST(App, KicksTheWatchdogOnlyAfterACompletedStep) {
  ReceivingEnd link;
  auto board = board_with(20, link);
  WatchingMonitor::board = &board;
  kicks_seen_by_step = 0;
  App<SimulatedBoard, WatchingMonitor> app(board);
  ASSERT_TRUE(app.run());
  EXPECT_EQ(board.kicks(), 20U);
}

/// Steps that take longer than any sampling period.
struct SlowBoard : SimulatedBoard {
  using SimulatedBoard::SimulatedBoard;
  std::uint32_t now_us() { return clock_us += 20'000; }
  std::uint32_t clock_us = 0;
};

TEST(App, CountsStepsThatOverrunTheSamplingPeriod) {
  SlowBoard board(frames(30), [](auto) {});
  App<SlowBoard> app(board);
  ASSERT_TRUE(app.run());
  EXPECT_EQ(app.counters().overruns, 30U);
}

}  // namespace
}  // namespace morepro::firmware
