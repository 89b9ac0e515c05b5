#include "sim_host/simulate/effect_option.hpp"

#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <vector>

#include "lib/gap/effect_catalogue.hpp"
#include "lib/gap/effect_size.hpp"
#include "sim_host/machine/effect_rules.hpp"
#include "sim_host/support/suggestion.hpp"
#include "sim_host/support/user_error.hpp"

namespace morepro::host {
namespace {

using gap::Effect;

[[noreturn]] void refuse(const std::string& text, const std::string& sentence) {
  throw UsageError(fmt::format("--effect {}: {}", text, sentence));
}

std::optional<double> number_in(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = fast_float::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_whole = error == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
  return is_whole ? std::optional(value) : std::nullopt;
}

Effect effect_in(const std::string& text, std::string_view name) {
  if (const auto effect = gap::effect_named(name)) return *effect;
  std::vector<std::string_view> names;
  for (const gap::EffectInfo& info : gap::kEffects) names.push_back(info.name);
  refuse(text, fmt::format("no effect is called '{}'{}; 'morepro effects' lists them", name,
                           did_you_mean(name, names)));
}

double size_in(const std::string& text, Effect effect, std::string_view size) {
  const auto value = number_in(size);
  if (!value)
    refuse(text, fmt::format("'{}' is no number; write the size in {}", size, gap::info_of(effect).unit));
  if (const std::string objection = objection_to_size(effect, *value); !objection.empty())
    refuse(text, objection);
  return *value;
}

double onset_in(const std::string& text, std::string_view option, double duration_s) {
  constexpr std::string_view kFrom = "from=";
  const auto value = option.starts_with(kFrom) ? number_in(option.substr(kFrom.size())) : std::nullopt;
  if (!value) refuse(text, fmt::format("'{}' is not understood; write from=SECONDS after the comma", option));
  if (!(*value >= 0.0 && *value < duration_s))
    refuse(text,
           fmt::format("from={} is outside the run of 0 .. {} s; choose a time inside", *value, duration_s));
  return *value;
}

}  // namespace

std::string objection_to_rate(const gap::AppliedEffect& effect, double rate_hz) {
  const double most_s = 0.2 / rate_hz;
  if (effect.form.effect != Effect::kClockJitter || effect.coefficient[0] <= most_s) return {};
  return fmt::format("a jitter above a fifth of the sampling interval, {:g} s, is not simulated", most_s);
}

gap::AppliedEffect effect_from_option(const std::string& text, const gap::EffectScales<double>& scales,
                                      const EffectLimits& limits) {
  const std::string_view whole = text;
  const std::size_t equals = whole.find('=');
  if (equals == std::string_view::npos) refuse(text, "write NAME=SIZE or NAME=SIZE,from=SECONDS");
  const std::string_view value = whole.substr(equals + 1);
  const std::size_t comma = value.find(',');
  const Effect effect = effect_in(text, whole.substr(0, equals));
  gap::AppliedEffect one = gap::applied(effect, size_in(text, effect, value.substr(0, comma)), scales);
  if (comma != std::string_view::npos)
    one.onset_s = onset_in(text, value.substr(comma + 1), limits.duration_s);
  if (const std::string objection = objection_to_rate(one, limits.rate_hz); !objection.empty())
    refuse(text, objection);
  return one;
}

}  // namespace morepro::host
