/**
 * A shell set (.glb) and its directory, `extras.nacre`: see docs/shell_file.md. Every length is
 * checked against the file; nothing is decoded here.
 */
import { borderOf, boxOf, type Border } from "./border";
import type { Sphere } from "./camera";
import type { Box } from "./projection";
import { length, type Vec3 } from "./vector";

/** What is wrong with a file, in a line for people. */
export class FileProblem extends Error {}

/** A surface as the file holds it. */
export interface Surface {
  /** What it is, in a line that says what is wrong with it. */
  name: string;
  triangles: number;
  vertices: number;
  /** Of positions, mm relative to the set's centre. */
  bounds: Box;
  /** Of the volume, if that has an inside. */
  border: Border | null;
  /** Compressed bytes; empty for a level that the volume does not reach. */
  bytes: Uint8Array;
  checksum: string;
}

export const trianglesOf = (surfaces: readonly Surface[]): number =>
  surfaces.reduce((sum, surface) => sum + surface.triangles, 0);

export interface Level extends Surface {
  emission: number;
  value: number;
  representative: number;
  sumRepresentative: number;
  /** A copy with fewer triangles, for a first picture and for slow machines. */
  coarse: Surface | null;
  /** The bounds of both. */
  reach: Box;
}

export interface ShellSet {
  levels: Level[];
  center: Vec3;
  sphere: Sphere;
  dims: Vec3;
  spacing: Vec3;
  sampleType: string;
  emission: [number, number][];
  placement: string;
  tolerance: number;
  bits: number;
  step: number;
  certificate: unknown;
  /** What coarse copies are worth, where there are any; `error` as in the file, of maxima. */
  coarse: { tolerance: number; error: unknown } | null;
  generator: string;
  fileBytes: number;
}

type Json = { [key: string]: any };

function problem(found: string, expected: string): never {
  throw new FileProblem(`found ${found}, expected ${expected}`);
}

const numberOf = (value: unknown, what: string): number =>
  typeof value === "number" && Number.isFinite(value) ? value : problem(`no number at ${what}`, "one");

const countOf = (value: unknown, what: string): number =>
  Number.isSafeInteger(value) && (value as number) >= 0
    ? (value as number) : problem(`no count at ${what}`, "one");

function vectorOf(value: unknown, what: string): Vec3 {
  if (!Array.isArray(value) || value.length !== 3) problem(`no vector at ${what}`, "three numbers");
  return value.map((x) => numberOf(x, what)) as unknown as Vec3;
}

interface Chunks { json: Json; binary: Uint8Array }

/** The two chunks of a binary glTF 2 file. */
function chunksOf(file: Uint8Array): Chunks {
  const view = new DataView(file.buffer, file.byteOffset, file.byteLength);
  if (file.length < 20 || view.getUint32(0, true) !== 0x46546c67) {
    problem("no binary glTF", "a shell set (.glb) that nacre wrote");
  }
  if (view.getUint32(4, true) !== 2) problem(`glTF version ${view.getUint32(4, true)}`, "2");
  const total = view.getUint32(8, true);
  if (total !== file.length) problem(`${file.length} bytes`, `the ${total} that the file speaks of`);
  const jsonLength = view.getUint32(12, true);
  if (view.getUint32(16, true) !== 0x4e4f534a || jsonLength > file.length - 20) {
    problem("a damaged header", "a JSON chunk within the file");
  }
  const text = new TextDecoder().decode(file.subarray(20, 20 + jsonLength));
  let json: Json;
  try {
    json = JSON.parse(text);
  } catch {
    problem("malformed JSON", "a shell set");
  }
  const at = 20 + jsonLength;
  if (at + 8 > file.length) return { json, binary: new Uint8Array() };
  const binaryLength = view.getUint32(at, true);
  if (view.getUint32(at + 4, true) !== 0x004e4942 || binaryLength > file.length - at - 8) {
    problem("a damaged binary chunk", "one within the file");
  }
  return { json, binary: file.subarray(at + 8, at + 8 + binaryLength) };
}

function boundsOf(accessor: Json): Box {
  return { lo: vectorOf(accessor?.min, "an accessor's min"), hi: vectorOf(accessor?.max, "an accessor's max") };
}

const around = (a: Box, b: Box): Box => ({
  lo: a.lo.map((x, i) => Math.min(x, b.lo[i])) as unknown as Vec3,
  hi: a.hi.map((x, i) => Math.max(x, b.hi[i])) as unknown as Vec3,
});

