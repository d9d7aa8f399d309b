/** The tools of a scene: meshes with a colour and a pose that hands can move. */
import { deleteMesh, uploadMesh } from "./meshes";
import type { Box } from "./projection";
import type { GpuTool } from "./renderer";
import { FileProblem } from "./shell_set";
import { posedMesh, readTool, type Matrix } from "./tool_file";
import { add, rotate, type Vec3 } from "./vector";

export interface Tool {
  name: string;
  corners: Float64Array;
  color: string;
  /** mm a unit of the file. */
  scale: number;
  /** Rigid, to LPS mm, row by row. */
  pose: Matrix;
}

const column = (m: Matrix, c: number): Vec3 => [m[c], m[4 + c], m[8 + c]];
const fromColumns = (x: Vec3, y: Vec3, z: Vec3, t: Vec3): Matrix =>
  [0, 1, 2].flatMap((r) => [x[r], y[r], z[r], t[r]]).concat([0, 0, 0, 1]);

/** Where the tool's own origin is, LPS mm. */
export const originOf = (tool: Tool): Vec3 => column(tool.pose, 3);

export function moved(pose: Matrix, by: Vec3): Matrix {
  return fromColumns(column(pose, 0), column(pose, 1), column(pose, 2), add(column(pose, 3), by));
}

/** Turned about an axis through the tool's own origin. */
export function turned(pose: Matrix, axis: Vec3, angle: number): Matrix {
  const [x, y, z] = [0, 1, 2].map((c) => rotate(column(pose, c), axis, angle));
  return fromColumns(x, y, z, column(pose, 3));
}

/** 16 numbers, row by row: a rigid motion. @throws FileProblem */
export function readPose(text: string): Matrix {
  const numbers = text.trim().split(/[\s,]+/).map(Number);
  if (numbers.length !== 16 || !numbers.every(Number.isFinite)) {
    throw new FileProblem(`found ${numbers.length} numbers, expected 16`);
  }
  const axes = [0, 1, 2].map((c) => column(numbers, c));
  const rigid = axes.every((a, i) => axes.every((b, j) => {
    const product = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    return Math.abs(product - (i === j ? 1 : 0)) < 1e-3;
  })) && numbers.slice(12).join() === "0,0,0,1";
  if (!rigid) throw new FileProblem("found a matrix that is no rigid motion, expected one");
  return numbers;
}

export const poseText = (pose: Matrix): string => [0, 4, 8, 12].map(
  (r) => pose.slice(r, r + 4).map((x) => Number(x.toFixed(6))).join(" ")).join("\n");

const rgbOf = (color: string): Vec3 =>
  [1, 3, 5].map((i) => parseInt(color.slice(i, i + 2), 16) / 255) as unknown as Vec3;

interface Posed { pose: Matrix; scale: number; gpu: GpuTool; bounds: Box }

export class ToolShelf {
  readonly tools: Tool[] = [];
  private readonly posed = new Map<Tool, Posed>();

  constructor(private readonly gl: WebGL2RenderingContext, private readonly center: () => Vec3) {}

  /** A tool as it comes: in the middle of the volume. @throws FileProblem */
  add(name: string, file: Uint8Array): Tool {
    const corners = readTool(name, file);
    const tool: Tool = {
      name, corners, color: "#59b3ff", scale: 1,
      pose: fromColumns([1, 0, 0], [0, 1, 0], [0, 0, 1], this.center()),
    };
    this.tools.push(tool);
    return tool;
  }

  remove(tool: Tool): void {
    this.drop(tool);
    this.tools.splice(this.tools.indexOf(tool), 1);
  }

  /** Meshes and bounds of all tools as they are posed now. */
  scene(): { gpu: GpuTool[]; bounds: Box[] } {
    const all = this.tools.map((tool) => {
      const posed = this.posedNow(tool);
      posed.gpu.color = rgbOf(tool.color);
      return posed;
    });
    return { gpu: all.map((p) => p.gpu), bounds: all.map((p) => p.bounds) };
  }

  forgetAll(): void { this.posed.clear(); }

  private posedNow(tool: Tool): Posed {
    const known = this.posed.get(tool);
    if (known && known.pose === tool.pose && known.scale === tool.scale) return known;
    this.drop(tool);
    const scaled = tool.pose.map((x, i) => (i % 4 < 3 && i < 12 ? x * tool.scale : x));
    const { mesh, bounds } = posedMesh(tool.corners, scaled, this.center());
    const made = {
      pose: tool.pose, scale: tool.scale, bounds,
      gpu: { mesh: uploadMesh(this.gl, mesh), color: rgbOf(tool.color) },
    };
    this.posed.set(tool, made);
    return made;
  }

  private drop(tool: Tool): void {
    const known = this.posed.get(tool);
    if (known) deleteMesh(this.gl, known.gpu.mesh);
    this.posed.delete(tool);
  }
}

