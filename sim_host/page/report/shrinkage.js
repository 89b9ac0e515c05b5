import { barOf, element, percent, spoken, width } from "./element.js";

const MODELS = [
  ["datasheet", "datasheet"], ["refit", "refit"], ["with_effect", "with effects"], ["noise_floor", "noise floor"],
];
const NO_EFFECT = "No effect was added, so there is no share to state.";

function bars(title, errors) {
  const most = Math.max(...MODELS.map(([key]) => errors[key] ?? 0));
  const table = element("table", { className: "bars" }, element("caption", { text: title }));
  for (const [key, name] of MODELS) {
    if (errors[key] == null) continue;
    const row = table.insertRow();
    const bar = barOf(most > 0 ? errors[key] / most : 0, `model-${key}`);
    row.append(element("th", { scope: "row", text: name }), element("td", { className: "wide" }, bar),
      element("td", { className: "number", text: percent(errors[key], 2) }));
  }
  return table;
}

function shareBar({ share_closed: share, ci90: [low, high] }) {
  const bar = barOf(share);
  bar.append(element("u"));
  bar.style.setProperty("--low", width(low));
  bar.style.setProperty("--high", width(high));
  return element("div", { className: "line" }, bar,
    element("span", { text: `${percent(share)} of the gap closed, 90 %: ${percent(low)} .. ${percent(high)}` }));
}

function group(place, text, balances) {
  const known = Object.entries(balances).filter(([, errors]) => typeof errors === "object");
  if (known.length === 0) return;
  place.append(element("h4", { text }),
    element("div", { className: "maps" }, ...known.map(([balance, errors]) =>
      element("div", { className: "map" }, bars(spoken(balance), errors)))));
}

/** How far the gap shrinks: the closed share with its interval, errors balance by balance. */
export function addShrinkage(place, { shrinkage, which }) {
  if (which.length > 0) place.append(shareBar(shrinkage));
  else place.append(element("p", { className: "muted", text: NO_EFFECT }));
  const { horizon_s: horizon } = shrinkage.free_run_nrmse;
  group(place, `Error of a free run over ${horizon} s, relative to what moves`, shrinkage.free_run_nrmse);
  group(place, "Error of one step, relative to what moves", shrinkage.one_step_nrmse);
}
