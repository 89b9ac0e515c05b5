// Dashed lines across a chart: gates, bounds; and upright ones: harmonics.
import { shown } from "../shared/number.js";
import { color } from "../shared/theme.js";

function line(plot, draw, tint = color("muted")) {
  const { ctx: context } = plot;
  context.save();
  context.strokeStyle = tint;
  context.fillStyle = tint;
  context.lineWidth = devicePixelRatio;
  context.font = `${11 * devicePixelRatio}px system-ui`;
  context.setLineDash([6 * devicePixelRatio, 4 * devicePixelRatio]);
  context.beginPath();
  draw(context);
  context.stroke();
  context.restore();
}

/** Readable where a curve runs through it. */
function label(context, text, x, y) {
  context.save();
  context.setLineDash([]);
  context.lineWidth = 3 * devicePixelRatio;
  context.strokeStyle = color("panel");
  context.strokeText(text, x, y);
  context.fillText(text, x, y);
  context.restore();
}

export function limitPlugin(limits) {
  const one = (plot, { value, label: text }) => {
    const y = plot.valToPos(value, "y", true);
    const { left, top, width, height } = plot.bbox;
    if (!(y >= top && y <= top + height)) return;
    line(plot, (context) => {
      context.moveTo(left, y);
      context.lineTo(left + width, y);
      context.textAlign = "right";
      label(context, text, left + width - 4, y - 3);
    });
  };
  return { hooks: { draw: (plot) => limits.forEach((limit) => one(plot, limit)) } };
}

/** `marks`: [{x, label}]; labels that would overlap take turns in height. */
export function markPlugin(marks) {
  const one = (plot, { x, label: text }, index) => {
    const at = plot.valToPos(x, "x", true);
    const { left, top, width, height } = plot.bbox;
    if (!(at >= left && at <= left + width)) return;
    line(plot, (context) => {
      context.moveTo(at, top);
      context.lineTo(at, top + height);
      context.textAlign = "left";
      label(context, text, at + 3, top + (12 + 13 * (index % 3)) * devicePixelRatio);
    });
  };
  return { hooks: { draw: (plot) => marks.forEach((mark, index) => one(plot, mark, index)) } };
}

/** `segments`: [{from: {x, y}, to: {x, y}, label}]. */
export function segmentPlugin(segments) {
  const one = (plot, { from, to, label: text }) => {
    const { left, top, width, height } = plot.bbox;
    const [start, end] = [from, to].map(({ x, y }) => [plot.valToPos(x, "x", true), plot.valToPos(y, "y", true)]);
    line(plot, (context) => {
      context.save();
      context.beginPath();
      context.rect(left, top, width, height);
      context.clip();
      context.beginPath();
      context.lineWidth = 2 * devicePixelRatio;
      context.moveTo(...start);
      context.lineTo(...end);
      context.stroke();
      context.textAlign = "right";
      label(context, text, Math.min(end[0], left + width) - 4, end[1] - 6 * devicePixelRatio);
      context.restore();
      context.beginPath();
    }, color("text"));
  };
  return { hooks: { draw: (plot) => segments.forEach((segment) => one(plot, segment)) } };
}

/** A range that holds data and limits with a margin. */
export function rangeOf(scale, limits) {
  return (_, low, high) => {
    const values = [low, high, ...limits.map(({ value }) => value)].filter((value) => Number.isFinite(value));
    if (values.length === 0) return [0, 1];
    const least = Math.min(...values);
    const most = Math.max(...values);
    if (scale === "log") return [Math.max(least, 1e-12) / 1.2, most * 1.2];
    const margin = 0.06 * (most - least) || 0.5 * Math.abs(most) || 0.5;
    return [least - margin, most + margin];
  };
}

const DISTRIBUTION = { linear: 1, log: 3, asinh: 4 };

/** uPlot's options of a y scale. */
export function yScale(scale, limits) {
  return { distr: DISTRIBUTION[scale] ?? 1, asinh: 3, range: rangeOf(scale, limits) };
}

/** A few round numbers, equally far apart. */
function evenly(low, high) {
  const step = 10 ** Math.floor(Math.log10((high - low) / 2));
  const wide = [1, 2, 5].map((factor) => factor * step).find((size) => (high - low) / size <= 6) ?? 10 * step;
  const first = Math.ceil(low / wide);
  const count = Math.floor(high / wide) - first + 1;
  return Array.from({ length: count }, (_, i) => Number(((first + i) * wide).toPrecision(6)));
}

/** 1, 2 and 5 times powers of ten between two positive numbers; the powers alone where there are several. */
function decades(low, high) {
  const powers = [];
  for (let power = Math.floor(Math.log10(low)); power <= Math.ceil(Math.log10(high)); ++power) powers.push(10 ** power);
  const inside = (value) => value >= low && value <= high;
  const whole = powers.filter(inside);
  if (whole.length > 6) return whole.filter((_, i) => i % 2 === 0);
  if (whole.length > 2) return whole;
  const some = powers.flatMap((power) => [power, 2 * power, 5 * power]).filter(inside);
  return some.length > 2 ? some : evenly(low, high);
}

/** Ticks of an axis that is not linear, few enough to be read. */
export function readableTicks(scale, axis) {
  if (scale === "linear") return {};
  return {
    splits: (plot) => {
      const { min, max } = plot.scales[axis];
      if (scale === "log") return decades(min, max);
      const outer = decades(1, Math.max(-min, max)).filter((value) => value !== 2 && value !== 5 && value !== 1);
      return [...outer.map((value) => -value), -3, 0, 3, ...outer].sort((a, b) => a - b)
        .filter((value) => value >= min && value <= max);
    },
    filter: (_, splits) => splits,
    values: (_, splits) => splits.map((value) => shown(value)),
  };
}
