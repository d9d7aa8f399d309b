// What is decoded, when and why; progress; less detail while frames run late, and none at rest.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { address, goTo, inFolder, launch, look, nacre, open, repeatedSet, settled } from "./support.mjs";

const browser = await launch();
after(() => browser.close());

const glb = (name) => readFileSync(inFolder(name));
const surfacesOf = (file) => JSON.parse(file.subarray(20, 20 + file.readUInt32LE(12))).nodes[0].extras.nacre.levels;
const thousands = (count) => Math.round(count / 1000).toLocaleString("en");
const sum = (surfaces) => surfaces.reduce((all, surface) => all + surface.triangles, 0);

/** The page of a set. */
function pageOf(set, name) {
  writeFileSync(inFolder("set.glb"), set);
  nacre("view", "set.glb", "-o", name, "-q");
  return address(inFolder(name));
}

let plain; // noise and vessels: many triangles for a small volume
let copied; // simplified, with copies
let without; // of shells of even sizes, without copies
let whole; // what the status says of it
before(() => {
  const flags = ["--window", "200,1400", "--keep-specks", "--certificate", "none", "-q"];
  nacre("phantom", "angiogram", "--size", "96,96,47", "-o", "angiogram.nrrd", "-q");
  nacre("build", "angiogram.nrrd", "--levels", "0.07,0.5", "--quantization", "16", ...flags, "-o", "plain.glb");
  // Small: its frames take less than what is said of them below, on slow machines beside other work too.
  nacre("phantom", "angiogram", "--size", "56,56,27", "-o", "small.nrrd", "-q");
  const simplified = ["--levels", "0.12,0.25,0.5", "--tolerance", "0.01", "--coarse", "0.2", ...flags];
  nacre("build", "small.nrrd", ...simplified, "-o", "copied.glb");
  nacre("build", "angiogram.nrrd", ...simplified, "-o", "dense.glb");
  [plain, copied] = [glb("plain.glb"), glb("copied.glb")];
  without = repeatedSet(copied, 2, { copies: false });
  whole = `${thousands(sum(surfacesOf(without)))}k triangles, 480 × 400`;
});

/** Before the page runs: notes what is sent to the decoder, how far it is said to be, and makes frames take `frameCost()` ms. */
const observe = () => {
  window.asked = [];
  const { postMessage } = Worker.prototype;
  Worker.prototype.postMessage = function (request, ...rest) {
    asked.push(request.triangles);
    return postMessage.call(this, request, ...rest);
  };
  window.shares = [];
  new MutationObserver(() => {
    const bar = document.getElementById("progress");
    if (bar && !bar.hidden) shares.push(Number(bar.getAttribute("aria-valuenow")));
  }).observe(document, { subtree: true, attributes: true, attributeFilter: ["aria-valuenow"] });
  window.frameCost = () => 0;
  const { fenceSync, getSyncParameter } = WebGL2RenderingContext.prototype;
  const fences = new Map();
  WebGL2RenderingContext.prototype.fenceSync = function (...given) {
    const fence = fenceSync.apply(this, given);
    fences.set(fence, performance.now() + frameCost(this.canvas));
    return fence;
  };
  WebGL2RenderingContext.prototype.getSyncParameter = function (fence, name) {
    const isOver = performance.now() >= fences.get(fence);
    return isOver ? this.SIGNALED : this.UNSIGNALED;
  };
};

const opened = (url) => open(browser, url, { width: 770, height: 400 }, {}, observe);
const asked = (page) => page.evaluate(() => window.asked);
const status = (page) => page.textContent("#status");

async function close(page) {
  assert.deepEqual(page.problems, []);
  await page.close();
}

test("a set of 3 MB loads with progress, and is shown whole", async () => {
  const set = repeatedSet(plain, Math.ceil(3e6 / plain.length));
  const levels = surfacesOf(set);
  const page = await opened(pageOf(set, "large.html"));
  console.log(`${set.length} bytes, ${sum(levels)} triangles`);
  const shares = await page.evaluate(() => window.shares);
  assert.ok(shares.some((share) => share > 0 && share < 100), `progress was seen: ${shares}`);
  assert.deepEqual(shares, [...shares].sort((a, b) => a - b), "and never went back");
  assert.ok(await page.locator("#progress").isHidden());
  assert.match(await status(page), new RegExp(`\\n${thousands(sum(levels))}k triangles`));
  assert.deepEqual(await asked(page), levels.map((level) => level.triangles).reverse(), "brightest first");
  await close(page);
});

