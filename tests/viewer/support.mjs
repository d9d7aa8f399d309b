// What the page's tests share: a browser with software WebGL, pages made by nacre, pictures compared.
import { execFile, execFileSync } from "node:child_process";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { cpus, tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { promisify } from "node:util";

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

/** The ends of several commands, run as many at a time as there are processors. */
export function nacreAll(commands) {
  const lanes = Array(cpus().length).fill(Promise.resolve());
  return commands.map((flags, i) => {
    const lane = i % lanes.length;
    const end = lanes[lane].then(() => promisify(execFile)(nacreBinary, flags, { cwd: folder, timeout: 120_000 }));
    lanes[lane] = end.catch(() => {}); // whoever waits for this end is told
    return end;
  });
}

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

/** Waits until what is on the screen is what was asked for. */
export const settled = (page) => page.evaluate(() => settled());

/** A page at that address, its errors gathered. @param script  runs before the page's own code */
export async function open(browser, url, size = { width: 822, height: 512 }, options = {}, script = () => {}) {
  const page = await browser.newPage({ viewport: size, ...options });
  page.setDefaultTimeout(120_000);
  page.problems = [];
  page.on("pageerror", (error) => page.problems.push(error.message));
  page.on("console", (message) => { if (message.type() === "error") page.problems.push(message.text()); });
  await page.addInitScript(inBrowser);
  await page.addInitScript(script);
  await page.goto(url);
  await page.addStyleTag({ content: "#status, #hint, #message.small { opacity: 0 }" }); // what is not of the picture
  await settled(page);
  return page;
}

let visits = 0;

/** A number makes each address a new one. */
const visitOf = (hash) => `${hash}&visit=${++visits}`;

/** Goes to another view by the address, as a link does. */
export const goTo = (page, hash) => page.evaluate((to) => goTo(to), visitOf(hash));

/** The picture of the page's own Save button, written to that file. */
export async function savePicture(page, name, width, height) {
  await page.fill("#save-width", String(width));
  await page.fill("#save-height", String(height));
  const [download] = await Promise.all([page.waitForEvent("download"), page.click("#save")]);
  await download.saveAs(inFolder(name));
  return inFolder(name);
}

/** What the browser does for the tests. */
const inBrowser = () => {
  window.pixelsOf = async (png) => {
    const bitmap = await createImageBitmap(png);
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
    context.drawImage(bitmap, 0, 0);
    return context.getImageData(0, 0, bitmap.width, bitmap.height).data;
  };
  window.pngOf = (base64) => new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], { type: "image/png" });
  /** dB */
  window.psnrOf = (a, b) => {
    if (a.length !== b.length) return -Infinity;
    let squares = 0;
    for (let i = 0; i < a.length; ++i) if (i % 4 < 3) squares += (a[i] - b[i]) ** 2;
    return 10 * Math.log10(255 ** 2 / (squares / (a.length * 0.75)));
  };
  window.settled = async () => {
    const { dataset } = document.documentElement;
    const end = performance.now() + 120_000;
    while (!["ready", "empty", "damaged", "failed"].includes(dataset.state)) {
      if (performance.now() > end) throw new Error(`the page is ${dataset.state} for two minutes`);
      await new Promise((done) => setTimeout(done, 4));
    }
  };
  window.goTo = async (hash) => {
    const isTold = new Promise((done) => addEventListener("hashchange", done, { once: true }));
    location.hash = hash;
    await isTold; // the page was told before: it is drawing now
    return settled();
  };
  /** The picture of the page's own Save button, as it is handed to the user. */
  window.savedPicture = (width, height) => new Promise((resolve) => {
    const { click } = HTMLAnchorElement.prototype;
    HTMLAnchorElement.prototype.click = function () {
      HTMLAnchorElement.prototype.click = click;
      resolve(fetch(this.href).then((file) => file.blob()));
    };
    document.getElementById("save-width").value = width;
    document.getElementById("save-height").value = height;
    document.getElementById("save").click();
  });
};

const base64Of = (path) => readFileSync(path).toString("base64");

