#include "sim_host/recording/csv_row.hpp"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "sim_host/recording/recording_time.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool ends_field(char c) { return c == ',' || c == '\n'; }

struct Cursor {
  const char* position;
  const char* end;

  [[nodiscard]] bool at_field_end() const { return position == end || ends_field(*position); }
  void skip_blanks() {
    while (position != end && is_blank(*position)) ++position;
  }
  void skip_field() {
    while (!at_field_end()) ++position;
  }
};

/// One row, and what is needed to say where in it something is wrong.
class RowParser {
 public:
  RowParser(const CsvHeader& header, Cursor cursor, std::size_t line)
      : header_(header), cursor_(cursor), row_start_(cursor.position), line_(line) {}

  const char* parse(CsvRow& row) {
    for (std::size_t i = 0; i < header_.columns.size(); ++i) {
      if (i > 0) take_comma(i);
      parse_field(header_.columns[i], row);
    }
    if (cursor_.position != cursor_.end && *cursor_.position == ',') refuse_count(count_fields());
    return cursor_.position == cursor_.end ? cursor_.end : cursor_.position + 1;
  }

 private:
  void take_comma(std::size_t fields_so_far) {
    if (cursor_.position == cursor_.end || *cursor_.position != ',') refuse_count(fields_so_far);
    ++cursor_.position;
  }

  void parse_field(const CsvColumn& column, CsvRow& row) {
    if (column.kind == CsvColumn::Kind::kIgnored) return cursor_.skip_field();
    cursor_.skip_blanks();
    const char* field = cursor_.position;
    if (column.kind == CsvColumn::Kind::kTime) {
      row.time_s = parse_number<double>(column);
      if (!(std::fabs(row.time_s) < kLongestTimeS)) refuse_time(field);
    } else {
      if (cursor_.at_field_end()) return;
      const float value = parse_number<float>(column);
      if (!std::isnan(value)) row.frame.set(column.channel, value);
    }
  }

  template <typename T>
  T parse_number(const CsvColumn& column) {
    T value{};
    const char* field = cursor_.position;
    const char* first = field;
    if (cursor_.end - first > 1 && first[0] == '+' && first[1] != '-') ++first;
    const auto result = fast_float::from_chars(first, cursor_.end, value);
    cursor_.position = result.ptr;
    cursor_.skip_blanks();
    if (result.ec == std::errc::invalid_argument || !cursor_.at_field_end()) refuse_text(column, field);
    return value;
  }

  [[nodiscard]] TextPlace place(const char* position) const {
    return {header_.info.file, line_, static_cast<std::size_t>(position - row_start_) + 1};
  }

  [[nodiscard]] std::size_t count_fields() {
    std::size_t fields = 1;
    for (const char* c = row_start_; c != cursor_.end && *c != '\n'; ++c) fields += *c == ',' ? 1 : 0;
    return fields;
  }

  [[nodiscard]] bool is_cut() const { return std::find(row_start_, cursor_.end, '\n') == cursor_.end; }

  [[noreturn]] void refuse_count(std::size_t fields) {
    if (fields < header_.columns.size() && is_cut())
      throw UserError(
          place(cursor_.position),
          fmt::format("the file ends within this row, behind {} fields of {}; remove the row that "
                      "was cut",
                      fields, header_.columns.size()));
    throw UserError(
        place(cursor_.position),
        fmt::format("the row has {} fields, the header has {}; give every row one field per column, empty "
                    "where a sample is missing",
                    fields, header_.columns.size()));
  }

  [[noreturn]] void refuse_text(const CsvColumn& column, const char* field) {
    cursor_.position = field;
    cursor_.skip_field();
    const std::string_view text(field, static_cast<std::size_t>(cursor_.position - field));
    if (const std::size_t fields = count_fields(); fields != header_.columns.size()) refuse_count(fields);
    if (text.empty()) {
      throw UserError(place(field),
                      fmt::format("'{}' is empty; every row needs its time in seconds", column.name));
    }
    throw UserError(place(field),
                    fmt::format("'{}' in column '{}' is not a number; write a decimal number such as -1.5e-3",
                                text.substr(0, 40), column.name));
  }

  [[noreturn]] void refuse_time(const char* field) const {
    throw UserError(place(field),
                    "the time is not finite, or too large for seconds; correct or remove the row");
  }

  const CsvHeader& header_;
  Cursor cursor_;
  const char* row_start_;
  std::size_t line_;
};

}  // namespace

std::size_t parse_csv_row(const CsvHeader& header, std::string_view text, std::size_t offset,
                          std::size_t line, CsvRow& row) {
  row.frame = SensorFrame{};
  RowParser parser(header, {text.data() + offset, text.data() + text.size()}, line);
  return static_cast<std::size_t>(parser.parse(row) - text.data());
}

}  // namespace morepro::host
