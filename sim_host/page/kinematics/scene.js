import {
  Box3, BufferGeometry, Color, DirectionalLight, Float32BufferAttribute, GridHelper, HemisphereLight, Line,
  LineBasicMaterial, LineDashedMaterial, Mesh, MeshBasicMaterial, PerspectiveCamera, Scene, SphereGeometry, Vector3,
  WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { color, onThemeChange } from "../shared/theme.js";
import { framesOf } from "./chain.js";

/** 1, 2 or 5 times a power of ten, near a tenth of a length. */
function gridStep(length) {
  const power = 10 ** Math.floor(Math.log10(length / 10));
  return [1, 2, 5, 10].find((step) => step * power >= length / 10) * power;
}

/** The room that the machine needs along its trajectory. */
export function roomOf(joints, trajectory, tool) {
  const room = new Box3().expandByPoint(new Vector3());
  const stride = Math.max(1, Math.floor(trajectory.times.length / 200));
  for (let row = 0; row < trajectory.times.length; row += stride) {
    const values = trajectory.columns.map((column) => column[row]);
    for (const frame of framesOf(joints, values)) room.expandByPoint(new Vector3().setFromMatrixPosition(frame));
  }
  tool[0].forEach((x, row) => room.expandByPoint(new Vector3(x, tool[1][row], tool[2][row])));
  return room;
}

function lineOf(tool, material) {
  const geometry = new BufferGeometry();
  const points = tool[0].flatMap((x, row) => [x, tool[1][row], tool[2][row]]);
  geometry.setAttribute("position", new Float32BufferAttribute(points, 3));
  return new Line(geometry, material);
}

/** The picture: machine, path, grid and light. Drawn when something changed, not all the time. */
export class View {
  /** Throws where the browser has no WebGL. */
  constructor(place, machine, room, { tool, points_m }) {
    Object.assign(this, { place, machine, room, scene: new Scene(), isWanted: false });
    this.size = room.getSize(new Vector3()).length();
    this.renderer = new WebGLRenderer({ antialias: true });
    this.renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    place.append(this.renderer.domElement);
    this.camera = new PerspectiveCamera(40, 1, this.size / 200, this.size * 50);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener("change", () => this.draw());
    this.#addLight();
    this.#addPath(tool, points_m);
    this.scene.add(machine.root);
    this.#paint();
    this.fit();
    onThemeChange(() => this.#paint());
    new ResizeObserver(() => this.#resize()).observe(place);
  }

  #addLight() {
    const sun = new DirectionalLight("#ffffff", 2.2);
    sun.position.set(0.6, -1, 1.6);
    this.scene.add(sun, new HemisphereLight("#ffffff", "#8a93a0", 1.5));
  }

  #addPath(tool, points) {
    this.way = lineOf(tool, new LineDashedMaterial({ dashSize: this.size / 80, gapSize: this.size / 120 }));
    this.way.computeLineDistances();
    this.trace = lineOf(tool, new LineBasicMaterial());
    this.dots = points.map((point) => {
      const dot = new Mesh(new SphereGeometry(this.size / 130, 20, 12), new MeshBasicMaterial());
      dot.position.set(...point);
      return dot;
    });
    this.scene.add(this.way, this.trace, ...this.dots);
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
    this.way.material.color.set(color("muted"));
    this.trace.material.color.set(color("warning"));
    for (const dot of this.dots) dot.material.color.set(color("warning"));
    this.machine.retint();
    this.draw();
  }

  /** Brings the whole trajectory into the picture. */
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

  /** How many points of the path lie behind. */
  showTrace(rows) {
    this.trace.geometry.setDrawRange(0, rows);
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
