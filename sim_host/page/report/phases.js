// What the machine does, as bands behind every chart over time.
import { color } from "../shared/theme.js";

const CUT = 2;
const IDLE = 0;
const CHANGE = 3;
export const PHASES = ["idle", "air cut", "cut", "tool change"];
const HATCH_PX = 7;

/** [{from, to, value}] of runs that the program wrote as [[first bucket, value], ...]. */
export function spans({ runs, bucket_s }, end) {
  return runs.map(([first, value], i) => ({
    from: first * bucket_s,
    to: i + 1 < runs.length ? runs[i + 1][0] * bucket_s : end,
    value,
  }));
}

/** The span of a time: the last that begins before it. */
export function spanAt(list, time) {
  let low = 0;
  let high = list.length - 1;
  while (low < high) {
    const middle = (low + high + 1) >> 1;
    if (list[middle].from <= time) low = middle;
    else high = middle - 1;
  }
  const found = list[low];
  return found && time >= found.from && time <= found.to ? found : undefined;
}

/** A spindle that stands long enough between two cuts may have been given another tool. */
function withToolChanges(list, least) {
  const firstCut = list.findIndex(({ value }) => value === CUT);
  const lastCut = list.findLastIndex(({ value }) => value === CUT);
  return list.map((span, i) =>
    span.value === IDLE && i > firstCut && firstCut >= 0 && i < lastCut && span.to - span.from >= least
      ? { ...span, value: CHANGE } : span);
}

/** Empty where the recording does not tell. */
export function phaseSpans(phases, end) {
  if (!phases?.runs) return [];
  return withToolChanges(spans(phases, end), phases.tool_change_s);
}

function hatch(context, x, y, width, height) {
  context.save();
  context.beginPath();
  context.rect(x, y, width, height);
  context.clip();
  context.beginPath();
  for (let at = x - height; at < x + width; at += HATCH_PX * devicePixelRatio) {
    context.moveTo(at, y + height);
    context.lineTo(at + height, y);
  }
  context.strokeStyle = color("phase-line");
  context.stroke();
  context.restore();
}

/** Writes what a span is into it, where it is wide enough. */
export function nameSpans(plot, list, middle, nameOf) {
  const { ctx: context, bbox } = plot;
  context.save();
  context.font = `${12 * devicePixelRatio}px system-ui`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillStyle = "#000";
  for (const { from, to, value } of list) {
    if (value == null || to < plot.scales.x.min || from > plot.scales.x.max) continue;
    const left = Math.max(bbox.left, plot.valToPos(from, "x", true));
    const right = Math.min(bbox.left + bbox.width, plot.valToPos(to, "x", true));
    const name = nameOf(value);
    if (right - left < 40 || context.measureText(name).width > right - left - 8) continue;
    context.fillText(name, 0.5 * (left + right), middle);
  }
  context.restore();
}

/** Fills the spans that lie in a chart; those narrower than a pixel once per pixel. */
export function paintSpans(plot, list, top, height, fillOf, isHatched = () => false) {
  const { ctx: context, bbox } = plot;
  const { min, max } = plot.scales.x;
  let drawn = -Infinity;
  for (const { from, to, value } of list) {
    if (to < min || from > max || value == null) continue;
    const fill = fillOf(value);
    if (!fill) continue;
    const left = Math.max(bbox.left, plot.valToPos(from, "x", true));
    const right = Math.min(bbox.left + bbox.width, Math.max(plot.valToPos(to, "x", true), left + 1));
    if (right <= drawn) continue;
    context.fillStyle = fill;
    context.fillRect(left, top, right - left, height);
    if (isHatched(value)) hatch(context, left, top, right - left, height);
    drawn = right;
  }
}

export function phasePlugin(list) {
  return {
    hooks: {
      drawClear: (plot) => {
        const fills = PHASES.map((_, i) => color(`phase-${i}`));
        paintSpans(plot, list, plot.bbox.top, plot.bbox.height, (value) => fills[value], (value) => value === CHANGE);
      },
    },
  };
}

/** The phases that occur, with their colours. */
export function phaseLegend(list) {
  const legend = document.createElement("span");
  legend.className = "phases";
  const seen = new Set(list.map(({ value }) => value));
  PHASES.forEach((name, value) => {
    if (!seen.has(value)) return;
    const item = document.createElement("span");
    const mark = Object.assign(document.createElement("i"), { className: `phase phase-${value}` });
    item.append(mark, name);
    legend.append(item);
  });
  return legend;
}
