import { BoxGeometry, ConeGeometry, CylinderGeometry, Mesh, MeshStandardMaterial } from "three";

/** Of size 1; the axes of drum and tip are z, the tip points down. */
export const BOX = new BoxGeometry(1, 1, 1);
export const DRUM = new CylinderGeometry(1, 1, 1, 32).rotateX(Math.PI / 2);
export const TIP = new ConeGeometry(1, 1, 32).rotateX(Math.PI / 2).translate(0, 0, -0.5);

export function paint(color, more = { roughness: 0.55, metalness: 0.1 }) {
  return new MeshStandardMaterial({ color, ...more });
}

export function solid(geometry, material, ...size) {
  const mesh = new Mesh(geometry, material);
  mesh.scale.set(...size);
  return mesh;
}

/** Stretches a box over a way along z (or x) of its frame; a way of no length is not drawn. */
export function stretch(mesh, from, to, along, width) {
  const length = Math.abs(to - from);
  mesh.visible = length > 1e-9;
  mesh.scale.set(width, width, width);
  mesh.position.set(0, 0, 0);
  mesh.scale[along] = Math.max(length, 1e-9);
  mesh.position[along] = (from + to) / 2;
}
