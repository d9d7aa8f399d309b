/** The list of shells, brightest first: shown and hidden one by one. */
import { cssColor } from "./color_maps";
import { byId, element, onClick } from "./dom";
import type { LiveLevels } from "./live";
import type { Level } from "./shell_set";
import type { Viewer } from "./viewer";

export class ShellList {
  /** Where the server makes levels; they can then be moved and deleted. */
  live: LiveLevels | null = null;
  private rows: { index: number; check: HTMLInputElement; swatch: HTMLElement }[] = [];

  constructor(private readonly viewer: Viewer) {
    onClick("shells-all", () => viewer.change({ hidden: new Set() }));
    onClick("shells-none", () => viewer.change({ hidden: new Set(this.levels().keys()) }));
    onClick("shells-half", () => this.hideEverySecond());
  }

  build(): void {
    this.rows = [];
    const rows = this.levels().map((level, index) => this.row(level, index)).reverse();
    byId("shell-list").replaceChildren(...rows);
  }

  show(): void {
    const { hidden, colorMap } = this.viewer.state;
    const { lo, hi } = this.viewer.state.mode === "max" ? this.viewer.window() : { lo: 0, hi: 1 };
    for (const { index, check, swatch } of this.rows) {
      check.checked = !hidden.has(index);
      const brightness = (this.levels()[index].representative - lo) / (hi - lo);
      swatch.style.background = cssColor(colorMap, brightness);
    }
  }

  private levels(): Level[] { return this.viewer.set?.levels ?? []; }

  private row(level: Level, index: number): HTMLElement {
    const check = element("input", { type: "checkbox" });
    check.addEventListener("change", () => this.toggle(index, check.checked));
    const swatch = element("i", { "aria-hidden": "true" });
    const value = Number(level.value.toPrecision(6));
    const words = element("span", {}, level.emission.toFixed(3), element("small", {}, ` (${value})`));
    const triangles = level.triangles > 0 ? level.triangles.toLocaleString("en") : "empty";
    this.rows.push({ index, check, swatch });
    const row = element("label", { class: "shell", "data-shell": String(index + 1) },
      check, swatch, words, element("small", {}, triangles));
    row.title = `Shell ${index + 1}: emission ${level.emission}, shown as ${level.representative}`;
    check.setAttribute("aria-label",
      `Shell ${index + 1}, emission ${level.emission.toFixed(3)}, ${triangles} triangles`);
    return this.live ? this.withLive(this.live, row, level, words) : row;
  }

  /** The level as a field, and a way to delete it. */
  private withLive(live: LiveLevels, row: HTMLElement, level: Level, words: HTMLElement): HTMLElement {
    const field = element("input", { type: "number", step: "any", min: "0.001", max: "1",
      value: String(Number(level.emission.toFixed(6))), "aria-label": `Emission of the level at ${level.emission}` });
    field.addEventListener("change", () => void live.move(level, field.valueAsNumber));
    const remove = element("button", { type: "button", "aria-label": `Delete the level at ${level.emission}` }, "×");
    remove.addEventListener("click", (event) => {
      event.preventDefault();
      live.remove(level);
    });
    words.replaceChildren(field);
    row.classList.add("live");
    row.append(remove);
    return row;
  }

  private toggle(index: number, shown: boolean): void {
    const hidden = new Set(this.viewer.state.hidden);
    if (shown) hidden.delete(index);
    else hidden.add(index);
    this.viewer.change({ hidden });
  }

  private hideEverySecond(): void {
    const hidden = new Set(this.viewer.state.hidden);
    const shown = [...this.levels().keys()].filter((k) => !hidden.has(k));
    shown.forEach((k, i) => { if (i % 2 === 1) hidden.add(k); });
    this.viewer.change({ hidden });
  }
}
