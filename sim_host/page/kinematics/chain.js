import { Matrix4 } from "three";

/** From the frame before a joint to the one behind it (Denavit-Hartenberg, the thesis's equation 3). */
function behind(joint, variable) {
  const turns = joint.kind === "revolute";
  const theta = joint.theta_rad + (turns ? variable : 0);
  const d = joint.d_m + (turns ? 0 : variable);
  const [c, s] = [Math.cos(theta), Math.sin(theta)];
  const [ca, sa] = [Math.cos(joint.alpha_rad), Math.sin(joint.alpha_rad)];
  // prettier-ignore
  return new Matrix4().set(
    c, -s * ca, s * sa, joint.a_m * c,
    s, c * ca, -c * sa, joint.a_m * s,
    0, sa, ca, d,
    0, 0, 0, 1);
}

/** Frames of a chain in the base: the base, one behind every joint; the last one is the tool's. */
export function framesOf(joints, values) {
  const frames = [new Matrix4()];
  joints.forEach((joint, i) => frames.push(frames[i].clone().multiply(behind(joint, values[i]))));
  return frames;
}
