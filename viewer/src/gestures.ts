/** Turning, moving, zooming and windowing by mouse, touch and keys. */
import { pannedTarget } from "./camera";
import { clamp } from "./vector";
import type { Viewer } from "./viewer";

/** Degrees a pixel of drag. */
const turnSpeed = 0.4;
const wheelSpeed = 0.0015;
const keyTurn = 5;
const keyMove = 20;
const keyZoom = 1.1;

type Drag = "turn" | "move" | "window";

const wrapped = (degrees: number): number => ((degrees + 180) % 360 + 360) % 360 - 180;
const rounded = (x: number): number => Math.round(x * 1000) / 1000;

export class Gestures {
  private readonly pointers = new Map<number, PointerEvent>();
  private drag: Drag = "turn";

  constructor(private readonly viewer: Viewer) {
    const { canvas } = viewer;
    canvas.addEventListener("pointerdown", (event) => this.down(event));
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"] as const) {
      canvas.addEventListener(end, (event) => this.pointers.delete(event.pointerId));
    }
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
    canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 16 : 1;
      this.zoom(Math.exp(-event.deltaY * lines * wheelSpeed));
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => this.key(event));
  }

  /** The camera to its right and up, so that the picture follows the hand to the left and down. */
  turn(azimuth: number, elevation: number): void {
    const { camera } = this.viewer.state;
    this.viewer.changeCamera({
      azimuth: rounded(wrapped(camera.azimuth + azimuth)),
      elevation: rounded(clamp(camera.elevation + elevation, -90, 90)),
    }, true);
  }

  /** By pixels of the page. */
  pan(dx: number, dy: number): void {
    const target = pannedTarget(this.viewer.camera(), dx, dy);
    this.viewer.changeCamera({ lookAt: target }, true);
  }

  zoom(by: number): void {
    this.viewer.changeCamera({ zoom: clamp(this.viewer.state.camera.zoom * by, 0.05, 200) }, true);
  }

  /** Window by dx, level by dy, as fractions of the present window. */
  windowLevel(dx: number, dy: number): void {
    const { lo, hi } = this.viewer.window();
    const width = hi - lo;
    const changed = width * Math.exp(dx);
    const level = (lo + hi) / 2 + dy * width;
    this.viewer.change({ window: { lo: level - changed / 2, hi: level + changed / 2 } }, true);
  }

  private down(event: PointerEvent): void {
    this.viewer.canvas.focus({ preventScroll: true });
    this.viewer.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, event);
    if (event.button === 2 || (event.button === 0 && event.ctrlKey)) this.drag = "window";
    else if (event.button === 1 || event.shiftKey) this.drag = "move";
    else this.drag = "turn";
    if (event.button === 1) event.preventDefault();
  }

  private move(event: PointerEvent): void {
    const before = this.pointers.get(event.pointerId);
    if (!before) return;
    const dx = event.clientX - before.clientX;
    const dy = event.clientY - before.clientY;
    if (dx === 0 && dy === 0) return;
    const others = [...this.pointers.values()].filter((p) => p.pointerId !== event.pointerId);
    this.pointers.set(event.pointerId, event);
    if (others.length >= 2) this.windowLevel(dx * 0.005, dy * 0.003);
    else if (others.length === 1) this.twoFingers(before, event, others[0]);
    else this.dragged(dx, dy);
  }

  private dragged(dx: number, dy: number): void {
    if (this.drag === "window") this.windowLevel(dx * 0.008, dy * 0.004);
    else if (this.drag === "move") this.pan(dx, dy);
    else this.turn(-dx * turnSpeed, dy * turnSpeed);
  }

  /** Each finger moves half of the picture's way, pinches and turns it. */
  private twoFingers(before: PointerEvent, now: PointerEvent, other: PointerEvent): void {
    const from = [before.clientX - other.clientX, before.clientY - other.clientY];
    const to = [now.clientX - other.clientX, now.clientY - other.clientY];
    const lengths = [Math.hypot(from[0], from[1]), Math.hypot(to[0], to[1])];
    this.pan((now.clientX - before.clientX) / 2, (now.clientY - before.clientY) / 2);
    if (Math.min(...lengths) < 10) return;
    this.zoom(lengths[1] / lengths[0]);
    const angle = Math.atan2(to[1], to[0]) - Math.atan2(from[1], from[0]);
    this.roll((-wrapped((angle * 180) / Math.PI)));
  }

  /** Degrees about the viewing direction. */
  roll(by: number): void {
    const { camera } = this.viewer.state;
    this.viewer.changeCamera({ roll: rounded(wrapped(camera.roll + by)) }, true);
  }

  private key(event: KeyboardEvent): void {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (way && event.shiftKey) this.pan(way[0] * keyMove, -way[1] * keyMove);
    else if (way) this.turn(-way[0] * keyTurn, -way[1] * keyTurn);
    else if (event.key === "+" || event.key === "=") this.zoom(keyZoom);
    else if (event.key === "-") this.zoom(1 / keyZoom);
    else if (event.key === "[" || event.key === "]") this.roll(event.key === "[" ? -keyTurn : keyTurn);
    else return;
    event.preventDefault();
  }
}
