// Sections that are charts over time and a sentence.
import { shown } from "../shared/number.js";
import { element } from "./element.js";
import { addTimeCharts } from "./time_chart.js";

const NO_MODEL =
  "There is no axis of which both its inputs and what moves are recorded and described in the machine file.";
const MODEL_TEXT =
  "What the model expects of every sample from all samples before it, with its band of two standard deviations. A " +
  "bucket of samples is drawn from its smallest to its largest value, so no spike is lost.";

/** `command`: the only one that has it; none: all have. */
function charts(id, title, text, absent, command) {
  return {
    id, title,
    build(place, context) {
      if (command && context.command !== command) return false;
      place.append(element("p", { className: "muted", text }));
      if (addTimeCharts(place, id, context) > 0) return true;
      place.replaceChildren(place.firstChild);
      return absent;
    },
  };
}

export const model = charts("model", "Measured against model", MODEL_TEXT, NO_MODEL);
export const signals = charts("signals", "Recorded signals", "As recorded; a hole in a curve is a dropout.", false);
export const hypotheses = charts("hypotheses", "Hypotheses",
  "Probability of each chip load of the bank, while the tool cuts and the monitor can tell.",
  "The monitor could not tell the chip load at any time of this recording.", "replay");
const NO_TREND = "Trend: there is too little of it, or it wanders too much, to say how fast the tool gets blunt.";
const PER_HOUR = 3600;
/** Slower than this per second it is said per hour. */
const SLOW = 0.01;

function trendText(trend) {
  if (!trend) return NO_TREND;
  const { slope_per_s: slope, standard_error_per_s: error, from_s: from, to_s: to } = trend;
  const [scale, unit] = Math.abs(slope) + error < SLOW ? [PER_HOUR, "hour"] : [1, "second"];
  const sign = slope < 0 ? "−" : "+";
  const size = `${sign}${shown(scale * Math.abs(slope), 3)} ± ${shown(scale * error, 2)} per ${unit}`;
  const sure = Math.abs(slope) < 2 * error ? ", which is less than two standard errors: none that can be seen" : "";
  return `Trend from ${from.toFixed(3)} to ${to.toFixed(3)} s, since the tool could last have been changed: ` +
    `${size} (a straight line with its standard error)${sure}.`;
}

/** Charts, and below them how it goes on. */
function withTrend(section) {
  return {
    ...section,
    build(place, context) {
      const outcome = section.build(place, context);
      if (outcome === true) place.append(element("p", { id: "trend", text: trendText(context.data.wear_trend) }));
      return outcome;
    },
  };
}

export const wear = withTrend(charts("wear", "Wear",
  "The chip load that the torque looks like beside the commanded one: a blunt tool needs the torque of a " +
    "thicker chip. Before it says WATCH or REPLACE the monitor allows for errors of the datasheet and waits " +
    "whether it lasts.",
  "The machine file describes no tool, so there is no wear to speak of.", "replay"));
