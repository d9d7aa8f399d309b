/**
 * Decodes shells with Draco, off the page's own thread: the source of a worker. Where there are no
 * workers it runs in the page, and answers between frames.
 */
import { createDecoderModule } from "draco3dgltf";
import wasm from "draco3dgltf/draco_decoder_gltf.wasm";
import createHashes from "xxhash-wasm";
import { moveWithin, type Border } from "./border";
import type { MeshData } from "./meshes";

export interface DecodeRequest {
  id: number;
  bytes: Uint8Array;
  checksum: string;
  triangles: number;
  vertices: number;
  lo: readonly number[];
  hi: readonly number[];
  /** Of the volume, where the set states one. */
  border: Border | null;
  normals: boolean;
}

export interface DecodeReply { id: number; mesh?: MeshData; problem?: string; milliseconds: number }

type Post = (reply: DecodeReply, transfer: Transferable[]) => void;

async function makeDecoder(): Promise<(request: DecodeRequest) => MeshData> {
  const [draco, hashes] = await Promise.all(
    [createDecoderModule({ wasmBinary: wasm }), createHashes()]);
  return (request) => {
    const found = hashes.h64Raw(request.bytes, 0n).toString(16).padStart(16, "0");
    if (found !== request.checksum) {
      throw new Error(`found checksum ${found}, expected ${request.checksum}`);
    }
    return decode(draco, request);
  };
}

function decode(draco: any, request: DecodeRequest): MeshData {
  const decoder = new draco.Decoder();
  const mesh = new draco.Mesh();
  try {
    const status = decoder.DecodeArrayToMesh(request.bytes, request.bytes.length, mesh);
    if (!status.ok()) throw new Error(`found ${status.error_msg()}, expected a Draco mesh`);
    if (mesh.num_faces() !== request.triangles || mesh.num_points() !== request.vertices) {
      throw new Error(`found ${mesh.num_faces()} triangles, expected ${request.triangles}`);
    }
    const positions = positionsOf(draco, decoder, mesh);
    checkBounds(positions, request);
    if (request.border) moveWithin(positions, request.border);
    const indices = indicesOf(draco, decoder, mesh);
    return { positions, indices, normals: request.normals ? vertexNormals(positions, indices) : null };
  } finally {
    draco.destroy(mesh);
    draco.destroy(decoder);
  }
}

function positionsOf(draco: any, decoder: any, mesh: any): Float32Array {
  const attribute = decoder.GetAttribute(mesh, decoder.GetAttributeId(mesh, draco.POSITION));
  const count = mesh.num_points() * 3;
  const at = draco._malloc(count * 4);
  try {
    decoder.GetAttributeDataArrayForAllPoints(mesh, attribute, draco.DT_FLOAT32, count * 4, at);
    return new Float32Array(draco.HEAPF32.buffer, at, count).slice();
  } finally {
    draco._free(at);
  }
}

function indicesOf(draco: any, decoder: any, mesh: any): Uint16Array | Uint32Array {
  const count = mesh.num_faces() * 3;
  const at = draco._malloc(count * 4);
  try {
    decoder.GetTrianglesUInt32Array(mesh, count * 4, at);
    const indices = new Uint32Array(draco.HEAPF32.buffer, at, count);
    return mesh.num_points() < 65536 ? Uint16Array.from(indices) : indices.slice();
  } finally {
    draco._free(at);
  }
}

function checkBounds(positions: Float32Array, request: DecodeRequest): void {
  for (let i = 0; i < positions.length; ++i) {
    const axis = i % 3;
    if (!(positions[i] >= request.lo[axis] && positions[i] <= request.hi[axis])) {
      throw new Error(`found a position at ${positions[i]} mm, expected it within the bounds`);
    }
  }
}

/** Normals of the triangles around a vertex, weighted by their angle there: render/vertex_normals.h. */
export function vertexNormals(
  positions: Float32Array, indices: Uint16Array | Uint32Array,
): Float32Array {
  const sums = new Float64Array(positions.length);
  const edge = (from: number, to: number): [number, number, number] => [
    positions[3 * to] - positions[3 * from], positions[3 * to + 1] - positions[3 * from + 1],
    positions[3 * to + 2] - positions[3 * from + 2],
  ];
  for (let t = 0; t < indices.length; t += 3) {
    const [a, b, c] = [edge(indices[t], indices[t + 1]), edge(indices[t + 1], indices[t + 2]),
      edge(indices[t + 2], indices[t])];
    // All corners see the same twice the area and normal; c = -(a + b).
    const x = a[2] * c[1] - a[1] * c[2];
    const y = a[0] * c[2] - a[2] * c[0];
    const z = a[1] * c[0] - a[0] * c[1];
    const area = Math.hypot(x, y, z);
    if (!(area > 0)) continue;
    const inner = (u: number[], v: number[]): number => u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
    const angles = [Math.atan2(area, -inner(a, c)), Math.atan2(area, -inner(b, a)),
      Math.atan2(area, -inner(c, b))];
    for (let corner = 0; corner < 3; ++corner) {
      const at = 3 * indices[t + corner];
      const by = angles[corner] / area;
      sums[at] += x * by;
      sums[at + 1] += y * by;
      sums[at + 2] += z * by;
    }
  }
  const normals = new Float32Array(positions.length);
  for (let i = 0; i < sums.length; i += 3) {
    const size = Math.hypot(sums[i], sums[i + 1], sums[i + 2]);
    if (size > 0) for (let k = 0; k < 3; ++k) normals[i + k] = sums[i + k] / size;
  }
  return normals;
}

/** Answers requests by `post`, one after the other; makes itself ready before the first. */
export function serve(post: Post): (request: DecodeRequest) => void {
  const ready = makeDecoder();
  ready.catch(() => {}); // each request is told
  return (request) => {
    ready.then((decodeNow) => {
      const start = performance.now();
      const mesh = decodeNow(request);
      const buffers = [mesh.positions, mesh.indices, ...(mesh.normals ? [mesh.normals] : [])];
      post({ id: request.id, mesh, milliseconds: performance.now() - start },
        buffers.map((array) => array.buffer as ArrayBuffer));
    }).catch((error: unknown) => {
      const problem = error instanceof Error ? error.message : String(error);
      post({ id: request.id, problem, milliseconds: 0 }, []);
    });
  };
}

declare const importScripts: unknown;

if (typeof importScripts === "function") {
  const scope = globalThis as unknown as
    { postMessage: Post; onmessage: (event: { data: DecodeRequest }) => void };
  const answer = serve((reply, transfer) => scope.postMessage(reply, transfer));
  scope.onmessage = (event) => answer(event.data);
} else {
  (globalThis as { nacreDecoder?: typeof serve }).nacreDecoder = serve;
}
