#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "sim_host/report/pyramid.hpp"

namespace morepro::host {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

/// Samples with holes of any length, and a spike now and then.
std::vector<float> signal_of(std::uint32_t seed, std::size_t rows) {
  std::mt19937 random(seed);
  std::vector<float> values;
  while (values.size() < rows) {
    const auto kind = random() % 16;
    if (kind == 0) values.insert(values.end(), random() % 300, kNone);
    values.push_back(kind == 1 ? 1.0e6F : static_cast<float>(random() % 1000));
  }
  values.resize(rows);
  return values;
}

Bucket brute(const std::vector<float>& values, std::size_t first, std::size_t last) {
  Bucket range;
  for (std::size_t i = first; i < std::min(last, values.size()); ++i)
    if (!std::isnan(values[i])) {
      range.low = std::isnan(range.low) ? values[i] : std::min(range.low, values[i]);
      range.high = std::isnan(range.high) ? values[i] : std::max(range.high, values[i]);
    }
  return range;
}

void expect_same(const Bucket& found, const Bucket& right, std::size_t i) {
  EXPECT_EQ(std::isnan(found.low), std::isnan(right.low)) << "bucket " << i;
  EXPECT_EQ(std::isnan(found.high), std::isnan(right.high)) << "bucket " << i;
  if (std::isnan(right.low)) return;
  EXPECT_EQ(found.low, right.low) << "bucket " << i;
  EXPECT_EQ(found.high, right.high) << "bucket " << i;
}

Pyramid taken(const std::vector<float>& values, std::size_t most) {
  Pyramid pyramid(most);
  for (const float value : values) pyramid.take(value);
  return pyramid;
}

TEST(ReportPyramid, EveryBucketHasTheExtremesOfItsRows) {
  for (const std::size_t rows : {1U, 2U, 63U, 64U, 65U, 1000U, 4097U, 20000U})
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
      SCOPED_TRACE(testing::Message() << rows << " rows, seed " << seed);
      const std::vector<float> values = signal_of(seed, rows);
      const Pyramid pyramid = taken(values, 64);
      const std::vector<Bucket> buckets = pyramid.buckets();
      const std::size_t width = pyramid.bucket_rows();
      ASSERT_EQ(buckets.size(), (rows + width - 1) / width);
      for (std::size_t i = 0; i < buckets.size(); ++i)
        expect_same(buckets[i], brute(values, i * width, (i + 1) * width), i);
    }
}

TEST(ReportPyramid, AnyWindowIsKnownToOneBucketAtEitherEnd) {
  const std::vector<float> values = signal_of(7, 50000);
  const Pyramid pyramid = taken(values, 256);
  const std::vector<Bucket> buckets = pyramid.buckets();
  const std::size_t width = pyramid.bucket_rows();
  std::mt19937 random(11);
  for (int trial = 0; trial < 500; ++trial) {
    const std::size_t first = random() % 49000;
    const std::size_t last = first + 2 * width + random() % (values.size() - first);
    Bucket seen;
    for (std::size_t i = first / width; i < std::min(buckets.size(), (last + width - 1) / width); ++i)
      seen.take(buckets[i]);
    const Bucket least = brute(values, first, last);
    const Bucket most = brute(values, first / width * width, (last + width - 1) / width * width);
    EXPECT_LE(seen.low, least.low);
    EXPECT_GE(seen.high, least.high);
    expect_same(seen, most, static_cast<std::size_t>(trial));
  }
}

TEST(ReportPyramid, ANeverEndingSignalTakesBoundedMemory) {
  Pyramid pyramid(100);
  for (unsigned i = 0; i < 300000; ++i) {
    pyramid.take(static_cast<float>(i));
    ASSERT_LE(pyramid.buckets().size(), 100U);
    ASSERT_GE(pyramid.buckets().size(), std::min(i + 1U, 50U));
  }
}

TEST(ReportPyramid, AGapIsAGapAndAsLongAsItWas) {
  Pyramid skipping(32);
  Pyramid taking(32);
  std::mt19937 random(5);
  for (int i = 0; i < 200; ++i) {
    const std::uint64_t hole = random() % 200;
    skipping.skip(hole);
    for (std::uint64_t k = 0; k < hole; ++k) taking.take(kNone);
    for (Pyramid* pyramid : {&skipping, &taking}) pyramid->take(static_cast<float>(i));
  }
  ASSERT_EQ(skipping.rows(), taking.rows());
  ASSERT_EQ(skipping.bucket_rows(), taking.bucket_rows());
  const std::vector<Bucket> right = taking.buckets();
  for (std::size_t i = 0; i < right.size(); ++i) expect_same(skipping.buckets()[i], right[i], i);
}

TEST(ReportPyramid, ALongGapLeavesEmptyBuckets) {
  Pyramid pyramid(16);
  pyramid.take(1.0F);
  pyramid.skip(1'000'000'000'000);
  pyramid.take(2.0F);
  const std::vector<Bucket> buckets = pyramid.buckets();
  ASSERT_GE(buckets.size(), 8U);
  EXPECT_EQ(buckets.front().high, 1.0F);
  EXPECT_EQ(buckets.back().low, 2.0F);
  for (std::size_t i = 1; i + 1 < buckets.size(); ++i) EXPECT_TRUE(buckets[i].is_empty());
}

}  // namespace
}  // namespace morepro::host
