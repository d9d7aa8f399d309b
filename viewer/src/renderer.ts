/**
 * Draws a plan with WebGL2, by the formulas of render/gl. In place of glClipControl and glDepthRange
 * (a range cannot be turned round here), a shell's remap is made in the vertex stage.
 */
import type { Border } from "./border";
import type { Camera } from "./camera";
import { colorMapBytes, isInverted } from "./color_maps";
import { ProgramFamily, Target, type Program, type UniformValue } from "./gl_objects";
import { LayerEstimate } from "./layer_estimate";
import { drawMesh, type GpuMesh } from "./meshes";
import type { Faces, Mode, Pass, Plan, ShellDraw } from "./plan";
import { clipRows, rayFrame, voxelRays, type Interval, type RayFrame } from "./projection";
import * as shaders from "./shaders";
import { Tables } from "./tables";
import type { Vec3 } from "./vector";

/** What sums and counts are added up in. */
export type FloatTargets = "float" | "half" | "none";

export interface GpuTool { mesh: GpuMesh; color: Vec3 }

export interface Frame {
  camera: Camera;
  plan: Plan;
  origin: Vec3;
  /** Of the volume, if that has an inside. */
  border: Border | null;
  /** The shells' meshes, undefined while a shell is not there yet. */
  shells: readonly (GpuMesh | undefined)[];
  tools: readonly GpuTool[];
}

export interface Display {
  mode: Mode;
  window: Interval;
  colorMap: string;
  over: boolean;
}

const largest = 3.0e38;
const noTool = 1;
/** Voxels: the rounding of rays' places. */
const atBorder = 1e-4;

type Uniforms = Record<string, UniformValue>;

function usableTargets(gl: WebGL2RenderingContext, wanted: FloatTargets): FloatTargets {
  const full = gl.getExtension("EXT_color_buffer_float");
  const half = gl.getExtension("EXT_color_buffer_half_float") ?? full;
  if (wanted === "float" && full && gl.getExtension("EXT_float_blend")) return "float";
  return half && wanted !== "none" ? "half" : "none";
}

export class Renderer {
  readonly floatTargets: FloatTargets;
  triangles = 0;
  private readonly families: Record<"max" | "crossings" | "lit" | "tool" | "display", ProgramFamily>;
  private readonly targets: Record<"depth" | "values" | "lit" | "starts" | "ends" | "tools", Target>;
  private readonly tables: Tables;
  private readonly layers: LayerEstimate;
  private readonly nothing: WebGLVertexArrayObject;
  /** What the targets hold. */
  private measured: Frame | null = null;

  constructor(private readonly gl: WebGL2RenderingContext, wanted: FloatTargets = "float") {
    this.floatTargets = usableTargets(gl, wanted);
    const family = (source: string): ProgramFamily =>
      new ProgramFamily(gl, shaders.vertexSource, shaders.fragmentPrelude + source);
    this.families = {
      max: family(shaders.maxSource), crossings: family(shaders.crossingsSource),
      lit: family(shaders.litSource), tool: family(shaders.toolSource),
      display: new ProgramFamily(gl, shaders.screenVertexSource, shaders.displaySource),
    };
    const values = this.floatTargets === "float" ? gl.R32F : gl.R16F;
    const depth = gl.DEPTH_COMPONENT24;
    this.targets = {
      depth: new Target(gl, 0, depth), values: new Target(gl, values, 0),
      lit: new Target(gl, gl.R8, depth), tools: new Target(gl, gl.RGBA8, depth),
      starts: new Target(gl, gl.R16F, 0), ends: new Target(gl, gl.R16F, 0),
    };
    this.tables = new Tables(gl);
    this.layers = new LayerEstimate(gl);
    this.nothing = gl.createVertexArray()!;
    gl.frontFace(gl.CW); // y points down in clip coordinates
  }

