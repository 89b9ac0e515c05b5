#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <matio.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "sim_host/recording/recording_reader.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

using testing::HasSubstr;

/// A MATLAB file of a test's own.
class Mat : public testing::Test {
 protected:
  ~Mat() override {
    close();
    std::filesystem::remove(path_);
  }

  void create(mat_ft version) { file_ = Mat_CreateVer(path_.c_str(), nullptr, version); }
  void close() {
    if (file_ != nullptr) Mat_Close(file_);
    file_ = nullptr;
  }

  template <class T>
  void put(const char* name, matio_classes kind, matio_types type, std::size_t rows, std::size_t columns,
           std::vector<T> values, int options = 0) {
    std::array<std::size_t, 2> size{rows, columns};
    matvar_t* variable = Mat_VarCreate(name, kind, type, 2, size.data(), values.data(), options);
    EXPECT_EQ(Mat_VarWrite(file_, variable, MAT_COMPRESSION_NONE), 0);
    Mat_VarFree(variable);
  }
  void put(const char* name, std::vector<double> values) {
    const std::size_t size = values.size();
    put(name, MAT_C_DOUBLE, MAT_T_DOUBLE, size, 1, std::move(values));
  }
  void put_complex(const char* name) {
    std::array<double, 3> re{1, 2, 3}, im{4, 5, 6};
    mat_complex_split_t parts{re.data(), im.data()};
    std::array<std::size_t, 2> size{3, 1};
    matvar_t* variable =
        Mat_VarCreate(name, MAT_C_DOUBLE, MAT_T_DOUBLE, 2, size.data(), &parts, MAT_F_COMPLEX);
    EXPECT_EQ(Mat_VarWrite(file_, variable, MAT_COMPRESSION_NONE), 0);
    Mat_VarFree(variable);
  }

  std::vector<SensorFrame> read(const std::vector<std::string>& map = {}, double rate_hz = 0.0) {
    close();
    RecordingReader reader(path_, {.sources = column_sources(map), .rate_hz = rate_hz});
    std::vector<SensorFrame> frames;
    for (SensorFrame frame; reader.next(frame) == hal::ReadStatus::kFrame;) frames.push_back(frame);
    info_ = reader.info();
    return frames;
  }

  std::string refusal(const std::vector<std::string>& map = {}, double rate_hz = 0.0) {
    try {
      read(map, rate_hz);
    } catch (const std::exception& error) {
      return error.what();
    }
    return "nothing was refused";
  }

  std::string path_ = testing::TempDir() + "mat_" + std::to_string(getpid()) + ".mat";
  mat_t* file_ = nullptr;
  RecordingInfo info_;
};

class MatVersion : public Mat, public testing::WithParamInterface<mat_ft> {};

TEST_P(MatVersion, GivesVariablesOfAnyNumericTypeAsFrames) {
  create(GetParam());
  put<double>("time_s", MAT_C_DOUBLE, MAT_T_DOUBLE, 1, 4, {0.0, 0.001, 0.002, 0.004});
  put<float>("feed_force_n", MAT_C_SINGLE, MAT_T_SINGLE, 4, 1,
             {0.1F, std::numeric_limits<float>::quiet_NaN(), INFINITY, 0.0F});
  put<std::int16_t>("feed_position_m", MAT_C_INT16, MAT_T_INT16, 4, 1, {-7, 8, 9, 9});
  put<std::uint8_t>("contact", MAT_C_UINT8, MAT_T_UINT8, 4, 1, {0, 1, 1, 1}, MAT_F_LOGICAL);
  const auto frames = read();
  ASSERT_EQ(frames.size(), 4U);
  EXPECT_EQ(frames[0].get(Channel::kFeedForce), 0.1F);
  EXPECT_FALSE(frames[1].has(Channel::kFeedForce));
  EXPECT_EQ(frames[2].get(Channel::kFeedForce), INFINITY);
  EXPECT_EQ(frames[0].get(Channel::kFeedPosition), -7.0F);
  EXPECT_EQ(frames[2].get(Channel::kContact), 1.0F);
  EXPECT_EQ(frames[3].time_us, 4000U);
  EXPECT_EQ(frames[3].sequence, 4U) << "a missing row is a missing frame";
  EXPECT_EQ(info_.rate_hz, 1000.0);
}

