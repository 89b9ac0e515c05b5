import { shown } from "../shared/number.js";
import { tableOf } from "../shared/table.js";
import { element, percent } from "./element.js";

const UNITS = "Units are in the names: _nm_a is N m/A, _kgm2 kg m², _ohm Ω, _h H.";
const change = ({ datasheet, refit }) =>
  datasheet && refit != null
    ? `${refit >= datasheet ? "+" : "−"}${percent(Math.abs(refit / datasheet - 1), 2)}` : "–";
const deviations = ({ datasheet, refit, standard_error: error }) =>
  datasheet != null && refit != null && error > 0 ? shown(Math.abs(refit - datasheet) / error, 3) : "–";

const COLUMNS = [
  ["parameter", (row) => row.name],
  ["datasheet", (row) => shown(row.datasheet), true],
  ["value", (row) => shown(row.refit, 5), true],
  ["standard error", (row) => shown(row.standard_error, 2), true],
  ["relative", (row) => (row.refit ? percent(Math.abs(row.standard_error / row.refit), 3) : "–"), true],
  ["change", change, true],
  ["in standard errors", deviations, true],
  ["identifiable", (row) => (row.identifiable ? "✓ yes" : "✕ no")],
  ["why", (row) => row.reason || ""],
];

export const parameters = {
  id: "parameters",
  title: "Parameters",
  build(place, { result }) {
    if (!result.parameters?.length) return "No parameter could be looked at in this recording.";
    const frame = tableOf(COLUMNS, result.parameters);
    frame.tabIndex = 0;
    place.append(element("p", { className: "muted", text: UNITS }), frame);
    return true;
  },
};
