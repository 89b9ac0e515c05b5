import { moveCursor, onCursor } from "../shared/chart.js";
import { Player } from "../shared/player.js";
import { addValue, showValue } from "../shared/readout.js";
import { ScenePanel } from "../shared/scene_panel.js";
import { onThemeChange } from "../shared/theme.js";
import { element } from "./element.js";
import { FeedMachine } from "./feed_machine.js";
import { MachineSignals } from "./machine_signals.js";
import { CURSOR } from "./time_chart.js";

const SPEEDS = [0.001, 0.01, 0.1, 0.5, 1, 2, 10, 60];
const NOTHING = "The recording holds neither a feed position nor a spindle speed, so there is nothing that could move.";
const TEXT =
  "The carriage stands where the feed axis was, the spindle has turned by the sum of its recorded speed; the sizes " +
  "of head and workpiece are not the machine's. It follows the cursor of the charts and plays the time that they show.";
const NO_FEED = " The feed position is not recorded: the carriage stands.";
const NO_SPEED = " The spindle's speed is not recorded: it does not turn.";

/** The values of the moment, as far as they are recorded. */
class Values {
  constructor(place, signals) {
    const table = element("table");
    place.append(table);
    const add = (id, name, unit) => {
      const cell = addValue(table, name, unit, id === "tool" ? "transparent" : undefined);
      cell.id = `machine-${id}`;
      return cell;
    };
    this.position = signals.feed && add("position", "feed position", "m");
    this.speed = signals.speed && add("speed", "spindle speed", "rad/s");
    this.commanded = signals.commanded && add("commanded", "commanded chip load", "mm");
    this.estimate = signals.estimate && add("estimate", "chip load that the torque looks like", "mm");
    this.tool = add("tool", "tool", "");
    this.mark = table.querySelector(".swatch");
  }

  show(now, drawn) {
    if (this.position) showValue(this.position, now.position_m === null ? null : drawn.x, 6);
    if (this.speed) showValue(this.speed, now.speed_rad_s, 2);
    if (this.commanded) showValue(this.commanded, now.commanded_mm);
    if (this.estimate) showValue(this.estimate, now.estimate_mm);
    this.tool.textContent = now.tool.text;
    this.mark.style.background = now.tool.fill;
  }
}

/** WebGL takes time to start: not before somebody looks. */
function whenSeen(place, action) {
  const observer = new IntersectionObserver((entries) => {
    if (!entries.some((entry) => entry.isIntersecting)) return;
    observer.disconnect();
    action();
  });
  observer.observe(place);
}

/** The charts' cursor moves the player; the player moves the cursor. */
function couple(player, view) {
  let isLed = false;
  let hasCursor = false;
  const lead = (action) => {
    isLed = true;
    action();
    isLed = false;
  };
  onCursor(CURSOR, (time) => lead(() => {
    hasCursor = true;
    player.pause();
    player.seek(time);
  }));
  player.onChange(() => {
    if (isLed) return;
    hasCursor = true;
    moveCursor(CURSOR, player.time);
  });
  view.onChange(() => {
    Object.assign(player, { start: view.from, end: view.to });
    lead(() => player.seek(player.time));
    // After the charts: the cursor keeps its time, not its place.
    if (hasCursor) requestAnimationFrame(() => moveCursor(CURSOR, player.time));
  });
}

function addMachine(place, context, signals) {
  const player = new Player(context.view.from, context.view.to);
  const panel = new ScenePanel(place, player, SPEEDS);
  const machine = new FeedMachine(signals.travel, signals.teeth);
  const values = new Values(panel.readout, signals);
  const show = () => {
    const now = signals.at(player.time);
    machine.pose(now);
    values.show(now, machine.toolPosition());
    panel.view?.draw();
  };
  player.onChange(show);
  onThemeChange(show);
  player.seek(player.start);
  couple(player, context.view);
  whenSeen(panel.scene, () => panel.open(machine.room, [machine]));
}

/** The machine in 3-D at the time of the cursor. */
export const machine = {
  id: "machine",
  title: "The machine",
  build(place, context) {
    const signals = new MachineSignals(context);
    if (!signals.feed && !signals.speed) return NOTHING;
    const text = TEXT + (signals.feed ? "" : NO_FEED) + (signals.speed ? "" : NO_SPEED);
    place.append(element("p", { className: "muted", text }));
    // Its elements are looked for by id: they must be on the page.
    requestAnimationFrame(() => addMachine(place, context, signals));
    return true;
  },
};