/** The surface that a level, or its copy, speaks of. */
function surfaceOf(
  chunks: Chunks, border: Border | null, given: Json, where: string, name: string,
): Surface {
  if (given.mesh === null) {
    const nowhere: Vec3 = [0, 0, 0];
    return { name, triangles: 0, vertices: 0, checksum: "", bytes: new Uint8Array(),
      border, bounds: { lo: nowhere, hi: nowhere } };
  }
  const primitive = chunks.json.meshes?.[countOf(given.mesh, `${where}.mesh`)]?.primitives?.[0];
  const draco = primitive?.extensions?.KHR_draco_mesh_compression;
  const view = chunks.json.bufferViews?.[countOf(draco?.bufferView, `the mesh of ${where}`)];
  const offset = countOf(view?.byteOffset ?? 0, `the bytes of ${where}`);
  const size = countOf(view?.byteLength, `the bytes of ${where}`);
  if (offset + size > chunks.binary.length) {
    problem(`the bytes of ${where} beyond the file's end`, "them within the file");
  }
  return {
    name,
    triangles: countOf(given.triangles, `${where}.triangles`),
    vertices: countOf(given.vertices, `${where}.vertices`),
    checksum: String(given.checksum),
    border,
    bytes: chunks.binary.subarray(offset, offset + size),
    bounds: boundsOf(chunks.json.accessors?.[primitive.attributes?.POSITION]),
  };
}

function levelOf(chunks: Chunks, border: Border | null, level: Json, k: number): Level {
  const where = `levels[${k}]`;
  const representative = numberOf(level?.representative, `${where}.representative`);
  const emission = numberOf(level.emission, `${where}.emission`);
  const at = `at emission ${emission.toPrecision(3)}`;
  const shell = surfaceOf(chunks, border, level, where, `Shell ${at}`);
  const coarse = level.coarse
    ? surfaceOf(chunks, border, level.coarse, `${where}.coarse`, `Coarse copy of the shell ${at}`) : null;
  return {
    ...shell, emission, coarse,
    reach: coarse ? around(shell.bounds, coarse.bounds) : shell.bounds,
    value: numberOf(level.value, `${where}.value`),
    representative,
    sumRepresentative: numberOf(level.sum_representative ?? representative, `${where}.sum_representative`),
  };
}

const times = (m: number[], p: Vec3, w: number): Vec3 => [0, 4, 8].map(
  (r) => m[r] * p[0] + m[r + 1] * p[1] + m[r + 2] * p[2] + m[r + 3] * w) as unknown as Vec3;

/** core/volume_geometry.h: half the longest diagonal of the box from first to last sample. */
function sphereOf(dims: Vec3, worldFromVoxel: number[]): Sphere {
  const { lo, hi } = boxOf(dims);
  const middle = lo.map((x, i) => (x + hi[i]) / 2) as unknown as Vec3;
  const extent = hi.map((x, i) => x - lo[i]);
  const signs: Vec3[] = [[1, 1, 1], [-1, 1, 1], [1, -1, 1], [1, 1, -1]];
  const diagonals = signs.map((s) =>
    length(times(worldFromVoxel, s.map((x, i) => x * extent[i]) as unknown as Vec3, 0)));
  return { center: times(worldFromVoxel, middle, 1), radius: Math.max(...diagonals) / 2 };
}

function extrasOf(json: Json): Json {
  const extras = (json.nodes ?? []).map((node: Json) => node?.extras?.nacre).find(Boolean);
  if (!extras) problem("a glTF file without extras.nacre", "a shell set that nacre wrote");
  if (countOf(extras.format, "format") > 1) {
    problem(`a shell set of format ${extras.format}`, "at most 1 (it needs a later page)");
  }
  return extras;
}

/** The directory of a set. @throws FileProblem */
export function readShellSet(file: Uint8Array): ShellSet {
  const chunks = chunksOf(file);
  const extras = extrasOf(chunks.json);
  const matrix = extras.volume?.world_from_voxel;
  if (!Array.isArray(matrix) || matrix.length !== 16) problem("no world_from_voxel", "16 numbers");
  const m = matrix.map((x: unknown) => numberOf(x, "world_from_voxel"));
  const dims = vectorOf(extras.volume.dims, "volume.dims");
  if (!Array.isArray(extras.levels)) problem("no levels", "a list of them");
  const center = vectorOf(extras.center_mm, "center_mm");
  const sphere = sphereOf(dims, m);
  const border = borderOf(dims, m, center, sphere);
  const levels = extras.levels.map((level: Json, k: number) => levelOf(chunks, border, level, k));
  if (levels.some((level: Level, k: number) => k > 0 && level.emission <= levels[k - 1].emission)) {
    problem("levels out of order", "ascending ones");
  }
  return {
    levels, dims, center, sphere,
    spacing: [0, 1, 2].map((c) => Math.hypot(m[c], m[4 + c], m[8 + c])) as unknown as Vec3,
    sampleType: String(extras.volume.type),
    emission: extras.emission,
    placement: String(extras.placement),
    tolerance: numberOf(extras.tolerance, "tolerance"),
    bits: countOf(extras.grid?.bits, "grid.bits"),
    step: numberOf(extras.grid?.step_mm, "grid.step_mm"),
    certificate: extras.certificate,
    coarse: extras.coarse
      ? { tolerance: numberOf(extras.coarse.tolerance, "coarse.tolerance"), error: extras.coarse.max } : null,
    generator: String(chunks.json.asset?.generator ?? ""),
    fileBytes: file.length,
  };
}
