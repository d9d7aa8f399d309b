/** What is written over the picture: orientation letters and the millimetre scale. */
import { pixelSize, type Camera } from "./camera";
import { scale, type Vec3 } from "./vector";

/** Letters of a direction of the patient, the largest part first: "L", "LA". */
export function letters(direction: Vec3): string {
  const names: [string, string][] = [["L", "R"], ["P", "A"], ["S", "I"]];
  return direction
    .map((x, axis) => ({ size: Math.abs(x), letter: names[axis][x > 0 ? 0 : 1] }))
    .filter((part) => part.size > 0.35)
    .sort((a, b) => b.size - a.size)
    .slice(0, 2)
    .map((part) => part.letter)
    .join("");
}

/** The longest of 1, 2, 5, 10, ... mm that is at most `most` mm. */
export function scaleLength(most: number): number {
  const power = 10 ** Math.floor(Math.log10(most));
  return [5, 2, 1].find((step) => step * power <= most)! * power;
}

export class Overlay {
  private readonly sides: Record<"left" | "right" | "top" | "bottom", HTMLElement>;

  constructor(private readonly root: HTMLElement) {
    const side = (name: string): HTMLElement => root.querySelector(`[data-side=${name}]`)!;
    this.sides = { left: side("left"), right: side("right"), top: side("top"), bottom: side("bottom") };
  }

  update(camera: Camera, cssWidth: number): void {
    this.sides.right.textContent = letters(camera.right);
    this.sides.left.textContent = letters(scale(camera.right, -1));
    this.sides.top.textContent = letters(camera.up);
    this.sides.bottom.textContent = letters(scale(camera.up, -1));
    const mmPerCssPixel = (pixelSize(camera) * camera.width) / cssWidth;
    const bar = this.root.querySelector<HTMLElement>("#scale-bar")!;
    const usable = mmPerCssPixel > 0 && Number.isFinite(mmPerCssPixel);
    bar.hidden = !usable;
    if (!usable) return;
    const mm = scaleLength(Math.min(160, cssWidth / 3) * mmPerCssPixel);
    bar.style.width = `${mm / mmPerCssPixel}px`;
    bar.textContent = `${mm} mm${camera.perspective ? " at the centre" : ""}`;
  }
}
