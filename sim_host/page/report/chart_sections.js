// Sections that are charts over time and a sentence.
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
export const wear = charts("wear", "Wear",
  "The chip load that the torque looks like beside the commanded one: a blunt tool needs the torque of a " +
    "thicker chip. Before it says WATCH or REPLACE the monitor allows for errors of the datasheet and waits " +
    "whether it lasts.",
  "The machine file describes no tool, so there is no wear to speak of.", "replay");
