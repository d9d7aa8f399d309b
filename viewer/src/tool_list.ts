/** The list of tools: colour, scale and pose of each. */
import { say } from "./message";
import { byId, element } from "./dom";
import { poseText, readPose, type Tool } from "./tools";
import type { Viewer } from "./viewer";

export class ToolList {
  constructor(private readonly viewer: Viewer) {
    viewer.listen((what) => { if (what === "tools") this.build(); });
    byId<HTMLInputElement>("tool-file").addEventListener("change", (event) => {
      const input = event.target as HTMLInputElement;
      void addTools(viewer, [...(input.files ?? [])]).then(() => { input.value = ""; });
    });
  }

  /** Built anew only where tools come and go: a field under the hand stays. */
  build(): void {
    const list = byId("tool-list");
    const { tools } = this.viewer.shelf;
    const known = [...list.children] as (HTMLElement & { tool?: Tool })[];
    if (known.length !== tools.length || known.some((row, i) => row.tool !== tools[i])) {
      list.replaceChildren(...tools.map((tool) => this.row(tool)));
    }
    [...list.querySelectorAll("textarea")].forEach((field, i) => {
      if (document.activeElement !== field) field.value = poseText(tools[i].pose);
    });
  }

  private row(tool: Tool): HTMLElement {
    const color = element("input", { type: "color", value: tool.color, "aria-label": `Colour of ${tool.name}` });
    color.addEventListener("input", () => { tool.color = color.value; this.viewer.toolsChanged(); });
    const scale = element("input", { type: "number", value: String(tool.scale), min: "0", step: "any",
      "aria-label": `Millimetres a unit of ${tool.name}` });
    scale.addEventListener("change", () => {
      if (scale.valueAsNumber > 0) { tool.scale = scale.valueAsNumber; this.viewer.toolsChanged(); }
    });
    const remove = element("button", { type: "button", "aria-label": `Remove ${tool.name}` }, "Remove");
    remove.addEventListener("click", () => { this.viewer.shelf.remove(tool); this.viewer.toolsChanged(); });
    const pose = element("textarea", { spellcheck: "false",
      "aria-label": `Pose of ${tool.name}: 16 numbers, row by row, to LPS mm` });
    pose.addEventListener("change", () => this.setPose(tool, pose));
    const row = element("div", { class: "tool" },
      element("strong", {}, tool.name),
      element("div", { class: "row" }, color, element("span", {}, "mm a unit"), scale, remove), pose);
    return Object.assign(row, { tool });
  }

  private setPose(tool: Tool, field: HTMLTextAreaElement): void {
    try {
      tool.pose = readPose(field.value);
      this.viewer.toolsChanged();
    } catch (error) {
      say(`Pose of ${tool.name}: ${(error as Error).message}`, "small");
      field.value = poseText(tool.pose);
    }
  }
}

/** Reads tools and shows them, or says what is wrong. */
export async function addTools(viewer: Viewer, files: File[]): Promise<void> {
  for (const file of files) {
    try {
      viewer.shelf.add(file.name, new Uint8Array(await file.arrayBuffer()));
    } catch (error) {
      say(`${file.name}: ${(error as Error).message}`, "small");
    }
  }
  viewer.toolsChanged();
}
