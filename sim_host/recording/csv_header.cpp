#include "sim_host/recording/csv_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "sim_host/support/suggestion.hpp"
#include "sim_host/support/trimmed.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

constexpr std::string_view kTimeColumn = "time_s";
constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

constexpr auto kKnownColumns = [] {
  std::array<std::string_view, kChannelCount + 1> names{};
  for (std::size_t i = 0; i < kChannelCount; ++i) names[i] = kChannels[i].column;
  names[kChannelCount] = kTimeColumn;
  return names;
}();

// Spreadsheets put names between quotes.
std::string_view unquoted(std::string_view name) {
  const bool is_quoted = name.size() >= 2 && name.front() == '"' && name.back() == '"';
  return is_quoted ? trimmed(name.substr(1, name.size() - 2)) : name;
}

class HeaderParser {
 public:
  HeaderParser(const std::string& file, std::string_view text) : text_(text) {
    header_.info.file = file;
    if (text.starts_with(kByteOrderMark)) header_.first_row_offset = kByteOrderMark.size();
  }

  CsvHeader parse() {
    std::string_view line;
    while (take_line(line)) {
      const std::string_view content = trimmed(line);
      if (content.empty()) continue;
      if (content.front() != '#') {
        parse_names(line);
        return std::move(header_);
      }
      parse_metadata(content.substr(1));
    }
    throw UserError(
        {header_.info.file, line_, 0},
        "the recording is empty; expected a header row such as 'time_s,feed_force_n,feed_position_m'");
  }

 private:
  bool take_line(std::string_view& line) {
    std::size_t& offset = header_.first_row_offset;
    if (offset >= text_.size()) return false;
    const std::size_t end = std::min(text_.find('\n', offset), text_.size());
    line = text_.substr(offset, end - offset);
    offset = std::min(end + 1, text_.size());
    line_ = header_.first_row_line++;
    return true;
  }

  void parse_metadata(std::string_view line) {
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) return;
    header_.info.metadata.emplace_back(trimmed(line.substr(0, colon)), trimmed(line.substr(colon + 1)));
  }

  void parse_names(std::string_view line) {
    std::size_t start = 0;
    while (start <= line.size()) {
      const std::size_t end = std::min(line.find(',', start), line.size());
      add_column(unquoted(trimmed(line.substr(start, end - start))), start + 1);
      start = end + 1;
    }
    check_time_column(line);
    if (header_.info.recorded == 0) {
      throw UserError({header_.info.file, line_, 1},
                      fmt::format("no column is a signal of the machine{}; use names such as '{}' or '{}'",
                                  suggestion(), kChannels[0].column, kChannels[1].column));
    }
  }

  void add_column(std::string_view name, std::size_t place) {
    const bool twice = std::any_of(header_.columns.begin(), header_.columns.end(),
                                   [name](const CsvColumn& column) { return column.name == name; });
    if (twice) {
      throw UserError({header_.info.file, line_, place},
                      fmt::format("column '{}' is there twice; remove or rename one of the two", name));
    }
    header_.columns.push_back(classify(name, place));
  }

  CsvColumn classify(std::string_view name, std::size_t place) {
    CsvColumn column{.kind = CsvColumn::Kind::kIgnored, .channel = {}, .name = std::string(name)};
    const auto known = std::find(kKnownColumns.begin(), kKnownColumns.end(), name);
    if (name == kTimeColumn) {
      column.kind = CsvColumn::Kind::kTime;
    } else if (known != kKnownColumns.end()) {
      column.kind = CsvColumn::Kind::kChannel;
      column.channel = static_cast<Channel>(known - kKnownColumns.begin());
      header_.info.recorded = static_cast<std::uint16_t>(header_.info.recorded | bit_of(column.channel));
    } else {
      header_.info.warnings.push_back(fmt::format("{}: column '{}' is not known and is ignored{}",
                                                  to_text({header_.info.file, line_, place}), name,
                                                  did_you_mean(name, kKnownColumns)));
    }
    return column;
  }

  void check_time_column(std::string_view line) const {
    const bool found = std::any_of(header_.columns.begin(), header_.columns.end(),
                                   [](const CsvColumn& c) { return c.kind == CsvColumn::Kind::kTime; });
    if (found) return;
    const TextPlace place{header_.info.file, line_, 1};
    if (trimmed(line).find_first_not_of("0123456789.,;+-eE \t") == std::string_view::npos) {
      throw UserError(place, "a header row is missing above the numbers; name the columns, time_s first");
    }
    if (header_.columns.size() == 1 && line.find_first_of(";\t") != std::string_view::npos) {
      throw UserError(place, "the columns are not separated by commas; write 'time_s,...' with commas");
    }
    throw UserError(
        place, fmt::format("the header has no column 'time_s'{}; add the time in seconds under that name",
                           suggestion()));
  }

  /// " (did you mean 'x' by 'y'?)" for the first column that is nearly a known one.
  [[nodiscard]] std::string suggestion() const {
    for (const CsvColumn& column : header_.columns) {
      const std::string_view near = nearest(column.name, kKnownColumns);
      if (column.kind == CsvColumn::Kind::kIgnored && !near.empty())
        return fmt::format(" (did you mean '{}' by '{}'?)", near, column.name);
    }
    return {};
  }

  std::string_view text_;
  CsvHeader header_;
  std::size_t line_ = 0;
};

}  // namespace

CsvHeader read_csv_header(const std::string& file, std::string_view text) {
  return HeaderParser(file, text).parse();
}

}  // namespace morepro::host
