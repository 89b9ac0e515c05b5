// Structure without a name has a place: a balance, cells, the signal that it follows or the line that it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/unit/driven_axis.hpp"

namespace morepro::diagnose_test {
namespace {

using host::BalanceResult;
using host::GapCell;
using host::Verdict;

constexpr double kTurn = 2.0 * std::numbers::pi;

/// A recording whose voltage lacks `lost_v`, of a row, of the time in s and the spindle's angle in rad.
RecordingSignals with_lost_voltage(
    const std::function<double(const RecordingSignals&, std::size_t, double, double)>& lost_v) {
  RecordingSignals signals = record({.duration_s = 5.0});
  const auto& speed = signals.value[index_of(Channel::kSpindleSpeed)];
  auto& voltage = signals.value[index_of(Channel::kArmatureVoltage)];
  double angle_rad = 0.0;
  for (std::size_t row = 0; row < signals.rows; ++row) {
    if (speed[row] == speed[row]) angle_rad += std::fabs(static_cast<double>(speed[row])) / signals.rate_hz;
    voltage[row] -= static_cast<float>(lost_v(signals, row, signals.time_s(row), angle_rad));
  }
  return signals;
}

const BalanceResult& balance_in(const DiagnosisResult& result, gap::Balance balance) {
  return *std::find_if(result.where.begin(), result.where.end(),
                       [balance](const BalanceResult& b) { return b.balance == balance; });
}

/// The strongest cell of a kind that is as narrow as a line.
GapCell line_in(const BalanceResult& balance, std::string_view by) {
  GapCell strongest{.by = by, .residual_ratio = 0.0};
  for (const GapCell& cell : balance.cells)
    if (cell.by == by && cell.to - cell.from < 0.05 * cell.to && cell.from != cell.to &&
        cell.residual_ratio > strongest.residual_ratio)
      strongest = cell;
  return strongest;
}

/// Beyond noise, below 59 Hz.
double slow_excess(const DiagnosisResult& result) {
  for (const GapCell& cell : balance_in(result, gap::Balance::kArmatureVoltage).cells)
    if (cell.by == "frequency" && cell.from == 0.0) return cell.residual_ratio - 1.0;
  return 0.0;
}

TEST(UnnamedStructure, FollowsTheFeedsSpeedInTheVoltage) {
  const DiagnosisResult result =
      diagnosed(with_lost_voltage([](const RecordingSignals& signals, std::size_t row, double, double) {
                  const float speed = signals.value[index_of(Channel::kFeedSpeed)][row];
                  return speed == speed ? 2.0 * static_cast<double>(speed) : 0.0;
                }),
                datasheet(0.05));
  ASSERT_EQ(result.verdict, Verdict::kUnexplained) << said(result);
  ASSERT_FALSE(result.unexplained_follows.empty());
  EXPECT_EQ(result.unexplained_follows.front(), "the feed speed");
  const BalanceResult& voltage = balance_in(result, gap::Balance::kArmatureVoltage);
  EXPECT_TRUE(voltage.is_significant);
  // The eight spans of time are all of the recording: what is too much of it is in them.
  double sum = 0.0;
  for (const GapCell& cell : voltage.cells)
    if (cell.by == "time") sum += cell.residual_ratio;
  EXPECT_NEAR(sum / 8.0, voltage.residual_ratio, 0.02 * voltage.residual_ratio);
  // The feed is moved at a few Hz.
  EXPECT_GT(slow_excess(result), 2.0 * voltage.residual_ratio);
}

DiagnosisResult with_37_hz(double amplitude_v) {
  return diagnosed(
      with_lost_voltage([amplitude_v](const RecordingSignals&, std::size_t, double time_s, double) {
        return amplitude_v * std::sin(kTurn * 37.0 * time_s);
      }),
      datasheet(0.05));
}

TEST(UnnamedStructure, IsALineInTime) {
  const DiagnosisResult result = with_37_hz(0.05);
  ASSERT_EQ(result.verdict, Verdict::kUnexplained) << said(result);
  EXPECT_TRUE(result.unexplained_follows.empty());
  const GapCell line = line_in(balance_in(result, gap::Balance::kArmatureVoltage), "frequency");
  EXPECT_NEAR(0.5 * (line.from + line.to), 37.0, line.to - line.from);
  EXPECT_LT(line.p_value, 1.0e-6);
}

// Over a floor that has nothing of it. So small that parameters do not bend to it; a tenth: the pieces in
// which it is taken out hold some noise, too.
TEST(UnnamedStructure, IsFourTimesAsMuchOfALineTwiceAsLarge) {
  const double of_one = slow_excess(with_37_hz(0.0125));
  const double of_two = slow_excess(with_37_hz(0.025));
  EXPECT_GT(of_one, 0.2);
  EXPECT_NEAR(of_two, 4.0 * of_one, 0.1 * of_two);
}

TEST(UnnamedStructure, IsALineOverTheAngle) {
  const DiagnosisResult result =
      diagnosed(with_lost_voltage([](const RecordingSignals&, std::size_t, double, double angle_rad) {
                  return 0.05 * std::sin(0.37 * angle_rad);
                }),
                datasheet(0.05));
  ASSERT_EQ(result.verdict, Verdict::kUnexplained) << said(result);
  const GapCell line = line_in(balance_in(result, gap::Balance::kArmatureVoltage), "order");
  EXPECT_NEAR(0.5 * (line.from + line.to), 0.37, line.to - line.from);
  EXPECT_LT(line.p_value, 1.0e-6);
}

TEST(UnnamedStructure, FollowsPositionTimesForceWhereTheMassIsNotTheSameEverywhere) {
  DrivenAxis axis;
  axis.mass_at = [](double place_m) { return 1.0 + 6.0e-4 * std::sin(place_m / 0.02); };
  const DiagnosisResult result = diagnosed(record(axis), datasheet(0.0));
  ASSERT_EQ(result.verdict, Verdict::kUnexplained) << said(result);
  ASSERT_FALSE(result.unexplained_follows.empty());
  EXPECT_EQ(result.unexplained_follows.front(), "position times feed force");
}

TEST(UnnamedStructure, HasNoPlaceWhereThereIsNone) {
  const DiagnosisResult result = diagnosed(record({.duration_s = 5.0}), datasheet(0.05));
  EXPECT_TRUE(result.unexplained_follows.empty());
}

}  // namespace
}  // namespace morepro::diagnose_test
