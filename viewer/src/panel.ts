/** The controls beside the picture: each shows the state and changes it. */
import { Actions } from "./actions";
import { viewNames, type ViewName } from "./camera";
import { colorMapNames } from "./color_maps";
import { byId, element, onClick, Slider } from "./dom";
import type { Mode } from "./plan";
import { trianglesOf, type ShellSet } from "./shell_set";
import { ShellList } from "./shell_list";
import { ToolList } from "./tool_list";
import { commandOf, isSmooth, noCue, noSlab, type State } from "./state";
import { clamp } from "./vector";
import type { Viewer } from "./viewer";

const modeNotes: Record<Mode, string> = {
  max: "The largest emission on each ray.",
  sum: "The emission along each ray, added up: emission × mm.",
  count: "Each shell crossed adds its brightness.",
  iso: "The outermost shell shown, lit from the eye.",
};

export class Panel {
  private readonly sliders: Record<string, Slider>;
  readonly shells: ShellList;
  private readonly tools: ToolList;

  constructor(private readonly viewer: Viewer, private readonly actions: Actions) {
    this.sliders = this.makeSliders();
    this.shells = new ShellList(viewer);
    this.tools = new ToolList(viewer);
    this.bindPicture();
    this.bindView();
    this.bindCueAndSlab();
    this.bindSaving();
    viewer.listen((what) => {
      if (what === "set") this.showSet();
      if (what === "set" || what === "state" || what === "tools") this.show();
      if (what === "tools") byId("over-row").hidden = viewer.shelf.tools.length === 0;
    });
  }

  private makeSliders(): Record<string, Slider> {
    const { viewer } = this;
    const camera = (key: keyof State["camera"]) => (value: number, moving: boolean): void =>
      viewer.changeCamera({ [key]: value }, moving);
    const cue = (key: keyof State["cue"]) => (value: number, moving: boolean): void =>
      viewer.change({ cue: { ...viewer.state.cue, [key]: value } }, moving);
    const made: Record<string, Slider> = {
      level: new Slider("level", (level, moving) => this.setWindow(level, null, moving)),
      width: new Slider("width", (width, moving) => this.setWindow(null, width, moving)),
      "cine-speed": new Slider("cine-speed", (speed) => { this.actions.cineSpeed = speed; this.show(); }),
      perspective: new Slider("perspective", (value, moving) =>
        viewer.changeCamera({ perspective: clamp(value, 0, 170), distance: null }, moving)),
      distance: new Slider("distance", (value, moving) => camera("distance")(Math.max(0, value), moving)),
      roll: new Slider("roll", camera("roll")),
      zoom: new Slider("zoom", (value, moving) => camera("zoom")(clamp(value, 0.05, 200), moving), true),
      a: new Slider("a", cue("a")), b: new Slider("b", cue("b")), beta0: new Slider("beta0", cue("beta0")),
      "slab-near": new Slider("slab-near", (lo, moving) => this.setSlab(lo, null, moving)),
      "slab-far": new Slider("slab-far", (hi, moving) => this.setSlab(null, hi, moving)),
    };
    made["cine-speed"].limits(-120, 120, 1);
    made.perspective.limits(0, 120, 1);
    made.roll.limits(-180, 180, 1);
    made.zoom.limits(-2, 5, 0.01);
    made.a.limits(-2, 2, 0.01);
    made.b.limits(-1, 2, 0.01);
    made.beta0.limits(-1, 2, 0.01);
    return made;
  }

  private setWindow(level: number | null, width: number | null, moving: boolean): void {
    const { lo, hi } = this.viewer.window();
    const middle = level ?? (lo + hi) / 2;
    const half = Math.max(width ?? hi - lo, 1e-4) / 2;
    this.viewer.change({ window: { lo: middle - half, hi: middle + half } }, moving);
  }

  /** The end that is moved pushes the other one before it. */
  private setSlab(lo: number | null, hi: number | null, moving: boolean): void {
    const least = this.radius() / 500;
    const slab = { ...this.viewer.state.slab };
    if (lo !== null) slab.hi = Math.max(slab.hi, lo + least);
    if (hi !== null) slab.lo = Math.min(slab.lo, hi - least);
    this.viewer.change({ slab: { lo: lo ?? slab.lo, hi: hi ?? slab.hi } }, moving);
  }

  private radius(): number { return this.viewer.set?.sphere.radius ?? 100; }

