/**
 * How much detail a moving picture has, so that it moves fluently: coarse copies of the shells, where
 * the set has them; fewer pixels; fewer shells. What does not make frames sooner is taken back.
 */
import { clamp } from "./vector";

/**
 * Frames later than this, in ms, take detail away; ones earlier than the other give some back, and so
 * do those between after a while: what was late may have been something else's work.
 */
const lateFrame = 33;
const earlyFrame = 14;
/** Judgements before detail is given back; twice as many each time that was too much. */
const leastPatience = 4;
const mostPatience = 64;
const smallestScale = 0.5;
const largestStride = 6;
/** Copies are drawn only where they have at most this share of the triangles. */
const worthCopies = 0.7;
/** Frames before they are judged by their median, or two that take so long together, ms. */
const judged = 5;
const judgedTime = 150;
/** One frame is enough of a whole picture if it is very late, and of less detail on trial if it is later still. */
const veryLateFrame = 2 * lateFrame;
const hopelessFrame = 4 * lateFrame;
/** Less detail helps if with it a frame takes at most this share of the time. */
const gain = 0.8;

type Step = "copies" | "pixels" | "shells";

interface Amount {
  /** Of the device's pixels, in each direction. */
  scale: number;
  /** Every how many of the shells shown is drawn. */
  stride: number;
  /** Whether shells that have a coarse copy are drawn as that. */
  isCoarse: boolean;
}

const whole: Amount = { scale: 1, stride: 1, isCoarse: false };

export class Detail {
  amount: Amount = { ...whole };
  /** Whether moving pictures are whole, however late (?detail=full, for measuring). */
  isFixed = false;
  private times: number[] = [];
  /** The last step, while it is not known whether it helps: what was before it. */
  private trial: { step: Step; amount: Amount; milliseconds: number } | null = null;
  private useless = new Set<Step>();
  /** What a whole picture is compared with, to see whether less detail still helps. */
  private present: { amount: Amount; milliseconds: number } | null = null;
  /** Judgements in time, and late ones without a remedy, since detail changed. */
  private calm = 0;
  private stuck = 0;
  /** Late judgements without a remedy before a whole picture is tried, now and after the next in vain. */
  private untilWhole = 0;
  private wholePatience = mostPatience;
  /** Whether the last change gave detail back. */
  private isTrying = false;
  private patience = leastPatience;
  /** Where pictures are drawn elsewhere, pixels are all that can be saved. */
  onlyPixels = false;
  /** The triangles of a set drawn with its copies, of those without. */
  private copies = 1;

  /** Another set. @param copies  its triangles drawn with its coarse copies, of those without */
  begin(copies: number): void {
    this.amount = { ...whole };
    [this.times, this.trial, this.present, this.useless] = [[], null, null, new Set()];
    [this.calm, this.stuck, this.isTrying, this.patience] = [0, 0, false, leastPatience];
    [this.untilWhole, this.wholePatience] = [0, mostPatience];
    this.copies = copies;
  }

  /** A picture at rest took so long: moving ones need not find out. */
  accountAtRest(milliseconds: number): void {
    if (!this.isFixed && this.isWhole() && !this.present && milliseconds > veryLateFrame) this.lessDetail(milliseconds);
  }

  account(milliseconds: number): void {
    if (this.isFixed) return;
    this.times.push(milliseconds);
    if (!this.isEnough(milliseconds)) return;
    const median = [...this.times].sort((a, b) => a - b)[Math.floor((this.times.length - 1) / 2)];
    this.times = [];
    if (this.trial) this.judge(this.trial, median);
    if (this.present) this.compare(this.present, median);
    if (median > lateFrame) this.late(median);
    else this.inTime(median);
  }

  private isEnough(last: number): boolean {
    const { length } = this.times;
    const time = this.times.reduce((sum, one) => sum + one, 0);
    const isPlain = (this.isWhole() && last > veryLateFrame) || (this.trial !== null && last > hopelessFrame);
    return isPlain || length >= judged || (length > 1 && time > judgedTime);
  }

  private isWhole(): boolean {
    const { scale, stride, isCoarse } = this.amount;
    return scale === 1 && stride === 1 && !isCoarse && !this.trial;
  }

  /** Takes a step back that did not help; after one that did, others may help again. */
  private judge(trial: NonNullable<Detail["trial"]>, median: number): void {
    this.trial = null;
    if (median <= gain * trial.milliseconds) return this.useless.clear();
    this.amount = trial.amount;
    this.useless.add(trial.step);
  }

  /** Goes back to less detail if the whole picture takes longer by as much as a step has to gain. */
  private compare(present: NonNullable<Detail["present"]>, median: number): void {
    this.present = null;
    this.untilWhole = this.wholePatience;
    if (gain * median <= present.milliseconds) {
      this.wholePatience = mostPatience;
      return;
    }
    this.amount = present.amount;
    this.wholePatience *= 2;
  }

  private late(median: number): void {
    if (this.isTrying) this.patience = Math.min(2 * this.patience, mostPatience);
    [this.isTrying, this.calm] = [false, 0];
    this.lessDetail(median);
  }

  private inTime(median: number): void {
    this.calm += 1;
    this.isTrying = median < earlyFrame || this.calm >= this.patience;
    if (!this.isTrying) return;
    this.calm = 0;
    this.moreDetail(median);
  }

  private lessDetail(milliseconds: number): void {
    const { amount } = this;
    const possible: Record<Step, boolean> = {
      copies: !this.onlyPixels && this.copies <= worthCopies && !amount.isCoarse,
      pixels: amount.scale > smallestScale, shells: !this.onlyPixels && amount.stride < largestStride,
    };
    const step = (["copies", "pixels", "shells"] as const).find((s) => possible[s] && !this.useless.has(s));
    if (!step) return this.noStep(milliseconds);
    this.trial = { step, amount, milliseconds };
    this.amount = { ...amount };
    if (step === "copies") this.amount.isCoarse = true;
    else if (step === "pixels") this.amount.scale = clamp(amount.scale * Math.SQRT1_2, smallestScale, 1);
    else this.amount.stride = this.fewerShells(milliseconds);
  }

  /** Late whatever is left out: perhaps all of it is in vain by now. If not, other steps wait. */
  private noStep(milliseconds: number): void {
    if (--this.untilWhole < 0 && !this.isWhole()) {
      this.present = { amount: this.amount, milliseconds };
      this.amount = { ...whole };
    }
    this.stuck = (this.stuck + 1) % mostPatience;
    if (this.stuck === 0) this.useless.clear();
  }

  /** As many as would be in time, if time goes with triangles. */
  private fewerShells(milliseconds: number): number {
    const { stride } = this.amount;
    return clamp(Math.ceil((stride * milliseconds) / lateFrame), stride + 1, largestStride);
  }

  private moreDetail(median: number): void {
    const amount = { ...this.amount };
    if (amount.stride > 1) amount.stride -= 1;
    else if (amount.scale < 1) amount.scale = Math.min(1, amount.scale * Math.SQRT2);
    else if (amount.isCoarse && median < lateFrame * this.copies) amount.isCoarse = false;
    else this.useless.clear();
    this.amount = amount;
  }
}
