import { addTimeCharts } from "../report/time_chart.js";
import { element } from "../report/element.js";
import { byVerdict, VERDICTS } from "./comparison.js";

const TEXT =
  "Both recordings in one chart, below it the difference; its band is the tolerance. Of recordings of different " +
  "rates the rows that are compared are drawn.";

/** Per signal both recordings, and below them their difference. */
export const overlays = {
  id: "signals",
  title: "Signals",
  build(place, context) {
    const { result } = context;
    if (result.kind === "results") return false;
    place.append(element("p", { className: "muted", text: TEXT }));
    const grid = element("div", { className: "pairs" });
    place.append(grid);
    for (const { name, verdict } of byVerdict(result.signals)) {
      const pair = element("article", { className: "pair", id: `signal-${name}` },
        element("h3", { text: `${name}: ${VERDICTS[verdict]}` }));
      grid.append(pair);
      if (addTimeCharts(pair, name, context) === 0)
        pair.append(element("p", { className: "muted", text: "Neither recording has a sample of it." }));
    }
    return true;
  },
};
