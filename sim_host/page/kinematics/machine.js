import { AxesHelper, Group, Vector3 } from "three";
import { BOX, DRUM, paint, solid, stretch, TIP } from "../shared/solids.js";
import { seriesColor } from "../shared/theme.js";
import { framesOf } from "./chain.js";

/** One joint with the link behind it, drawn in the frame before the joint. */
class JointBody {
  constructor(joint, index, values, size) {
    Object.assign(this, { joint, size, group: new Group(), arm: new Group() });
    const material = paint(seriesColor(index));
    this.material = material;
    this.index = index;
    for (const group of [this.group, this.arm]) group.matrixAutoUpdate = false;
    this.link = solid(BOX, material, size, size, size);
    this.reach = solid(BOX, material, size, size, size);
    stretch(this.reach, -joint.a_m, 0, "x", size);
    this.arm.add(this.reach);
    this.group.add(this.link);
    if (joint.kind === "revolute") this.group.add(solid(DRUM, material, 1.5 * size, 1.5 * size, 2.4 * size));
    else this.addRail(values);
  }

  /** A slide has a rail as long as it is used, and a carriage on it. */
  addRail(values) {
    const used = values.map((value) => this.joint.d_m + value);
    const rail = solid(BOX, this.material);
    const [low, high] = used.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [0, 0]);
    stretch(rail, low, high, "z", 0.45 * this.size);
    this.carriage = solid(BOX, this.material, 2 * this.size, 2 * this.size, 1.4 * this.size);
    this.group.add(rail, this.carriage);
  }

  pose(before, behind, value) {
    const d = this.joint.d_m + (this.joint.kind === "revolute" ? 0 : value);
    this.group.matrix.copy(before);
    this.arm.matrix.copy(behind);
    stretch(this.link, 0, d, "z", this.size);
    if (this.carriage) this.carriage.position.z = d;
  }

  retint() {
    this.material.color.set(seriesColor(this.index));
  }
}

/** A chain of joints as solids; `size` is the thickness of its links in m. */
export class Machine {
  constructor(joints, columns, size) {
    this.joints = joints;
    this.root = new Group();
    this.bodies = joints.map((joint, i) => new JointBody(joint, i, columns[i], size));
    for (const body of this.bodies) this.root.add(body.group, body.arm);
    this.tool = new Group();
    this.tool.matrixAutoUpdate = false;
    this.tip = paint("#8d99a6", { roughness: 0.35, metalness: 0.6 });
    this.tool.add(solid(TIP, this.tip, 1.3 * size, 1.3 * size, 3.5 * size), new AxesHelper(5 * size));
    this.root.add(this.tool);
  }

  /** Moves to joint values in m and rad. */
  pose(values) {
    const frames = framesOf(this.joints, values);
    this.bodies.forEach((body, i) => body.pose(frames[i], frames[i + 1], values[i]));
    this.tool.matrix.copy(frames[frames.length - 1]);
    this.root.updateMatrixWorld(true);
  }

  /** Where the drawn tool is, in m. */
  toolPosition() {
    return new Vector3().setFromMatrixPosition(this.tool.matrixWorld);
  }

  retint() {
    this.bodies.forEach((body) => body.retint());
  }
}
