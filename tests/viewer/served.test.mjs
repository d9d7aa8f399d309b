// `nacre view`: the served page, live levels, what is not given away, and a clean end.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { request } from "node:http";
import { after, test } from "node:test";
import { setTimeout } from "node:timers/promises";
import { folder, inFolder, launch, look, makeAngiogram, nacre, open, psnr, savePicture, settled, writeTool } from "./support.mjs";

const browser = await launch();
makeAngiogram();
const running = new Set();
after(async () => {
  for (const server of running) server.kill("SIGKILL");
  await browser.close();
});

/** A server with those arguments, and its address. */
const serve = (...flags) => start(["view", ...flags, "--no-open"]);

async function start(flags, env = process.env) {
  const server = spawn(process.env.NACRE_BINARY, flags, { cwd: folder, env });
  running.add(server);
  let said = "";
  for await (const text of server.stdout) {
    said += text;
    const address = said.match(/http:\/\/127\.0\.0\.1:\d+\//);
    if (address) return { server, address: address[0] };
  }
  throw new Error(`it said no address: ${said}`);
}

async function until(isSo, what) {
  for (let tries = 0; tries < 200 && !isSo(); ++tries) await setTimeout(50);
  assert.ok(isSo(), what);
}

async function end(server, signal) {
  const ended = once(server, "exit");
  server.kill(signal);
  const [status] = await ended;
  running.delete(server);
  return status;
}

/** The status of a request with a Host and a path as they are given. */
const statusOf = (address, path, host, method = "GET") => new Promise((resolve, reject) => {
  const { hostname, port } = new URL(address);
  const asked = request({ hostname, port, path, method, headers: host ? { Host: host } : {} }, (answer) => {
    answer.resume();
    resolve(answer.statusCode);
  });
  asked.on("error", reject);
  asked.end();
});

test("a set is served, nothing else is, and SIGINT ends it", async () => {
  const { server, address } = await serve("angiogram.glb");
  const page = await open(browser, `${address}?pictures=page`);
  nacre("render", "angiogram.glb", "--layers", "smooth", "--size", "256x256", "-o", "nacre.png", "-q");
  assert.ok(await psnr(page, await savePicture(page, "page.png", 256, 256), inFolder("nacre.png")) >= 40);
  assert.equal(await page.locator("#live").isVisible(), false);
  for (const path of ["/angiogram.nrrd", "/../angiogram.nrrd", "/%2e%2e/angiogram.nrrd", "/etc/passwd", "/level"]) {
    assert.equal(await statusOf(address, path), 404, path);
  }
  assert.equal(await statusOf(address, "/set.glb"), 200);
  assert.equal(await statusOf(address, "/set.glb", "elsewhere.example"), 403);
  assert.equal(await statusOf(address, "/level?emission=0.5", undefined, "POST"), 404, "no volume, no levels");
  await page.close();
  assert.equal(await end(server, "SIGINT"), 0);
});

/** What the canvas without WebGL shows, as PNG; null while it is not shown. */
const servedPicture = (page) => page.evaluate(() => {
  const canvas = document.getElementById("served");
  return canvas.hidden ? null : canvas.toDataURL().split(",")[1];
});

test("where the browser draws in software the server draws maxima, as the command does", async () => {
  const { server, address } = await serve("angiogram.glb");
  const page = await open(browser, `${address}#azimuth=20&colormap=hot`); // SwiftShader, which is told
  const shown = async (name) => {
    await settled(page);
    const png = await servedPicture(page);
    assert.notEqual(png, null, "the server's picture is shown");
    writeFileSync(inFolder(name), Buffer.from(png, "base64"));
    return inFolder(name);
  };
  const drawn = (...flags) => {
    const { width, height } = page.viewportSize();
    const wide = width - 310; // the panel's width
    nacre("render", "angiogram.glb", "--backend", "cpu", "--size", `${wide}x${height}`, ...flags, "-o", "nacre.png", "-q");
    return inFolder("nacre.png");
  };
  assert.ok(await psnr(page, await shown("a.png"), drawn("--azimuth", "20", "--colormap", "hot")) >= 50);
  assert.match(await page.textContent("#status"), /drawn by nacre, 512 × 512/);
  assert.equal(await page.textContent("#command"), "nacre render set.glb --azimuth 20 --colormap hot -o picture.png");
  const turned = "#elevation=30&slab=-10,20&cue=0.5,0.5,0&hide=2&display=0,0.8";
  await page.evaluate((hash) => goTo(hash), turned);
  assert.ok(await psnr(page, await shown("b.png"), drawn(
    "--elevation", "30", "--slab=-10,20", "--cue", "0.5,0.5,0", "--hide", "2", "--display", "0,0.8")) >= 60);
  nacre("render", "angiogram.glb", "--elevation", "30", "--slab=-10,20", "--cue", "0.5,0.5,0", "--hide", "2", "--display", "0,0.8",
    "--backend", "cpu", "--size", "300x200", "-o", "saved.png", "-q");
  assert.ok(await psnr(page, await savePicture(page, "page.png", 300, 200), inFolder("saved.png")) >= 60);

  // What moves is drawn soon, then as well as it can be.
  const asked = [];
  page.on("request", (request) => asked.push(request.url()));
  await page.evaluate(() => goTo("#"));
  await page.focus("#picture");
  await page.keyboard.press("ArrowLeft");
  await page.waitForFunction(() => document.documentElement.dataset.state === "ready");
  await settled(page);
  const layers = asked.map((url) => new URL(url).searchParams.get("layers"));
  assert.equal(layers.at(-1), "fine", layers.join());

  // What it refuses is drawn by the page, and no more than that.
  await page.route("**/picture?*azimuth=77*", (route) => route.fulfill({ status: 400, body: "no" }));
  await page.evaluate(() => goTo("#azimuth=77"));
  assert.equal(await servedPicture(page), null);
  await page.evaluate(() => goTo("#azimuth=78&hide=99"));
  assert.notEqual(await servedPicture(page), null);
  assert.match(page.problems.splice(0).join("|"), /^[^|]*status of 400[^|]*$/, "which the browser notes");

  // Surfaces are lit, and tools drawn, by the page itself.
  await page.evaluate(() => goTo("#mode=iso"));
  assert.equal(await servedPicture(page), null);
  await page.evaluate(() => goTo("#"));
  assert.notEqual(await servedPicture(page), null);
  writeTool();
  const before = await look(page);
  await page.setInputFiles("#tool-file", inFolder("tool.obj"));
  await page.waitForFunction(() => document.getElementById("served").hidden);
  assert.notEqual(await look(page), before);
  assert.deepEqual(page.problems, []);
  await page.close();
  assert.equal(await end(server, "SIGINT"), 0);
});

test("a page whose server has gone draws by itself", async () => {
  const { server, address } = await serve("angiogram.glb");
  const page = await open(browser, address);
  assert.notEqual(await servedPicture(page), null);
  const picture = await savePicture(page, "before.png", 256, 256);
  assert.equal(await end(server, "SIGINT"), 0);
  assert.ok(await psnr(page, await savePicture(page, "after.png", 256, 256), picture) >= 30, "saved, with all its shells");
  assert.equal(await servedPicture(page), null);
  assert.match(await page.textContent("#command"), /--layers smooth/);
  await page.evaluate(() => goTo("#azimuth=40"));
  nacre("render", "angiogram.glb", "--azimuth", "40", "--layers", "smooth", "--size", "256x256", "-o", "nacre.png", "-q");
  assert.ok(await psnr(page, await savePicture(page, "page.png", 256, 256), inFolder("nacre.png")) >= 40);
  await page.close();
});

test("levels are added, moved and deleted while it is served", async () => {
  const { server, address } = await serve("angiogram.nrrd", "--window", "400,1400", "--levels", "3", "--placement", "uniform");
  const page = await open(browser, address);
  const levels = () => page.locator(".shell input[type=number]").evaluateAll((all) => all.map((field) => Number(field.value)));
  const three = await levels();
  assert.equal(three.length, 3);
  let seen = await look(page);
  const changed = async (what) => {
    await settled(page);
    const now = await look(page);
    assert.notEqual(now, seen, what);
    seen = now;
  };
  await page.fill("#live-emission", "0.35");
  await page.click("#live-add");
  await page.waitForFunction(() => document.querySelectorAll(".shell").length === 4);
  await changed("added");
  await page.waitForFunction(() => document.getElementById("live").dataset.milliseconds);
  console.log(`a level was seen after ${await page.getAttribute("#live", "data-milliseconds")} ms`);
  const field = page.locator(".shell input[type=number]").nth(2);
  assert.equal(await field.inputValue(), "0.35");
  await field.fill("0.2");
  await field.press("Enter");
  await page.waitForFunction(() => [...document.querySelectorAll(".shell input[type=number]")].some((f) => f.value === "0.2"));
  await changed("moved");
  await page.locator(".shell button").nth(2).click();
  await page.waitForFunction(() => document.querySelectorAll(".shell").length === 3);
  assert.deepEqual(await levels(), three);
  await changed("deleted");
  await page.fill("#live-emission", "7");
  await page.click("#live-add");
  assert.match(await page.textContent("#message"), /found 7, expected above 0 and up to 1/);
  assert.equal(await statusOf(address, "/level?emission=x", undefined, "POST"), 400);
  assert.equal(await page.evaluate(() => document.documentElement.dataset.problem), undefined, "each shell was decoded");
  assert.deepEqual(page.problems, []);
  await page.close();
  assert.equal(await end(server, "SIGTERM"), 0);
});

test("a level to simplify is shown as it is first, then simplified, hidden or not", async () => {
  const { server, address } = await serve("angiogram.nrrd", "--window", "400,1400", "--levels", "2", "--tolerance", "0.05");
  const page = await open(browser, address);
  let simplify;
  const told = new Promise((resolve) => { simplify = resolve; });
  await page.route((asked) => asked.search === "?emission=0.4", async (route) => {
    await told;
    await route.continue();
  });
  await page.fill("#live-emission", "0.4");
  await page.press("#live-emission", "Enter");
  const row = page.locator(".shell", { has: page.getByLabel("Emission of the level at 0.4") });
  const triangles = async () => Number((await row.locator("small").last().textContent()).replace(",", ""));
  const draft = await triangles();
  await row.locator("input[type=checkbox]").uncheck();
  await page.locator("#live-progress", { hasText: "Simplifying the shell at 0.4" }).waitFor();
  simplify();
  await page.locator("#live-progress").waitFor({ state: "hidden" });
  assert.ok(await triangles() < draft, `${await triangles()} of ${draft} triangles`);
  assert.equal(await row.locator("input[type=checkbox]").isChecked(), false, "still hidden");
  assert.deepEqual(page.problems, []);
  await page.close();
  assert.equal(await end(server, "SIGINT"), 0);
});

test("a desktop's opener gets the address, no held signal and a group of its own, and is waited for", async () => {
  mkdirSync(inFolder("bin"));
  writeFileSync(inFolder("bin/xdg-open"), `#!/bin/sh
# By what the shell does itself: it holds all signals back for as long as a child takes to start.
while read -r name value; do [ "$name" = SigBlk: ] && mask=$value; done < /proc/$$/status
{ echo "$1"; echo $$; cut -d" " -f5 /proc/$$/stat; echo "SigBlk: $mask"; } > said.tmp
mv said.tmp said.txt
`, { mode: 0o755 });
  const { server, address } = await start(["view", "angiogram.glb"],
    { ...process.env, DISPLAY: ":0", PATH: `${inFolder("bin")}:${process.env.PATH}` });
  await until(() => existsSync(inFolder("said.txt")), "the opener was started");
  const [opened, pid, group, blocked] = readFileSync(inFolder("said.txt"), "utf8").trim().split("\n");
  assert.equal(opened, address);
  assert.match(blocked, /^SigBlk:\s*0+$/, "signals that stay blocked in the browser");
  assert.equal(group.trim(), pid, "Ctrl+C ends the server, not the browser");
  await until(() => !existsSync(`/proc/${pid}`), "nothing of the opener is left");
  assert.equal(await end(server, "SIGINT"), 0);
});

test("a port that is taken gets a line", async () => {
  const { server, address } = await serve("angiogram.glb");
  assert.throws(() => nacre("view", "angiogram.glb", "--no-open", "--port", new URL(address).port), (error) =>
    error.status === 4 && /found it taken/.test(String(error.stderr)));
  assert.equal(await end(server, "SIGINT"), 0);
});
