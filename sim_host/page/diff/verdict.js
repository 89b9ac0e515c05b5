import { shown } from "../shared/number.js";
import { verdictSection } from "../report/verdict.js";

/** "0.5", "0.5 or 1 % of A", of which the greater counts. */
export function toleranceText({ absolute, relative }) {
  const share = `${shown(100 * relative)} % of A`;
  if (relative === 0) return shown(absolute);
  return absolute === 0 ? share : `${shown(absolute)} or ${share}`;
}

const count = (number, what) => `${number} ${number === 1 ? what : `${what}s`}`;

function evidenceOf({ kind, signals, rows, tolerance, not_compared: ignored }) {
  const what = kind === "results" ? "value" : "signal";
  const within = signals.filter(({ verdict }) => verdict === "within").length;
  const list = [`${within} of ${count(signals.length, what)} within tolerance`];
  if (rows) {
    list.push(`${count(rows.aligned, "row")} compared, at most ${tolerance.time_s} s apart; ` +
      `${rows.only_in_a} only in A, ${rows.only_in_b} only in B`);
  }
  list.push(`B may differ by ${toleranceText(tolerance)} where a ${what} has no tolerance of its own`);
  if (ignored?.length > 0) list.push(`Not compared, because it says nothing about the machine: ${ignored.join(", ")}`);
  return list;
}

export const verdict = verdictSection(({ result }) => ({
  state: result.within_tolerance ? "same" : "differs",
  sentence: result.explanation || "Everything is the same within tolerance",
  evidence: evidenceOf(result),
}));