INSTANTIATE_TEST_SUITE_P(Of, MatVersion, testing::Values(MAT_FT_MAT5, MAT_FT_MAT73), [](const auto& version) {
  return version.param == MAT_FT_MAT5 ? "Version5" : "Version73";
});

TEST_F(Mat, TakesOtherNamesWithAFactor) {
  create(MAT_FT_MAT5);
  put("t", {0.0, 0.5, 1.0});
  put("drive", {1.0, 2.0, 3.0});
  put("gain", {4.0});
  put("rest", {1.0, 1.0, 1.0});
  EXPECT_EQ(read({"time_s=t", "feed_force_n=gain*drive"})[2].get(Channel::kFeedForce), 12.0F);
  EXPECT_THAT(info_.warnings, testing::ElementsAre(HasSubstr("'rest' is not used")));
  EXPECT_EQ(read({"time_s=0.5*t", "feed_force_n=drive"})[2].time_us, 500000U);
}

TEST_F(Mat, TakesARateInPlaceOfATime) {
  create(MAT_FT_MAT5);
  put("feed_force_n", {1.0, 2.0, 3.0});
  EXPECT_EQ(read({}, 200.0)[2].time_us, 10000U);
  EXPECT_EQ(info_.rate_hz, 200.0);
}

TEST_F(Mat, SaysWhatAFileLacks) {
  create(MAT_FT_MAT5);
  put("force", {1.0, 2.0, 3.0});
  put("brief", {1.0, 2.0});
  put("t", {0.0, 1.0, 2.0});
  put("back", {0.0, 2.0, 1.0});
  put("nan", {0.0, NAN, 1.0});
  put<double>("matrix", MAT_C_DOUBLE, MAT_T_DOUBLE, 2, 2, {1, 2, 3, 4});
  put<char>("text", MAT_C_CHAR, MAT_T_UTF8, 1, 3, {'a', 'b', 'c'});
  put_complex("complex");
  EXPECT_THAT(refusal(), HasSubstr("the file holds force, brief, t, back"));
  const std::string force = "feed_force_n=force";
  EXPECT_THAT(refusal({force}), HasSubstr("no variable 'time_s'"));
  EXPECT_THAT(refusal({force, "time_s=brief"}), HasSubstr("'brief' has 2 values, 'force' has 3"));
  EXPECT_THAT(refusal({force, "time_s=back"}), HasSubstr("time 1 of row 3 does not increase after 2"));
  EXPECT_THAT(refusal({force, "time_s=nan"}), HasSubstr("row 2 is not finite"));
  EXPECT_THAT(refusal({force, "time_s=complex"}), HasSubstr("'complex' is complex"));
  EXPECT_THAT(refusal({force, "time_s=matrix"}), HasSubstr("'matrix' is no row or column"));
  EXPECT_THAT(refusal({force, "time_s=text"}), HasSubstr("'text' is no row or column"));
  EXPECT_THAT(refusal({force, "time_s=forse"}), HasSubstr("did you mean 'force'?"));
  EXPECT_THAT(refusal({force, "time_s=t*t"}), HasSubstr("neither a number nor a scalar"));
  EXPECT_THAT(refusal({force, "time_s=t"}, 10.0), HasSubstr("--rate is for files without"));
  EXPECT_THAT(refusal({force, force}), HasSubstr("mapped twice"));
  EXPECT_THAT(refusal({"feed_forse_n=force"}), HasSubstr("did you mean 'feed_force_n'?"));
  EXPECT_THAT(refusal({"feed_force_n"}), HasSubstr("write COLUMN=VARIABLE"));
}

TEST_F(Mat, RefusesWhatIsNoMatFileAndEveryCut) {
  create(MAT_FT_MAT5);
  put("time_s", {0.0, 1.0, 2.0});
  put("feed_force_n", {1.0, 2.0, 3.0});
  close();
  for (auto size = std::filesystem::file_size(path_) - 1; size > 0;
       size -= std::min<std::uintmax_t>(size, 7)) {
    std::filesystem::resize_file(path_, size);
    EXPECT_THAT(refusal(), HasSubstr(path_)) << size;
  }
  std::ofstream(path_) << "time_s,contact\n0,1\n1,1\n";
  EXPECT_THAT(refusal(), HasSubstr("no MATLAB file"));
}

}  // namespace
}  // namespace morepro::host