test("hidden shells are not decoded until they are shown", async () => {
  const triangles = surfacesOf(copied).map((level) => level.triangles);
  const page = await opened(`${pageOf(copied, "copied.html")}#hide=1,2`);
  assert.deepEqual(await asked(page), [triangles[2]]);
  await page.check("[data-shell='2'] input");
  await settled(page);
  assert.deepEqual((await asked(page)).slice(1), [triangles[1]]);
  await goTo(page, "hide=3");
  assert.deepEqual((await asked(page)).slice(2), [triangles[0]], "what is there is not decoded again");
  await close(page);
});

/** Turns the picture by itself until the status matches; what it says and how many pixels there are then. */
async function turnUntil(page, words) {
  await page.click("#cine");
  await page.waitForFunction((source) => new RegExp(source).test(document.getElementById("status").textContent), words.source);
  const turning = await page.evaluate(() => ({ status: document.getElementById("status").textContent,
    width: document.getElementById("picture").width }));
  await page.click("#cine");
  await settled(page);
  return turning;
}

/** Frames of the whole set take 53 ms, those of a part of it in proportion. */
const costByTriangles = (page) => page.evaluate((all) => {
  window.frameCost = () => Number(document.getElementById("status").textContent.match(/\n(\d+)k/)[1]) * 53 / all;
}, sum(surfacesOf(without)) / 1000);

/** The page at rest has all shells and pixels; `first` is what the first view looked like. */
async function assertWhole(page, set, first) {
  assert.match(await status(page), new RegExp(`\n${thousands(sum(surfacesOf(set)))}k triangles, 480 × 400$`));
  await goTo(page, "");
  assert.equal(await look(page), first);
}

test("where frames run late for their pixels, a turning picture has fewer, and one at rest all", async () => {
  const page = await opened(pageOf(without, "without.html"));
  const first = await look(page);
  await page.evaluate(() => { window.frameCost = (canvas) => 50 * (canvas.width / 480) ** 2; });
  const turning = await turnUntil(page, /triangles, (3|2)\d\d × /);
  assert.ok(turning.width < 480, JSON.stringify(turning));
  assert.doesNotMatch(turning.status, /1 shell of/);
  await assertWhole(page, without, first);
  await close(page);
});

test("where they run late for their triangles, a turning picture has fewer shells, and one at rest all", async () => {
  const page = await opened(address(inFolder("without.html")));
  const first = await look(page);
  await costByTriangles(page);
  await turnUntil(page, /1 shell of [2-6] while it moves/);
  await assertWhole(page, without, first);
  await page.evaluate(() => { window.frameCost = () => 50; });
  await turnUntil(page, new RegExp(`\\n${whole}$`)); // what does not help is taken back
  await close(page);
});

test("less detail that helped once and does no longer is given back", async () => {
  const page = await opened(address(inFolder("without.html")));
  await costByTriangles(page);
  await page.click("#cine");
  await page.evaluate(async () => { // so long that it counts as a help
    const isLess = () => /1 shell of [2-6]/.test(document.getElementById("status").textContent);
    for (let frames = 0; frames < 16; frames = isLess() ? frames + 1 : 0) await new Promise(requestAnimationFrame);
    window.frameCost = () => 50;
  });
  await page.waitForFunction((words) => document.getElementById("status").textContent.endsWith(`\n${words}`), whole);
  await page.click("#cine");
  await close(page);
});

