#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lib/frame/channel.hpp"

namespace morepro::host {

/// Where one column of a recording comes from in a file that has names of its own.
struct ColumnSource {
  std::optional<Channel> channel;  ///< none: the time
  std::string factor;              ///< a number or the name of a scalar variable; empty: 1
  std::string variable;
};

/// What a file does not say about itself.
struct ColumnMapping {
  std::vector<ColumnSource> sources;
  double rate_hz = 0.0;  ///< of a file without times; 0: it has them

  [[nodiscard]] bool is_empty() const { return sources.empty() && rate_hz == 0.0; }
};

/// "time_s" or the name of a channel.
std::string_view column_name(const std::optional<Channel>& channel);

/// Is it "time_s" or the name of a channel?
bool is_column(std::string_view name);

/// Reads "feed_force_n=vir", "feed_force_n=gtau*vir" or "feed_force_n=35.15*vir". Throws UsageError where the
/// left side is no column of a recording or the right side names nothing.
ColumnSource column_source(const std::string& text);

/// One source per text; throws UsageError where a column has two.
std::vector<ColumnSource> column_sources(const std::vector<std::string>& texts);

}  // namespace morepro::host
