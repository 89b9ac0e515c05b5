// What a recording tells about the machine at a time.
import { color } from "../shared/theme.js";
import { PHASES, spanAt, spans } from "./phases.js";

const CUT = 2;

/** The angle that the spindle has turned by at the beginning of every bucket; where no speed is known it stands. */
function angleOf(speed) {
  const { lows, highs } = speed.level(0);
  const angles = new Float64Array(lows.length + 1);
  for (let i = 0; i < lows.length; ++i) {
    const mean = 0.5 * (lows[i] + highs[i]);
    angles[i + 1] = angles[i] + (Number.isNaN(mean) ? 0 : mean * speed.source.bucket_s);
  }
  return angles;
}

export class MachineSignals {
  constructor({ store, phases, data }) {
    this.feed = store.get("recording.feed_position_m");
    this.speed = store.get("recording.spindle_speed_rad_s");
    this.commanded = store.get("monitor.commanded") ?? store.get("recording.chip_load_mm");
    this.estimate = store.get("monitor.chip_load");
    this.phases = phases;
    this.states = data.states && { names: data.states.names, spans: spans(data.states, data.span.duration_s) };
    this.angles = this.speed && angleOf(this.speed);
    this.teeth = data.turning?.teeth || 2;
  }

  /** Along the axis, in m; of an axis that is not recorded or did not move one point. */
  get travel() {
    const { low, high } = this.feed?.source ?? { low: 0, high: 0 };
    return { low, high };
  }

  #angleAt(time) {
    if (!this.angles) return 0;
    const place = Math.min(time / this.speed.source.bucket_s, this.angles.length - 1);
    const i = Math.min(Math.floor(place), this.angles.length - 2);
    return this.angles[i] + (place - i) * (this.angles[i + 1] - this.angles[i]);
  }

  /** What the tool does, the monitor's word on it while it cuts, and the colour for both. */
  #toolAt(time) {
    const phase = spanAt(this.phases, time)?.value;
    if (phase == null) return { text: "not known", fill: color("muted") };
    const state = this.states && phase === CUT ? this.states.names[spanAt(this.states.spans, time)?.value] : undefined;
    const fill = state ? `state-${state.toLowerCase().replaceAll("_", "-")}` : `phase-strong-${phase}`;
    return { text: state ? `${PHASES[phase]}, ${state}` : PHASES[phase], fill: color(fill) };
  }

  /** null: not recorded, or missing. */
  at(time) {
    return {
      position_m: this.feed?.at(time) ?? null,
      speed_rad_s: this.speed?.at(time) ?? null,
      angle_rad: this.#angleAt(time),
      commanded_mm: this.commanded?.at(time) ?? null,
      estimate_mm: this.estimate?.at(time) ?? null,
      tool: this.#toolAt(time),
    };
  }
}
