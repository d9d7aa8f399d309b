/**
 * The camera of core/camera.h: named views of the patient (LPS mm), then azimuth, elevation and roll
 * as vtkCamera's; the same flags as `nacre render` give the same picture.
 */
import { add, cross, dot, length, normalize, radians, rotate, scale, sub, type Vec3 } from "./vector";

export type ViewName = "anterior" | "posterior" | "left" | "right" | "superior" | "inferior";

export const viewNames: readonly ViewName[] = [
  "anterior", "posterior", "left", "right", "superior", "inferior",
];

const viewFrames: Record<ViewName, { forward: Vec3; up: Vec3 }> = {
  anterior: { forward: [0, 1, 0], up: [0, 0, 1] },
  posterior: { forward: [0, -1, 0], up: [0, 0, 1] },
  left: { forward: [-1, 0, 0], up: [0, 0, 1] },
  right: { forward: [1, 0, 0], up: [0, 0, 1] },
  superior: { forward: [0, 0, -1], up: [0, -1, 0] },
  inferior: { forward: [0, 0, 1], up: [0, -1, 0] },
};

/** Around the volume's box: depths and slabs are measured from it. */
export interface Sphere {
  center: Vec3;
  radius: number;
}

/** Angles in degrees, lengths in mm, as on the command line. */
export interface CameraOptions {
  view: ViewName;
  azimuth: number;
  elevation: number;
  roll: number;
  zoom: number;
  /** Field of view over the shorter side; 0: orthographic. */
  perspective: number;
  /** Of the eye from the target; null: where the sphere fills the field of view. */
  distance: number | null;
  /** Target, LPS mm; null: the sphere's centre. */
  lookAt: Vec3 | null;
}

export interface Camera {
  width: number;
  height: number;
  target: Vec3;
  right: Vec3;
  up: Vec3;
  forward: Vec3;
  perspective: boolean;
  eyeDistance: number;
  /** Half the picture's shorter side: mm (orthographic), or the tangent of its half angle. */
  halfExtent: number;
  sphere: Sphere;
}

export function makeCamera(
  options: CameraOptions, sphere: Sphere, width: number, height: number,
): Camera {
  const frame = viewFrames[options.view];
  let forward = rotate(frame.forward, frame.up, radians(options.azimuth));
  const levelRight = normalize(cross(forward, frame.up));
  forward = normalize(rotate(forward, scale(levelRight, -1), radians(options.elevation)));
  const across = cross(forward, frame.up);
  const right = length(across) < 1e-9 ? levelRight : normalize(across);
  const up = normalize(rotate(cross(right, forward), forward, radians(options.roll)));
  const half = radians(options.perspective) / 2;
  const perspective = options.perspective > 0;
  return {
    width, height, sphere, perspective, forward, up,
    target: options.lookAt ?? sphere.center,
    right: normalize(cross(forward, up)),
    eyeDistance: perspective ? (options.distance ?? sphere.radius / Math.sin(half)) : 0,
    halfExtent: (perspective ? Math.tan(half) : sphere.radius) / options.zoom,
  };
}

export const eyeOf = (camera: Camera): Vec3 =>
  sub(camera.target, scale(camera.forward, camera.eyeDistance));

/** Depth of a point from the sphere's centre along the viewing direction: what slabs are given in. */
export const slabDepth = (camera: Camera, p: Vec3): number =>
  dot(sub(p, camera.sphere.center), camera.forward);

/** Millimetres a pixel at the target. */
export function pixelSize(camera: Camera): number {
  const half = camera.halfExtent * (camera.perspective ? camera.eyeDistance : 1);
  return (2 * half) / Math.min(camera.width, camera.height);
}

/** Where a point of the patient is in the picture, in pixels from its upper left corner. */
export function pixelOf(camera: Camera, p: Vec3): [number, number] {
  const offset = sub(p, camera.target);
  const away = camera.perspective ? camera.eyeDistance + dot(offset, camera.forward) : 1;
  const pixels = Math.min(camera.width, camera.height) / 2 / (camera.halfExtent * away);
  return [
    camera.width / 2 + dot(offset, camera.right) * pixels,
    camera.height / 2 - dot(offset, camera.up) * pixels,
  ];
}

/** The target moved so that the picture follows the hand by so many pixels. */
export function pannedTarget(camera: Camera, dx: number, dy: number): Vec3 {
  const mm = pixelSize(camera);
  return add(camera.target, add(scale(camera.right, -dx * mm), scale(camera.up, dy * mm)));
}
