#include "sim_host/support/file_window.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>

#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

class Window : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = testing::TempDir() + "window_XXXXXX";
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string path(const char* name) const { return (folder_ / name).string(); }

  static std::vector<std::uint8_t> random_bytes(std::size_t size) {
    std::mt19937 random(7);
    std::vector<std::uint8_t> bytes(size);
    std::generate(bytes.begin(), bytes.end(), [&] { return static_cast<std::uint8_t>(random()); });
    return bytes;
  }

  static void write(const std::string& path, const std::vector<std::uint8_t>& bytes) {
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }

  /// Everything, in steps of all sizes up to what is promised.
  static std::vector<std::uint8_t> all_of(FileWindow& window, std::size_t size) {
    std::vector<std::uint8_t> taken;
    for (std::size_t step = 1; !window.ahead().empty(); step = step % FileWindow::kAhead + 1) {
      auto& ahead = window.ahead();
      EXPECT_EQ(window.offset(), taken.size());
      EXPECT_GE(ahead.size(), std::min(FileWindow::kAhead, size - taken.size()));
      const std::size_t count = std::min(step, ahead.size());
      taken.insert(taken.end(), ahead.begin(), ahead.begin() + static_cast<std::ptrdiff_t>(count));
      ahead = ahead.subspan(count);
    }
    return taken;
  }

  std::filesystem::path folder_;
};

TEST_F(Window, GivesEveryByteOnceAndAgainAfterARewind) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{4095}, std::size_t{1} << 20U,
                                 (std::size_t{1} << 20U) + 1, std::size_t{3'000'000}}) {
    const auto bytes = random_bytes(size);
    write(path("bytes"), bytes);
    FileWindow window(path("bytes"));
    EXPECT_EQ(all_of(window, size), bytes) << size;
    window.rewind();
    EXPECT_EQ(all_of(window, size), bytes) << size << ", again";
  }
}

TEST_F(Window, ReadsAPipeTwice) {
  const auto bytes = random_bytes(1'500'000);
  const std::string pipe = path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::thread writer([&] { write(pipe, bytes); });
  FileWindow window(pipe);
  writer.join();
  EXPECT_EQ(all_of(window, bytes.size()), bytes);
  window.rewind();
  EXPECT_EQ(all_of(window, bytes.size()), bytes);
}

TEST_F(Window, EndsWhereAFileThatGrowsOrShrinksMustEnd) {
  write(path("grows"), random_bytes(10'000));
  FileWindow grows(path("grows"));
  write(path("grows"), random_bytes(20'000));
  EXPECT_EQ(all_of(grows, 10'000).size(), 10'000U) << "nothing has looked at the rest";
  write(path("shrinks"), random_bytes(10'000));
  FileWindow shrinks(path("shrinks"));
  write(path("shrinks"), random_bytes(3'000));
  EXPECT_EQ(all_of(shrinks, 3'000).size(), 3'000U);
}

TEST_F(Window, RefusesWhatIsNoFile) {
  EXPECT_THROW(FileWindow(path("absent")), UserError);
  EXPECT_THROW(FileWindow(folder_.string()), UserError);
}

}  // namespace
}  // namespace morepro::host
