#include "sim_host/diagnose/search/onset.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace morepro::host {
namespace {

constexpr std::size_t kFewestBlocks = 8;
constexpr std::size_t kLastBlocks = 4;  // what happens at the very end may be anything

/// Moments of the parameters, some columns and the innovation, in this order.
std::vector<Eigen::Index> chosen(const AxisFit& fit, Eigen::Index first, Eigen::Index count,
                                 Eigen::Index width) {
  std::vector<Eigen::Index> columns = fit.parameter_columns();
  for (Eigen::Index i = 0; i < count; ++i) columns.push_back(first + i);
  columns.push_back(width - 1);
  return columns;
}

Eigen::MatrixXd part_of(const Eigen::MatrixXd& lower, const std::vector<Eigen::Index>& columns) {
  const auto n = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd part(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) {
      const Eigen::Index a = columns[static_cast<std::size_t>(i)], b = columns[static_cast<std::size_t>(j)];
      part(i, j) = part(j, i) = lower(std::max(a, b), std::min(a, b));
    }
  return part;
}

}  // namespace

LateStart best_start(const AxisFit& fit, const GapStatistics& statistics, Eigen::Index first,
                     Eigen::Index count) {
  LateStart best;
  const std::size_t blocks = statistics.block.size();
  if (blocks < kFewestBlocks) return best;
  const Eigen::Index width = statistics.block.front().cols();
  const std::vector<Eigen::Index> columns = chosen(fit, first, count, width);
  const auto parameters = static_cast<Eigen::Index>(parameter_count(fit.axis()));
  const auto size = static_cast<Eigen::Index>(columns.size());
  std::vector<Eigen::Index> active(columns.size() - 1);
  std::iota(active.begin(), active.end(), 0);
  const std::vector<Eigen::Index> nominal(active.begin(), active.begin() + parameters);
  const Eigen::VectorXd precision = fit.precision(size), target = fit.target(size);
  Eigen::MatrixXd total = Eigen::MatrixXd::Zero(size, size);
  for (const Eigen::MatrixXd& block : statistics.block) total += part_of(block, columns);
  best.rss_without = best.rss = morepro::host::fit(total, nominal, precision, target).rss;
  Eigen::MatrixXd tail = Eigen::MatrixXd::Zero(size, size);
  for (std::size_t b = blocks; b-- > 0;) {
    tail += part_of(statistics.block[b], columns);
    if (b + kLastBlocks > blocks) continue;
    // The parameters see the whole recording, the columns only its tail.
    Eigen::MatrixXd split = total;
    split.middleCols(parameters, count) = tail.middleCols(parameters, count);
    split.middleRows(parameters, count) = tail.middleRows(parameters, count);
    const LinearFit one = morepro::host::fit(split, active, precision, target);
    if (b == 0) best.rss_at_start = one.rss;
    if (!(one.rss < best.rss)) continue;
    best.rss = one.rss;
    best.onset_s = static_cast<double>(b) * statistics.block_s;
    best.coefficient = one.coefficient.tail(count);
  }
  return best;
}

bool is_surely_late(const LateStart& start, double rows) {
  constexpr double kSurely = 30.0;      // deviance
  constexpr double kNoticeably = 0.05;  // of what the columns take
  if (!(start.onset_s > 0.0) || !(start.rss > 0.0)) return false;
  const double unit = start.rss_without / std::max(rows, 1.0);
  const double gain = start.rss_without - start.rss;
  return start.rss_at_start - start.rss > std::max(kSurely * unit, kNoticeably * gain);
}

}  // namespace morepro::host
