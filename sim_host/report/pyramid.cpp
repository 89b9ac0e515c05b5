#include "sim_host/report/pyramid.hpp"

#include <algorithm>

namespace morepro::host {

void Bucket::take(const Bucket& other) {
  if (other.is_empty()) return;
  low = is_empty() ? other.low : std::min(low, other.low);
  high = high >= other.high ? high : other.high;
}

Pyramid::Pyramid(std::size_t most_buckets) : most_(std::max<std::size_t>(most_buckets / 2 * 2, 2)) {
  closed_.reserve(most_);
}

void Pyramid::take(const Bucket& row) {
  ++rows_;
  open_.take(row);
  if (++open_rows_ == bucket_rows_) close();
}

void Pyramid::skip(std::uint64_t rows) {
  rows_ += rows;
  while (rows > 0) {
    const std::uint64_t step = std::min(rows, bucket_rows_ - open_rows_);
    rows -= step;
    open_rows_ += step;
    if (open_rows_ == bucket_rows_) close();
  }
}

void Pyramid::close() {
  closed_.push_back(open_);
  open_ = {};
  open_rows_ = 0;
  if (closed_.size() < most_) return;
  for (std::size_t i = 0; i < most_ / 2; ++i) {
    Bucket pair = closed_[2 * i];
    pair.take(closed_[2 * i + 1]);
    closed_[i] = pair;
  }
  closed_.resize(most_ / 2);
  bucket_rows_ *= 2;
}

std::vector<Bucket> Pyramid::buckets() const {
  std::vector<Bucket> all = closed_;
  if (open_rows_ > 0) all.push_back(open_);
  return all;
}

}  // namespace morepro::host
