/** A line at the first opening that says how to turn and zoom; gone with the first thing done. */
import { byId, element, onClick } from "./dom";
import type { Viewer } from "./viewer";

const storageKey = "nacre-hint";

/** Pages from disk and in frames may have no storage: the hint then comes with each opening. */
function isRemembered(): boolean {
  try {
    return localStorage.getItem(storageKey) !== null;
  } catch {
    return false;
  }
}

function remember(): void {
  try {
    localStorage.setItem(storageKey, "seen");
  } catch {
    // no storage
  }
}

const words = {
  mouse: "Drag to turn, wheel to zoom, Shift and drag to move. H for all keys.",
  touch: "One finger turns; two zoom, move and roll. More under Help.",
};

/** Keys by which people get to the hint's own button. */
const passingKeys = ["Tab", "Shift", "Control", "Alt", "Meta"];

export class Hint {
  private readonly box = byId("hint");
  private readonly ended = new AbortController();

  constructor(viewer: Viewer) {
    const stop = viewer.listen((what) => {
      if (what !== "frame" || !viewer.set) return;
      stop();
      this.show();
    });
  }

  private show(): void {
    const isTouch = matchMedia("(pointer: coarse)").matches;
    this.box.hidden = false; // before its words, which are then read out
    this.box.prepend(element("span", {}, isTouch ? words.touch : words.mouse));
    onClick("hint-close", () => this.end());
    const options = { signal: this.ended.signal, capture: true, passive: true };
    for (const act of ["pointerdown", "wheel", "keydown"]) {
      document.addEventListener(act, (event) => this.done(event), options);
    }
  }

  private done(event: Event): void {
    const isOwn = event.target instanceof Node && this.box.contains(event.target);
    const isPassing = event instanceof KeyboardEvent && passingKeys.includes(event.key);
    const escapes = event instanceof KeyboardEvent && event.key === "Escape";
    if (escapes || (!isOwn && !isPassing)) this.end();
  }

  private end(): void {
    const hadFocus = this.box.contains(document.activeElement);
    this.ended.abort();
    this.box.hidden = true;
    remember();
    if (hadFocus) byId("picture").focus();
  }
}

/** Shows the hint with the first picture, unless it was seen before or the address says hint=off. */
export function showHintOnce(viewer: Viewer, asked: URLSearchParams): void {
  if (asked.get("hint") !== "off" && !isRemembered()) new Hint(viewer);
}