  /** Draws the frame and shows it in `target` (null: the canvas). */
  draw(frame: Frame, display: Display, target: WebGLFramebuffer | null): void {
    this.measure(frame);
    if (frame.plan.layers.length > 0 && !this.layers.isKnown) this.estimate(frame);
    this.show(frame, display, target);
  }

  /** Shows the frame that was drawn last anew, estimated between the levels with its own weights. */
  finish(frame: Frame, display: Display, target: WebGLFramebuffer | null): void {
    if (frame !== this.measured || frame.plan.layers.length === 0) return;
    if (this.estimate(frame)) this.show(frame, display, target);
  }

  private estimate({ camera }: Frame): boolean { return this.layers.measure(camera.width, camera.height); }

  /** The largest sum or count of the picture. */
  largest(frame: Frame): number {
    const { gl } = this;
    this.measure(frame);
    if (frame.plan.passes.length === 0 || this.floatTargets === "none") return 0;
    const { width, height } = frame.camera;
    const pixels = new Float32Array(4 * width * height);
    this.targets.values.bind();
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, pixels);
    let most = 0;
    for (let i = 0; i < pixels.length; i += 4) most = Math.max(most, pixels[i]);
    return most;
  }

  private measure(frame: Frame): void {
    const { plan, camera } = frame;
    this.triangles = 0;
    const rays = rayFrame(camera, frame.origin, plan.rays, plan.cue);
    const uniforms = this.frameUniforms(frame, rays);
    if (plan.tools.length > 0) this.drawTools(frame, uniforms);
    for (const pass of plan.passes) this.drawPass(pass, frame, uniforms);
    if (plan.layers.length > 0) this.drawRanks(frame);
    this.measured = frame;
  }

  private drawRanks({ plan, camera, border, origin }: Frame): void {
    const { gl, targets } = this;
    const starts = this.floatTargets !== "none" && plan.passes.some((pass) => pass.kind === "startCounts");
    this.layers.ranks.begin(camera.width, camera.height, 1); // binds a texture where it is made anew
    const sources = [targets.depth.depth, this.tables.numbers, targets.starts.color, targets.tools.depth];
    const sizes = this.fillTables(this.layers.tablesOf(plan));
    sources.forEach((bound, unit) => this.bind(unit, bound));
    this.setDepthTest(null);
    this.setFaces("both");
    gl.bindVertexArray(this.nothing);
    const rays = border && voxelRays(camera, origin, border);
    const box = border && rays && {
      ray_from: rays.from.flat(), ray_way: rays.way.flat(), least_way: camera.perspective ? 0 : -largest,
      box_lo: border.lo.map((x) => x - atBorder), box_hi: border.hi.map((x) => x + atBorder),
    };
    const defines = [
      ...(starts ? ["STARTS"] : []), ...(plan.tools.length > 0 ? ["TOOLS"] : []), ...(box ? ["BOX"] : []),
    ];
    this.layers.drawRanks(defines, {
      measured: 0, tables: 1, start_counts: 2, tool_depth: 3, table_sizes: sizes,
      tool_depths_mm: this.toolDepths(plan), ...box,
    });
    sources.forEach((_, unit) => this.bind(unit, null));
  }

  private frameUniforms(frame: Frame, rays: RayFrame): Uniforms {
    const clip = clipRows(frame.camera, frame.origin);
    return {
      clip_x: clip.x, clip_y: clip.y, clip_w: clip.w, depth_from_local: rays.depth,
      end_mm: Math.min(rays.end, largest), z_of_depth: rays.zOfDepth, cue: rays.cue,
      cue_range: rays.cueRange, slope_of_pixel: rays.slopeOfPixel,
      local_from_view: rays.localFromView.flat(), tool_depth: noTool,
      tool_depths_mm: this.toolDepths(frame.plan),
    };
  }

  /** Depths of a pass from the start of the rays, with a margin: the ends mean "nothing". */
  private fromStart(depths: Interval, plan: Plan): readonly number[] {
    const margin = 1e-3 + 1e-3 * (depths.hi - depths.lo);
    return [depths.lo - plan.rays.start - margin, depths.hi - plan.rays.start + margin];
  }

  private toolDepths(plan: Plan): readonly number[] {
    return plan.tools.length > 0 ? this.fromStart(plan.toolDepths, plan) : [0, 1];
  }

  private setFaces(faces: Faces): void {
    const { gl } = this;
    if (faces === "both") return gl.disable(gl.CULL_FACE);
    gl.enable(gl.CULL_FACE);
    gl.cullFace(faces === "front" ? gl.BACK : gl.FRONT);
  }

  private drawTools(frame: Frame, uniforms: Uniforms): void {
    const { gl } = this;
    const { camera, plan } = frame;
    this.targets.tools.begin(camera.width, camera.height, 1);
    this.setDepthTest(gl.LESS);
    this.setFaces("both");
    const linear = camera.perspective ? "WRITE_DEPTH" : "LINEAR";
    const program = this.families.tool.with(["NORMALS flat", linear]);
    program.use({ ...uniforms, depths_mm: this.toolDepths(plan) });
    for (const tool of plan.tools) {
      program.set({ color: frame.tools[tool].color });
      this.drawTriangles(frame.tools[tool].mesh);
    }
  }

  private setDepthTest(func: number | null): void {
    const { gl } = this;
    gl.disable(gl.BLEND);
    if (func === null) return gl.disable(gl.DEPTH_TEST);
    gl.enable(gl.DEPTH_TEST);
    gl.depthFunc(func);
  }

  private drawPass(pass: Pass, frame: Frame, uniforms: Uniforms): void {
    const { gl } = this;
    const { width, height } = frame.camera;
    const additive = pass.kind !== "max" && pass.kind !== "lit";
    if (additive && this.floatTargets === "none") return;
    this.targetOf(pass).begin(width, height, pass.kind === "max" ? 0 : 1);
    this.setDepthTest(additive ? null : pass.kind === "max" ? gl.GREATER : gl.LESS);
    if (additive) {
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.ONE, gl.ONE);
    }
    if (frame.plan.tools.length > 0) this.bind(noTool, this.targets.tools.depth);
    let used: Program | null = null;
    for (const draw of pass.draws) {
      const mesh = frame.shells[draw.shell];
      if (!mesh || (pass.kind === "lit" && !mesh.hasNormals)) continue;
      const program = this.programFor(pass, draw, frame);
      if (program !== used) program.use(uniforms);
      used = program;
      program.set({
        remap: [draw.far, draw.near], weight: draw.weight,
        depths_mm: this.fromStart(pass.depths, frame.plan),
      });
      this.setFaces(draw.faces);
      this.drawTriangles(mesh);
    }
    gl.disable(gl.BLEND);
  }

  private targetOf(pass: Pass): Target {
    const { targets } = this;
    switch (pass.kind) {
      case "max": return targets.depth;
      case "lit": return targets.lit;
      case "startCounts": return targets.starts;
      case "endCounts": return targets.ends;
      default: return targets.values;
    }
  }

  private programFor(pass: Pass, draw: ShellDraw, frame: Frame): Program {
    const { perspective } = frame.camera;
    const cut = draw.cutBySlab || draw.cutByTools ? ["CUT"] : [];
    const tools = draw.cutByTools ? ["TOOLS"] : [];
    switch (pass.kind) {
      case "max": {
        const byFragment = perspective && draw.near !== draw.far;
        return this.families.max.with([...cut, ...tools, byFragment ? "WRITE_DEPTH" : "REMAP"]);
      }
      case "lit":
        return this.families.lit.with(
          ["NORMALS smooth", perspective ? "WRITE_DEPTH" : "LINEAR", ...cut, ...tools]);
      case "sum": return this.families.crossings.with(["SUM", ...tools]);
      case "count": return this.families.crossings.with(["COUNT", ...tools]);
      case "startCounts": return this.families.crossings.with(["AT_START", ...tools]);
      case "endCounts": return this.families.crossings.with(["AT_END", ...tools]);
    }
  }

  private drawTriangles(mesh: GpuMesh): void {
    drawMesh(this.gl, mesh);
    this.triangles += mesh.corners / 3;
  }

  private bind(unit: number, of: WebGLTexture | null): void {
    this.gl.activeTexture(this.gl.TEXTURE0 + unit);
    this.gl.bindTexture(this.gl.TEXTURE_2D, of);
  }

  private show(frame: Frame, display: Display, target: WebGLFramebuffer | null): void {
    const { gl, targets } = this;
    const { plan, camera } = frame;
    const passOf = (kind: Pass["kind"]): Pass | undefined => plan.passes.find((p) => p.kind === kind);
    const main = plan.passes[0];
    const layered = plan.layers.length > 0;
    this.setDepthTest(null);
    this.setFaces("both");
    gl.bindVertexArray(this.nothing);
    if (layered) this.layers.drawColumns(camera.width, camera.height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    gl.viewport(0, 0, camera.width, camera.height);
    const blank = !main || (this.floatTargets === "none" && (main.kind === "sum" || main.kind === "count"));
    if (blank && plan.tools.length === 0) return this.clearTo(colorMapBytes(display.colorMap, 2));
    if (blank) targets.depth.begin(camera.width, camera.height, 0);
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    const counted = this.floatTargets !== "none";
    const [starts, ends] = counted && !layered ? [passOf("startCounts"), passOf("endCounts")] : [];
    const depths = blank || (main.kind === "max" && !layered);
    const defines = [
      ...(layered ? ["LAYERS"] : []), ...(depths ? ["DEPTHS"] : []), ...(starts ? ["STARTS"] : []), ...(ends ? ["ENDS"] : []),
      ...(plan.tools.length > 0 ? ["TOOLS"] : []),
    ];
    const source = blank ? targets.depth : layered ? this.layers.columns : this.targetOf(main);
    const sources = [
      depths ? source.depth : source.color, this.tables.numbers, this.tables.colors, targets.starts.color,
      targets.ends.color, targets.tools.color, targets.tools.depth,
    ];
    const sizes = this.fillTables(layered ? this.layers.tablesOf(plan)
      : [plan.emissionOfRank, starts?.emissionOfCount ?? [0], ends?.emissionOfCount ?? [0]]);
    this.gl.activeTexture(gl.TEXTURE2);
    this.tables.fillColors(display.colorMap);
    sources.forEach((bound, unit) => this.bind(unit, bound));
    const rays = rayFrame(camera, frame.origin, plan.rays, plan.cue);
    const over = display.over || display.mode === "iso";
    this.families.display.with(defines).use({
      measured: 0, tables: 1, color_map: 2, start_counts: 3, end_counts: 4, tool_color: 5,
      tool_depth: 6, table_sizes: sizes, depth_scale: blank ? 0 : plan.depthScale,
      window: [display.window.lo, 1 / (display.window.hi - display.window.lo)],
      height: camera.height, cue: rays.cue, cue_range: rays.cueRange,
      end_mm: Math.min(rays.end, largest), tool_depths_mm: this.toolDepths(plan),
      blend: over ? 2 : display.mode === "max" ? 0 : 1, inverted: isInverted(display.colorMap),
      ...(layered ? this.layers.uniforms : {}),
    });
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    sources.forEach((_, unit) => this.bind(unit, null));
  }

  private clearTo(colors: Uint8Array): void {
    const { gl } = this;
    gl.clearColor(colors[0] / 255, colors[1] / 255, colors[2] / 255, 1);
    gl.clear(gl.COLOR_BUFFER_BIT);
  }

  private fillTables(rows: readonly (readonly number[])[]): number[] {
    this.gl.activeTexture(this.gl.TEXTURE1);
    return this.tables.fill(rows);
  }
}
