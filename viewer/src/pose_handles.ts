/**
 * Handles on the picture that move and turn a tool: a knob at its origin (in the picture's plane),
 * one above (nearer and farther), one to the right (about the viewing direction), and one below right
 * (about the picture's axes). Keys do the same on a focused knob.
 */
import { pixelOf, pixelSize, type Camera } from "./camera";
import { byId, element } from "./dom";
import { moved, originOf, turned, type Tool } from "./tools";
import { add, cross, length, scale, type Vec3 } from "./vector";
import type { Viewer } from "./viewer";

interface Knob {
  name: string;
  sign: string;
  /** CSS pixels from the tool's origin. */
  at: readonly [number, number];
  /** @param dx, dy  CSS pixels moved; @param x, y  where the hand is, from the tool's origin */
  act(tool: Tool, camera: Camera, dx: number, dy: number, x: number, y: number): void;
}

/** Radians a CSS pixel. */
const turnSpeed = 0.01;
const keyStep = 4;

const inPlane = (camera: Camera, dx: number, dy: number): Vec3 =>
  add(scale(camera.right, dx * pixelSize(camera)), scale(camera.up, -dy * pixelSize(camera)));

const knobs: readonly Knob[] = [
  {
    name: "Move", sign: "✥", at: [0, 0],
    act: (tool, camera, dx, dy) => { tool.pose = moved(tool.pose, inPlane(camera, dx, dy)); },
  },
  {
    name: "Move away and near", sign: "⇅", at: [0, -56],
    act: (tool, camera, _dx, dy) => {
      tool.pose = moved(tool.pose, scale(camera.forward, -dy * pixelSize(camera)));
    },
  },
  {
    name: "Turn in the picture's plane", sign: "⟳", at: [56, 0],
    act: (tool, camera, dx, dy, x, y) => {
      const size = Math.max(Math.hypot(x, y), 20);
      const angle = (x * dy - y * dx) / (size * size);
      tool.pose = turned(tool.pose, camera.forward, angle);
    },
  },
  {
    name: "Tilt", sign: "◒", at: [40, 40],
    act: (tool, camera, dx, dy) => {
      const way = inPlane(camera, dx, dy);
      const axis = cross(way, camera.forward);
      const size = length(axis);
      if (size === 0) return;
      tool.pose = turned(tool.pose, scale(axis, 1 / size), Math.hypot(dx, dy) * turnSpeed);
    },
  },
];

export class PoseHandles {
  private shown: { tool: Tool; knob: Knob; button: HTMLElement }[] = [];

  constructor(private readonly viewer: Viewer) {
    viewer.listen((what) => {
      if (what === "tools" || what === "set") this.build();
      if (what === "frame" || what === "tools") this.place();
    });
  }

  private build(): void {
    const { tools } = this.viewer.shelf;
    const known = new Set(this.shown.map((handle) => handle.tool));
    if (known.size === tools.length && tools.every((tool) => known.has(tool))) return;
    this.shown = tools.flatMap((tool) => knobs.map((knob) => {
      const button = element("button", { type: "button", class: "handle",
        title: `${knob.name}: ${tool.name}`, "aria-label": `${knob.name}: ${tool.name}; drag, or arrow keys` }, knob.sign);
      this.bind(tool, knob, button);
      return { tool, knob, button };
    }));
    byId("handles").replaceChildren(...this.shown.map((handle) => handle.button));
  }

  private place(): void {
    if (this.shown.length === 0) return;
    const camera = this.viewer.camera();
    for (const { tool, knob, button } of this.shown) {
      const [x, y] = pixelOf(camera, originOf(tool));
      button.style.left = `${x + knob.at[0]}px`;
      button.style.top = `${y + knob.at[1]}px`;
    }
  }

  private bind(tool: Tool, knob: Knob, button: HTMLElement): void {
    let last: PointerEvent | null = null;
    button.addEventListener("pointerdown", (event) => {
      button.setPointerCapture(event.pointerId);
      last = event;
    });
    button.addEventListener("pointermove", (event) => {
      if (!last) return;
      this.act(tool, knob, event.clientX - last.clientX, event.clientY - last.clientY, event);
      last = event;
    });
    for (const end of ["pointerup", "pointercancel"]) button.addEventListener(end, () => { last = null; });
    button.addEventListener("keydown", (event) => {
      const way = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
      if (!way) return;
      event.preventDefault();
      this.act(tool, knob, way[0] * keyStep, way[1] * keyStep, null);
    });
  }

  private act(tool: Tool, knob: Knob, dx: number, dy: number, hand: PointerEvent | null): void {
    const camera = this.viewer.camera();
    const [x, y] = pixelOf(camera, originOf(tool));
    const box = this.viewer.canvas.getBoundingClientRect();
    const from = hand ? [hand.clientX - box.left - x, hand.clientY - box.top - y] : knob.at;
    knob.act(tool, camera, dx, dy, from[0], from[1]);
    this.viewer.toolsChanged(true);
  }
}
