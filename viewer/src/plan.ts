/**
 * What a picture draws, and what it does without: the rules of render/plan.h that matter here. A pure
 * function of the set's directory, the camera and the options; no shell need be decoded.
 */
import { type Camera } from "./camera";
import { layersOfRanks, type LayerRange } from "./layers";
import {
  beta, mayHide, nearPlane, outsideView, rangeOn, viewDepth, viewDepthOfSlab, type Box, type Cue,
  type Interval, type RaySpan,
} from "./projection";
import type { Vec3 } from "./vector";

export type Mode = "max" | "sum" | "count" | "iso";
export type Faces = "front" | "back" | "both";
export type PassKind = "max" | "startCounts" | "endCounts" | "sum" | "count" | "lit";

export interface ShellFacts {
  emission: number;
  representative: number;
  /** What sums show for the layer, most often the same. */
  sumRepresentative: number;
  triangles: number;
  /** Bounds of whatever may be drawn for it. */
  reach: Box;
}

export interface Scene {
  center: Vec3;
  shells: readonly ShellFacts[];
  tools: readonly Box[];
}

export interface PictureOptions {
  mode: Mode;
  cue: Cue;
  /** mm from the centre along the viewing direction; infinite where nothing is cut. */
  slab: Interval;
  hidden: ReadonlySet<number>;
  /** Shells that are not drawn, but leave their layers to others: of a picture that moves. */
  leftOut: ReadonlySet<number>;
}

export interface ShellDraw {
  shell: number;
  faces: Faces;
  cutBySlab: boolean;
  cutByTools: boolean;
  /** max: depth at z = 1 and at z = 0, both in [0, 1]. */
  near: number;
  far: number;
  /** What a crossing adds: r_k minus the previous shown one (sum), r_k (count). */
  weight: number;
}

export interface Pass {
  kind: PassKind;
  draws: ShellDraw[];
  depths: Interval;
  /** Start- and endCounts: the emission where n shells are around, [0] = 0. */
  emissionOfCount: number[];
  /** The rank of that emission, where depths are ranks. */
  rankOfCount: number[];
}

export interface Plan {
  /** Tools in view, and the view depths of them together. */
  tools: number[];
  toolDepths: Interval;
  passes: Pass[];
  rays: RaySpan;
  cue: Cue;
  /** Brightness of depth 1 in a cued maximum; 0 where depths are ranks. */
  depthScale: number;
  emissionOfRank: number[];
  /** Between which a maximum is estimated, one for each rank; none: it stays as it is. */
  layers: LayerRange[];
  normals: boolean;
  /** Shells drawn, in the order in which they are best decoded. */
  wanted: number[];
}

interface Shown {
  index: number;
  facts: ShellFacts;
  step: number;
  depths: Interval;
  startsInside: boolean;
  endsInside: boolean;
  cutBySlab: boolean;
  reached: boolean;
}

/** Hidden shells leave their layer to the previous shown one. */
function shownShells(scene: Scene, options: PictureOptions): Shown[] {
  let around = 0;
  const list: Shown[] = [];
  scene.shells.forEach((facts, index) => {
    if (options.hidden.has(index) || options.leftOut.has(index) || facts.triangles === 0) return;
    const step = facts.sumRepresentative - around;
    around = facts.sumRepresentative;
    const dark = options.mode === "sum" ? step === 0
      : options.mode !== "iso" && facts.representative <= 0;
    if (dark) return;
    list.push({
      index, facts, step, depths: { lo: 0, hi: 0 },
      startsInside: false, endsInside: false, cutBySlab: false, reached: false,
    });
  });
  return list;
}

/** Where rays start and end, tools aside. */
function raySpan(camera: Camera, slab: Interval): RaySpan {
  const near = camera.perspective ? nearPlane(camera) : -Infinity;
  return {
    start: Math.max(near, viewDepthOfSlab(camera, slab.lo)), end: viewDepthOfSlab(camera, slab.hi),
  };
}

