#include "sim_host/report/series_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim_host/report/base64.hpp"

namespace morepro::host {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kDataBytes = 2.0e6;                 // of a page of 3 MB, of which 0.7 are code
constexpr double kBytesPerBucket = 4.0 * 4.0 / 3.0;  // two 16-bit numbers in base64
constexpr std::size_t kMostBuckets = 32768;          // more than any screen has columns
constexpr double kSteps = 65534.0;
constexpr std::uint16_t kEmptyBucket = 65535;

void append(std::uint16_t value, std::vector<std::uint8_t>& bytes) {
  bytes.push_back(static_cast<std::uint8_t>(value & 0xFFU));
  bytes.push_back(static_cast<std::uint8_t>(value >> 8));
}

/// Outwards to the next step, so that rounding hides no extreme.
std::uint16_t step_of(double value, const Bucket& range, bool is_high) {
  const double span = static_cast<double>(range.high) - static_cast<double>(range.low);
  if (!(span > 0.0)) return 0;
  const double step = (value - static_cast<double>(range.low)) / span * kSteps;
  return static_cast<std::uint16_t>(std::clamp(is_high ? std::ceil(step) : std::floor(step), 0.0, kSteps));
}

/// False where there is not one sample.
bool encode(const Pyramid& pyramid, Json& series) {
  const std::vector<Bucket> buckets = pyramid.buckets();
  Bucket range;
  for (const Bucket& bucket : buckets) range.take(bucket);
  if (range.is_empty()) return false;
  std::vector<std::uint8_t> bytes;
  bytes.reserve(4 * buckets.size());
  for (const Bucket& bucket : buckets) {
    append(bucket.is_empty() ? kEmptyBucket : step_of(static_cast<double>(bucket.low), range, false), bytes);
    append(bucket.is_empty() ? kEmptyBucket : step_of(static_cast<double>(bucket.high), range, true), bytes);
  }
  series["low"] = static_cast<double>(range.low);
  series["high"] = static_cast<double>(range.high);
  series["data"] = base64(bytes);
  return true;
}

}  // namespace

std::size_t SeriesTable::add(std::string id, std::string label, std::string unit) {
  series_.push_back({std::move(id), std::move(label), std::move(unit), Pyramid(most_buckets_)});
  return series_.size() - 1;
}

void SeriesTable::begin_row(std::uint64_t row) {
  if (has_row_ && row == row_) return;
  for (Series& series : series_) {
    if (has_row_) series.pyramid.take(std::exchange(series.now, {}));
    series.pyramid.skip(row - series.pyramid.rows());
  }
  row_ = row;
  has_row_ = true;
}

void SeriesTable::set(std::size_t series, double value) { set(series, value, value); }

void SeriesTable::set(std::size_t series, double low, double high) {
  if (!std::isfinite(low) || !std::isfinite(high)) return;
  series_[series].now.take({static_cast<float>(low), static_cast<float>(high)});
}

double SeriesTable::bucket_s() const {
  return series_.empty() ? row_s_ : row_s_ * static_cast<double>(series_.front().pyramid.bucket_rows());
}

Json SeriesTable::json() const {
  Json all = Json::object();
  for (const Series& series : series_) {
    if (series.label.empty()) continue;
    Json one{{"label", series.label}, {"unit", series.unit}, {"bucket_s", bucket_s()}};
    if (encode(series.pyramid, one)) all[series.id] = std::move(one);
  }
  return all;
}

std::size_t buckets_for(std::size_t series) {
  const double most = kDataBytes / kBytesPerBucket / static_cast<double>(std::max<std::size_t>(series, 1));
  return std::min(kMostBuckets, static_cast<std::size_t>(most));
}

}  // namespace morepro::host
