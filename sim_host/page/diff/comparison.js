import { element } from "../report/element.js";
import { shown } from "../shared/number.js";
import { tableOf } from "../shared/table.js";
import { toleranceText } from "./verdict.js";

/** Sign and words: nobody has to see the colour. */
export const VERDICTS = {
  within: "✓ within", out: "✕ out", missing: "! missing", only_in_a: "✕ only in A", only_in_b: "✕ only in B",
};

/** What differs first. */
export function byVerdict(signals) {
  const isWithin = ({ verdict }) => Number(verdict === "within");
  return [...signals].sort((one, other) => isWithin(one) - isWithin(other));
}

const outText = ({ out, compared }) => (compared > 0 ? `${out} of ${compared}` : "–");
const missingText = ({ missing_in_a: a, missing_in_b: b }) =>
  [[a, "A"], [b, "B"]].filter(([count]) => count > 0).map(([count, side]) => `${count} in ${side}`).join(", ") || "–";
const time = (value) => (value == null ? "–" : value.toFixed(6));
const sideText = (signal, side) => (signal.largest ? shown(signal.largest[side], 9) : signal[side] ?? "–");

const NAME = ["verdict", ({ verdict }) => VERDICTS[verdict]];
const TOLERANCE = ["tolerance", ({ tolerance }) => toleranceText(tolerance), true];
const DIFFERENCE = ({ largest }) => shown(largest?.difference, 6);
const OF_RECORDINGS = [
  ["signal", ({ name }) => name],
  NAME,
  ["first at, s", (signal) => time(signal.first_out_s), true],
  ["samples out", outText, true],
  ["missing", missingText, true],
  ["largest B − A", DIFFERENCE, true],
  ["at, s", ({ largest }) => time(largest?.difference ? largest.time_s : null), true],
  ["RMS of B − A", (signal) => (signal.compared > 0 ? shown(signal.rms_difference) : "–"), true],
  TOLERANCE,
];
const OF_RESULTS = [
  ["value", ({ name }) => name],
  NAME,
  ["A", (signal) => sideText(signal, "a")],
  ["B", (signal) => sideText(signal, "b")],
  ["B − A", DIFFERENCE, true],
  TOLERANCE,
];

function tableFor(columns, signals) {
  const frame = tableOf(columns, signals);
  frame.tabIndex = 0;
  [...frame.querySelectorAll("tbody tr")].forEach((row, i) => {
    row.dataset.name = signals[i].name;
    row.dataset.verdict = signals[i].verdict;
  });
  return frame;
}

/** Signals lead to their charts. */
function addLinks(frame) {
  for (const row of frame.querySelectorAll("tbody tr")) {
    const link = element("a", { href: `#signal-${row.dataset.name}`, text: row.dataset.name });
    row.cells[0].replaceChildren(link);
  }
}

function addResults(place, signals) {
  const out = signals.filter(({ verdict }) => verdict !== "within");
  const within = signals.filter(({ verdict }) => verdict === "within");
  if (out.length > 0) place.append(tableFor(OF_RESULTS, out));
  if (within.length === 0) return;
  place.append(element("details", { open: out.length === 0 },
    element("summary", { text: `${within.length} within tolerance` }), tableFor(OF_RESULTS, within)));
}

/** Signal by signal, or value by value, what the JSON says. */
export const comparison = {
  id: "comparison",
  title: "Comparison",
  build(place, { result, data }) {
    if (result.signals.length === 0) return "There is nothing to compare.";
    if (result.kind === "results") {
      addResults(place, result.signals);
      return true;
    }
    const frame = tableFor(OF_RECORDINGS, byVerdict(result.signals));
    addLinks(frame);
    place.append(frame);
    if (data.span.start_s === 0) return true;
    return `Times are those of the recordings; charts begin with 0 at ${data.span.start_s} s.`;
  },
};