function drawOf(shell: Shown, faces: Faces): ShellDraw {
  return {
    shell: shell.index, faces, cutBySlab: shell.cutBySlab, cutByTools: shell.reached,
    near: 0, far: 0, weight: 0,
  };
}

const pass = (kind: PassKind, draws: ShellDraw[], emissionOfCount: number[] = []): Pass =>
  ({ kind, draws, depths: { lo: 0, hi: 0 }, emissionOfCount, rankOfCount: [] });

/** The largest emission shown where n of the shells, nested, surround a point. */
function counting(kind: PassKind, shells: Shown[]): Pass {
  const emission = [0];
  for (const shell of shells) {
    emission.push(Math.max(emission[emission.length - 1], shell.facts.representative));
  }
  const draws = shells.map((shell) => drawOf(shell, "both"));
  if (kind === "startCounts") for (const draw of draws) draw.cutByTools = false;
  return pass(kind, draws, emission);
}

function facesFor(shell: Shown, slope: number): Faces {
  if (slope > 0) return "front";
  if (slope < 0) return "back";
  return shell.startsInside && !shell.endsInside ? "back" : "front";
}

/** Depth remaps, [H96] eqs 3 and 5; without a cue the depth is the rank. */
function remap(plan: Plan, draws: ShellDraw[], scene: Scene, cue: Cue): void {
  const shades = draws.map((draw) => scene.shells[draw.shell].representative);
  const ranks = [...new Set(shades)].sort((a, b) => a - b);
  const flat = cue.a === 0;
  plan.depthScale = flat ? 0 : Math.max(beta(cue, 0), beta(cue, 1));
  if (flat) plan.emissionOfRank = [0, ...ranks.map((r) => beta(cue, 0) * r)];
  draws.forEach((draw, i) => {
    const rank = (ranks.indexOf(shades[i]) + 1) / ranks.length;
    draw.near = flat ? rank : (beta(cue, 1) * shades[i]) / plan.depthScale;
    draw.far = flat ? rank : (beta(cue, 0) * shades[i]) / plan.depthScale;
  });
}

/** Under a cue a pixel does not tell its layer; where shells are hidden, those shown are to show alone. */
function planLayers(plan: Plan, scene: Scene, options: PictureOptions): void {
  const { cue, hidden, leftOut } = options;
  if (cue.a !== 0 || hidden.size > 0) return;
  const factor = beta(cue, 0);
  const levels = scene.shells.filter((_, k) => !leftOut.has(k));
  plan.layers = layersOfRanks(levels, factor, plan.emissionOfRank);
  for (const { emissionOfCount, rankOfCount } of plan.passes) {
    rankOfCount.push(...emissionOfCount.map((emission) => plan.emissionOfRank.indexOf(factor * emission)));
  }
}

function planMax(plan: Plan, shells: Shown[], scene: Scene, options: PictureOptions): void {
  const { cue } = options;
  const draws = shells.map((shell) => drawOf(shell, facesFor(shell, cue.a)));
  remap(plan, draws, scene, cue);
  // Brightest first: most of what is covered never passes the depth test.
  draws.sort((a, b) => Math.max(b.near, b.far) - Math.max(a.near, a.far));
  plan.passes.push(pass("max", draws));
  const starts = shells.filter((shell) =>
    shell.startsInside && (cue.a > 0 || (cue.a === 0 && shell.endsInside)));
  if (starts.length > 0) plan.passes.push(counting("startCounts", starts));
  const ends = shells.filter((shell) => shell.endsInside && cue.a < 0);
  if (ends.length > 0) plan.passes.push(counting("endCounts", ends));
  planLayers(plan, scene, options);
}

function planCrossings(plan: Plan, shells: Shown[], kind: "sum" | "count"): void {
  const draws = shells.map((shell) => {
    const weight = kind === "sum" ? shell.step : shell.facts.representative;
    return { ...drawOf(shell, "both"), weight };
  });
  plan.passes.push(pass(kind, draws));
}

