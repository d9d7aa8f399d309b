// The page as a file: offline from disk, damaged, without WebGL2, with lesser float targets, on a phone.
import assert from "node:assert/strict";
import { readFileSync, statSync, writeFileSync } from "node:fs";
import { after, test } from "node:test";
import { address, angiogramFlags, goTo, inFolder, launch, look, makeAngiogram, nacre, open, psnr, savePicture } from "./support.mjs";

const browser = await launch();
const url = makeAngiogram();
after(() => browser.close());

const html = () => readFileSync(inFolder("angiogram.html"), "utf8");

test("without its set the page has at most 1.2 MB", () => {
  const whole = statSync(inFolder("angiogram.html")).size;
  const set = 4 * Math.ceil(statSync(inFolder("angiogram.glb")).size / 3);
  console.log(`the page without its set: ${whole - set} bytes`);
  assert.ok(whole - set <= 1.2e6);
});

test("build writes the page that view writes", () => {
  nacre("build", "angiogram.nrrd", ...angiogramFlags, "-o", "built.html", "-q");
  assert.equal(readFileSync(inFolder("built.html"), "utf8"), html());
});

test("it opens from disk without asking for anything", async () => {
  const page = await browser.newPage();
  const asked = [];
  page.on("request", (request) => asked.push(request.url()));
  await page.context().setOffline(true);
  await page.goto(url);
  await page.waitForFunction(() => document.documentElement.dataset.state === "ready", null, { timeout: 120_000 });
  assert.deepEqual(asked.filter((a) => !a.startsWith("file:") && !a.startsWith("blob:") && !a.startsWith("data:")), []);
  assert.match(await page.textContent("#facts"), /96 × 96 × 47 samples of i16/);
  await page.close();
});

/** The page of a set whose bytes were changed. */
function damagedPage(name, change) {
  const set = readFileSync(inFolder("angiogram.glb"));
  writeFileSync(inFolder(name), html().replace(set.toString("base64"), change(Buffer.from(set))));
  return address(inFolder(name));
}

const damages = {
  "cut short": (set) => set.subarray(0, 5000).toString("base64"),
  "no glTF": (set) => { set[0] = 0; return set.toString("base64"); },
  "broken JSON": (set) => { set[30] = 0x7d; return set.toString("base64"); },
  "no base64": () => "%%%%",
};
for (const [name, change] of Object.entries(damages)) {
  test(`a set that is ${name} gets a message`, async () => {
    const page = await open(browser, damagedPage("damaged.html", change));
    assert.equal(await page.evaluate(() => document.documentElement.dataset.state), "damaged");
    assert.match(await page.textContent("#message"), /cannot be shown: found .*, expected /);
    assert.ok(await page.locator("#message").isVisible());
    assert.deepEqual(page.problems, []);
    await page.close();
  });
}

test("a shell whose bytes are damaged is left out, and said to be", async () => {
  const flip = (set) => { set[set.length - 400] ^= 255; return set.toString("base64"); };
  const page = await open(browser, damagedPage("flipped.html", flip));
  await page.waitForFunction(() => document.documentElement.dataset.problem !== undefined);
  assert.match(await page.textContent("#message"), /found checksum .* The picture is shown without it/);
  await page.close();
});

test("without WebGL2 the page says so", async () => {
  const page = await browser.newPage();
  await page.addInitScript(() => { HTMLCanvasElement.prototype.getContext = () => null; });
  await page.goto(url);
  await page.waitForFunction(() => document.documentElement.dataset.state === "failed");
  assert.match(await page.textContent("#message"), /has no WebGL2/);
  await page.close();
});

test("without workers shells are decoded in the page", async () => {
  const page = await browser.newPage();
  await page.addInitScript(() => { delete window.Worker; });
  await page.goto(url);
  await page.waitForFunction(() => document.documentElement.dataset.state === "ready", null, { timeout: 120_000 });
  await page.close();
});

test("half floats add up to about 1 %, and it is said", async () => {
  const page = await open(browser, `${url}?floats=half#mode=sum&display=0,10`);
  assert.match(await page.textContent("#mode-note"), /half floats: sums are good to about 1 %/);
  nacre("render", "angiogram.glb", "--mode", "sum", "--display", "0,10", "--size", "256x256", "-o", "sum.png", "-q");
  const found = await psnr(page, await savePicture(page, "half.png", 256, 256), inFolder("sum.png"));
  console.log(`a sum in half floats: ${found.toFixed(1)} dB`);
  assert.ok(found >= 40, `${found} dB`);
  await page.close();
});

test("without float targets sums are not shown, and it is said; maxima are", async () => {
  const page = await open(browser, `${url}?floats=none#mode=sum`);
  assert.match(await page.textContent("#mode-note"), /cannot add up in floats/);
  await goTo(page, "slab=-8,9");
  nacre("render", "angiogram.glb", "--layers", "smooth", "--size", "256x256", "-o", "max.png", "-q");
  await goTo(page, "");
  assert.ok(await psnr(page, await savePicture(page, "none.png", 256, 256), inFolder("max.png")) >= 40);
  await page.close();
});

test("on a phone the picture and the controls share the screen", async () => {
  const page = await open(browser, url, { width: 390, height: 844 }, { deviceScaleFactor: 2, hasTouch: true, isMobile: true });
  const picture = await page.locator("#picture").boundingBox();
  const panel = await page.locator("#panel").boundingBox();
  assert.ok(picture.width === 390 && picture.height >= 400, JSON.stringify(picture));
  assert.ok(panel.width <= 390 && panel.y >= picture.y + picture.height - 1);
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= 390, "nothing sticks out");
  const small = await page.locator("button:visible, select:visible").evaluateAll(
    (all) => all.filter((e) => e.getBoundingClientRect().height < 36).map((e) => e.outerHTML.slice(0, 60)));
  assert.deepEqual(small, [], "fingers hit every button");
  const earlier = await look(page);
  await page.tap("[data-view=left]");
  assert.notEqual(await look(page), earlier);
  await page.close();
});
