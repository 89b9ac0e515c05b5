const byId = (id) => document.getElementById(id);

/** Buttons, slider, and keys while the focus is in `place`. */
export function addControls(place, player, view) {
  const [play, time, clock, speed] = ["play", "time", "clock", "speed"].map(byId);
  time.min = player.start;
  time.max = player.end;
  play.addEventListener("click", () => player.toggle());
  time.addEventListener("input", () => {
    const wanted = Number(time.value);
    player.pause();
    player.seek(wanted);
  });
  speed.addEventListener("change", () => {
    player.speed = Number(speed.value);
  });
  byId("fit").addEventListener("click", () => view?.fit());
  byId("fit").disabled = !view;
  place.addEventListener("keydown", (event) => {
    if (event.target.matches("select, button, input")) return;
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
    time.value = player.time;
    clock.textContent = `${player.time.toFixed(3)} of ${player.end.toFixed(3)} s`;
    clock.dataset.value = player.time;
  });
}
