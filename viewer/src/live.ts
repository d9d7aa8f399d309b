/**
 * Live levels, [H96] section 5: with `nacre view VOLUME` the server makes the shell of any level;
 * levels are added, moved and deleted here.
 */
import { byId, element } from "./dom";
import { say } from "./message";
import { readShellSet, type Level } from "./shell_set";
import type { Viewer } from "./viewer";

/** Each layer shows its middle, the brightest 1: what uniform levels show (docs/shell_file.md). */
export function showMiddles(levels: readonly Level[]): void {
  levels.forEach((level, k) => {
    const next = levels[k + 1];
    level.representative = next ? (level.emission + next.emission) / 2 : 1;
    level.sumRepresentative = level.representative;
  });
}

export class LiveLevels {
  private readonly emission = element("input", {
    type: "number", min: "0.001", max: "1", step: "any", value: "0.5", id: "live-emission",
  });

  /** Shells that are simplified, one after the other. */
  private simplifying: Promise<void> = Promise.resolve();

  constructor(private readonly viewer: Viewer) {
    const add = element("button", { type: "button", id: "live-add" }, "Add level");
    add.addEventListener("click", () => void this.add(this.emission.valueAsNumber));
    this.emission.addEventListener("keydown", (event) => {
      if (event.key === "Enter") void this.add(this.emission.valueAsNumber);
    });
    byId("live").append(element("div", { class: "row" },
      element("label", { for: "live-emission" }, "At emission"), this.emission, add));
    byId("live").hidden = false;
  }

  async add(emission: number): Promise<void> {
    if (this.objects(emission)) return;
    await this.make(emission, (level) => this.replace(null, level));
  }

  /** Drops what is hidden where it was. */
  async move(level: Level, emission: number): Promise<void> {
    if (this.objects(emission)) return this.viewer.levelsChanged(null, null);
    await this.make(emission, (moved) => this.replace(level, moved));
  }

  remove(level: Level): void { this.replace(level, null); }

  /** Says why there is no making a level there. */
  private objects(emission: number): boolean {
    const taken = this.viewer.set?.levels.some((level) => Math.abs(level.emission - emission) < 1e-9);
    const lawful = emission > 0 && emission <= 1;
    if (taken) say(`There is a level at ${emission}.`, "small");
    else if (!lawful) say(`Level: found ${emission}, expected above 0 and up to 1`, "small");
    return taken || !lawful;
  }

  private replace(old: Level | null, made: Level | null, shown = true): void {
    const { set, state } = this.viewer;
    if (!set || (old && !set.levels.includes(old))) return; // deleted meanwhile
    const hidden = new Set(set.levels.filter((level, k) => state.hidden.has(k) && level !== old));
    const levels = set.levels.filter((level) => level !== old);
    if (made) levels.push(made);
    if (made && !shown) hidden.add(made);
    set.levels = levels.sort((a, b) => a.emission - b.emission);
    showMiddles(set.levels);
    state.hidden = new Set([...set.levels.keys()].filter((k) => hidden.has(set.levels[k])));
    this.viewer.levelsChanged(old, made);
  }

  /** Shows a level's shell, first as a quick draft where the server simplifies. */
  private async make(emission: number, show: (level: Level) => void): Promise<void> {
    const asked = performance.now();
    document.documentElement.dataset.state = "drawing";
    const draft = await this.fetchLevel(emission, "&draft", 300);
    if (!draft) return this.viewer.change({});
    show(draft.level);
    this.noteWhenShown(draft.level, asked);
    if (draft.isDraft) this.simplifying = this.simplifying.then(() => this.simplify(draft.level, emission));
  }

  /** Puts the whole shell in the place of its draft, unless that is gone by now. */
  private async simplify(draft: Level, emission: number): Promise<void> {
    if (!this.viewer.set?.levels.includes(draft)) return;
    const whole = await this.fetchLevel(emission, "", 1000);
    const at = this.viewer.set.levels.indexOf(draft);
    if (whole) this.replace(draft, whole.level, !this.viewer.state.hidden.has(at));
  }

  /** The time from asking for a level to seeing it, for those who measure. */
  private noteWhenShown(level: Level, asked: number): void {
    const stop = this.viewer.listen((what) => {
      const isGone = !this.viewer.set?.levels.includes(level);
      const isShown = what === "frame" && this.viewer.loader.isSettled(level) && this.viewer.loop.isSettled();
      if (isShown) byId("live").dataset.milliseconds = String(Math.round(performance.now() - asked));
      if (isShown || isGone) stop();
    });
  }

  /** The shell of a level, from the server; says what is wrong and gives null where there is none. */
  private async fetchLevel(
    emission: number, query: string, patience: number,
  ): Promise<{ level: Level; isDraft: boolean } | null> {
    const stop = this.showWaiting(`${query ? "Making" : "Simplifying"} the shell at ${emission}`, patience);
    try {
      const answer = await fetch(`level?emission=${emission}${query}`, { method: "POST" });
      if (!answer.ok) throw new Error(await answer.text());
      const level = readShellSet(new Uint8Array(await answer.arrayBuffer())).levels[0];
      return { level, isDraft: answer.headers.get("Nacre-Draft") === "yes" };
    } catch (error) {
      say(`Level at ${emission}: ${(error as Error).message}`, "small");
      return null;
    } finally {
      stop();
    }
  }

  /** Says so where it takes longer than `patience`, ms, and for how long it has. */
  private showWaiting(what: string, patience: number): () => void {
    const line = byId("live-progress");
    const start = performance.now();
    const timer = setInterval(() => {
      const passed = performance.now() - start;
      if (passed < patience) return;
      line.hidden = false;
      line.textContent = `${what} ... ${(passed / 1000).toFixed(1)} s`;
    }, 100);
    return () => {
      clearInterval(timer);
      line.hidden = true;
    };
  }
}
