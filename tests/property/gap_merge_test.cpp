#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "lib/gap/explained_columns.hpp"

namespace morepro::gap {
namespace {

constexpr std::size_t kMergedColumns = 10;
constexpr std::size_t kParameters = 4;
using MergedStatistics = SquareRootStatistics<float, kMergedColumns>;

std::vector<MergedStatistics::Row> rows_of(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> normal;
  std::vector<MergedStatistics::Row> rows(600);
  for (auto& row : rows) {
    for (float& x : row) x = normal(random);
    row[3] = row[0] + 0.1F * row[3];
    row[7] *= 1.0e4F;
    row[kMergedColumns] += 0.2F * row[8];
  }
  return rows;
}

/// Which column explains most.
std::size_t best_of(const MergedStatistics& statistics) {
  const ExplainedColumns<float, kMergedColumns> explained(kParameters);
  std::size_t best = kParameters;
  for (std::size_t j = kParameters; j < kMergedColumns; ++j)
    if (explained.gain_of(statistics, j, 1).gain > explained.gain_of(statistics, best, 1).gain) best = j;
  return best;
}

/// Rows in random order, cut into `shards` pieces, merged in random order.
MergedStatistics merged(std::vector<MergedStatistics::Row> rows, std::size_t shards, std::mt19937& random) {
  std::shuffle(rows.begin(), rows.end(), random);
  std::vector<MergedStatistics> pieces(shards);
  for (std::size_t i = 0; i < rows.size(); ++i) pieces[i % shards].add(rows[i]);
  MergedStatistics sum;
  for (const MergedStatistics& piece : pieces) sum.merge(piece);
  return sum;
}

// Every rotation rounds each element once: 600 rows and as many of the merges' leave at most some 1e-4 of a
// column's size, in the worst case; 1e-5 is what chance leaves, ten times over.
constexpr double kRounding = 1.0e-4;

TEST(GapMerge, DoesNotDependOnShardsOrOrder) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    std::mt19937 random(seed);
    const auto rows = rows_of(seed);
    const MergedStatistics whole = merged(rows, 1, random);
    for (const std::size_t shards : {1U, 2U, 3U, 7U, 50U, 600U}) {
      const MergedStatistics sum = merged(rows, shards, random);
      EXPECT_EQ(sum.rows(), whole.rows());
      EXPECT_EQ(best_of(sum), best_of(whole)) << seed << ' ' << shards;
      for (std::size_t a = 0; a <= kMergedColumns; ++a)
        for (std::size_t b = a; b <= kMergedColumns; ++b) {
          const double size = std::sqrt(static_cast<double>(whole.left(a, a, 0) * whole.left(b, b, 0)));
          EXPECT_NEAR(sum.left(a, b, 0), whole.left(a, b, 0), kRounding * size) << shards;
        }
    }
  }
}

TEST(GapMerge, IsAssociative) {
  const auto rows = rows_of(3);
  MergedStatistics a, b, c;
  for (std::size_t i = 0; i < rows.size(); ++i) (i % 3 == 0 ? a : i % 3 == 1 ? b : c).add(rows[i]);
  MergedStatistics left = a;
  left.merge(b);
  left.merge(c);
  MergedStatistics right = b;
  right.merge(c);
  a.merge(right);
  EXPECT_NEAR(left.residual(kParameters), a.residual(kParameters),
              kRounding * static_cast<double>(left.residual(kParameters)));
}

}  // namespace
}  // namespace morepro::gap