const within = (inner: Box, outer: Box): boolean => inner.lo.every(
  (x, i) => x >= outer.lo[i] && inner.hi[i] <= outer.hi[i]);

/** A shell that no ray starts in hides those inside it. */
function planLit(plan: Plan, shells: Shown[]): void {
  const outermost = shells[0];
  const drawn = outermost.startsInside ? shells : shells.filter((shell) =>
    shell === outermost || !within(shell.facts.reach, outermost.facts.reach));
  const draws = drawn.map((shell) => drawOf(shell, shell.startsInside ? "both" : "front"));
  const depths = {
    lo: Math.min(...drawn.map((shell) => shell.depths.lo)),
    hi: Math.max(...drawn.map((shell) => shell.depths.hi)),
  };
  plan.passes.push({ ...pass("lit", draws), depths });
  plan.normals = true;
}

function findTools(plan: Plan, scene: Scene, camera: Camera): void {
  const depth = viewDepth(camera, scene.center);
  scene.tools.forEach((bounds, tool) => {
    if (outsideView(camera, scene.center, bounds)) return;
    plan.tools.push(tool);
    const own = rangeOn(bounds, depth);
    plan.toolDepths.lo = Math.min(plan.toolDepths.lo, own.lo);
    plan.toolDepths.hi = Math.max(plan.toolDepths.hi, own.hi);
  });
  if (camera.perspective) plan.toolDepths.lo = Math.max(plan.toolDepths.lo, nearPlane(camera));
}

/** Fills in where rays start and end; false for a shell that no ray meets. */
function findEnds(shell: Shown, plan: Plan, scene: Scene, camera: Camera, options: PictureOptions): boolean {
  const bounds = shell.facts.reach;
  const slabStart = viewDepthOfSlab(camera, options.slab.lo);
  const depths = rangeOn(bounds, viewDepth(camera, scene.center));
  shell.depths = depths;
  if (depths.hi < slabStart || depths.lo > plan.rays.end) return false;
  if (outsideView(camera, scene.center, bounds)) return false;
  shell.reached = plan.tools.some((tool) =>
    mayHide(camera, scene.center, scene.tools[tool], bounds));
  shell.startsInside = depths.lo <= plan.rays.start;
  shell.endsInside = shell.reached || depths.hi > plan.rays.end;
  shell.cutBySlab = depths.lo < slabStart || depths.hi > plan.rays.end;
  return true;
}

/** Where depth is counted from: where rays start, or the nearest of what is drawn. */
function countFromNearest(plan: Plan, shells: Shown[], camera: Camera): void {
  const nearest = Math.min(...shells.map((shell) => shell.depths.lo));
  const from = Number.isFinite(nearest) ? nearest : viewDepthOfSlab(camera, 0);
  plan.rays.start = Math.max(plan.rays.start, from);
}

export function makePlan(scene: Scene, camera: Camera, options: PictureOptions): Plan {
  const { cue, mode } = options;
  const plan: Plan = {
    tools: [], toolDepths: { lo: Infinity, hi: -Infinity }, passes: [], cue,
    rays: raySpan(camera, options.slab), depthScale: 0, emissionOfRank: [0], layers: [],
    normals: false, wanted: [],
  };
  findTools(plan, scene, camera);
  const empty = plan.rays.end <= plan.rays.start;
  const shells = empty ? [] : shownShells(scene, options).filter((shell) =>
    findEnds(shell, plan, scene, camera, options));
  if (shells.length > 0) {
    if (mode === "max") planMax(plan, shells, scene, options);
    else if (mode === "iso") planLit(plan, shells);
    else planCrossings(plan, shells, mode);
  }
  countFromNearest(plan, shells, camera);
  const drawn = new Set(plan.passes.flatMap((p) => p.draws.map((draw) => draw.shell)));
  // Brightest first; of lit shells the outermost, which hides the others.
  plan.wanted = [...drawn].sort((a, b) => (mode === "iso" ? a - b : b - a));
  return plan;
}
