// Every control, operated as a user would, and its effect seen in the picture or the address.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, beforeEach, test } from "node:test";
import { goTo, inFolder, launch, look, makeAngiogram, nacre, open, psnr, savePicture, settled, toolPose, writeTool } from "./support.mjs";

const browser = await launch();
const size = { width: 640, height: 340 };
let page;
let url;
/** The picture as it was last looked at; null if it may have changed since. */
let seen = null;

before(async () => {
  writeTool();
  url = `${makeAngiogram()}?detail=full`; // a picture that moves is then drawn once, not again at rest
  nacre("phantom", "spheres", "--size", "24,24,24", "-o", "ball.nrrd", "-q");
  nacre("build", "ball.nrrd", "--window", "0,28", "--levels", "2", "-o", "ball.glb", "-q");
  page = await open(browser, url, size);
});
beforeEach(() => {
  seen = null;
  return goTo(page, "");
});
after(() => browser.close());

const hashNow = () => page.evaluate(() => decodeURIComponent(location.hash.slice(1)));

/** The address once it matches: it follows the state a few times a second. */
async function address(hash) {
  let now = await hashNow();
  for (let tries = 0; tries < 100 && !hash.test(now); ++tries) {
    await page.waitForTimeout(30);
    now = await hashNow();
  }
  return now;
}

/** The act changes the picture; the address then matches. */
async function changes(what, act, hash) {
  const earlier = seen ?? await look(page);
  await act();
  seen = await look(page);
  assert.notEqual(seen, earlier, `${what}: the picture is the same`);
  if (hash) assert.match(await address(hash), hash, what);
}

async function setNumber(name, value) {
  const field = page.locator(`[data-slider="${name}"] input[type=number]`);
  await field.fill(String(value));
  await field.press("Enter");
}

/** What takes the pointer in the middle of an element. */
const beneath = (selector) => page.locator(selector).evaluate((shown) => {
  const { x, y, width, height } = shown.getBoundingClientRect();
  return document.elementFromPoint(x + width / 2, y + height / 2).id;
});

const canvas = async () => page.locator("#picture").boundingBox();

async function drag(from, to, options = {}) {
  const box = await canvas();
  const at = ([x, y]) => [box.x + box.width * x, box.y + box.height * y];
  if (options.key) await page.keyboard.down(options.key);
  await page.mouse.move(...at(from));
  await page.mouse.down({ button: options.button ?? "left" });
  await page.mouse.move(...at(to), { steps: 3 });
  await page.mouse.up({ button: options.button ?? "left" });
  if (options.key) await page.keyboard.up(options.key);
}

test("each kind of picture", async () => {
  for (const mode of ["sum", "count", "iso"]) {
    await changes(mode, () => page.check(`input[name=mode][value=${mode}]`, { force: true }), new RegExp(`mode=${mode}`));
    assert.ok((await page.textContent("#mode-note")).length > 10);
  }
  await changes("max", () => page.check("input[name=mode][value=max]", { force: true }), /^$/);
});

test("a sum's own window is its largest pixel", async () => {
  await page.check("input[name=mode][value=sum]", { force: true });
  await settled(page);
  const shown = await savePicture(page, "sum.png", 256, 256);
  nacre("render", "angiogram.glb", "--mode", "sum", "--size", "256x256", "-o", "nacre.png", "-q");
  assert.ok(await psnr(page, shown, inFolder("nacre.png")) >= 40);
});

test("colours, level, window and their own window", async () => {
  await changes("colours", () => page.selectOption("#color-map", "hot"), /colormap=hot/);
  await changes("level", () => setNumber("level", 0.3), /display=-0.2,0.8/);
  await changes("window", () => setNumber("width", 0.4), /display=0.1,0.5/);
  await changes("window by key", async () => {
    await page.locator("#slider-width").focus();
    for (let i = 0; i < 30; ++i) await page.keyboard.press("ArrowRight");
  });
  await changes("own window", () => page.click("#window-auto"), /^colormap=hot$/);
});