  private bindPicture(): void {
    const { viewer } = this;
    for (const input of document.querySelectorAll<HTMLInputElement>("input[name=mode]")) {
      input.addEventListener("change", () => this.actions.setMode(input.value as Mode));
    }
    const colors = byId<HTMLSelectElement>("color-map");
    colors.append(...colorMapNames.map((name) => element("option", { value: name }, name)));
    colors.addEventListener("change", () => viewer.change({ colorMap: colors.value }));
    onClick("window-auto", () => this.actions.ownWindow());
    byId<HTMLInputElement>("over").addEventListener("change", (event) =>
      viewer.change({ over: (event.target as HTMLInputElement).checked }));
  }

  private bindView(): void {
    for (const button of document.querySelectorAll<HTMLElement>("[data-view]")) {
      button.addEventListener("click", () => this.actions.setView(button.dataset.view as ViewName));
    }
    onClick("cine", () => this.actions.toggleCine());
    onClick("reset", () => this.actions.reset());
    onClick("full-screen", () => this.actions.toggleFullScreen());
    onClick("help-button", () => this.actions.showHelp());
  }

  private bindCueAndSlab(): void {
    const { viewer } = this;
    onClick("cue-near", () => viewer.change({ cue: { a: 0.85, b: 0.15, beta0: 0 } }));
    onClick("cue-off", () => viewer.change({ cue: { ...noCue } }));
    onClick("slab-off", () => viewer.change({ slab: { ...noSlab } }));
  }

  private bindSaving(): void {
    onClick("save", () => void this.actions.save());
    onClick("copy-link", () => void this.actions.copyLink());
  }

  private show(): void {
    const { state } = this.viewer;
    for (const input of document.querySelectorAll<HTMLInputElement>("input[name=mode]")) {
      input.checked = input.value === state.mode;
    }
    byId<HTMLSelectElement>("color-map").value = state.colorMap;
    byId<HTMLInputElement>("over").checked = state.over;
    byId("cine").setAttribute("aria-pressed", String(this.actions.isTurning()));
    for (const name of viewNames) {
      document.querySelector(`[data-view=${name}]`)!.setAttribute("aria-pressed", String(
        state.camera.view === name && state.camera.azimuth === 0 && state.camera.elevation === 0));
    }
    this.showNote();
    this.showSliders();
    this.shells.show();
    byId("command").textContent = commandOf(state, this.viewer.isServed());
  }

  private showNote(): void {
    const { viewer } = this;
    const { mode } = viewer.state;
    const layers = mode !== "max" ? "" : isSmooth(viewer.state)
      ? " Estimated between the shells' levels."
      : " Each layer shows one brightness.";
    const adds = mode === "sum" || mode === "count";
    const note = byId("mode-note");
    const words: Record<string, string> = {
      float: "",
      half: " This device adds in half floats: sums are good to about 1 %.",
      none: " This device cannot add up in floats: sums and counts are not shown.",
    };
    note.textContent = modeNotes[mode] + layers + (adds ? words[viewer.floatTargets] : "");
    note.classList.toggle("warn", adds && viewer.floatTargets !== "float");
  }

  private showSliders(): void {
    const { sliders, viewer } = this;
    const { camera, cue, slab, mode } = viewer.state;
    const window = viewer.window();
    const most = mode === "max" || mode === "iso" ? 1 : Math.max(window.hi, 1e-3) * 1.5;
    sliders.level.limits(0, most, most / 500);
    sliders.width.limits(0, most, most / 500);
    sliders.level.show((window.lo + window.hi) / 2);
    sliders.width.show(window.hi - window.lo);
    sliders["cine-speed"].show(this.actions.cineSpeed);
    sliders.perspective.show(camera.perspective);
    const radius = this.radius();
    const eye = viewer.camera().eyeDistance;
    sliders.distance.limits(0, Math.ceil(radius * 6), radius / 200);
    sliders.distance.enable(camera.perspective > 0);
    sliders.distance.show(eye);
    sliders.roll.show(camera.roll);
    sliders.zoom.show(camera.zoom);
    for (const key of ["a", "b", "beta0"] as const) sliders[key].show(cue[key]);
    for (const [name, value] of [["slab-near", slab.lo], ["slab-far", slab.hi]] as const) {
      sliders[name].limits(-Math.ceil(radius), Math.ceil(radius), radius / 200);
      sliders[name].show(clamp(value, -Math.ceil(radius), Math.ceil(radius)));
    }
  }

