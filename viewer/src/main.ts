/** Starts the page: the viewer, its controls, and the set that the page holds or is told to fetch. */
import { Actions, bindKeys } from "./actions";
import { byId } from "./dom";
import { Gestures } from "./gestures";
import { showHintOnce } from "./hint";
import { LiveLevels } from "./live";
import { say } from "./message";
import { Overlay } from "./overlay";
import { Panel } from "./panel";
import { PoseHandles } from "./pose_handles";
import type { FloatTargets } from "./renderer";
import { ServedPictures } from "./served_pictures";
import { hashOf, stateOf } from "./state";
import { Viewer } from "./viewer";

const page = document.documentElement;

const setText = byId("nacre-set").textContent!.trim();
const isLive = setText.startsWith("live:");

/** A plain loop: Uint8Array.from with a function takes twenty times as long. */
function bytesOf(characters: string): Uint8Array {
  const bytes = new Uint8Array(characters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = characters.charCodeAt(i);
  return bytes;
}

/** The set as the page has it: its bytes in base64, "fetch:ADDRESS", "live:ADDRESS", or none. */
async function ownSet(): Promise<Uint8Array | null> {
  const text = setText;
  if (text === "" || text.startsWith("/*")) return null;
  if (isLive || text.startsWith("fetch:")) {
    const answer = await fetch(text.slice(text.indexOf(":") + 1));
    if (!answer.ok) throw new Error(`the server answered ${answer.status}`);
    return new Uint8Array(await answer.arrayBuffer());
  }
  try {
    return bytesOf(atob(text));
  } catch {
    return new Uint8Array(); // cut off or changed: no shell set, which is said
  }
}

/** User timing, for those who measure: the first picture with every shell, the first whole one. */
function markPictures(viewer: Viewer): void {
  const mark = (name: string, isThere: boolean): void => {
    if (isThere && performance.getEntriesByName(name).length === 0) performance.mark(name);
  };
  viewer.listen((what) => {
    if (what === "set") for (const name of ["first-picture", "whole-picture"]) performance.clearMarks(name);
    if (what !== "frame" || !viewer.set) return;
    mark("first-picture", viewer.picture.isComplete);
    mark("whole-picture", viewer.picture.isWhole);
  });
}

/** The address follows the state: at once, but a moving picture's at most a few times a second. */
function keepAddress(viewer: Viewer): void {
  let written = location.hash.replace(/^#/, "");
  let timer = 0;
  let isLate = false;
  const write = (): void => {
    const hash = hashOf(viewer.state);
    const isTaken = location.hash.replace(/^#/, "") !== written; // by a link, which is told soon
    if (hash === written || isTaken) return;
    written = hash;
    history.replaceState(null, "", hash === "" ? location.pathname + location.search : `#${hash}`);
  };
  const follow = (): void => {
    timer = 0;
    if (!isLate) return;
    isLate = false;
    write();
    timer = window.setTimeout(follow, 300);
  };
  viewer.listen((what) => {
    if (what !== "state") return;
    isLate = true;
    if (timer !== 0 && viewer.loop.isMoving()) return;
    clearTimeout(timer);
    follow();
  });
  window.addEventListener("hashchange", () => {
    const given = location.hash.replace(/^#/, "");
    if (given === written) return;
    written = given;
    viewer.change(stateOf(given));
  });
}

function showStatus(viewer: Viewer): void {
  const { loop } = viewer;
  const pixels = `${viewer.pixels.width} × ${viewer.pixels.height}`;
  const speed = loop.isMoving() && loop.rate > 1 ? `, ${loop.rate} a second` : "";
  const less = [
    ...(loop.isCoarse() ? ["coarse copies"] : []),
    ...(loop.stride() > 1 ? [`1 shell of ${loop.stride()}`] : []),
  ].join(", ");
  const shells = less ? `, ${less} while it moves` : "";
  const thousands = Math.round(viewer.triangles / 1000).toLocaleString("en");
  const drawn = viewer.isServed() ? `drawn by nacre, ${pixels}` : `${thousands}k triangles, ${pixels}${shells}`;
  byId("status").textContent = `${loop.milliseconds.toFixed(1)} ms a frame${speed}\n${drawn}`;
}

function showProgress(viewer: Viewer): void {
  const { wanted, loaded, problem } = viewer.loader.state();
  const bar = byId("progress");
  const share = wanted > 0 ? Math.round((100 * loaded) / wanted) : 100;
  bar.hidden = loaded >= wanted;
  bar.setAttribute("aria-valuenow", String(share));
  (bar.firstElementChild as HTMLElement).style.width = `${share}%`;
  if (viewer.set && viewer.loop.isSettled()) page.dataset.state = loaded >= wanted ? "ready" : "loading";
  if (problem) {
    say(`${problem}. The picture is shown without it.`, "small");
    viewer.loader.problem = "";
    page.dataset.problem = problem;
  }
}

function bindFiles(viewer: Viewer, actions: Actions): void {
  byId<HTMLInputElement>("set-file").addEventListener("change", (event) =>
    void actions.openFiles([...((event.target as HTMLInputElement).files ?? [])]));
  const stage = byId("stage");
  stage.addEventListener("dragover", (event) => event.preventDefault());
  stage.addEventListener("drop", (event) => {
    event.preventDefault();
    void actions.openFiles([...(event.dataTransfer?.files ?? [])]);
  });
  viewer.canvas.addEventListener("dblclick", () => actions.reset());
}

function bindPanelToggle(): void {
  const toggle = byId("panel-toggle");
  toggle.addEventListener("click", () => {
    const folded = document.body.classList.toggle("folded");
    toggle.setAttribute("aria-expanded", String(!folded));
    toggle.textContent = folded ? "Controls" : "Hide controls";
  });
}

const asked = new URLSearchParams(location.search);

/**
 * Whether the server is to draw maxima: where the browser draws in software, or as
 * ?pictures=server or ?pictures=page say.
 */
function asksForPictures(viewer: Viewer): boolean {
  if (!isLive && !setText.startsWith("fetch:")) return false;
  const given = asked.get("pictures");
  return given === "server" || (given !== "page" && viewer.isSoftware);
}

/** Which float targets to use at most, for trying what lesser devices show: ?floats=half. */
function floatsWanted(): FloatTargets {
  const given = asked.get("floats");
  return given === "half" || given === "none" ? given : "float";
}

async function start(): Promise<void> {
  page.dataset.state = "starting";
  const viewer = new Viewer(
    byId<HTMLCanvasElement>("picture"), byId<HTMLCanvasElement>("served"), byId("nacre-decoder").textContent!, floatsWanted());
  viewer.loop.detail.isFixed = asked.get("detail") === "full";
  const actions = new Actions(viewer);
  const overlay = new Overlay(byId("overlay"));
  new Gestures(viewer);
  const panel = new Panel(viewer, actions);
  if (isLive) panel.shells.live = new LiveLevels(viewer);
  new PoseHandles(viewer);
  bindKeys(actions);
  bindFiles(viewer, actions);
  bindPanelToggle();
  showHintOnce(viewer, asked);
  keepAddress(viewer);
  markPictures(viewer);
  viewer.state = stateOf(location.hash);
  viewer.listen((what) => {
    if (viewer.set && (what === "state" || what === "tools")) page.dataset.state = "drawing";
    if (what === "frame" || what === "loading") showProgress(viewer);
    if (what === "frame") showStatus(viewer);
    if (what === "frame") overlay.update(viewer.camera(), viewer.canvas.clientWidth);
  });
  const bytes = await ownSet();
  if (bytes) {
    actions.openSet("The shell set of this page", bytes);
    if (viewer.set && asksForPictures(viewer)) {
      viewer.served = new ServedPictures("picture");
      viewer.change({});
    }
  } else {
    page.dataset.state = "empty";
    say("No shell set yet: open or drop a .glb that nacre build wrote.", "news");
    viewer.change({});
  }
}

start().catch((error: unknown) => {
  const reason = error instanceof Error ? error.message : String(error);
  page.dataset.state = "failed";
  say(reason === "no WebGL2"
    ? "This browser has no WebGL2, which the picture needs. Current Firefox, Chrome, Edge and Safari have it; it may be switched off in the settings, or the graphics driver may be on their block list."
    : `The page could not start: ${reason}.`, "problem");
});
