#include <array>
#include <nlohmann/json.hpp>

#include "sim_host/diff/diff_output.hpp"

namespace morepro::host {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array<const char*, 5> kVerdictKeys{"within", "out", "missing", "only_in_a", "only_in_b"};

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

Json tolerance_of(const Tolerance& tolerance) {
  return {{"absolute", tolerance.absolute}, {"relative", tolerance.relative}};
}

Json side_of(const DiffSide& side, bool is_recording) {
  if (!is_recording) return {{"file", side.file}, {"values", side.rows}};
  return {{"file", side.file}, {"rows", side.rows}, {"rate_hz", side.rate_hz}};
}

Json largest_of(const SignalDiff& signal) {
  if (!signal.largest) return nullptr;
  const LargestDifference& largest = *signal.largest;
  return {{"difference", largest.difference},
          {"a", largest.a},
          {"b", largest.b},
          {"time_s", or_null(largest.time_s)}};
}

Json signal_of(const SignalDiff& signal) {
  Json json{{"name", signal.name},
            {"verdict", kVerdictKeys[static_cast<std::size_t>(signal.verdict)]},
            {"tolerance", tolerance_of(signal.tolerance)},
            {"compared", signal.compared},
            {"out", signal.out},
            {"missing_in_a", signal.missing_in_a},
            {"missing_in_b", signal.missing_in_b},
            {"first_out_s", or_null(signal.first_out_s)},
            {"largest", largest_of(signal)},
            {"rms_difference", signal.rms_difference}};
  if (!signal.text_a.empty()) json["a"] = signal.text_a;
  if (!signal.text_b.empty()) json["b"] = signal.text_b;
  return json;
}

}  // namespace

std::string diff_json(const DiffResult& r) {
  Json signals = Json::array();
  for (const SignalDiff& signal : r.signals) signals.push_back(signal_of(signal));
  Json tolerance = tolerance_of(r.tolerance);
  if (r.is_of_recordings) tolerance["time_s"] = r.time_tolerance_s;
  Json json{{"schema", "morepro.diff/1"},
            {"kind", r.is_of_recordings ? "recordings" : "results"},
            {"a", side_of(r.a, r.is_of_recordings)},
            {"b", side_of(r.b, r.is_of_recordings)},
            {"tolerance", tolerance},
            {"within_tolerance", r.is_within()},
            {"explanation", diff_sentence(r)}};
  if (r.is_of_recordings)
    json["rows"] = {
        {"aligned", r.aligned_rows}, {"only_in_a", r.rows_only_in_a}, {"only_in_b", r.rows_only_in_b}};
  else
    json["not_compared"] = r.ignored;
  json["signals"] = signals;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace morepro::host
