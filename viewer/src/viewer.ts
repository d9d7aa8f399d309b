/** The scene, its state and its pictures: what the controls act on. */
import { makeCamera, type Camera } from "./camera";
import { FrameLoop } from "./frame_loop";
import { ShellLoader } from "./shell_loader";
import { makePlan, type Mode, type Plan, type PictureOptions, type Scene } from "./plan";
import type { Interval } from "./projection";
import type { GpuMesh } from "./meshes";
import { Renderer, type Display, type FloatTargets, type Frame } from "./renderer";
import { drawsInSoftware, Refused, type ServedPictures } from "./served_pictures";
import { encoded, ownWindowSide, pngOf } from "./picture_file";
import { trianglesOf, type Level, type ShellSet, type Surface } from "./shell_set";
import { firstState, hashOf, lawfulCue, type State } from "./state";
import { ToolShelf } from "./tools";

/** Triangles to decode from which on coarse copies come first: they take a part of a second. */
const manyTriangles = 400_000;
/** Copies are worth it with at most this share of the triangles. */
const copiesShare = 0.5;

/** Most pixels of the canvas a CSS pixel, in each direction. */
const mostPixelRatio = 2;

function sized(canvas: HTMLCanvasElement, width: number, height: number): void {
  if (canvas.width !== width) canvas.width = width;
  if (canvas.height !== height) canvas.height = height;
}

const nothing: ReadonlySet<number> = new Set();

export type Listener = (what: "state" | "set" | "frame" | "loading" | "tools") => void;

export class Viewer {
  state: State = firstState();
  set: ShellSet | null = null;
  readonly shelf: ToolShelf;
  readonly loop: FrameLoop;
  readonly loader: ShellLoader;
  plan: Plan | null = null;
  /** Whether the last picture had every shell, as itself or as its copy; and all as themselves. */
  picture = { isComplete: false, isWhole: false };
  /** Where the server draws pictures of this set that the browser would draw in software. */
  served: ServedPictures | null = null;
  /** A state that it does not draw. */
  private refused: string | null = null;
  /** Whether WebGL is drawn by the processor. */
  readonly isSoftware: boolean;
  /** Of the last picture. */
  pixels = { width: 0, height: 0 };
  private renderer: Renderer;
  private drawn: Frame | null = null;
  private readonly gl: WebGL2RenderingContext;
  private listeners: Listener[] = [];
  /** The largest sum and count of the whole set, once known. */
  private readonly largest = new Map<Mode, { value: number; isWhole: boolean }>();

  constructor(
    readonly canvas: HTMLCanvasElement,
    /** Over it, without WebGL: for pictures that are drawn elsewhere. */
    private readonly servedCanvas: HTMLCanvasElement,
    decoderSource: string, private readonly floats: FloatTargets,
  ) {
    const gl = canvas.getContext("webgl2", { antialias: false, depth: false, alpha: false });
    if (!gl) throw new Error("no WebGL2");
    this.gl = gl;
    this.isSoftware = drawsInSoftware(gl);
    this.renderer = new Renderer(gl, floats);
    this.shelf = new ToolShelf(gl, () => this.set?.sphere.center ?? [0, 0, 0]);
    this.loader = new ShellLoader(gl, decoderSource, () => this.loaded());
    this.loop = new FrameLoop(gl, () => this.draw(), () => this.finish(), () => this.tell("frame"));
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
    this.drawAllHere();
    for (const level of this.set?.levels ?? []) this.forget(level);
    this.loader.problem = "";
    this.largest.clear();
    this.set = set;
    this.state.hidden = new Set([...this.state.hidden].filter((k) => k < set.levels.length));
    const copies = set.levels.map((level) => level.coarse ?? level);
    this.loop.detail.begin(trianglesOf(copies) / Math.max(1, trianglesOf(set.levels)));
    this.tell("set");
    this.change({});
  }

  /** Takes over what differs, and draws. */
  change(to: Partial<State>, moving = false): void {
    Object.assign(this.state, to);
    this.state.cue = lawfulCue(this.state.cue);
    const shells = this.set?.levels.length ?? Infinity;
    if ([...this.state.hidden].some((k) => k >= shells)) {
      this.state.hidden = new Set([...this.state.hidden].filter((k) => k < shells));
    }
    if (!this.isServed()) this.served?.stop();
    this.tell("state");
    if (moving) this.loop.invalidateMoving();
    else this.loop.invalidate();
  }

  changeCamera(to: Partial<State["camera"]>, moving = false): void {
    this.change({ camera: { ...this.state.camera, ...to } }, moving);
  }

  toolsChanged(moving = false): void {
    if (!this.isServed()) this.served?.stop();
    this.tell("tools");
    if (moving) this.loop.invalidateMoving();
    else this.loop.invalidate();
  }

