/**
 * How much detail a moving picture has, so that it moves fluently: fewer pixels; where that does not
 * help, because triangles are what takes the time, fewer shells.
 */
import { clamp } from "./vector";

/** A frame later than this, in ms, takes detail away; one earlier than the other gives some back. */
const lateFrame = 33;
const earlyFrame = 14;
const smallestScale = 0.5;
const largestStride = 6;
/** Frames of one detail before it is judged by their median; one is enough if it is very late. */
const judged = 3;
const veryLateFrame = 2 * lateFrame;
/** Pixels are what takes the time if with half of them a frame takes at most this share of it. */
const gain = 0.8;

export class Detail {
  /** Of the device's pixels, in each direction. */
  scale = 1;
  /** Every how many of the shells shown is drawn. */
  stride = 1;
  /** Whether moving pictures are whole, however late (?detail=full, for measuring). */
  isFixed = false;
  private times: number[] = [];
  /** The time before pixels were taken away, while it is not known whether that helped. */
  private before = 0;
  private byTriangles = false;

  /** A picture at rest took so long: moving ones need not find out. */
  accountAtRest(milliseconds: number): void {
    const isWhole = this.scale === 1 && this.stride === 1 && this.before === 0;
    if (!this.isFixed && isWhole && milliseconds > veryLateFrame) this.lessDetail(milliseconds);
  }

  account(milliseconds: number): void {
    if (this.isFixed) return;
    this.times.push(milliseconds);
    if (this.times.length < judged && milliseconds < veryLateFrame) return;
    const median = [...this.times].sort((a, b) => a - b)[Math.floor(this.times.length / 2)];
    this.times = [];
    if (this.before > 0) this.judgeFewerPixels(median);
    else if (median > lateFrame) this.lessDetail(median);
    else if (median < earlyFrame) this.moreDetail();
  }

  private judgeFewerPixels(median: number): void {
    if (median > gain * this.before) {
      this.byTriangles = true;
      this.scale = 1;
      this.fewerShells(median);
    }
    this.before = 0;
  }

  private lessDetail(median: number): void {
    if (!this.byTriangles && this.scale > smallestScale) {
      this.before = median;
      this.scale = clamp(this.scale * Math.SQRT1_2, smallestScale, 1);
    } else {
      this.fewerShells(median);
    }
  }

  /** As many as would be in time, if time goes with triangles. */
  private fewerShells(milliseconds: number): void {
    const needed = Math.ceil((this.stride * milliseconds) / lateFrame);
    this.stride = clamp(needed, this.stride + 1, largestStride);
  }

  private moreDetail(): void {
    if (this.stride > 1) this.stride -= 1;
    else if (this.scale < 1) this.scale = Math.min(1, this.scale * 1.1);
    else this.byTriangles = false;
  }
}
