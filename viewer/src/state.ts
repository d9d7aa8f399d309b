/** What a view is: all of it stands in the address, with the names of `nacre render`'s flags. */
import { viewNames, type CameraOptions, type ViewName } from "./camera";
import { colorMapNames } from "./color_maps";
import type { Mode } from "./plan";
import { beta, type Cue, type Interval } from "./projection";
import { clamp, type Vec3 } from "./vector";

export const modes: readonly Mode[] = ["max", "sum", "count", "iso"];

export interface State {
  mode: Mode;
  camera: CameraOptions;
  cue: Cue;
  slab: Interval;
  hidden: Set<number>;
  /** Shown as black and as full brightness; null: the mode's own. */
  window: Interval | null;
  colorMap: string;
  /** Tools replaced by what is seen in front of them, [H96]; else the brighter of both. */
  over: boolean;
}

export const noCue: Cue = { a: 0, b: 1, beta0: 0 };
export const noSlab: Interval = { lo: -Infinity, hi: Infinity };

export const firstCamera = (): CameraOptions => ({
  view: "anterior", azimuth: 0, elevation: 0, roll: 0, zoom: 1, perspective: 0, distance: null,
  lookAt: null,
});

export const firstState = (): State => ({
  mode: "max", camera: firstCamera(), cue: { ...noCue }, slab: { ...noSlab }, hidden: new Set(),
  window: null, colorMap: "gray", over: false,
});

/** Shortest digits that are good to a part in a million. */
const digits = (x: number): string => String(Number(x.toPrecision(7)));
const list = (numbers: readonly number[]): string => numbers.map(digits).join(",");

/** The flags that differ from the first state, as names and values. */
export function flagsOf(state: State): [string, string][] {
  const { camera, cue, slab } = state;
  const flags: [string, string][] = [];
  const put = (wanted: boolean, name: string, value: string): void => {
    if (wanted) flags.push([name, value]);
  };
  put(state.mode !== "max", "mode", state.mode);
  put(camera.view !== "anterior", "view", camera.view);
  put(camera.azimuth !== 0, "azimuth", digits(camera.azimuth));
  put(camera.elevation !== 0, "elevation", digits(camera.elevation));
  put(camera.roll !== 0, "roll", digits(camera.roll));
  put(camera.zoom !== 1, "zoom", digits(camera.zoom));
  put(camera.perspective > 0, "perspective", digits(camera.perspective));
  put(camera.distance !== null, "distance", digits(camera.distance ?? 0));
  put(camera.lookAt !== null, "look-at", list(camera.lookAt ?? []));
  const cut = Number.isFinite(slab.lo) || Number.isFinite(slab.hi);
  put(cut, "slab", list([slab.lo, slab.hi].map((x) => clamp(x, -1e6, 1e6))));
  put(cue.a !== 0 || cue.b !== 1 || cue.beta0 !== 0, "cue", list([cue.a, cue.b, cue.beta0]));
  put(state.hidden.size > 0, "hide", list([...state.hidden].sort((a, b) => a - b).map((k) => k + 1)));
  put(state.colorMap !== "gray", "colormap", state.colorMap);
  put(state.window !== null, "display", list([state.window?.lo ?? 0, state.window?.hi ?? 1]));
  put(state.over, "tool-blend", "over");
  return flags;
}

export const hashOf = (state: State): string =>
  flagsOf(state).map(([name, value]) => `${name}=${value}`).join("&");

/** Whether a picture is estimated between the levels, if these make layers. */
export const isSmooth = ({ mode, cue, hidden }: State): boolean =>
  mode === "max" && cue.a === 0 && hidden.size === 0;

/**
 * The same picture on the command line, which by itself takes more rays a pixel.
 * @param isServed  whether the server draws it, as the command would
 */
export const commandOf = (state: State, isServed: boolean): string =>
  ["nacre render set.glb", ...flagsOf(state).map(([name, value]) => `--${name} ${value}`),
    ...(!isServed && isSmooth(state) ? ["--layers smooth"] : []), "-o picture.png"].join(" ");

function numbersOf(text: string | null, count: number): number[] | null {
  const numbers = (text ?? "").split(",").map(Number);
  return text !== null && numbers.length === count && numbers.every(Number.isFinite) ? numbers : null;
}

const oneOf = <T extends string>(text: string | null, names: readonly T[], otherwise: T): T =>
  names.find((name) => name === text) ?? otherwise;

/** A state from an address; what is missing or makes no sense is as at first. */
export function stateOf(hash: string): State {
  const given = new URLSearchParams(hash.replace(/^#/, ""));
  const state = firstState();
  const number = (name: string, otherwise: number): number =>
    numbersOf(given.get(name), 1)?.[0] ?? otherwise;
  state.mode = oneOf(given.get("mode"), modes, "max");
  state.camera = {
    view: oneOf<ViewName>(given.get("view"), viewNames, "anterior"),
    azimuth: number("azimuth", 0), elevation: number("elevation", 0), roll: number("roll", 0),
    zoom: clamp(number("zoom", 1), 0.01, 1000), perspective: clamp(number("perspective", 0), 0, 170),
    distance: null, lookAt: numbersOf(given.get("look-at"), 3) as Vec3 | null,
  };
  const distance = numbersOf(given.get("distance"), 1);
  if (distance && state.camera.perspective > 0) state.camera.distance = Math.max(0, distance[0]);
  const slab = numbersOf(given.get("slab"), 2);
  if (slab && slab[0] < slab[1]) {
    state.slab = { lo: slab[0] <= -1e6 ? -Infinity : slab[0], hi: slab[1] >= 1e6 ? Infinity : slab[1] };
  }
  const cue = numbersOf(given.get("cue"), 3);
  if (cue) state.cue = lawfulCue({ a: cue[0], b: cue[1], beta0: cue[2] });
  const hidden = (given.get("hide") ?? "").split(",").map(Number);
  state.hidden = new Set(hidden.filter((k) => Number.isInteger(k) && k >= 1).map((k) => k - 1));
  state.colorMap = oneOf(given.get("colormap"), colorMapNames, "gray");
  const window = numbersOf(given.get("display"), 2);
  if (window && window[0] < window[1]) state.window = { lo: window[0], hi: window[1] };
  state.over = given.get("tool-blend") === "over";
  return state;
}

/** beta must not be negative anywhere: beta0 is raised until it is not. */
export function lawfulCue(cue: Cue): Cue {
  const least = Math.min(beta(cue, 0), beta(cue, 1));
  return least < 0 ? { ...cue, beta0: Number((cue.beta0 - least).toPrecision(6)) } : cue;
}