/** PSNR of two PNGs over all pixels and channels, dB; the browser reads them. */
export const psnr = (page, a, b) => page.evaluate(async ([one, other]) =>
  psnrOf(await pixelsOf(pngOf(one)), await pixelsOf(pngOf(other))), [base64Of(a), base64Of(b)]);

/** PSNR of the page's picture of a view, `hash`, and that in the file, dB: one call, for many of them. */
export const psnrOfView = (page, hash, width, height, path) => page.evaluate(async (given) => {
  await goTo(given.hash);
  const shown = await pixelsOf(await savedPicture(given.width, given.height));
  return psnrOf(shown, await pixelsOf(pngOf(given.png)));
}, { hash: visitOf(hash), width, height, png: base64Of(path) });

/** Of the pixels of two pictures, the shares that differ by more than 1/255 and by more than 8/255 in some channel. */
export const differences = (page, a, b) => page.evaluate(async ([one, other]) => {
  const [x, y] = [await pixelsOf(pngOf(one)), await pixelsOf(pngOf(other))];
  const beyond = (most) => {
    let pixels = 0;
    for (let i = 0; i < x.length; i += 4) if ([0, 1, 2].some((c) => Math.abs(x[i + c] - y[i + c]) > most)) ++pixels;
    return pixels / (x.length / 4);
  };
  return { one: beyond(1), eight: beyond(8) };
}, [base64Of(a), base64Of(b)]);

const boxOf = (page) => page.evaluate(() => {
  const { x, y, width, height } = document.getElementById("picture").getBoundingClientRect();
  return { x, y, width, height };
});

/** What the picture's part of the window shows, to see whether it changed. */
export async function look(page) {
  await settled(page);
  page.devTools ??= await page.context().newCDPSession(page);
  const clip = { ...await boxOf(page), scale: 1 };
  return (await page.devTools.send("Page.captureScreenshot", { format: "png", clip, optimizeForSpeed: true })).data;
}

/** A shell file's set several times over, its levels spread anew over (0, 1]: a large set for little. */
export function repeatedSet(file, times, { copies: withCopies = true } = {}) {
  const jsonEnd = 20 + file.readUInt32LE(12);
  const json = JSON.parse(file.subarray(20, jsonEnd));
  const binary = file.subarray(jsonEnd + 8);
  const { nacre: extras } = json.nodes[0].extras;
  const of = { views: json.bufferViews, meshes: json.meshes, levels: extras.levels };
  const repeats = [...Array(times).keys()];
  const moved = (surface, i) => ({ ...surface, mesh: surface.mesh + i * of.meshes.length });
  json.bufferViews = repeats.flatMap((i) => of.views.map((view) =>
    ({ ...view, byteOffset: (view.byteOffset ?? 0) + i * binary.length })));
  json.meshes = repeats.flatMap((i) => structuredClone(of.meshes).map((mesh) => {
    mesh.primitives[0].extensions.KHR_draco_mesh_compression.bufferView += i * of.views.length;
    return mesh;
  }));
  extras.levels = repeats.flatMap((i) => of.levels.map(({ coarse, ...level }) =>
    ({ ...moved(level, i), ...(withCopies && coarse ? { coarse: moved(coarse, i) } : {}) })));
  if (!withCopies) delete extras.coarse;
  extras.levels.forEach((level, k) => { level.emission = level.representative = (k + 1) / extras.levels.length; });
  json.buffers[0].byteLength = times * binary.length;
  const text = Buffer.from(JSON.stringify(json));
  const chunk = (type, bytes, filler) => {
    const padded = Buffer.concat([bytes, Buffer.alloc(-bytes.length & 3, filler)]);
    const head = Buffer.alloc(8);
    head.writeUInt32LE(padded.length, 0);
    head.writeUInt32LE(type, 4);
    return Buffer.concat([head, padded]);
  };
  const whole = Buffer.concat([file.subarray(0, 12), chunk(0x4e4f534a, text, " "),
    chunk(0x004e4942, Buffer.concat(repeats.map(() => binary)), 0)]);
  whole.writeUInt32LE(whole.length, 8);
  return whole;
}
