const byId = (id) => document.getElementById(id);

export const CONTROLS = `
<div class="controls">
<button id="play" class="primary" type="button">Play</button>
<input id="time" type="range" min="0" step="any" value="0" aria-label="Time in s">
<output id="clock" for="time"></output>
<label>Speed <select id="speed"></select></label>
<button id="fit" type="button" disabled>Fit view</button>
</div>
`;

/** Buttons, slider, and keys while the focus is in `place`, which holds CONTROLS. `speeds`: 1 is as recorded. */
export function addControls(place, player, speeds) {
  const [play, time, clock, speed] = ["play", "time", "clock", "speed"].map(byId);
  speed.append(...speeds.map((value) => new Option(`${value} x`, value, value === 1, value === 1)));
  play.addEventListener("click", () => player.toggle());
  time.addEventListener("input", () => {
    const wanted = Number(time.value);
    player.pause();
    player.seek(wanted);
  });
  speed.addEventListener("change", () => {
    player.speed = Number(speed.value);
  });
  place.addEventListener("keydown", (event) => {
    const isNative = event.target.matches("select, button") || (event.target.matches("input") && event.key !== " ");
    if (isNative) return;
    const step = (player.end - player.start) / 100;
    const actions = { " ": () => player.toggle(), ArrowLeft: () => player.seek(player.time - step),
      ArrowRight: () => player.seek(player.time + step), Home: () => player.seek(player.start),
      End: () => player.seek(player.end) };
    if (!actions[event.key]) return;
    event.preventDefault();
    actions[event.key]();
  });
  player.onChange(() => {
    play.textContent = player.isPlaying ? "Pause" : "Play";
    time.min = player.start;
    time.max = player.end;
    time.value = player.time;
    clock.textContent = `${player.time.toFixed(3)} of ${player.end.toFixed(3)} s`;
    clock.dataset.value = player.time;
  });
}