test("named views, by buttons and by keys", async () => {
  const views = ["anterior", "posterior", "left", "right", "superior", "inferior"];
  for (const view of views.slice(1)) {
    await changes(view, () => page.click(`[data-view=${view}]`), new RegExp(`view=${view}`));
  }
  await page.locator("#picture").focus();
  for (const [i, view] of views.entries()) {
    await changes(`key ${i + 1}`, () => page.keyboard.press(String(i + 1)), view === "anterior" ? /^$/ : new RegExp(view));
  }
});

test("letters say where the patient's sides are", async () => {
  const letters = async () => Object.fromEntries(await page.locator("#overlay [data-side]").evaluateAll(
    (sides) => sides.map((side) => [side.dataset.side, side.textContent])));
  assert.deepEqual(await letters(), { left: "R", right: "L", top: "S", bottom: "I" });
  await page.click("[data-view=inferior]");
  await settled(page);
  assert.deepEqual(await letters(), { left: "R", right: "L", top: "A", bottom: "P" });
});

test("the millimetre scale is as long as it says", async () => {
  // 512 pixels across the sphere of the volume at zoom 1; `nacre info` says its radius.
  const radius = Number(nacre("info", "angiogram.nrrd").match(/radius ([\d.]+) mm/)[1]);
  const { height, width } = await canvas();
  for (const zoom of [1, 2.5]) {
    await goTo(page, `zoom=${zoom}`);
    const mm = Number((await page.textContent("#scale-bar")).match(/^(\d+) mm$/)[1]);
    const bar = await page.locator("#scale-bar").evaluate((e) => parseFloat(e.style.width));
    const expected = (mm * Math.min(width, height) * zoom) / (2 * radius);
    assert.ok(Math.abs(bar / expected - 1) < 0.02, `${mm} mm: found ${bar} pixels, expected ${expected}`);
  }
});

test("the list says each shell's level, triangles and colour", async () => {
  nacre("info", "angiogram.glb", "--json", "set.json", "-q");
  const set = JSON.parse(readFileSync(inFolder("set.json")));
  const rows = await page.locator(".shell").evaluateAll((all) => all.map((row) => ({
    text: row.textContent, color: row.querySelector("i").style.background })));
  assert.equal(rows.length, set.levels.length);
  const [darkest, brightest] = [rows.at(-1), rows[0]];
  assert.ok(darkest.text.startsWith(set.levels[0].emission.toFixed(3)), darkest.text);
  assert.ok(darkest.text.endsWith(set.levels[0].triangles.toLocaleString("en")), darkest.text);
  const gray = (row) => Number(row.color.match(/\d+/)[0]);
  assert.ok(Math.abs(gray(darkest) - 255 * set.levels[0].representative) < 1.5, darkest.color);
  assert.ok(gray(brightest) > gray(darkest));
  await page.selectOption("#color-map", "hot");
  await settled(page);
  const hot = await page.locator(".shell i").first().evaluate((e) => e.style.background);
  assert.notEqual(hot, brightest.color);
});

test("frame time and size are in view", async () => {
  assert.match(await page.textContent("#status"), /^[\d.]+ ms a frame\n\d+k triangles, \d+ × \d+$/);
});

test("a picture is saved at the size chosen, by button and by key", async () => {
  const sizeOf = (name) => { const png = readFileSync(inFolder(name)); return [png.readUInt32BE(16), png.readUInt32BE(20)]; };
  await savePicture(page, "saved.png", 90, 60);
  assert.deepEqual(sizeOf("saved.png"), [90, 60]);
  await page.locator("#picture").focus();
  const [download] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("s")]);
  await download.saveAs(inFolder("key.png"));
  assert.deepEqual(sizeOf("key.png"), [90, 60]);
  assert.match(download.suggestedFilename(), /^nacre-max\.png$/);
  await page.fill("#save-width", "9000");
  await page.click("#save");
  assert.match(await page.textContent("#message"), /found 9000 x 60, expected 1 to 8192/);
  assert.equal(await beneath("#message"), "picture", "the line is not in the hand's way");
});

