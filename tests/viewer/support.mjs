// What the page's tests share: a browser with software WebGL, pages made by nacre, pictures compared.
import { execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const modules = process.env.NACRE_VIEWER_MODULES;
const nacreBinary = process.env.NACRE_BINARY;
const skipped = 77;

function skip(why) {
  console.log(`skipped: ${why}`);
  process.exit(skipped);
}

/** A Chromium that is installed: $CHROMIUM, or Debian's. */
function chromiumPath() {
  const places = [process.env.CHROMIUM, "/usr/bin/chromium", "/usr/bin/chromium-browser", "/usr/bin/google-chrome"];
  return places.find((path) => path && existsSync(path)) ?? skip("found no chromium, expected it installed (scripts/setup)");
}

export async function launch() {
  const executablePath = chromiumPath();
  if (!existsSync(join(modules, "playwright-core"))) skip("found no playwright-core (npm ci did not run)");
  const { chromium } = createRequire(join(modules, "here.js"))("playwright-core");
  return chromium.launch({
    executablePath,
    // Software WebGL; the page itself is composed without it, as on a machine without a GPU.
    args: ["--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-gpu-compositing"],
  });
}

/** A folder for a test's files, gone at its end. */
export const folder = mkdtempSync(join(tmpdir(), "nacre-viewer-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));
export const inFolder = (name) => join(folder, name);
export const address = (path) => pathToFileURL(path).href;

export const nacre = (...flags) => execFileSync(nacreBinary, flags, { cwd: folder, encoding: "utf8", timeout: 120_000 });

/** Optimal levels: what sums show differs from what maxima show. */
export const angiogramFlags = ["--window", "400,1400", "--levels", "8", "--placement", "optimal", "--certificate", "none"];

/** The set most tests look at: a small angiogram's shells, and its page. */
export function makeAngiogram() {
  nacre("phantom", "angiogram", "--size", "96,96,47", "-o", "angiogram.nrrd", "-q");
  nacre("build", "angiogram.nrrd", ...angiogramFlags, "-o", "angiogram.glb", "-q");
  nacre("view", "angiogram.glb", "-o", "angiogram.html", "-q");
  return address(inFolder("angiogram.html"));
}

/** A pyramid with an open base, in its own frame, and a pose that puts it among the vessels. */
export const toolObj = "v 0 0 0\nv 12 12 60\nv -12 12 60\nv -12 -12 60\nv 12 -12 60\n" +
  "f 1 2 3\nf 1 3 4\nf 1 4 5\nf 1 5 2\n";
export const toolPose = "0.8 0 0.6 -20\n0 1 0 -5\n-0.6 0 0.8 -30\n0 0 0 1\n";

export function writeTool() {
  writeFileSync(inFolder("tool.obj"), toolObj);
  writeFileSync(inFolder("pose.txt"), toolPose);
}

const settledStates = ["ready", "empty", "damaged", "failed"];

/** Waits until what is on the screen is what was asked for. */
export const settled = (page) => page.waitForFunction(
  (states) => states.includes(document.documentElement.dataset.state), settledStates, { timeout: 120_000 });

/** A page at that address, its errors gathered. */
export async function open(browser, url, size = { width: 822, height: 512 }, options = {}) {
  const page = await browser.newPage({ viewport: size, ...options });
  page.setDefaultTimeout(120_000);
  page.problems = [];
  page.on("pageerror", (error) => page.problems.push(error.message));
  page.on("console", (message) => { if (message.type() === "error") page.problems.push(message.text()); });
  await page.goto(url);
  await page.addStyleTag({ content: "#status, #message.small { opacity: 0 }" }); // what is not of the picture
  await settled(page);
  return page;
}

let visits = 0;

/** Goes to another view by the address, as a link does. The number makes each address a new one. */
export async function goTo(page, hash) {
  await page.evaluate((to) => {
    document.documentElement.dataset.state = "drawing";
    location.hash = to;
  }, `${hash}&visit=${++visits}`);
  await settled(page);
}

/** The picture of the page's own Save button, written to that file. */
export async function savePicture(page, name, width, height) {
  await page.fill("#save-width", String(width));
  await page.fill("#save-height", String(height));
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#save")]);
  await download.saveAs(inFolder(name));
  return inFolder(name);
}

/** PSNR of two PNGs over all pixels and channels, dB; the browser reads them. */
export async function psnr(page, a, b) {
  const files = [a, b].map((path) => readFileSync(path).toString("base64"));
  return page.evaluate(async (pictures) => {
    const pixels = await Promise.all(pictures.map(async (base64) => {
      const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
      const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
      const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
      const context = canvas.getContext("2d");
      context.drawImage(bitmap, 0, 0);
      return context.getImageData(0, 0, bitmap.width, bitmap.height).data;
    }));
    if (pixels[0].length !== pixels[1].length) return -Infinity;
    const squares = pixels[0].reduce((sum, x, i) => sum + (i % 4 < 3 ? (x - pixels[1][i]) ** 2 : 0), 0);
    return 10 * Math.log10(255 ** 2 / (squares / (pixels[0].length * 0.75)));
  }, files);
}

/** What the picture's part of the window shows, to see whether it changed. */
export const look = async (page) => {
  await settled(page);
  const box = await page.locator("#picture").boundingBox();
  return (await page.screenshot({ clip: box })).toString("base64");
};
