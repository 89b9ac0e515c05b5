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
using host::FollowedSignal;
using host::GapCell;
using host::Verdict;

constexpr double kTurn = 2.0 * std::numbers::pi;

using Volts = std::function<double(const RecordingSignals&, std::size_t, double, double)>;

/// A recording whose voltage lacks `lost_v`, of a row, of the time in s and the spindle's angle in rad.
RecordingSignals with_lost_voltage(const Volts& lost_v,
                                   host::ProfileKind profile = host::ProfileKind::kRich) {
  RecordingSignals signals = record({.duration_s = 5.0, .profile = profile});
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

bool has_line(const DiagnosisResult& result) {
  return std::any_of(result.where.begin(), result.where.end(), [](const BalanceResult& balance) {
    return line_in(balance, "frequency").residual_ratio > 0.0 ||
           line_in(balance, "order").residual_ratio > 0.0;
  });
}

void expect_line(const DiagnosisResult& result, gap::Balance balance, std::string_view by, double frequency) {
  EXPECT_EQ(result.verdict, Verdict::kUnexplained) << said(result);
  const GapCell line = line_in(balance_in(result, balance), by);
  EXPECT_NEAR(0.5 * (line.from + line.to), frequency, line.to - line.from);
  EXPECT_LT(line.p_value, 1.0e-6);
}

Volts sine(double amplitude_v, double frequency_hz) {
  return [=](const RecordingSignals&, std::size_t, double time_s, double) {
    return amplitude_v * std::sin(kTurn * frequency_hz * time_s);
  };
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
  EXPECT_EQ(result.unexplained_follows.front(),
            (FollowedSignal{gap::Balance::kArmatureVoltage, "the feed speed"}));
  EXPECT_FALSE(has_line(result));
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

TEST(UnnamedStructure, HasAPlaceWithoutACurrentAndFollowsWhatIsEstimatedOfIt) {
  RecordingSignals signals =
      with_lost_voltage([](const RecordingSignals& recorded, std::size_t row, double, double) {
        const float current = recorded.value[index_of(Channel::kArmatureCurrent)][row];
        const float speed = recorded.value[index_of(Channel::kSpindleSpeed)][row];
        const double product = static_cast<double>(current) * static_cast<double>(speed);
        return product == product ? 2.0e-3 * product : 0.0;
      });
  leave_out(signals, Channel::kArmatureCurrent);
  const DiagnosisResult result = diagnosed(signals, datasheet(0.05));
  ASSERT_EQ(result.verdict, Verdict::kUnexplained) << said(result);
  EXPECT_TRUE(balance_in(result, gap::Balance::kSpindleTorque).is_significant);
  ASSERT_FALSE(result.unexplained_follows.empty());
  EXPECT_EQ(result.unexplained_follows.front().signal, "speed times estimated current");
  for (const FollowedSignal& one : result.unexplained_follows)
    EXPECT_EQ(one.balance, gap::Balance::kSpindleTorque) << one.signal;
}

DiagnosisResult with_37_hz(double amplitude_v) {
  return diagnosed(with_lost_voltage(sine(amplitude_v, 37.0)), datasheet(0.05));
}

TEST(UnnamedStructure, IsALineInTime) {
  const DiagnosisResult result = with_37_hz(0.05);
  EXPECT_TRUE(result.unexplained_follows.empty());
  expect_line(result, gap::Balance::kArmatureVoltage, "frequency", 37.0);
  EXPECT_EQ(line_in(balance_in(result, gap::Balance::kArmatureVoltage), "order").residual_ratio, 0.0);
}

TEST(UnnamedStructure, IsALineOfTheForceAndFollowsNothing) {
  RecordingSignals signals = record({.duration_s = 5.0});
  for (std::size_t row = 0; row < signals.rows; ++row)
    signals.value[index_of(Channel::kFeedForce)][row] -=
        static_cast<float>(2.0 * std::sin(kTurn * 37.0 * signals.time_s(row)));
  const DiagnosisResult result = diagnosed(signals, datasheet(0.05));
  EXPECT_TRUE(result.unexplained_follows.empty());
  expect_line(result, gap::Balance::kFeedForce, "frequency", 37.0);
}

/// Loses rows of the sensors; inputs stay.
RecordingSignals without_rows(RecordingSignals signals, std::initializer_list<Channel> channels,
                              std::size_t every, std::size_t from) {
  for (const Channel channel : channels)
    for (std::size_t row = from; row < signals.rows; row += every)
      signals.value[index_of(channel)][row] = std::numeric_limits<float>::quiet_NaN();
  return signals;
}

TEST(UnnamedStructure, IsTheSameLineWhereSensorsLackRows) {
  const RecordingSignals signals = with_lost_voltage(sine(0.05, 37.0));
  const auto sparse = without_rows(signals, {Channel::kSpindleSpeed, Channel::kArmatureCurrent}, 5, 3);
  expect_line(diagnosed(sparse, datasheet(0.05)), gap::Balance::kArmatureVoltage, "frequency", 37.0);
  const auto slow = without_rows(signals, {Channel::kArmatureCurrent}, 2, 1);
  expect_line(diagnosed(slow, datasheet(0.05)), gap::Balance::kArmatureVoltage, "frequency", 37.0);
}

TEST(UnnamedStructure, IsAFrequencyAndAnOrderWhereTheSpeedHardlyChanges) {
  RecordingSignals signals = with_lost_voltage(sine(0.05, 80.0), host::ProfileKind::kProduction);
  const DiagnosisResult result = diagnosed(signals, datasheet(0.0));
  EXPECT_TRUE(result.unexplained_follows.empty());
  expect_line(result, gap::Balance::kArmatureVoltage, "frequency", 80.0);
  EXPECT_GT(line_in(balance_in(result, gap::Balance::kArmatureVoltage), "order").residual_ratio, 100.0);
}

// A fifth of the excess: the parameters bend to both lines, and the pieces in which these are taken out hold
// noise.
TEST(UnnamedStructure, IsTheSumOfItsLines) {
  const auto ratio = [](const Volts& lost_v) {
    const DiagnosisResult result = diagnosed(with_lost_voltage(lost_v), datasheet(0.05));
    return balance_in(result, gap::Balance::kArmatureVoltage).residual_ratio;
  };
  const Volts low = sine(0.05, 36.8);
  const Volts high = sine(0.05, 61.0);
  const double both = ratio([&](const RecordingSignals& s, std::size_t row, double time_s, double angle_rad) {
    return low(s, row, time_s, angle_rad) + high(s, row, time_s, angle_rad);
  });
  const double sum = 1.0 + (ratio(low) - 1.0) + (ratio(high) - 1.0);
  EXPECT_GT(sum, 2.0);
  EXPECT_NEAR(both, sum, 0.2 * (sum - 1.0));
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
  expect_line(result, gap::Balance::kArmatureVoltage, "order", 0.37);
}

TEST(UnnamedStructure, FollowsPositionTimesForceWhereTheMassIsNotTheSameEverywhere) {
  DrivenAxis axis;
  axis.mass_at = [](double place_m) { return 1.0 + 6.0e-4 * std::sin(place_m / 0.02); };
  const DiagnosisResult result = diagnosed(record(axis), datasheet(0.0));
  ASSERT_EQ(result.verdict, Verdict::kUnexplained) << said(result);
  ASSERT_FALSE(result.unexplained_follows.empty());
  EXPECT_EQ(result.unexplained_follows.front(),
            (FollowedSignal{gap::Balance::kFeedForce, "position times feed force"}));
}

/// The feed's only sensor delivers too seldom for its balance.
TEST(UnnamedStructure, SaysThatNoBalanceShowsIt) {
  RecordingSignals signals = record({.duration_s = 5.0});
  for (std::size_t row = 0; row < signals.rows; ++row)
    signals.value[index_of(Channel::kFeedForce)][row] -=
        static_cast<float>(5.0 * std::sin(kTurn * 7.3 * signals.time_s(row)));
  for (const Channel channel :
       {Channel::kFeedSpeed, Channel::kSpindleSpeed, Channel::kArmatureVoltage, Channel::kArmatureCurrent})
    leave_out(signals, channel);
  auto& position = signals.value[index_of(Channel::kFeedPosition)];
  for (std::size_t row = 0; row < signals.rows; ++row)
    if (row % 10 != 0) position[row] = std::numeric_limits<float>::quiet_NaN();
  const DiagnosisResult result = diagnosed(signals, datasheet(0.0));
  ASSERT_EQ(result.verdict, Verdict::kUnexplained) << said(result);
  EXPECT_FALSE(result.has_place());
  EXPECT_NE(result.explanation.find("no balance"), std::string::npos) << result.explanation;
}

TEST(UnnamedStructure, HasNoPlaceWhereThereIsNone) {
  const DiagnosisResult result = diagnosed(record({.duration_s = 5.0}), datasheet(0.0));
  EXPECT_EQ(result.verdict, Verdict::kNoGap) << said(result);
  EXPECT_TRUE(result.unexplained_follows.empty());
  EXPECT_FALSE(result.has_place());
  EXPECT_FALSE(has_line(result));
}

}  // namespace
}  // namespace morepro::diagnose_test
