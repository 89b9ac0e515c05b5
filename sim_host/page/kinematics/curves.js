import { addChart } from "../shared/chart.js";

const HEIGHT = 165;

/** A line at the player's time that can be dragged. */
function playhead(player) {
  const seek = (plot, event) => {
    if (event.buttons !== 1) return;
    player.pause();
    player.seek(plot.posToVal(event.clientX - plot.over.getBoundingClientRect().left, "x"));
  };
  const move = (plot) => {
    plot.playhead.style.left = `${plot.valToPos(player.time, "x")}px`;
  };
  return {
    hooks: {
      init: (plot) => {
        plot.playhead = Object.assign(document.createElement("div"), { className: "playhead" });
        plot.over.append(plot.playhead);
        for (const kind of ["pointerdown", "pointermove"])
          plot.over.addEventListener(kind, (event) => seek(plot, event));
      },
      ready: move,
      setSize: move,
      setScale: move,
    },
    move,
  };
}

function charts({ joints, rows, has_error }) {
  const all = joints.map((joint, index) => ({ ...joint, index }));
  const slides = all.filter((joint) => joint.kind === "prismatic");
  const turns = all.filter((joint) => joint.kind === "revolute");
  const of = (title, y, group, columns) => ({
    title, y,
    series: group.map((joint) => ({ label: joint.name, color: joint.index })),
    columns: group.map((joint) => columns[joint.index]),
  });
  const axes = ["x", "y", "z"].map((label) => ({ label }));
  const list = [
    of("Slides", "m", slides, rows.joints),
    of("Turns", "rad", turns, rows.joints),
    of("Speeds of the slides", "m/s", slides, rows.rates),
    of("Speeds of the turns", "rad/s", turns, rows.rates),
    { title: "Tool, wanted", y: "m", series: axes, columns: rows.tool_m },
    { title: "Speed of the tool", y: "m/s", series: axes, columns: rows.tool_speed_m_s },
  ];
  if (has_error)
    list.push({ title: "Tool, wanted minus reached", y: "m", series: axes, columns: rows.error_m });
  return list.filter((chart) => chart.series.length > 0);
}

/** Every curve of the trajectory, with the player's time in all of them. */
export function addCurves(place, data, trajectory, player) {
  const head = playhead(player);
  const drawn = charts(data).map(({ title, y, series, columns }) =>
    addChart(place, { title, x: "s", y, series, height: HEIGHT, sync: "time", plugins: [head] },
      [data.rows.time_s, ...columns]));
  player.onChange(() => {
    const idx = trajectory.rowAt(player.time);
    for (const { plot } of drawn) {
      head.move(plot);
      if (!plot.over.matches(":hover")) plot.setLegend({ idx });
    }
  });
}