  private showSet(): void {
    this.shells.build();
    this.tools.build();
    byId("facts").replaceChildren(...this.facts().flatMap(
      ([name, value]) => [element("dt", {}, name), element("dd", {}, value)]));
  }

  private facts(): [string, string][] {
    const { set } = this.viewer;
    if (!set) return [];
    const triangles = trianglesOf(set.levels);
    const mm = set.spacing.map((x) => Number(x.toPrecision(4))).join(" × ");
    const ends = [set.emission[0], set.emission[set.emission.length - 1]];
    const list: [string, string][] = [
      ["Volume", `${set.dims.join(" × ")} samples of ${set.sampleType}, ${mm} mm`],
      ["Window", `${ends[0]?.[0]} to ${ends[1]?.[0]}`],
      ["Shells", `${set.levels.length} (${set.placement}), ${triangles.toLocaleString("en")} triangles`],
      ["File", `${(set.fileBytes / 1e6).toFixed(2)} MB, ${set.generator}`],
      ["Grid", `${set.bits} bits, ${Number(set.step.toPrecision(3))} mm a step`],
      ["Simplified", set.tolerance > 0 ? `by up to ${set.tolerance} in emission` : "no"],
    ];
    return [...list, ...certificateFacts(set.certificate), ...copiesFacts(set)];
  }
}

type Json = Record<string, unknown>;

const memberOf = (json: unknown, key: string): unknown =>
  typeof json === "object" && json !== null ? (json as Json)[key] : undefined;

const digits = (value: unknown, count: number): string =>
  typeof value === "number" ? String(Number(value.toPrecision(count))) : "not given";

/** No PSNR: there is no error. */
const decibels = (psnr: unknown): string => typeof psnr === "number" ? `${psnr.toFixed(1)} dB` : "exact";

/** What the pictures of a kind differ by from the exact ones, in words. */
function errorFact(name: string, error: unknown, unit: string): [string, string][] {
  if (typeof memberOf(error, "rmse") !== "number") return [];
  const psnr = `PSNR ${decibels(memberOf(error, "psnr_db"))} over all pixels, ${decibels(memberOf(error, "psnr_lit_db"))} over lit ones`;
  const errors = `RMSE ${digits(memberOf(error, "rmse"), 3)}, largest error ${digits(memberOf(error, "max_error"), 3)} ${unit}`;
  return [[name, `${psnr}; ${errors}`]];
}

/** What coarse copies are for, and what their pictures are worth. */
function copiesFacts(set: ShellSet): [string, string][] {
  if (!set.coarse) return [];
  const triangles = trianglesOf(set.levels.map((level) => level.coarse ?? level)).toLocaleString("en");
  const what = `${triangles} triangles, simplified by up to ${set.coarse.tolerance} in emission; drawn while a large set loads, and turning where frames run late`;
  const error = errorFact("Their maximum", set.coarse.error, "(emission, 0 to 1)");
  return [["Coarse copies", what], ...(error.length > 0 ? error : [["Their maximum", "error not measured"] as [string, string]])];
}

/** The certificate: how far pictures and surfaces are from the exact ones. */
function certificateFacts(certificate: unknown): [string, string][] {
  if (typeof certificate !== "object" || certificate === null) return [["Certificate", "none in this file"]];
  const list = [
    ...errorFact("Maximum, flat layers", memberOf(certificate, "max"), "(emission, 0 to 1)"),
    ...errorFact("Between levels, nine rays a pixel", memberOf(certificate, "max_fine"), "(emission, 0 to 1)"),
    ...errorFact("Sum", memberOf(certificate, "sum"), "(emission \u00d7 mm)"),
  ];
  const surfaces = memberOf(certificate, "surfaces");
  if (surfaces) {
    list.push(["Surfaces", `emission off by ${digits(memberOf(surfaces, "rms_error"), 3)} RMS, ${digits(memberOf(surfaces, "max_error"), 3)} at most`]);
  }
  const [views, size] = [memberOf(certificate, "views"), memberOf(certificate, "size")];
  if (Array.isArray(views) && Array.isArray(size)) {
    list.push(["Measured on", `${views.length} views of ${size.join(" \u00d7 ")} pixels, against the exact pictures`]);
  }
  return list;
}
