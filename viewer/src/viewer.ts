/** The scene, its state and its pictures: what the controls act on. */
import { makeCamera, type Camera } from "./camera";
import { FrameLoop } from "./frame_loop";
import { ShellLoader } from "./shell_loader";
import { makePlan, type Mode, type Plan, type PictureOptions, type Scene } from "./plan";
import type { Interval } from "./projection";
import { Renderer, type Display, type FloatTargets, type Frame } from "./renderer";
import { ownWindowSide, pngOf } from "./picture_file";
import type { Level, ShellSet } from "./shell_set";
import { firstState, lawfulCue, type State } from "./state";
import { ToolShelf } from "./tools";

/** Most pixels of the canvas a CSS pixel, in each direction. */
const mostPixelRatio = 2;

export type Listener = (what: "state" | "set" | "frame" | "loading" | "tools") => void;

export class Viewer {
  state: State = firstState();
  set: ShellSet | null = null;
  readonly shelf: ToolShelf;
  readonly loop: FrameLoop;
  readonly loader: ShellLoader;
  plan: Plan | null = null;
  private renderer: Renderer;
  private readonly gl: WebGL2RenderingContext;
  private listeners: Listener[] = [];
  /** The largest sum and count of the whole set, once known. */
  private readonly largest = new Map<Mode, number>();

  constructor(
    readonly canvas: HTMLCanvasElement, decoderSource: string, private readonly floats: FloatTargets,
  ) {
    const gl = canvas.getContext("webgl2", { antialias: false, depth: false, alpha: false });
    if (!gl) throw new Error("no WebGL2");
    this.gl = gl;
    this.renderer = new Renderer(gl, floats);
    this.shelf = new ToolShelf(gl, () => this.set?.sphere.center ?? [0, 0, 0]);
    this.loader = new ShellLoader(gl, decoderSource, () => this.loaded());
    this.loop = new FrameLoop(gl, () => this.draw(), () => this.tell("frame"));
    canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    canvas.addEventListener("webglcontextrestored", () => this.restore());
    new ResizeObserver(() => this.loop.invalidate()).observe(canvas);
  }

  /** Tells the listener what happens, until what is returned is called. */
  listen(listener: Listener): () => void {
    this.listeners.push(listener);
    return () => { this.listeners = this.listeners.filter((other) => other !== listener); };
  }

  get floatTargets(): FloatTargets { return this.renderer.floatTargets; }
  get triangles(): number { return this.renderer.triangles; }

  /** Shows another set; the state stays as far as it makes sense. */
  open(set: ShellSet): void {
    for (const level of this.set?.levels ?? []) this.loader.forget(level);
    this.loader.problem = "";
    this.largest.clear();
    this.set = set;
    this.state.hidden = new Set([...this.state.hidden].filter((k) => k < set.levels.length));
    this.tell("set");
    this.change({});
  }

  /** Takes over what differs, and draws. */
  change(to: Partial<State>, moving = false): void {
    Object.assign(this.state, to);
    this.state.cue = lawfulCue(this.state.cue);
    this.tell("state");
    if (moving) this.loop.invalidateMoving();
    else this.loop.invalidate();
  }

  changeCamera(to: Partial<State["camera"]>, moving = false): void {
    this.change({ camera: { ...this.state.camera, ...to } }, moving);
  }

  toolsChanged(moving = false): void {
    this.tell("tools");
    if (moving) this.loop.invalidateMoving();
    else this.loop.invalidate();
  }

  /** A list of levels that has changed: one added, gone, or another in the place of an old one. */
  levelsChanged(old: Level | null, made: Level | null): void {
    if (old && made) this.loader.replace(old, made);
    else if (old) this.loader.forget(old);
    this.largest.clear();
    this.tell("set");
    this.change({});
  }

