import { addCauses } from "./causes.js";
import { element, percent, spoken } from "./element.js";
import { addHeatMap } from "./heat_map.js";
import { addShrinkage } from "./shrinkage.js";
import { addTimeCharts } from "./time_chart.js";

const FREE_TEXT =
  "The models alone, told the inputs and nothing of what was measured, restarted every horizon: the gap as it shows.";

function heading(place, text) {
  place.append(element("h3", { text }));
}

function boardText({ verdict, effect, where, alias_set: aliases, confidence }) {
  const named = effect
    ? `: ${spoken(effect)} in the ${spoken(where)}, confidence ${percent(confidence, 0)}` +
      (aliases.length > 1 ? `; it could also be ${aliases.slice(1).map(spoken).join(" or ")}` : "")
    : "";
  return `The watch on the board says ${spoken(verdict)}${named}. ` +
    "'morepro diagnose' says where, how large, and how far it shrinks.";
}

function buildDiagnosis(place, context) {
  const { result } = context;
  heading(place, "Where: residual power in units of the noise floor, after the refit");
  addHeatMap(place, result.where, context.view);
  heading(place, "Which");
  addCauses(place, result);
  heading(place, "How far, on data that was not used to find it");
  addShrinkage(place, result);
}

/** Where, which, how far. */
export const gap = {
  id: "gap",
  title: "The gap",
  build(place, context) {
    const { command, result, data } = context;
    if (command === "replay") return boardText(result.gap);
    if (command === "diagnose") buildDiagnosis(place, context);
    if (!data.charts.some(({ section }) => section === "free_run"))
      return command === "diagnose" ? true : false;
    heading(place, "Before and after");
    place.append(element("p", { className: "muted", text: FREE_TEXT }));
    addTimeCharts(place, "free_run", context);
    return true;
  },
};
