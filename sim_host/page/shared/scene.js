import {
  Color, DirectionalLight, GridHelper, HemisphereLight, PerspectiveCamera, Scene, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { color, onThemeChange } from "./theme.js";

/** 1, 2 or 5 times a power of ten, near a tenth of a length. */
function gridStep(length) {
  const power = 10 ** Math.floor(Math.log10(length / 10));
  return [1, 2, 5, 10].find((step) => step * power >= length / 10) * power;
}

/** The picture: things, grid and light. Drawn when something changed, not all the time. */
export class View {
  /** `room`: a Box3 in m. Throws where the browser has no WebGL. */
  constructor(place, room) {
    Object.assign(this, { place, room, things: [], scene: new Scene(), isWanted: false });
    this.size = room.getSize(new Vector3()).length();
    this.renderer = new WebGLRenderer({ antialias: true });
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    place.append(this.renderer.domElement);
    this.camera = new PerspectiveCamera(40, 1, this.size / 200, this.size * 50);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener("change", () => this.draw());
    this.#addLight();
    this.#paint();
    this.fit();
    onThemeChange(() => this.#paint());
    new ResizeObserver(() => this.#resize()).observe(place);
  }

  /** A thing has a `root` and takes its colours anew with `retint()`. */
  add(thing) {
    this.things.push(thing);
    this.scene.add(thing.root);
    thing.retint();
    this.draw();
  }

  #addLight() {
    const sun = new DirectionalLight("#ffffff", 2.2);
    sun.position.set(0.6, -1, 1.6);
    this.scene.add(sun, new HemisphereLight("#ffffff", "#8a93a0", 1.5));
  }

  /** Everything that follows the theme. */
  #paint() {
    this.scene.background = new Color(color("background"));
    if (this.grid) this.scene.remove(this.grid);
    this.gridStep_m = gridStep(this.size);
    const lines = 2 * Math.ceil(this.size / this.gridStep_m);
    this.grid = new GridHelper(lines * this.gridStep_m, lines, color("muted"), color("line")).rotateX(Math.PI / 2);
    this.grid.position.z = this.room.min.z;
    this.scene.add(this.grid);
    for (const thing of this.things) thing.retint();
    this.draw();
  }

  /** Brings the whole room into the picture. */
  fit() {
    this.#resize();
    const middle = this.room.getCenter(new Vector3());
    const angle = Math.min(1, this.camera.aspect) * Math.tan((this.camera.fov / 360) * Math.PI);
    const distance = (0.62 * this.size) / angle;
    this.camera.position.copy(middle).addScaledVector(new Vector3(0.75, -1, 0.6).normalize(), distance);
    this.controls.target.copy(middle);
    this.controls.update();
    this.draw();
  }

  #resize() {
    const { clientWidth: width, clientHeight: height } = this.place;
    if (width === 0 || height === 0) return;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.renderer.setSize(width, height);
    this.draw();
  }

  /** Once per frame at most. */
  draw() {
    if (this.isWanted) return;
    this.isWanted = true;
    requestAnimationFrame(() => {
      this.isWanted = false;
      this.renderer.render(this.scene, this.camera);
    });
  }
}
