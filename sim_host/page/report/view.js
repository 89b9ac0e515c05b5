// The time that all charts show.
const STEP = 0.25;
const FEWEST_ROWS = 20;
const TEXT = { in: "+", out: "−", back: "◀", on: "▶", whole: "Whole" };
const NAMES = { in: "Zoom in", out: "Zoom out", back: "Earlier", on: "Later", whole: "The whole recording" };
const KEYS = { "+": "in", "=": "in", "-": "out", ArrowLeft: "back", ArrowRight: "on", 0: "whole", Home: "whole" };

export class View {
  constructor({ duration_s, rate_hz }) {
    this.whole = duration_s;
    this.least = Math.min(duration_s, FEWEST_ROWS / rate_hz);
    this.from = 0;
    this.to = duration_s;
    this.listeners = [];
  }

  get span() { return this.to - this.from; }

  onChange(action) { this.listeners.push(action); }

  set(from, to) {
    const span = Math.min(this.whole, Math.max(this.least, to - from));
    const start = Math.min(Math.max(0, from), this.whole - span);
    if (start === this.from && span === this.span) return;
    this.from = start;
    this.to = start + span;
    for (const action of this.listeners) action();
  }

  reset() { this.set(0, this.whole); }

  /** `scale` < 1 shows less, around the middle. */
  zoom(scale) {
    const middle = 0.5 * (this.from + this.to);
    this.set(middle - 0.5 * scale * this.span, middle + 0.5 * scale * this.span);
  }

  move(share) { this.set(this.from + share * this.span, this.to + share * this.span); }

  act(name) {
    if (name === "in") this.zoom(0.5);
    if (name === "out") this.zoom(2);
    if (name === "back") this.move(-STEP);
    if (name === "on") this.move(STEP);
    if (name === "whole") this.reset();
  }

  /** True where the key was one of ours. */
  press(event) {
    const name = KEYS[event.key];
    if (!name || event.ctrlKey || event.metaKey || event.altKey) return false;
    this.act(name);
    event.preventDefault();
    return true;
  }
}

/** Buttons, the shown time, and keys for whatever of the page has the focus among the charts. */
export function addViewBar(place, view, legend) {
  const label = document.createElement("output");
  label.id = "shown";
  const write = () => {
    label.textContent = `${view.from.toFixed(4)} .. ${view.to.toFixed(4)} s`;
    label.dataset.from = view.from;
    label.dataset.to = view.to;
  };
  const buttons = Object.keys(TEXT).map((name) => {
    const button = Object.assign(document.createElement("button"), { textContent: TEXT[name], title: NAMES[name] });
    button.setAttribute("aria-label", NAMES[name]);
    button.addEventListener("click", () => view.act(name));
    return button;
  });
  const hint = Object.assign(document.createElement("span"), {
    className: "muted hint", id: "keys",
    textContent: "Drag over a chart to zoom, double click for the whole; keys + − ← → 0 on a chart.",
  });
  place.append(...buttons, label, legend, hint);
  view.onChange(write);
  write();
  document.addEventListener("keydown", (event) => {
    if (event.target.closest(".chart, #view")) view.press(event);
  });
}
