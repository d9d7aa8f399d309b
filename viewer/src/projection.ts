/**
 * Clip coordinates and what fragments need to know of their rays: render/projection.h and
 * render/ray_frame.h, for one whole picture. y points down in clip coordinates, so that row 0 of a
 * target is the picture's top row, as there.
 */
import type { Border } from "./border";
import { eyeOf, slabDepth, type Camera } from "./camera";
import { add, combine, dot, scale, sub, type Row, type Vec3 } from "./vector";

export interface Interval { lo: number; hi: number }
export interface Box { lo: Vec3; hi: Vec3 }
export interface Cue { a: number; b: number; beta0: number }

export const beta = (cue: Cue, z: number): number => cue.beta0 + (cue.a * z + cue.b);

const nearFraction = 1e-5;
export const nearPlane = (camera: Camera): number => nearFraction * camera.sphere.radius;

const halfSide = (camera: Camera, side: number): number =>
  (camera.halfExtent * side) / Math.min(camera.width, camera.height);

/** Clip x (right), y (down) and w of a point given relative to `origin`; z is each pass's own. */
export interface ClipRows { x: Row; y: Row; w: Row }

export function clipRows(camera: Camera, origin: Vec3): ClipRows {
  const from = camera.perspective ? eyeOf(camera) : camera.target;
  const along = (axis: Vec3, by: number): Row =>
    [axis[0] * by, axis[1] * by, axis[2] * by, dot(axis, sub(origin, from)) * by];
  return {
    x: along(camera.right, 1 / halfSide(camera, camera.width)),
    y: along(camera.up, -1 / halfSide(camera, camera.height)),
    w: camera.perspective ? along(camera.forward, 1) : [0, 0, 0, 1],
  };
}

const at = (row: Row, x: number, y: number, z: number): number =>
  row[0] * x + row[1] * y + row[2] * z + row[3];

/** The corners of a box. */
export function corners(box: Box): Vec3[] {
  const list: Vec3[] = [];
  for (let i = 0; i < 8; ++i) {
    list.push([
      (i & 1) !== 0 ? box.hi[0] : box.lo[0],
      (i & 2) !== 0 ? box.hi[1] : box.lo[1],
      (i & 4) !== 0 ? box.hi[2] : box.lo[2],
    ]);
  }
  return list;
}

/** Values of an affine function all over the box. */
export function rangeOn(box: Box, row: Row): Interval {
  const values = corners(box).map((p) => at(row, ...p));
  return { lo: Math.min(...values), hi: Math.max(...values) };
}

/** Whether no ray of the picture meets the box; may say no where the answer is yes. */
export function outsideView(camera: Camera, origin: Vec3, box: Box): boolean {
  const { x, y, w } = clipRows(camera, origin);
  const negative = (row: Row): boolean => rangeOn(box, row).hi < 0;
  const wide = 1 + 2 / camera.width;
  const high = 1 + 2 / camera.height;
  const near: Row = [0, 0, 0, nearPlane(camera)];
  return (camera.perspective && negative(combine(w, 1, near, -1))) ||
    negative(combine(w, wide, x, -1)) || negative(combine(w, wide, x, 1)) ||
    negative(combine(w, high, y, -1)) || negative(combine(w, high, y, 1));
}

/** Depth along the viewing direction: from the eye, or (orthographic) from the sphere's centre. */
export function viewDepth(camera: Camera, origin: Vec3): Row {
  const from = camera.perspective ? eyeOf(camera) : camera.sphere.center;
  return [...camera.forward, dot(camera.forward, sub(origin, from))] as unknown as Row;
}

export const viewDepthOfSlab = (camera: Camera, mm: number): number =>
  camera.perspective ? mm - slabDepth(camera, eyeOf(camera)) : mm;

