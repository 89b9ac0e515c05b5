#include "sim_host/diff/result_diff.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "sim_host/support/input_file.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

using Json = nlohmann::ordered_json;
using Value = std::pair<std::string, Json>;

constexpr std::array<std::string_view, 2> kNotCompared{"timing.frames_per_s", "recording.file"};
constexpr std::array<const char*, 3> kNames{"name", "effect", "balance"};

Json read_json(const std::string& path) {
  const InputFile file(path);
  Json json = Json::parse(file.text(), nullptr, false);
  if (json.is_object()) return json;
  throw UserError(
      fmt::format("{}: no JSON result; give a file that --json of replay, identify or diagnose wrote", path));
}

/// "[mass_kg]" for a thing with a name, "[3]" for another.
std::string place_of(const Json& item, std::size_t index) {
  for (const char* name : kNames)
    if (item.is_object() && item.contains(name) && item[name].is_string())
      return fmt::format("[{}]", item[name].get<std::string>());
  return fmt::format("[{}]", index);
}

void collect(const Json& json, const std::string& path, std::vector<Value>& values) {
  if (json.is_object()) {
    for (const auto& [key, value] : json.items())
      collect(value, path.empty() ? key : fmt::format("{}.{}", path, key), values);
  } else if (json.is_array()) {
    for (std::size_t k = 0; k < json.size(); ++k) collect(json[k], path + place_of(json[k], k), values);
  } else {
    values.emplace_back(path, json);
  }
}

/// Every value with a name of its own; a list that names two things alike counts them.
std::vector<Value> values_of(const Json& json) {
  std::vector<Value> values;
  collect(json, "", values);
  std::set<std::string> taken;
  for (auto& [name, value] : values) {
    const std::string first = name;
    for (int k = 2; !taken.insert(name).second; ++k) name = fmt::format("{}#{}", first, k);
  }
  return values;
}

const Json* find(const std::vector<Value>& values, const std::string& name, std::size_t hint) {
  if (hint < values.size() && values[hint].first == name) return &values[hint].second;
  const auto found =
      std::find_if(values.begin(), values.end(), [&](const Value& value) { return value.first == name; });
  return found == values.end() ? nullptr : &found->second;
}

SignalDiff compared(const std::string& name, const Json& a, const Json& b, const Tolerance& tolerance) {
  SignalDiff value{.name = name, .tolerance = tolerance, .compared = 1};
  bool is_same = a == b;
  if (a.is_number() && b.is_number()) {
    const double number_a = a.get<double>(), number_b = b.get<double>();
    value.largest = {number_b - number_a, number_a, number_b, std::nullopt};
    value.rms_difference = std::fabs(number_b - number_a);
    is_same = is_within(number_a, number_b, tolerance);
  } else {
    value.text_a = a.dump();
    value.text_b = b.dump();
  }
  value.out = is_same ? 0 : 1;
  value.verdict = is_same ? SignalVerdict::kWithin : SignalVerdict::kOut;
  return value;
}

bool is_not_compared(const std::string& name) {
  return std::find(kNotCompared.begin(), kNotCompared.end(), name) != kNotCompared.end();
}

SignalDiff only_in(SignalVerdict side, const Value& value) {
  SignalDiff only{.name = value.first, .verdict = side};
  ++(side == SignalVerdict::kOnlyInA ? only.missing_in_b : only.missing_in_a);
  (side == SignalVerdict::kOnlyInA ? only.text_a : only.text_b) = value.second.dump();
  return only;
}

void check_schemas(const std::string& file_a, const Json& a, const std::string& file_b, const Json& b) {
  const std::string schema_a = a.value("schema", ""), schema_b = b.value("schema", "");
  if (schema_a != schema_b)
    throw UserError(fmt::format("{} is of schema '{}', {} of '{}'; compare results of one command", file_a,
                                schema_a, file_b, schema_b));
}

}  // namespace

DiffResult diff_results(const std::string& a, const std::string& b, const Tolerances& tolerances) {
  const Json json_a = read_json(a), json_b = read_json(b);
  check_schemas(a, json_a, b, json_b);
  const auto values_a = values_of(json_a), values_b = values_of(json_b);
  DiffResult result{.is_of_recordings = false, .tolerance = tolerances.common};
  result.a = {.file = a, .rows = values_a.size()};
  result.b = {.file = b, .rows = values_b.size()};
  for (std::size_t k = 0; k < values_a.size(); ++k) {
    const auto& [name, value] = values_a[k];
    const Json* other = find(values_b, name, k);
    if (is_not_compared(name)) {
      result.ignored.push_back(name);
    } else if (other == nullptr) {
      result.signals.push_back(only_in(SignalVerdict::kOnlyInA, values_a[k]));
    } else {
      result.signals.push_back(compared(name, value, *other, tolerances.of(name)));
    }
  }
  for (std::size_t k = 0; k < values_b.size(); ++k)
    if (!is_not_compared(values_b[k].first) && find(values_a, values_b[k].first, k) == nullptr)
      result.signals.push_back(only_in(SignalVerdict::kOnlyInB, values_b[k]));
  check_names(tolerances, result.signals);
  return result;
}

}  // namespace morepro::host
