#pragma once
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "sim_host/report/pyramid.hpp"

namespace morepro::host {

/// Signals on one grid of rows, each in a pyramid of the same size: their buckets begin at the same rows.
class SeriesTable {
 public:
  SeriesTable(double row_s, std::size_t most_buckets) : row_s_(row_s), most_buckets_(most_buckets) {}

  /// Before the first row. Gives the index of the series. One without a label is not written: its pyramid is
  /// looked at.
  std::size_t add(std::string id, std::string label, std::string unit);

  /// Rows before this one are complete; those that were never begun have no samples. `row` never decreases.
  void begin_row(std::uint64_t row);
  void set(std::size_t series, double value);
  void set(std::size_t series, double low, double high);
  /// `rows`: of the whole grid.
  void finish(std::uint64_t rows) { begin_row(rows); }

  [[nodiscard]] const Pyramid& pyramid(std::size_t series) const { return series_[series].pyramid; }
  [[nodiscard]] double bucket_s() const;
  /// {id: {"label", "unit", "bucket_s", "low", "high", "data"}}: `data` is base64 of two 16-bit numbers
  /// (little endian) per bucket, smallest and largest value, 0 .. 65534 for low .. high, 65535 for none. A
  /// series without a sample is not there.
  [[nodiscard]] nlohmann::ordered_json json() const;

 private:
  struct Series {
    std::string id;
    std::string label;
    std::string unit;
    Pyramid pyramid;
    Bucket now{};
  };
  double row_s_;
  std::size_t most_buckets_;
  std::uint64_t row_ = 0;
  bool has_row_ = false;
  std::vector<Series> series_;
};

/// Buckets per series, so that so many series stay below the size that a page may have.
std::size_t buckets_for(std::size_t series);

}  // namespace morepro::host