function extentOn(camera: Camera, row: Row, w: Row, box: Box): Interval {
  if (camera.perspective && rangeOn(box, w).lo <= nearPlane(camera)) {
    return { lo: -Infinity, hi: Infinity };
  }
  const places = corners(box).map((p) => at(row, ...p) / at(w, ...p));
  return { lo: Math.min(...places), hi: Math.max(...places) };
}

/** Whether something in the box `front` may hide something in the box `behind`. */
export function mayHide(camera: Camera, origin: Vec3, front: Box, behind: Box): boolean {
  const depth = viewDepth(camera, origin);
  if (rangeOn(front, depth).lo > rangeOn(behind, depth).hi) return false;
  const { x, y, w } = clipRows(camera, origin);
  return [x, y].every((row, axis) => {
    const margin = 2 / (axis === 0 ? camera.width : camera.height);
    const a = extentOn(camera, row, w, front);
    const b = extentOn(camera, row, w, behind);
    return a.lo <= b.hi + margin && b.lo <= a.hi + margin;
  });
}

/** View depths where rays start and end; infinite where nothing ends them. */
export interface RaySpan { start: number; end: number }

/** See render/ray_frame.h: depth d is counted from the start of the rays. */
export interface RayFrame {
  depth: Row;
  end: number;
  zOfDepth: readonly [number, number];
  cue: readonly [number, number];
  cueRange: readonly [number, number];
  slopeOfPixel: Row;
  localFromView: readonly [Vec3, Vec3, Vec3];
}

export function zAtViewDepth(camera: Camera, depth: number): number {
  const { radius } = camera.sphere;
  return (radius + viewDepthOfSlab(camera, 0) - depth) / (2 * radius);
}

function slopeOfPixel(camera: Camera): Row {
  if (!camera.perspective) return [0, 0, 0, 0];
  const shorter = Math.min(camera.width, camera.height);
  const perPixel = (2 * camera.halfExtent) / shorter;
  return [
    (-camera.halfExtent * camera.width) / shorter, (camera.halfExtent * camera.height) / shorter,
    perPixel, -perPixel,
  ];
}

export function rayFrame(camera: Camera, origin: Vec3, rays: RaySpan, cue: Cue): RayFrame {
  const depth = viewDepth(camera, origin);
  const z = zAtViewDepth(camera, rays.start);
  const zPerMm = -0.5 / camera.sphere.radius;
  const ends = [beta(cue, 0), beta(cue, 1)];
  return {
    depth: [depth[0], depth[1], depth[2], depth[3] - rays.start],
    end: rays.end - rays.start,
    zOfDepth: [z, zPerMm],
    cue: [beta(cue, z), cue.a * zPerMm],
    cueRange: [Math.min(...ends), Math.max(...ends)],
    slopeOfPixel: slopeOfPixel(camera),
    localFromView: [camera.right, camera.up, scale(camera.forward, 1)],
  };
}

/** Rays in voxels: where they are and whither, each a + x b + y c, x and y a pixel's place. */
export interface VoxelRays { from: readonly Vec3[]; way: readonly Vec3[] }

export function voxelRays(camera: Camera, origin: Vec3, border: Border): VoxelRays {
  const perPixel = (2 * camera.halfExtent) / Math.min(camera.width, camera.height);
  const right = scale(camera.right, perPixel);
  const down = scale(camera.up, -perPixel);
  const corner = add(scale(right, -camera.width / 2), scale(down, -camera.height / 2));
  const voxels = (v: Vec3): Vec3 => border.toVoxels.map((row) => dot(row, v)) as unknown as Vec3;
  const middle = add(origin, border.middleMm);
  const place = (p: Vec3): Vec3 => add(voxels(sub(p, middle)), border.middle);
  const still: Vec3 = [0, 0, 0];
  return camera.perspective
    ? { from: [place(eyeOf(camera)), still, still],
      way: [voxels(add(camera.forward, corner)), voxels(right), voxels(down)] }
    : { from: [place(add(camera.target, corner)), voxels(right), voxels(down)],
      way: [voxels(camera.forward), still, still] };
}