  /** A list of levels that has changed: one added, gone, or another in the place of an old one. */
  levelsChanged(old: Level | null, made: Level | null): void {
    this.drawAllHere(); // the server has the levels it began with
    if (old && made) this.loader.replace(old, made);
    else if (old) this.forget(old);
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
    return { lo: 0, hi: this.largest.get(mode)?.value || 1 };
  }

  /** This view as a PNG, drawn anew at that size. */
  async save(width: number, height: number): Promise<Blob> {
    const wasServed = this.isServed();
    const served = await this.servedPicture(width, height, false);
    if (served) return encoded(served);
    if (wasServed) await this.drawnHere();
    const frame = this.frame(this.camera(width, height), nothing, false);
    const blob = await pngOf(this.gl, width, height, (target) => {
      this.renderer.draw(frame, this.display(), target);
      this.renderer.finish(frame, this.display(), target);
    });
    this.loop.invalidate();
    return blob;
  }

  /** From now on nothing is asked for. */
  private drawAllHere(): void {
    this.served?.stop();
    this.served = null;
  }

  /** Waits until a view that the server has drawn so far is drawn here, with all its shells. */
  private drawnHere(): Promise<void> {
    this.picture = { isComplete: false, isWhole: false };
    this.loop.invalidate();
    return new Promise((resolve) => {
      const stop = this.listen(() => {
        if (this.isServed() || !this.loop.isSettled() || !this.picture.isWhole) return;
        stop();
        resolve();
      });
    });
  }

  private forget(level: Level): void {
    this.loader.forget(level);
    if (level.coarse) this.loader.forget(level.coarse);
  }

  private tell(what: Parameters<Listener>[0]): void {
    for (const listener of this.listeners) listener(what);
  }

  private display(): Display {
    const { mode, colorMap, over } = this.state;
    return { mode, colorMap, over, window: this.window() };
  }

  /**
   * @param leftOut  shells not drawn although they are not hidden
   * @param coarse   whether shells that have a copy are drawn as that
   */
  private frame(camera: Camera, leftOut: ReadonlySet<number>, coarse: boolean): Frame {
    const levels = this.set?.levels ?? [];
    const tools = this.shelf.scene();
    const scene: Scene = { center: this.set?.center ?? [0, 0, 0], shells: levels, tools: tools.bounds };
    const options: PictureOptions = { ...this.state, leftOut };
    const plan = makePlan(scene, camera, options);
    return {
      camera, plan, origin: scene.center, border: levels[0]?.border ?? null, tools: tools.gpu,
      shells: levels.map((level) => this.meshOf(level, plan.normals, coarse)),
    };
  }

  /** A shell or its copy; either stands in for the other until that is there. */
  private meshOf(level: Level, normals: boolean, coarse: boolean): GpuMesh | undefined {
    if (this.loader.isRefused(level)) return undefined;
    const copy = level.coarse ? this.loader.meshOf(level.coarse, normals) : undefined;
    const shell = this.loader.meshOf(level, normals);
    return coarse ? copy ?? shell : shell ?? copy;
  }

  /**
   * What is to be decoded for a plan, the most urgent first: copies before shells where they make a
   * picture much sooner or the picture moves too slowly; after them where it would if it moved.
   */
  private wishes(plan: Plan): Surface[] {
    const levels = plan.wanted.map((k) => this.set!.levels[k]);
    const copiesOf = (of: Level[]): Surface[] => of.flatMap((level) => level.coarse ?? []);
    const { detail } = this.loop;
    if (detail.isFixed) return levels;
    const isThere = (surface: Surface): boolean => this.loader.meshOf(surface, plan.normals) !== undefined;
    const missing = levels.filter((level) => !isThere(level));
    const first = copiesOf(missing);
    const isSooner = trianglesOf(missing) >= manyTriangles &&
      trianglesOf(first) <= copiesShare * trianglesOf(missing);
    const all = copiesOf(levels);
    return [...new Set<Surface>([
      ...(isSooner ? first : []), ...(this.loop.isCoarse() ? all : all.filter(isThere)), ...levels,
      ...(detail.amount.isCoarse ? all : []),
    ])];
  }

  /** Of those not hidden all but every so many, while the picture moves too slowly. */
  private leftOutNow(): ReadonlySet<number> {
    const { hidden, mode } = this.state;
    const stride = mode === "iso" ? 1 : this.loop.stride();
    if (stride === 1) return nothing;
    const shown = [...(this.set?.levels.keys() ?? [])].filter((k) => !hidden.has(k)).reverse();
    return new Set(shown.filter((_, i) => i % stride !== 0));
  }

  /** Whether the server draws what is shown. */
  isServed(): boolean {
    return this.served !== null && this.set !== null && this.served.draws(this.state) &&
      this.shelf.scene().bounds.length === 0 &&
      (this.refused === null || this.refused !== hashOf(this.state));
  }

