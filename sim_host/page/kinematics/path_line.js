import {
  BufferGeometry, Float32BufferAttribute, Group, Line, LineBasicMaterial, LineDashedMaterial, Mesh, MeshBasicMaterial,
  SphereGeometry,
} from "three";
import { color } from "../shared/theme.js";

function lineOf(tool, material) {
  const geometry = new BufferGeometry();
  const points = tool[0].flatMap((x, row) => [x, tool[1][row], tool[2][row]]);
  geometry.setAttribute("position", new Float32BufferAttribute(points, 3));
  return new Line(geometry, material);
}

/** The path with its given points, and how much of it lies behind. `size`: of the room, in m. */
export class PathLine {
  constructor(tool, points, size) {
    this.root = new Group();
    this.way = lineOf(tool, new LineDashedMaterial({ dashSize: size / 80, gapSize: size / 120 }));
    this.way.computeLineDistances();
    this.trace = lineOf(tool, new LineBasicMaterial());
    this.dots = points.map((point) => {
      const dot = new Mesh(new SphereGeometry(size / 130, 20, 12), new MeshBasicMaterial());
      dot.position.set(...point);
      return dot;
    });
    this.root.add(this.way, this.trace, ...this.dots);
  }

  /** How many points of the path lie behind. */
  showTrace(rows) {
    this.trace.geometry.setDrawRange(0, rows);
  }

  retint() {
    this.way.material.color.set(color("muted"));
    this.trace.material.color.set(color("warning"));
    for (const dot of this.dots) dot.material.color.set(color("warning"));
  }
}
