import { shown } from "../shared/number.js";
import { barOf, barWithInterval, element, percent, spoken } from "./element.js";

const MODELS = [
  ["datasheet", "datasheet"], ["refit", "refit"], ["with_effect", "with effects"], ["noise_floor", "noise floor"],
];
const HELD_OUT = "Each piece of the recording is judged by models fitted to the others; 90 % intervals.";
const NO_EFFECT = "No effect was added, so there is no share to state.";

/** Without an interval where the recording has too few pieces for one, and for what noise leaves. */
function errorBar(error, interval, most, className) {
  const share = (value) => (most > 0 ? value / most : 0);
  if (interval == null || interval.includes(null)) return barOf(share(error), className);
  return barWithInterval(share(error), interval.map(share), className);
}

function bars(title, errors, intervals) {
  const highest = Object.values(intervals).map(([, high]) => high ?? 0);
  const most = Math.max(...MODELS.map(([key]) => errors[key] ?? 0), ...highest);
  const table = element("table", { className: "bars" }, element("caption", { text: title }));
  for (const [key, name] of MODELS) {
    if (errors[key] == null) continue;
    const [low, high] = intervals[key] ?? [];
    const row = table.insertRow();
    row.append(element("th", { scope: "row", text: name }),
      element("td", { className: "wide" }, errorBar(errors[key], intervals[key], most, `model-${key}`)),
      element("td", { className: "number", text: percent(errors[key], 2) }),
      element("td", { className: "number muted", text: low == null ? "" : `${(100 * low).toFixed(2)} .. ${percent(high, 2)}` }));
  }
  return table;
}

function shareBar({ share_closed: share, ci90: [low, high] }) {
  return element("div", { className: "line" }, barWithInterval(share, [low, high], ""),
    element("span", { text: `${percent(share)} of the gap closed, 90 %: ${percent(low)} .. ${percent(high)}` }));
}

function group(place, text, balances, intervals) {
  const known = Object.entries(balances).filter(([, errors]) => typeof errors === "object");
  if (known.length === 0) return;
  place.append(element("h4", { text }),
    element("div", { className: "all-bars" }, ...known.map(([balance, errors]) =>
      element("div", { className: "map" }, bars(spoken(balance), errors, intervals[balance])))));
}

/** How far the gap shrinks: the closed share with its interval, errors balance by balance. */
export function addShrinkage(place, { shrinkage, which }) {
  if (which.length > 0) place.append(shareBar(shrinkage));
  else place.append(element("p", { className: "muted", text: NO_EFFECT }));
  place.append(element("p", { className: "muted", text: HELD_OUT }));
  const { horizon_s: horizon } = shrinkage.free_run_nrmse;
  group(place, `Error of a free run over ${shown(horizon)} s, relative to what moves`, shrinkage.free_run_nrmse,
    shrinkage.free_run_nrmse_ci90);
  group(place, "Error of one step, relative to what moves", shrinkage.one_step_nrmse,
    shrinkage.one_step_nrmse_ci90);
}