  /** The server's picture; none where it draws none, or is gone: that is drawn here then. */
  private async servedPicture(width: number, height: number, soon: boolean): Promise<ImageData | null> {
    const { served } = this;
    if (!served || !this.isServed()) return null;
    const asked = hashOf(this.state);
    try {
      return await served.picture(this.state, width, height, soon);
    } catch (error) {
      if (error instanceof Refused) this.refused = asked;
      else if (this.served === served) this.served = null;
      this.tell("state"); // what draws it is another now, and so is the command
      return null;
    }
  }

  private async drawServed(width: number, height: number): Promise<boolean> {
    this.loader.want([], false);
    this.plan = this.drawn = null;
    this.loop.restTells = false; // fine layers at rest, and at first the set is decoded
    const soon = this.loop.isMoving();
    if (soon) this.loop.drawnWithLess();
    const { served } = this;
    const picture = await this.servedPicture(width, height, soon);
    if (!picture || this.served !== served || !this.isServed()) {
      this.loop.invalidate();
      return false;
    }
    sized(this.servedCanvas, width, height);
    this.servedCanvas.getContext("2d")!.putImageData(picture, 0, 0);
    this.servedCanvas.hidden = false;
    this.renderer.triangles = 0;
    this.picture = { isComplete: true, isWhole: true };
    return true;
  }

  private draw(): boolean | Promise<boolean> {
    const { canvas } = this;
    const ratio = Math.min(window.devicePixelRatio, mostPixelRatio) * this.loop.scale();
    const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
    this.pixels = { width, height };
    this.loop.isUnfinished = false;
    this.loop.detail.onlyPixels = this.isServed();
    return this.isServed() ? this.drawServed(width, height) : this.drawHere(width, height);
  }

  /** Whether the picture has what is to be judged by its time: a moving one its copies. */
  private drawHere(width: number, height: number): boolean {
    this.servedCanvas.hidden = true;
    if (this.gl.isContextLost()) return false;
    sized(this.canvas, width, height);
    const coarse = this.loop.isCoarse();
    const frame = this.frame(this.camera(width, height), this.leftOutNow(), coarse);
    if (this.isSoftware && this.loop.isMoving() && frame.plan.layers.length > 0) {
      frame.plan.layers = []; // flat: the estimate takes as long as half of the shells there
      this.loop.drawnWithLess();
    }
    this.loop.restTells = !this.isSoftware || frame.plan.layers.length === 0;
    this.plan = frame.plan;
    this.drawn = frame;
    this.loop.isUnfinished = frame.plan.layers.length > 0;
    const levels = this.set?.levels ?? [];
    const { wanted, normals } = frame.plan;
    this.loader.want(this.wishes(frame.plan), normals);
    this.findOwnWindow();
    this.renderer.draw(frame, this.display(), null);
    const drawn = wanted.map((k) => levels[k]);
    this.picture = {
      isComplete: wanted.every((k) => frame.shells[k] || this.loader.isRefused(levels[k])),
      isWhole: !coarse && drawn.every((level) => this.loader.isSettled(level)),
    };
    return !coarse || drawn.every((level) => !level.coarse || this.loader.meshOf(level.coarse, normals));
  }

  /** A maximum at rest has the weights of its own layers. */
  private finish(): void {
    if (this.drawn && !this.gl.isContextLost()) this.renderer.finish(this.drawn, this.display(), null);
  }

  /**
   * Sums and counts are shown up to their largest, found in a small picture of all shells: once of
   * their copies, where those come first, and once of the shells themselves.
   */
  private findOwnWindow(): void {
    const { mode, window } = this.state;
    const known = this.largest.get(mode);
    if (window || (mode !== "sum" && mode !== "count") || known?.isWhole) return;
    const { width, height } = this.canvas;
    const side = ownWindowSide / Math.max(width, height);
    const camera = this.camera(Math.round(width * side), Math.round(height * side));
    const frame = this.frame(camera, nothing, false);
    const isWhole = frame.plan.wanted.every((k) => this.loader.meshOf(this.set!.levels[k], false));
    if (!frame.plan.wanted.every((k) => frame.shells[k]) || (known && !isWhole)) return;
    const value = this.renderer.largest(frame);
    if (value > 0) this.largest.set(mode, { value, isWhole });
    this.tell("state");
  }

  forgetOwnWindow(): void { this.largest.delete(this.state.mode); }

  private loaded(): void {
    if (this.isServed()) return this.tell("loading");
    const { wanted, loaded } = this.loader.state();
    const levels = this.plan?.wanted.map((k) => this.set!.levels[k]) ?? [];
    const isComplete = levels.every((level) => this.meshOf(level, this.plan!.normals, false));
    const isFirst = isComplete && !this.picture.isComplete;
    if (loaded < wanted && !isFirst) this.loop.invalidateLoading();
    else this.loop.invalidate();
    this.tell("loading"); // afterwards: the picture is not ready before it is drawn
  }

  private restore(): void {
    this.loader.forgetAll();
    this.shelf.forgetAll();
    this.renderer = new Renderer(this.gl, this.floats);
    this.loop.restart();
  }
}
