import { shown } from "../shared/number.js";
import { tableOf } from "../shared/table.js";
import { element, percent } from "./element.js";

const UNITS = "Units are in the names: _nm_a is N m/A, _kgm2 kg m², _ohm Ω, _h H.";
/** Never "0.000 %" for what is small: an error of zero would be a claim. */
const relative = ({ refit, standard_error: error }) =>
  refit && error != null ? `${shown(100 * Math.abs(error / refit), 2)} %` : "–";
const change = ({ datasheet, refit }) => {
  if (!datasheet || refit == null) return "–";
  const size = percent(Math.abs(refit / datasheet - 1), 2);
  return size === percent(0, 2) ? size : `${refit > datasheet ? "+" : "−"}${size}`;
};
const deviations = ({ datasheet, refit, standard_error: error }) =>
  datasheet != null && refit != null && error > 0 ? shown(Math.abs(refit - datasheet) / error, 3) : "–";

const COLUMNS = [
  ["parameter", (row) => row.name],
  ["datasheet", (row) => shown(row.datasheet), true],
  ["value", (row) => shown(row.refit, 5), true],
  ["standard error", (row) => shown(row.standard_error, 2), true],
  ["relative", relative, true],
  ["change", change, true],
  ["in standard errors", deviations, true],
  ["identifiable", (row) => (row.identifiable ? "✓ yes" : "✕ no")],
];
const why = ({ reason, identifiable }) => (reason ? `${identifiable ? "note" : "why"}: ${reason}` : "");

export const parameters = {
  id: "parameters",
  title: "Parameters",
  build(place, { result }) {
    if (!result.parameters?.length) return "No parameter could be looked at in this recording.";
    const frame = tableOf(COLUMNS, result.parameters, why);
    frame.tabIndex = 0;
    place.append(element("p", { className: "muted", text: UNITS }), frame);
    return true;
  },
};
