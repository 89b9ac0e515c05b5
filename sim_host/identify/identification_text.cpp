#include <fmt/format.h>

#include <cmath>

#include "sim_host/identify/identification.hpp"

namespace morepro::host {
namespace {

std::string value_text(const ParameterResult& p) {
  if (!std::isfinite(p.refit)) return "";
  return fmt::format("  refit {:11.5g} +- {:.2g} ({:.2g} %)", p.refit, p.standard_error,
                     100.0 * p.standard_error / p.refit);
}

std::string parameter_text(const ParameterResult& p) {
  const std::string datasheet =
      std::isfinite(p.datasheet) ? fmt::format("  datasheet {:11.5g}", p.datasheet) : std::string();
  const std::string reason = p.reason.empty()    ? std::string()
                             : p.is_identifiable ? fmt::format("; {}", p.reason)
                                                 : fmt::format("  not identifiable: {}", p.reason);
  return fmt::format("  {:26}{}{}{}\n", p.name, datasheet, value_text(p), reason);
}

}  // namespace

std::string identification_text(const IdentificationResult& r) {
  std::string text =
      fmt::format("recording   {} rows at {:g} Hz, {:.3f} s, {} missing\nmachine     {}\nparameters\n",
                  r.rows, r.rate_hz, r.duration_s, r.missing_rows, r.machine);
  for (const ParameterResult& p : r.parameters) text += parameter_text(p);
  for (const DerivativeOrigin& d : r.derivatives)
    text +=
        fmt::format("derivative  {}: {}\n", d.quantity,
                    d.is_measured ? "measured" : fmt::format("difference over {:g} ms", 1.0e3 / r.rate_hz));
  if (!r.axes.empty()) text += "fit\n";
  for (const AxisFitFigures& a : r.axes)
    text += fmt::format("  {:8}  innovations {:.3f} of the sensors' noise, correlation {:.2f}, {} passes\n",
                        a.axis, std::sqrt(a.innovation_ratio), a.correlation, a.passes);
  return text +
         fmt::format("excitation  {}\n", r.is_sufficient ? "sufficient" : "not sufficient: " + r.advice);
}

}  // namespace morepro::host