test("perspective, distance, roll and zoom", async () => {
  await changes("perspective", () => setNumber("perspective", 60), /perspective=60/);
  await changes("distance", () => setNumber("distance", 90), /distance=90/);
  await changes("roll", () => setNumber("roll", 30), /roll=30/);
  await changes("zoom", () => setNumber("zoom", 2), /zoom=2/);
  await changes("reset", () => page.click("#reset"), /^$/);
  await page.locator("#picture").focus();
  await changes("p", () => page.keyboard.press("p"), /perspective=40/);
});

test("the cue", async () => {
  await changes("a", () => setNumber("a", 0.5), /cue=0.5,1,0/);
  await changes("b", () => setNumber("b", 0.2), /cue=0.5,0.2,0/);
  await changes("beta0", () => setNumber("beta0", 0.3), /cue=0.5,0.2,0.3/);
  await changes("a negative a", () => setNumber("a", -2), /cue=-2,/);
  const [a, b, beta0] = (await hashNow()).replace("cue=", "").split(",").map(Number);
  assert.ok(a === -2 && beta0 + b + a >= -1e-9, "beta is not negative anywhere");
  await changes("near is bright", () => page.click("#cue-near"), /cue=0.85,0.15,0/);
  await changes("no cue", () => page.click("#cue-off"), /^$/);
});

test("the slab", async () => {
  await changes("from", () => setNumber("slab-near", -5), /slab=-5,1000000/);
  await changes("to", () => setNumber("slab-far", 5), /slab=-5,5/);
  await changes("the end that is moved", () => setNumber("slab-far", -20), /slab=-?[\d.]+,-20/);
  const [near, far] = (await hashNow()).replace("slab=", "").split(",").map(Number);
  assert.ok(near < far && far === -20, "the end that is moved pushes the other");
  await changes("whole volume", () => page.click("#slab-off"), /^$/);
});

test("shells, all, none, half and one by one", async () => {
  assert.equal(await page.locator(".shell").count(), 8);
  await changes("none", () => page.click("#shells-none"), /hide=1,2,3,4,5,6,7,8/);
  await changes("one", () => page.check("[data-shell='4'] input"), /hide=1,2,3,5,6,7,8/);
  await changes("all", () => page.click("#shells-all"), /^$/);
  await changes("every second", () => page.click("#shells-half"), /hide=2,4,6,8/);
});

test("turning, moving, zooming and windowing with the mouse", async () => {
  await changes("drag", () => drag([0.4, 0.5], [0.6, 0.6]), /azimuth=-\d.*elevation=\d/);
  await changes("shift drag", () => drag([0.4, 0.5], [0.5, 0.5], { key: "Shift" }), /look-at=/);
  await changes("middle drag", () => drag([0.4, 0.5], [0.4, 0.6], { button: "middle" }));
  await changes("Ctrl drag", () => drag([0.4, 0.5], [0.45, 0.45], { key: "Control" }), /display=/);
  await changes("right drag", () => drag([0.4, 0.5], [0.3, 0.4], { button: "right" }), /display=/);
  const box = await canvas();
  await page.mouse.move(box.x + 100, box.y + 100);
  await changes("wheel", () => page.mouse.wheel(0, -300), /zoom=1\.\d/);
  await changes("double click", () => page.mouse.dblclick(box.x + 100, box.y + 100), /^display=[^&]*$/);
});

test("keys of the picture", async () => {
  await page.locator("#picture").focus();
  await changes("arrow", () => page.keyboard.press("ArrowLeft"), /azimuth=5/);
  await changes("up", () => page.keyboard.press("ArrowUp"), /elevation=-5/);
  await changes("shift arrow", () => page.keyboard.press("Shift+ArrowLeft"), /look-at/);
  await changes("plus", () => page.keyboard.press("+"), /zoom=1.1/);
  await changes("minus", () => page.keyboard.press("-"), /^(?!.*zoom)/);
  await changes("bracket", () => page.keyboard.press("]"), /roll=5/);
  await changes("the other bracket", () => page.keyboard.press("["), /^(?!.*roll)/);
  await changes("m", () => page.keyboard.press("m"), /mode=sum/);
  await changes("a narrow window", () => setNumber("width", 0.5), /display=/);
  await page.locator("#picture").focus();
  await changes("w", () => page.keyboard.press("w"), /^(?!.*display)/);
  await changes("r", () => page.keyboard.press("r"), /^mode=sum$/);
});

