import { Box3, Group, Vector3 } from "three";
import { BOX, DRUM, paint, solid, stretch } from "../shared/solids.js";
import { color } from "../shared/theme.js";

/** Thickness of the head as a share of the way that it travels, and what it is where it does not travel. */
const THICKNESS = 0.14;
const STANDING_M = 0.1;
const STEEL = { roughness: 0.4, metalness: 0.15 };

/** The turning part: a shank with a cutting edge per tooth; its lower end is the tool's place. */
function toolOf(teeth, size, material, edge) {
  const tool = new Group();
  const shank = solid(DRUM, material, 0.5 * size, 0.5 * size, 2 * size);
  shank.position.z = size;
  tool.add(shank);
  for (let i = 0; i < teeth; ++i) {
    const angle = (2 * Math.PI * i) / teeth;
    const tooth = solid(BOX, i === 0 ? edge : material, 0.45 * size, 0.22 * size, 1.3 * size);
    tooth.position.set(0.5 * size * Math.cos(angle), 0.5 * size * Math.sin(angle), 0.65 * size);
    tooth.rotation.z = angle;
    tool.add(tooth);
  }
  return tool;
}

/** A feed axis along x with a spindle on its carriage. The way is true, what moves on it a schematic. */
export class FeedMachine {
  constructor({ low, high }, teeth) {
    const way = high - low;
    const size = way > 0 ? THICKNESS * way : STANDING_M;
    this.frame = paint(color("series-7"));
    this.body = paint(color("series-0"));
    this.steel = paint(color("muted"), STEEL);
    this.edge = paint("#f4f6f8", STEEL);
    this.root = new Group();
    this.head = new Group();
    this.tool = toolOf(Math.max(1, Math.min(12, teeth)), size, this.steel, this.edge);
    this.head.add(this.#motor(size), this.tool);
    this.root.add(this.#rail(low, high, size), this.#work(low, high, size), this.head);
    this.room = new Box3(new Vector3(low - 2 * size, -1.5 * size, -0.8 * size),
      new Vector3(high + 2 * size, 2.5 * size, 5 * size));
  }

  #rail(low, high, size) {
    const rail = solid(BOX, this.frame);
    stretch(rail, low - 1.5 * size, high + 1.5 * size, "x", 0.6 * size);
    rail.position.set(rail.position.x, 1.7 * size, 3.3 * size);
    const posts = [low - 1.5 * size, high + 1.5 * size].map((x) => {
      const post = solid(BOX, this.frame, 0.6 * size, 0.6 * size, 4.4 * size);
      post.position.set(x, 1.7 * size, 1.4 * size);
      return post;
    });
    const group = new Group();
    group.add(rail, ...posts);
    return group;
  }

  /** The workpiece, as long as the way. */
  #work(low, high, size) {
    const work = solid(BOX, this.frame, high - low + 1.4 * size, size, 1.2 * size);
    work.position.set(0.5 * (low + high), 0.9 * size, -0.2 * size);
    return work;
  }

  #motor(size) {
    const motor = solid(DRUM, this.body, 0.9 * size, 0.9 * size, 2.2 * size);
    motor.position.z = 3.1 * size;
    const arm = solid(BOX, this.body, 1.2 * size, 1.4 * size, 1.4 * size);
    arm.position.set(0, 1.1 * size, 3.3 * size);
    const group = new Group();
    group.add(motor, arm);
    return group;
  }

  /** What is not known (null) stays where it was. */
  pose({ position_m: position, angle_rad: angle, tool }) {
    if (position !== null) this.head.position.x = position;
    this.tool.rotation.z = angle % (2 * Math.PI);
    this.steel.color.set(tool.fill);
    this.root.updateMatrixWorld(true);
  }

  /** Where the drawn tool is, in m. */
  toolPosition() {
    return new Vector3().setFromMatrixPosition(this.tool.matrixWorld);
  }

  retint() {
    this.frame.color.set(color("series-7"));
    this.body.color.set(color("series-0"));
  }
}
