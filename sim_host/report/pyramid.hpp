#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace morepro::host {

/// Smallest and largest value of some rows; NaN where none of them holds a sample.
struct Bucket {
  float low = std::numeric_limits<float>::quiet_NaN();
  float high = std::numeric_limits<float>::quiet_NaN();

  [[nodiscard]] bool is_empty() const { return !(low <= high); }
  void take(const Bucket& other);
};

/// A signal of any length in bounded memory: buckets of equally many rows, each with its smallest and largest
/// value. When there are too many, two and two become one. No extreme of the signal is lost; its place is
/// known to one bucket.
class Pyramid {
 public:
  /// `most_buckets`: at least 2; rounded down to an even number.
  explicit Pyramid(std::size_t most_buckets);

  /// The next row: one value, or a range. NaN: there is no sample.
  void take(float value) { take(Bucket{value, value}); }
  void take(const Bucket& row);
  /// So many rows without a sample, however many.
  void skip(std::uint64_t rows);

  [[nodiscard]] std::uint64_t rows() const { return rows_; }
  [[nodiscard]] std::uint64_t bucket_rows() const { return bucket_rows_; }
  /// In order; the last one may hold fewer rows.
  [[nodiscard]] std::vector<Bucket> buckets() const;

 private:
  void close();

  std::size_t most_;
  std::vector<Bucket> closed_;
  Bucket open_;
  std::uint64_t open_rows_ = 0;
  std::uint64_t bucket_rows_ = 1;
  std::uint64_t rows_ = 0;
};

}  // namespace morepro::host
