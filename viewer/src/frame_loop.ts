/**
 * When to draw: only when something changed, never more than one frame ahead of the graphics side.
 * While the picture moves and frames run late, it has less detail.
 */
import { Detail } from "./detail";

const restAfter = 250;
/** Pictures while shells arrive: each waits this many times as long as the last one took. */
const loadingWaits = 2;

export class FrameLoop {
  /** Of the last frame, from its first command to its end on the graphics side, ms. */
  milliseconds = 0;
  /** Frames in the last second. */
  rate = 0;
  /** Of pictures that move. */
  readonly detail = new Detail();
  /** Whether the time of a picture at rest says something of moving ones: not if it shows more. */
  restTells = true;
  private dirty = false;
  private scheduled = false;
  private fence: WebGLSync | null = null;
  /** Whether a picture is being drawn elsewhere. */
  private awaited = false;
  private started = 0;
  private movedAt = -Infinity;
  private restTimer = 0;
  private loadingTimer = 0;
  private ends: number[] = [];
  /** Whether the last frame had less detail than one at rest. */
  private reduced = false;
  private counts = true;
  /** No motion for a while. */
  private atRest = true;
  /** Whether the last picture can be finished once it is at rest. */
  isUnfinished = false;

  constructor(
    private readonly gl: WebGL2RenderingContext,
    /**
     * Whether the picture has the detail that was asked for: its time then counts. A promise where
     * it is drawn elsewhere first.
     */
    private readonly draw: () => boolean | Promise<boolean>,
    /** Does what the last picture can do without while it moves. */
    private readonly finish: () => void,
    private readonly measured: () => void,
  ) {}

  invalidate(): void {
    this.dirty = true;
    this.schedule();
  }

  /** The same, for a picture that moves: it may be drawn with fewer pixels, and again at rest. */
  invalidateMoving(): void {
    this.movedAt = performance.now();
    this.atRest = false;
    clearTimeout(this.restTimer);
    this.restTimer = window.setTimeout(() => this.rest(), restAfter);
    this.invalidate();
  }

  /**
   * The same, for a shell that has arrived while others are under way: drawing a picture anew with
   * each would take longer than loading them where frames are slow.
   */
  invalidateLoading(): void {
    if (this.loadingTimer !== 0) return;
    const passed = performance.now() - this.started - this.milliseconds;
    this.loadingTimer = window.setTimeout(() => {
      this.loadingTimer = 0;
      this.invalidate();
    }, Math.max(0, loadingWaits * this.milliseconds - passed));
  }

  isMoving(): boolean { return performance.now() - this.movedAt < restAfter; }

  /** Whether what is on the screen is the last that was asked for. */
  isSettled(): boolean {
    const isDrawn = !this.dirty && !this.fence && !this.awaited && !this.reduced;
    return isDrawn && !this.isUnfinished && this.loadingTimer === 0;
  }

  /** Of the device's pixels, in each direction. */
  scale(): number { return this.isMoving() ? this.detail.amount.scale : 1; }

  /** Every how many of the shells shown is drawn. */
  stride(): number { return this.isMoving() ? this.detail.amount.stride : 1; }

  /** Whether shells that have a coarse copy are drawn as that. */
  isCoarse(): boolean { return this.isMoving() && this.detail.amount.isCoarse; }

  /** To be called while drawing what shows less than it will at rest. */
  drawnWithLess(): void { this.reduced = true; }

  /** After a lost context: what was in flight never ends. */
  restart(): void {
    this.fence = null;
    this.invalidate();
  }

  private rest(): void {
    this.atRest = true;
    if (this.reduced) return this.invalidate();
    if (this.dirty || this.fence || !this.isUnfinished) return; // a picture comes, or there is nothing to do
    this.finishAtRest();
    this.measured();
  }

  private finishAtRest(): void {
    if (!this.isUnfinished || !this.atRest || this.dirty) return;
    this.isUnfinished = false;
    this.finish();
  }

  private schedule(): void {
    if (this.scheduled) return;
    this.scheduled = true;
    requestAnimationFrame(() => this.frame());
  }

  private frame(): void {
    this.scheduled = false;
    if (!this.dirty || this.fence || this.awaited) return;
    this.dirty = false;
    clearTimeout(this.loadingTimer);
    this.loadingTimer = 0;
    this.started = performance.now();
    this.reduced = this.scale() < 1 || this.stride() > 1 || this.isCoarse();
    const drawn = this.draw();
    if (typeof drawn !== "boolean") {
      this.awaited = true;
      void drawn.catch(() => false).then((counts) => this.ended(counts));
      return;
    }
    this.counts = drawn;
    this.fence = this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
    this.gl.flush();
    this.poll();
  }

  /** A picture drawn elsewhere is on the screen: the graphics side has no part in it. */
  private ended(counts: boolean): void {
    this.awaited = false;
    this.counts = counts;
    this.account();
    this.measured();
    if (this.dirty) this.schedule();
  }

  private poll(): void {
    const { gl, fence } = this;
    if (!fence) return;
    if (!gl.isContextLost() && gl.getSyncParameter(fence, gl.SYNC_STATUS) !== gl.SIGNALED) {
      setTimeout(() => this.poll());
      return;
    }
    gl.deleteSync(fence);
    this.fence = null;
    this.account();
    this.finishAtRest();
    this.measured();
    if (this.dirty) this.schedule();
  }

  private account(): void {
    const now = performance.now();
    this.milliseconds = now - this.started;
    this.ends = [...this.ends.filter((end) => end > now - 1000), now];
    this.rate = this.ends.length;
    if (this.isMoving() && this.counts) this.detail.account(this.milliseconds);
    else if (this.restTells && !this.isMoving()) this.detail.accountAtRest(this.milliseconds);
  }
}