test("cine turns until it is stopped", async () => {
  await setNumber("cine-speed", 90);
  await changes("cine", async () => {
    await page.click("#cine");
    await page.waitForFunction(() => / a second/.test(document.getElementById("status").textContent));
    assert.equal(await page.getAttribute("#cine", "aria-pressed"), "true");
    await page.click("#cine");
  }, /azimuth=/);
  const [stopped, later] = await page.evaluate(async () => {
    const command = () => document.getElementById("command").textContent;
    const first = command();
    for (let frame = 0; frame < 4; ++frame) await new Promise(requestAnimationFrame);
    return [first, command()];
  });
  assert.equal(later, stopped, "it stands still");
  await page.locator("#picture").focus();
  await page.keyboard.press("c");
  assert.equal(await page.getAttribute("#cine", "aria-pressed"), "true");
  await page.keyboard.press("c");
  assert.equal(await page.getAttribute("#cine", "aria-pressed"), "false");
});

test("touch: one finger turns, two pinch, three set the window", async () => {
  const touch = await page.context().newCDPSession(page);
  const box = await canvas();
  const fingers = (points) => points.map(([x, y], id) => ({ x: box.x + x, y: box.y + y, id }));
  const gesture = async (from, to) => {
    await touch.send("Input.dispatchTouchEvent", { type: "touchStart", touchPoints: fingers(from) });
    await touch.send("Input.dispatchTouchEvent", { type: "touchMove", touchPoints: fingers(to) });
    await touch.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
  };
  await changes("one finger", () => gesture([[200, 200]], [[240, 210]]), /azimuth=/);
  await changes("pinch", () => gesture([[200, 200], [260, 200]], [[170, 200], [290, 200]]), /zoom=1\.\d|zoom=2/);
  await changes("two move", () => gesture([[200, 200], [260, 200]], [[215, 220], [275, 220]]), /look-at=/);
  await changes("two turn", () => gesture([[200, 200], [260, 200]], [[200, 220], [260, 180]]), /roll=/);
  await changes("three", () => gesture([[100, 200], [160, 200], [220, 200]], [[130, 170], [190, 170], [250, 170]]), /display=/);
});

test("a tool: colour, scale, pose, handles by hand and key, removal", async () => {
  await changes("add", () => page.setInputFiles("#tool-file", inFolder("tool.obj")));
  await changes("colour", () => page.locator("#tool-list input[type=color]").fill("#ff4040"));
  await changes("scale", async () => {
    await page.locator("#tool-list input[type=number]").fill("0.5");
    await page.keyboard.press("Enter");
  });
  const handles = page.locator(".handle");
  assert.equal(await handles.count(), 4);
  const pose = () => page.locator("#tool-list textarea").inputValue();
  for (const [i, name] of ["move", "near", "turn", "tilt"].entries()) {
    const earlier = await pose();
    const box = await handles.nth(i).boundingBox();
    await page.mouse.move(box.x + 13, box.y + 13);
    await page.mouse.down();
    await page.mouse.move(box.x + 33, box.y + 38, { steps: 3 });
    await page.mouse.up();
    await settled(page);
    assert.notEqual(await pose(), earlier, `${name} by hand`);
    const dragged = await pose();
    await handles.nth(i).focus();
    await page.keyboard.press("ArrowDown");
    await settled(page);
    assert.notEqual(await pose(), dragged, `${name} by key`);
  }
  await page.locator("#tool-list textarea").fill("1 2 3");
  await page.locator("#tool-list textarea").blur();
  assert.match(await page.textContent("#message"), /found 3 numbers, expected 16/);
  await changes("pose", async () => {
    await page.locator("#tool-list textarea").fill(toolPose);
    await page.locator("#tool-list textarea").blur();
  });
  await changes("over", () => page.check("#over"), /tool-blend=over/);
  await changes("remove", () => page.locator("#tool-list button").click());
  assert.equal(await handles.count(), 0);
});

