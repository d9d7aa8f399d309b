/** What buttons and keys do. */
import { addTools } from "./tool_list";
import type { ViewName } from "./camera";
import { viewNames } from "./camera";
import { byId } from "./dom";
import { say } from "./message";
import { download } from "./picture_file";
import type { Mode } from "./plan";
import { FileProblem, readShellSet } from "./shell_set";
import { firstCamera, modes } from "./state";
import type { Viewer } from "./viewer";

export class Actions {
  /** Degrees a second. */
  cineSpeed = 30;
  private turning = 0;
  private lastTurn = 0;

  constructor(private readonly viewer: Viewer) {}

  isTurning(): boolean { return this.turning !== 0; }

  setMode(mode: Mode): void { this.viewer.change({ mode, window: null }); }

  /** Sums and counts: up to the largest of this view. */
  ownWindow(): void {
    this.viewer.forgetOwnWindow();
    this.viewer.change({ window: null });
  }

  setView(view: ViewName): void {
    this.viewer.changeCamera({ view, azimuth: 0, elevation: 0, roll: 0 });
  }

  reset(): void {
    this.stopCine();
    this.viewer.change({ camera: firstCamera() });
  }

  nextMode(): void {
    const at = modes.indexOf(this.viewer.state.mode);
    this.setMode(modes[(at + 1) % modes.length]);
  }

  togglePerspective(): void {
    const { camera } = this.viewer.state;
    this.viewer.changeCamera({ perspective: camera.perspective > 0 ? 0 : 40, distance: null });
  }

  toggleCine(): void {
    if (this.turning) return this.stopCine();
    this.lastTurn = performance.now();
    this.turning = requestAnimationFrame((now) => this.turn(now));
    this.viewer.change({});
  }

  async toggleFullScreen(): Promise<void> {
    try {
      if (document.fullscreenElement) await document.exitFullscreen();
      else await document.documentElement.requestFullscreen();
    } catch {
      say("This browser gives pages no full screen.", "small");
    }
    byId("full-screen").setAttribute("aria-pressed", String(document.fullscreenElement !== null));
  }

  showHelp(): void { byId<HTMLDialogElement>("help").showModal(); }

  async save(): Promise<void> {
    const side = (id: string): number =>
      Math.round(byId<HTMLInputElement>(id).valueAsNumber) || 1024;
    const [width, height] = [side("save-width"), side("save-height")];
    if (Math.min(width, height) < 1 || Math.max(width, height) > 8192) {
      return say(`Picture: found ${width} x ${height}, expected 1 to 8192 pixels a side`, "small");
    }
    try {
      download(await this.viewer.save(width, height), `nacre-${this.viewer.state.mode}.png`);
    } catch (error) {
      say(`Picture: ${(error as Error).message}`, "small");
    }
  }

  async copyLink(): Promise<void> {
    try {
      await navigator.clipboard.writeText(location.href);
      say("The address of this view is copied.", "news");
    } catch {
      say("Copy the address from the browser's bar: it holds this view.", "news");
    }
  }

  /** Files given by hand: a set, or tools. */
  async openFiles(files: File[]): Promise<void> {
    const isSet = (file: File): boolean => file.name.toLowerCase().endsWith(".glb");
    const set = files.find(isSet);
    if (set) this.openSet(set.name, new Uint8Array(await set.arrayBuffer()));
    const others = files.filter((file) => !isSet(file));
    if (others.length > 0) await addTools(this.viewer, others);
  }

  /** Shows a set, or says what is wrong with it. */
  openSet(name: string, bytes: Uint8Array): void {
    try {
      this.viewer.open(readShellSet(bytes));
      say("", "problem");
    } catch (error) {
      if (!(error instanceof FileProblem)) throw error;
      document.documentElement.dataset.state = "damaged";
      say(`${name} cannot be shown: ${error.message}.`, "problem");
    }
  }

  private stopCine(): void {
    cancelAnimationFrame(this.turning);
    this.turning = 0;
    this.viewer.change({});
  }

  private turn(now: number): void {
    const { camera } = this.viewer.state;
    const by = this.cineSpeed * Math.max(now - this.lastTurn, 0) / 1000;
    this.lastTurn = now;
    const azimuth = ((camera.azimuth + by + 180) % 360 + 360) % 360 - 180;
    this.viewer.changeCamera({ azimuth: Math.round(azimuth * 1000) / 1000 }, true);
    this.turning = requestAnimationFrame((next) => this.turn(next));
  }
}

/** Keys of the page as a whole; those that turn are the picture's (gestures.ts). */
export function bindKeys(actions: Actions): void {
  const keys: Record<string, () => void> = {
    m: () => actions.nextMode(), p: () => actions.togglePerspective(), c: () => actions.toggleCine(),
    w: () => actions.ownWindow(), r: () => actions.reset(), s: () => void actions.save(),
    f: () => void actions.toggleFullScreen(), h: () => actions.showHelp(), "?": () => actions.showHelp(),
  };
  viewNames.forEach((view, i) => { keys[String(i + 1)] = () => actions.setView(view); });
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const typing = (event.target as HTMLElement).matches("input:not([type=range]):not([type=checkbox]):not([type=radio]), textarea, select, dialog *");
    const act = keys[event.key.toLowerCase()];
    if (typing || !act) return;
    event.preventDefault();
    act();
  });
}
