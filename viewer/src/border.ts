/** core/volume_border.h: what a grid put beyond the volume's border is shown on it. */
import type { Sphere } from "./camera";
import { clamp, cross, dot, scale, sub, type Vec3 } from "./vector";

/** The volume's box in voxels, and the way there from a set's positions. Plain data, for a worker. */
export interface Border {
  lo: Vec3;
  hi: Vec3;
  middle: Vec3;
  /** The box's middle relative to the positions' origin, mm. */
  middleMm: Vec3;
  /** Rows: voxels of a mm, and mm of a voxel. */
  toVoxels: readonly Vec3[];
  toMm: readonly Vec3[];
}

/** An axis of one sample spans one spacing. */
export const boxOf = (dims: Vec3): { lo: Vec3; hi: Vec3 } => ({
  lo: dims.map((n) => (n === 1 ? -0.5 : 0)) as unknown as Vec3,
  hi: dims.map((n) => (n === 1 ? 0.5 : n - 1)) as unknown as Vec3,
});

/** @param worldFromVoxel  row by row; null where it has no inverse */
export function borderOf(
  dims: Vec3, worldFromVoxel: readonly number[], center: Vec3, sphere: Sphere,
): Border | null {
  const m = worldFromVoxel;
  const columns = [0, 1, 2].map((c): Vec3 => [m[c], m[4 + c], m[8 + c]]);
  const [x, y, z] = columns;
  const volume = dot(x, cross(y, z));
  if (!Number.isFinite(1 / volume)) return null;
  const { lo, hi } = boxOf(dims);
  return {
    lo, hi,
    middle: lo.map((from, i) => (from + hi[i]) / 2) as unknown as Vec3,
    middleMm: sub(sphere.center, center),
    toVoxels: [cross(y, z), cross(z, x), cross(x, y)].map((row) => scale(row, 1 / volume)),
    toMm: [0, 4, 8].map((r): Vec3 => [m[r], m[r + 1], m[r + 2]]),
  };
}

/** Voxels: the rounding of positions. */
const onBorder = 1e-6;

/** Moves positions beyond the border onto it, in voxels. */
export function moveWithin(positions: Float32Array, border: Border): void {
  for (let i = 0; i < positions.length; i += 3) {
    const from = sub([positions[i], positions[i + 1], positions[i + 2]], border.middleMm);
    const voxel = border.toVoxels.map((row, axis) => dot(row, from) + border.middle[axis]);
    const isWithin = voxel.every((at, axis) =>
      at >= border.lo[axis] - onBorder && at <= border.hi[axis] + onBorder);
    if (isWithin) continue;
    const moved = voxel.map((at, axis) =>
      clamp(at, border.lo[axis], border.hi[axis]) - border.middle[axis]) as unknown as Vec3;
    border.toMm.forEach((row, axis) => { positions[i + axis] = dot(row, moved) + border.middleMm[axis]; });
  }
}