test("a bad tool gets a line, not a blank page", async () => {
  await page.setInputFiles("#tool-file", { name: "bad.stl", mimeType: "model/stl", buffer: Buffer.from("not a mesh") });
  await page.waitForFunction(() => document.getElementById("message").textContent.startsWith("bad.stl: found"));
});

test("help, panel and full screen", async () => {
  await page.click("#help-button");
  assert.ok(await page.locator("#help").isVisible());
  await page.keyboard.press("Escape");
  assert.ok(!await page.locator("#help").isVisible());
  await page.locator("#picture").focus();
  await page.keyboard.press("h");
  assert.ok(await page.locator("#help").isVisible());
  await page.click("#help button");
  await page.click("#panel-toggle");
  await settled(page);
  assert.equal((await canvas()).width, size.width);
  assert.equal(await page.textContent("#panel-toggle"), "Controls");
  await page.click("#panel-toggle");
  await page.click("#full-screen");
  await page.waitForFunction(() => document.fullscreenElement !== null);
  await page.locator("#picture").focus();
  await page.keyboard.press("f");
  await page.waitForFunction(() => document.fullscreenElement === null);
});

test("the link of a view shows it again", async () => {
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  await goTo(page, "view=left&azimuth=20&cue=0.5,0.5,0&hide=2&colormap=bone");
  await page.click("#copy-link");
  await page.waitForFunction(() => !document.getElementById("message").hidden);
  const shown = await savePicture(page, "one.png", 128, 128);
  const other = await open(browser, await page.evaluate(() => navigator.clipboard.readText()), size);
  assert.equal(await psnr(page, shown, await savePicture(other, "other.png", 128, 128)), Infinity);
  assert.match(await other.textContent("#command"), /--view left --azimuth 20 --cue 0.5,0.5,0 --hide 2 --colormap bone/);
  await other.close();
});

test("another set is opened by hand", async () => {
  await changes("open", () => page.setInputFiles("#set-file", inFolder("ball.glb")));
  assert.equal(await page.locator(".shell").count(), 2);
  const facts = await page.textContent("#facts");
  assert.match(facts, /PSNR [\d.]+ dB over all pixels, [\d.]+ dB over lit ones; RMSE [\d.]+, largest error/, "its certificate");
  assert.match(facts, /Measured on\d+ views of \d+ × \d+ pixels/);
});

test("a set dropped on the picture is opened", async () => {
  const base64 = readFileSync(inFolder("angiogram.glb")).toString("base64");
  const files = await page.evaluateHandle((text) => {
    const data = new DataTransfer();
    data.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], "again.glb"));
    return data;
  }, base64);
  await changes("drop", () => page.dispatchEvent("#stage", "drop", { dataTransfer: files }));
  assert.equal(await page.locator(".shell").count(), 8);
});

test("every control has a name, and is reached by Tab", async () => {
  const nameless = await page.evaluate(() => [...document.querySelectorAll("button, input, select, textarea, canvas:not([aria-hidden])")]
    .filter((e) => !(e.getAttribute("aria-label") || e.textContent.trim() || e.labels?.length || e.title))
    .map((e) => e.outerHTML.slice(0, 80)));
  assert.deepEqual(nameless, []);
  await page.locator("#picture").focus();
  const reached = new Set();
  for (let i = 0; i < 80; ++i) {
    await page.keyboard.press("Tab");
    reached.add(await page.evaluate(() => document.activeElement?.id));
  }
  for (const id of ["slider-a", "color-map", "cine", "save", "shells-all", "slider-slab-near"]) {
    assert.ok(reached.has(id), `${id} by Tab`);
  }
});

test("a lost context is restored", async () => {
  const shown = await look(page);
  await page.evaluate(async () => {
    const canvas = document.getElementById("picture");
    const lose = canvas.getContext("webgl2").getExtension("WEBGL_lose_context");
    const lost = new Promise((done) => canvas.addEventListener("webglcontextlost", done));
    lose.loseContext();
    await lost;
    await new Promise((done) => setTimeout(done)); // not before the event is over
    document.documentElement.dataset.state = "drawing";
    lose.restoreContext();
  });
  await settled(page);
  assert.equal(await look(page), shown);
});

test("nothing was wrong on the way", () => assert.deepEqual(page.problems, []));
