#include "sim_host/recording/column_mapping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "sim_host/support/suggestion.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

constexpr std::string_view kTime = "time_s";

constexpr auto kRecordedColumns = [] {
  std::array<std::string_view, kChannelCount + 1> names{};
  for (std::size_t i = 0; i < kChannelCount; ++i) names[i] = kChannels[i].column;
  names[kChannelCount] = kTime;
  return names;
}();

}  // namespace

std::string_view column_name(const std::optional<Channel>& channel) {
  return channel ? info_of(*channel).column : kTime;
}

bool is_column(std::string_view name) {
  return std::find(kRecordedColumns.begin(), kRecordedColumns.end(), name) != kRecordedColumns.end();
}

ColumnSource column_source(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos)
    throw UsageError(fmt::format("--map {}: write COLUMN=VARIABLE, for example feed_force_n=force", text));
  const std::string_view column = std::string_view(text).substr(0, equals);
  const auto known = std::find(kRecordedColumns.begin(), kRecordedColumns.end(), column);
  if (known == kRecordedColumns.end())
    throw UsageError(fmt::format("--map {}: '{}' is no column of a recording{}; the columns are {}", text,
                                 column, did_you_mean(column, kRecordedColumns),
                                 fmt::join(kRecordedColumns, ", ")));
  ColumnSource source;
  if (*known != kTime) source.channel = static_cast<Channel>(known - kRecordedColumns.begin());
  source.variable = text.substr(equals + 1);
  if (const std::size_t times = source.variable.rfind('*'); times != std::string::npos) {
    source.factor = source.variable.substr(0, times);
    source.variable.erase(0, times + 1);
  }
  if (source.variable.empty())
    throw UsageError(fmt::format("--map {}: a variable is missing behind '='", text));
  return source;
}

std::vector<ColumnSource> column_sources(const std::vector<std::string>& texts) {
  std::vector<ColumnSource> sources;
  for (const std::string& text : texts) {
    sources.push_back(column_source(text));
    const auto same = [&](const ColumnSource& other) { return other.channel == sources.back().channel; };
    if (std::count_if(sources.begin(), sources.end(), same) > 1)
      throw UsageError(fmt::format("--map {}: '{}' is mapped twice; choose one variable", text,
                                   column_name(sources.back().channel)));
  }
  return sources;
}

}  // namespace morepro::host
