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
  });
}

export class LiveLevels {
  private readonly emission = element("input", {
    type: "number", min: "0.001", max: "1", step: "any", value: "0.5", id: "live-emission",
  });

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
    const level = await this.fetchLevel(emission);
    if (level) this.replace(null, level);
  }

  /** Drops what is hidden where it was. */
  async move(level: Level, emission: number): Promise<void> {
    const moved = await this.fetchLevel(emission);
    if (moved) this.replace(level, moved);
    else this.viewer.levelsChanged([]);
  }

  remove(level: Level): void { this.replace(level, null); }

  private replace(old: Level | null, made: Level | null): void {
    const { set, state } = this.viewer;
    if (!set) return;
    const hidden = new Set(set.levels.filter((level, k) => state.hidden.has(k) && level !== old));
    const levels = set.levels.filter((level) => level !== old);
    if (made) levels.push(made);
    set.levels = levels.sort((a, b) => a.emission - b.emission);
    showMiddles(set.levels);
    state.hidden = new Set([...set.levels.keys()].filter((k) => hidden.has(set.levels[k])));
    this.viewer.levelsChanged(old ? [old] : []);
  }

  /** The shell of a level, from the server; says what is wrong and gives null where there is none. */
  private async fetchLevel(emission: number): Promise<Level | null> {
    const taken = this.viewer.set?.levels.some((level) => Math.abs(level.emission - emission) < 1e-9);
    if (!(emission > 0 && emission <= 1) || taken) {
      say(taken ? `There is a level at ${emission}.` : `Level: found ${emission}, expected above 0 and up to 1`, "small");
      return null;
    }
    document.documentElement.dataset.state = "drawing";
    const stop = this.showWaiting(emission);
    try {
      const start = performance.now();
      const answer = await fetch(`level?emission=${emission}`, { method: "POST" });
      if (!answer.ok) throw new Error(await answer.text());
      const level = readShellSet(new Uint8Array(await answer.arrayBuffer())).levels[0];
      byId("live").dataset.milliseconds = String(Math.round(performance.now() - start));
      return level;
    } catch (error) {
      say(`Level at ${emission}: ${(error as Error).message}`, "small");
      this.viewer.change({});
      return null;
    } finally {
      stop();
    }
  }

  /** Says so where it takes longer than 0.3 s. */
  private showWaiting(emission: number): () => void {
    const timer = setTimeout(() => say(`Making the shell at ${emission} ...`, "news"), 300);
    return () => {
      clearTimeout(timer);
      if (byId("message").classList.contains("news")) say("", "problem");
    };
  }
}
