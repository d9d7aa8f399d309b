/** Small helpers for the page's elements. */

export function byId<T extends HTMLElement = HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no #${id}`);
  return found as T;
}

export const onClick = (id: string, act: () => void): void =>
  byId(id).addEventListener("click", act);

type Attributes = Record<string, string>;

export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K, attributes: Attributes = {}, ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const name in attributes) made.setAttribute(name, attributes[name]);
  made.append(...children);
  return made;
}

/** A slider with the number beside it; both can be set by hand. */
export class Slider {
  private readonly range: HTMLInputElement;
  private readonly number: HTMLInputElement;

  /**
   * @param changed      told whether the slider is being moved; a typed number comes once
   * @param logarithmic  the slider's place is the logarithm (base 2) of the value
   */
  constructor(name: string, changed: (value: number, moving: boolean) => void, private readonly logarithmic = false) {
    const row = document.querySelector<HTMLElement>(`[data-slider="${name}"]`)!;
    const label = row.dataset.name!;
    this.range = element("input", { type: "range", id: `slider-${name}` });
    this.number = element("input", { type: "number", "aria-label": `${label}, as a number` });
    row.append(element("label", { for: `slider-${name}` }, label), this.range, this.number);
    this.range.addEventListener("input", () => changed(
      logarithmic ? 2 ** this.range.valueAsNumber : this.range.valueAsNumber, true));
    this.number.addEventListener("change", () => {
      if (Number.isFinite(this.number.valueAsNumber)) changed(this.number.valueAsNumber, false);
    });
  }

  limits(lo: number, hi: number, step: number): void {
    [this.range.min, this.range.max, this.range.step] = [lo, hi, step].map(String);
    this.number.step = "any";
  }

  show(value: number): void {
    this.range.value = String(this.logarithmic ? Math.log2(value) : value);
    if (document.activeElement !== this.number) this.number.value = String(Number(value.toPrecision(5)));
  }

  enable(on: boolean): void {
    this.range.disabled = this.number.disabled = !on;
  }
}
