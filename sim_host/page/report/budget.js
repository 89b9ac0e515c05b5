import { shown } from "../shared/number.js";
import { barOf, element, percent } from "./element.js";

const row = (name, value) =>
  element("tr", {}, element("th", { scope: "row", text: name }), element("td", { className: "number", text: value }));
const TEXT =
  "Measured on the PC that replayed, this report's own work included; a board's figures are in the project's README.";

export const budget = {
  id: "budget",
  title: "Real-time budget",
  build(place, { data }) {
    if (!data.timing) return false;
    const { frames, elapsed_s: elapsed } = data.timing;
    const perFrame = elapsed / frames;
    const period = 1 / data.span.rate_hz;
    place.append(element("table", {},
      row("one frame takes", `${shown(1e6 * perFrame, 3)} µs`),
      row("time between two frames", `${shown(1e6 * period, 4)} µs`),
      row("share of it", percent(perFrame / period, 2)),
      row("frames per second", String(Math.round(frames / elapsed)))), barOf(perFrame / period),
    element("p", { className: "muted", text: TEXT }));
    return true;
  },
};
