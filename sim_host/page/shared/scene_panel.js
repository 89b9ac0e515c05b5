import "./scene_panel.css";
import { addControls, CONTROLS } from "./player_controls.js";
import { View } from "./scene.js";

const MARKUP = `
<div id="scene" tabindex="0" role="application" aria-label="The machine in 3-D"
aria-describedby="hint"></div>
<p id="no-view" class="warning" hidden>
This browser shows no 3-D (WebGL is off); curves and values work without it.</p>
${CONTROLS}
<div class="readout"></div>
<p id="hint" class="muted"></p>
`;
const KEYS = "With the picture in focus space plays and pauses, arrow keys step, Home and End go to the ends.";

function hintOf(view) {
  if (!view) return KEYS;
  const square = Number(view.gridStep_m.toPrecision(1));
  const mouse = "Drag to orbit, two fingers or the right button to move, wheel to zoom";
  return `${mouse}; one square of the grid is ${square} m. ${KEYS}`;
}

/** A picture in 3-D with play, pause, time and speed below it; one per page. Values go into `readout`. */
export class ScenePanel {
  constructor(place, player, speeds) {
    place.insertAdjacentHTML("beforeend", MARKUP);
    this.scene = place.querySelector("#scene");
    this.readout = place.querySelector(".readout");
    this.hint = place.querySelector("#hint");
    this.view = null;
    addControls(place, player, speeds);
  }

  /** Draws `things` in their room; nothing where the browser has no WebGL: curves and values go on. */
  open(room, things) {
    try {
      this.view = new View(this.scene, room);
      for (const thing of things) this.view.add(thing);
      const fit = document.getElementById("fit");
      fit.disabled = false;
      fit.addEventListener("click", () => this.view.fit());
    } catch {
      this.scene.hidden = true;
      document.getElementById("no-view").hidden = false;
    }
    this.hint.textContent = hintOf(this.view);
  }
}