  /** The camera of a picture of that size; without one, of the canvas in CSS pixels. */
  camera(width = this.canvas.clientWidth, height = this.canvas.clientHeight): Camera {
    const sphere = this.set?.sphere ?? { center: [0, 0, 0] as const, radius: 1 };
    return makeCamera(this.state.camera, sphere, Math.max(1, width), Math.max(1, height));
  }

  /** The window shown: the state's, or the mode's own. */
  window(): Interval {
    const { window, mode } = this.state;
    if (window) return window;
    if (mode === "max" || mode === "iso") return { lo: 0, hi: 1 };
    return { lo: 0, hi: this.largest.get(mode) || 1 };
  }

  /** This view as a PNG, drawn anew at that size. */
  async save(width: number, height: number): Promise<Blob> {
    const frame = this.frame(this.camera(width, height), this.state.hidden);
    const blob = await pngOf(this.gl, width, height, (target) =>
      this.renderer.draw(frame, this.display(), target));
    this.loop.invalidate();
    return blob;
  }

  private tell(what: Parameters<Listener>[0]): void {
    for (const listener of this.listeners) listener(what);
  }

  private display(): Display {
    const { mode, colorMap, over } = this.state;
    return { mode, colorMap, over, window: this.window() };
  }

  private frame(camera: Camera, hidden: ReadonlySet<number>): Frame {
    const levels = this.set?.levels ?? [];
    const tools = this.shelf.scene();
    const scene: Scene = { center: this.set?.center ?? [0, 0, 0], shells: levels, tools: tools.bounds };
    const options: PictureOptions = { ...this.state, hidden };
    const plan = makePlan(scene, camera, options);
    return {
      camera, plan, origin: scene.center, tools: tools.gpu,
      shells: levels.map((level) => this.loader.meshOf(level)),
    };
  }

  /** Those hidden, and of the others all but every so many while the picture moves too slowly. */
  private hiddenNow(): Set<number> {
    const hidden = new Set(this.state.hidden);
    const stride = this.state.mode === "iso" ? 1 : this.loop.stride();
    let shown = 0;
    for (let k = (this.set?.levels.length ?? 0) - 1; stride > 1 && k >= 0; --k) {
      if (!hidden.has(k) && shown++ % stride !== 0) hidden.add(k);
    }
    return hidden;
  }

  private draw(): void {
    if (this.gl.isContextLost()) return;
    const { canvas } = this;
    const ratio = Math.min(window.devicePixelRatio, mostPixelRatio) * this.loop.scale();
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    if (canvas.width !== width) canvas.width = width;
    if (canvas.height !== height) canvas.height = height;
    const frame = this.frame(this.camera(width, height), this.hiddenNow());
    this.plan = frame.plan;
    const levels = this.set?.levels ?? [];
    this.loader.want(frame.plan.wanted.map((k) => levels[k]), frame.plan.normals);
    this.findOwnWindow(frame);
    this.renderer.draw(frame, this.display(), null);
  }

  /** Sums and counts are shown up to their largest, found once in a small picture of all shells. */
  private findOwnWindow(frame: Frame): void {
    const { mode, window } = this.state;
    if (window || (mode !== "sum" && mode !== "count") || this.largest.has(mode)) return;
    if (!frame.plan.wanted.every((k) => frame.shells[k])) return;
    const side = ownWindowSide / Math.max(frame.camera.width, frame.camera.height);
    const camera = this.camera(
      Math.round(frame.camera.width * side), Math.round(frame.camera.height * side));
    const largest = this.renderer.largest(this.frame(camera, this.state.hidden));
    if (largest > 0) this.largest.set(mode, largest);
    this.tell("state");
  }

  forgetOwnWindow(): void { this.largest.delete(this.state.mode); }

  private loaded(): void {
    this.tell("loading");
    const { wanted, loaded } = this.loader.state();
    if (loaded < wanted) this.loop.invalidateLoading();
    else this.loop.invalidate();
  }

  private restore(): void {
    this.loader.forgetAll();
    this.shelf.forgetAll();
    this.renderer = new Renderer(this.gl, this.floats);
    this.loop.restart();
  }
}
