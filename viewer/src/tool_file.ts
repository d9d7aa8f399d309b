/**
 * Tool meshes from OBJ and STL (text and binary) files. Meshes may be open and of any winding: every
 * triangle is kept, with its own normal.
 */
import type { MeshData } from "./meshes";
import type { Box } from "./projection";
import { FileProblem } from "./shell_set";

function numberAt(words: string[], i: number, line: number): number {
  const value = Number(words[i]);
  if (words[i] === undefined || words[i] === "" || !Number.isFinite(value)) {
    throw new FileProblem(`found "${words[i] ?? ""}" in line ${line}, expected a finite number`);
  }
  return value;
}

/** Corners of the triangles of a Wavefront OBJ, nine numbers each; faces are cut into fans. */
function objTriangles(text: string): number[] {
  const vertices: number[] = [];
  const faces: { corners: number[]; line: number }[] = [];
  text.replace(/\\\r?\n/g, " ").split(/\r?\n/).forEach((raw, i) => {
    const words = raw.split("#")[0].trim().split(/\s+/);
    if (words[0] === "v") {
      for (let k = 1; k <= 3; ++k) vertices.push(numberAt(words, k, i + 1));
    } else if (words[0] === "f" || words[0] === "fo") {
      const corners = words.slice(1).map((word) => {
        const index = parseInt(word, 10);
        return index < 0 ? vertices.length / 3 + index : index - 1;
      });
      if (corners.length < 3) throw new FileProblem(`found "${raw}" in line ${i + 1}, expected three corners`);
      faces.push({ corners, line: i + 1 });
    }
  });
  const triangles: number[] = [];
  const put = (corner: number, line: number): void => {
    const at = 3 * corner;
    if (!(at >= 0 && at + 2 < vertices.length)) {
      throw new FileProblem(`found vertex ${corner + 1} in line ${line}, expected one of ${vertices.length / 3}`);
    }
    triangles.push(vertices[at], vertices[at + 1], vertices[at + 2]);
  };
  for (const { corners, line } of faces) {
    for (let k = 1; k + 1 < corners.length; ++k) {
      for (const corner of [corners[0], corners[k], corners[k + 1]]) put(corner, line);
    }
  }
  return triangles;
}

function binaryStlTriangles(file: Uint8Array, count: number): number[] {
  const view = new DataView(file.buffer, file.byteOffset, file.byteLength);
  const triangles: number[] = [];
  for (let t = 0; t < count; ++t) {
    for (let i = 0; i < 9; ++i) triangles.push(view.getFloat32(84 + 50 * t + 12 + 4 * i, true));
  }
  return triangles;
}

function textStlTriangles(text: string): number[] {
  const triangles: number[] = [];
  text.split(/\r?\n/).forEach((line, i) => {
    const words = line.trim().split(/\s+/);
    if (words[0] === "vertex") for (let k = 1; k <= 3; ++k) triangles.push(numberAt(words, k, i + 1));
  });
  return triangles;
}

function stlTriangles(file: Uint8Array): number[] {
  const count = file.length >= 84
    ? new DataView(file.buffer, file.byteOffset).getUint32(80, true) : 0;
  if (count > 0 && file.length >= 84 + 50 * count) return binaryStlTriangles(file, count);
  const text = new TextDecoder().decode(file);
  if (text.trimStart().startsWith("solid")) return textStlTriangles(text);
  throw new FileProblem(`found ${file.length} bytes, expected the ${84 + 50 * count} of ${count} triangles`);
}

/** The triangles of a tool's file. @throws FileProblem */
export function readTool(name: string, file: Uint8Array): Float64Array {
  const ending = name.toLowerCase().split(".").pop() ?? "";
  let corners: number[];
  if (ending === "obj") corners = objTriangles(new TextDecoder().decode(file));
  else if (ending.startsWith("stl")) corners = stlTriangles(file);
  else throw new FileProblem(`found the ending .${ending}, expected .obj or .stl`);
  if (corners.length === 0 || corners.length % 9 !== 0) {
    throw new FileProblem(`found ${Math.floor(corners.length / 9)} whole triangles, expected some`);
  }
  if (!corners.every(Number.isFinite)) throw new FileProblem("found a position that is not finite");
  return Float64Array.from(corners);
}

/** A 4x4 matrix, row by row. */
export type Matrix = readonly number[];

/** The posed triangles, mm relative to `center`, each lit flat. */
export function posedMesh(
  corners: Float64Array, pose: Matrix, center: readonly number[],
): { mesh: MeshData; bounds: Box } {
  const positions = new Float32Array(corners.length);
  const lo = [Infinity, Infinity, Infinity];
  const hi = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < corners.length; i += 3) {
    for (let r = 0; r < 3; ++r) {
      const m = 4 * r;
      const world = pose[m] * corners[i] + pose[m + 1] * corners[i + 1] +
        pose[m + 2] * corners[i + 2] + pose[m + 3];
      positions[i + r] = world - center[r];
      lo[r] = Math.min(lo[r], positions[i + r]);
      hi[r] = Math.max(hi[r], positions[i + r]);
    }
  }
  const mesh = { positions, normals: flatNormals(positions), indices: inOrder(corners.length / 3) };
  return { mesh, bounds: { lo, hi } as unknown as Box };
}

const inOrder = (count: number): Uint32Array => Uint32Array.from({ length: count }, (_, i) => i);

function flatNormals(p: Float32Array): Float32Array {
  const normals = new Float32Array(p.length);
  for (let t = 0; t < p.length; t += 9) {
    const a = [p[t + 3] - p[t], p[t + 4] - p[t + 1], p[t + 5] - p[t + 2]];
    const b = [p[t + 6] - p[t], p[t + 7] - p[t + 1], p[t + 8] - p[t + 2]];
    const n = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    const size = Math.hypot(n[0], n[1], n[2]) || 1;
    for (let i = 0; i < 9; ++i) normals[t + i] = n[i % 3] / size;
  }
  return normals;
}
