/** What the page has to say: a problem in the middle, or a line at the lower edge for a while. */
import { byId } from "./dom";

let timer = 0;

export function say(text: string, kind: "problem" | "small" | "news"): void {
  const box = byId("message");
  clearTimeout(timer);
  box.textContent = text;
  box.classList.toggle("small", kind !== "problem");
  box.classList.toggle("news", kind === "news");
  box.hidden = text === "";
  if (kind !== "problem") timer = window.setTimeout(() => { box.hidden = true; }, 8000);
}
