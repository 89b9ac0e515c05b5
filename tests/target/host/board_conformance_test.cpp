#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <memory>

#include "hal/conformance.hpp"
#include "hal/stub_board.hpp"
#include "sim_host/boards/recording_board.hpp"
#include "sim_host/boards/simulated_board.hpp"

namespace morepro {
namespace {

template <hal::Board B>
void expect_conformance(B& board, hal::Capabilities capabilities = {}) {
  hal::check_conformance(
      board, [](const char* name, bool passed) { EXPECT_TRUE(passed) << name; }, capabilities);
}

bool endless(SensorFrame& frame) {
  ++frame.sequence;
  return true;
}

TEST(Conformance, HoldsForTheStubThatPortsStartFrom) {
  hal::StubBoard board;
  expect_conformance(board, {.stores = false, .sends = false});
}

TEST(Conformance, HoldsForTheSimulatedBoard) {
  host::SimulatedBoard board(endless, [](auto) {});
  expect_conformance(board);
}

TEST(Conformance, HoldsForTheSimulatedBoardOnABadLink) {
  host::SimulatedBoard board(endless, [](auto) {},
                             {.drop = 0.2, .duplicate = 0.2, .reorder = 0.2, .corrupt = 0.2});
  expect_conformance(board);
}

TEST(Conformance, HoldsForTheRecordingBoard) {
  const auto folder = std::filesystem::temp_directory_path();
  const std::string input = (folder / "morepro_conformance_input").string();
  const std::string output = (folder / "morepro_conformance_output").string();
  std::fclose(std::fopen(input.c_str(), "wb"));
  host::FileBlocks files(input.c_str(), output.c_str());
  ASSERT_TRUE(files.ok());
  const auto board = std::make_unique<host::RecordingBoard>(files);
  expect_conformance(*board);
  EXPECT_TRUE(files.close());
  std::filesystem::remove(input);
  std::filesystem::remove(output);
}

/// Boards with one fault each: the suite has to see it.
struct BackwardsClock : hal::StubBoard {
  std::uint32_t now_us() { return --clock_us; }
  std::uint32_t clock_us = 1000;
};
struct StoppedClock : hal::StubBoard {
  std::uint32_t now_us() { return 7; }
};
struct ScribblingReader : hal::StubBoard {
  hal::ReadStatus read_frame(SensorFrame& frame) {
    frame = SensorFrame{};
    return hal::ReadStatus::kNothing;
  }
};
struct ForgetfulStore : hal::StubBoard {
  bool store(std::span<const std::uint8_t>) { return true; }
};
struct RestlessCause : hal::StubBoard {
  hal::ResetCause reset_cause() {
    calls = !calls;
    return calls ? hal::ResetCause::kPowerOn : hal::ResetCause::kSoftware;
  }
  bool calls = false;
};

template <hal::Board B>
int failures_of() {
  B board;
  int failures = 0;
  hal::check_conformance(board, [&failures](const char*, bool passed) { failures += passed ? 0 : 1; },
                         {.stores = false, .sends = false});
  return failures;
}

TEST(Conformance, FindsBoardsThatAreWrong) {
  EXPECT_EQ(failures_of<hal::StubBoard>(), 0);
  EXPECT_EQ(failures_of<BackwardsClock>(), 1);
  EXPECT_EQ(failures_of<StoppedClock>(), 1);
  EXPECT_EQ(failures_of<ScribblingReader>(), 1);
  EXPECT_GE(failures_of<ForgetfulStore>(), 1);
  EXPECT_EQ(failures_of<RestlessCause>(), 1);
}

}  // namespace
}  // namespace morepro