test("coarse copies are decoded when frames run late, turn in place of the shells, and give way to them", async () => {
  const levels = surfacesOf(copied);
  const copies = levels.map((level) => level.coarse);
  const url = address(inFolder("copied.html"));
  // On a busy machine frames may run late by themselves: not five times over.
  let page = await opened(url);
  for (let again = 0; again < 4 && (await asked(page)).length > levels.length; ++again) {
    await close(page);
    page = await opened(url);
  }
  assert.deepEqual(await asked(page), levels.map((level) => level.triangles).reverse(), "no copy while frames are in time");
  const first = await look(page);
  await page.evaluate(() => { window.frameCost = () => (/coarse/.test(document.getElementById("status").textContent) ? 20 : 50); });
  const turning = await turnUntil(page, new RegExp(`\n${thousands(sum(copies))}k triangles, 480 × 400, coarse copies while it moves`));
  assert.equal(turning.width, 480);
  assert.deepEqual((await asked(page)).slice(levels.length), copies.map((copy) => copy.triangles).reverse());
  await assertWhole(page, copied, first);
  const facts = await page.textContent("#facts");
  assert.match(facts, /Coarse copies[\d,]+ triangles, simplified by up to 0.2 in emission/);
  assert.match(facts, /Their maximumerror not measured/, "a set without a certificate");
  await close(page);
});

test("of a large set the coarse copies come first, and the shells replace them", async () => {
  const set = repeatedSet(glb("dense.glb"), 10);
  const levels = surfacesOf(set).reverse();
  const url = pageOf(set, "many.html");
  const page = await opened(url);
  const order = await asked(page);
  assert.deepEqual(order.slice(0, 2 * levels.length),
    [...levels.map((level) => level.coarse.triangles), ...levels.map((level) => level.triangles)]);
  assert.match(await status(page), new RegExp(`\n${thousands(sum(levels))}k triangles, 480 × 400$`));
  const [first, whole] = await page.evaluate(() => ["first-picture", "whole-picture"].map(
    (name) => performance.getEntriesByName(name)[0].startTime));
  assert.ok(first < whole, `the first picture ${first} ms, the whole one ${whole} ms after the start`);
  const shown = await look(page);
  await close(page);
  const full = await opened(`${url}?detail=full`);
  assert.deepEqual(await asked(full), levels.map((level) => level.triangles), "no copies where none are wanted");
  assert.equal(await look(full), shown);
  await close(full);
});

test("a damaged copy is said to be, and its shell is shown", async () => {
  const set = Buffer.from(copied);
  set[set.length - 400] ^= 255; // copies come last
  const page = await opened(pageOf(set, "damaged.html"));
  await page.evaluate(() => { window.frameCost = () => 70; });
  await page.click("#cine");
  await page.waitForFunction(() => document.documentElement.dataset.problem !== undefined);
  await page.click("#cine");
  await settled(page);
  assert.match(await page.textContent("#message"), /^Coarse copy of the shell at emission .*: found checksum .* shown without it/);
  assert.match(await status(page), new RegExp(`\n${thousands(sum(surfacesOf(copied)))}k triangles, 480 × 400$`));
  await close(page);
});

test("a hint says how to turn, once: gone with the first thing done, or dismissed by key", async () => {
  const url = address(inFolder("copied.html"));
  const hint = (page) => page.locator("#hint");
  const page = await opened(url);
  assert.ok(await hint(page).isVisible());
  assert.match(await hint(page).textContent(), /Drag to turn, wheel to zoom/);
  assert.equal(await hint(page).getAttribute("role"), "status");
  await page.keyboard.press("Tab");
  assert.ok(await hint(page).isVisible(), "Tab leads to it");
  await page.locator("#hint-close").focus();
  await page.keyboard.press("Enter");
  assert.ok(await hint(page).isHidden());
  assert.equal(await page.evaluate(() => document.activeElement.id), "picture");
  await page.reload();
  await settled(page);
  assert.ok(await hint(page).isHidden(), "it is remembered");
  await close(page);
  const touched = await open(browser, url, { width: 390, height: 844 }, { hasTouch: true, isMobile: true });
  assert.match(await hint(touched).textContent(), /One finger turns/);
  await touched.touchscreen.tap(200, 200);
  assert.ok(await hint(touched).isHidden());
  await touched.close();
  const forgetful = await open(browser, url, undefined, {}, () => {
    Object.defineProperty(window, "localStorage", { get() { throw new DOMException("denied", "SecurityError"); } });
  });
  await forgetful.keyboard.press("Escape");
  assert.ok(await hint(forgetful).isHidden());
  await forgetful.goto(`${url}?hint=off`);
  await settled(forgetful);
  assert.ok(await hint(forgetful).isHidden(), "where it is not wanted");
  await close(forgetful);
});
