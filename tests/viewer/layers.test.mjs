// Maxima between the levels: the filter against core/dequantization.h, the page's pictures against
// `nacre render --layers smooth`, and layers as they are where nothing is estimated.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { differences, goTo, inFolder, launch, look, makeAngiogram, nacreAll, open, savePicture, settled } from "./support.mjs";

const modules = process.env.NACRE_VIEWER_MODULES;
const sources = join(dirname(fileURLToPath(import.meta.url)), "../../viewer/src");
const { build } = createRequire(join(modules, "here.js"))("esbuild");
const imported = async (name) => {
  const bundle = await build({ entryPoints: [join(sources, name)], bundle: true, write: false, format: "esm" });
  return import(`data:text/javascript,${encodeURIComponent(bundle.outputFiles[0].text)}`);
};
const { layerFilter } = await imported("layer_statistics.ts");
const { layerRanges, layersOfRanks } = await imported("layers.ts");

/** A hill of layers, and single pixels around it. */
function hill(width, height, steepness) {
  const ranks = new Uint16Array(width * height);
  for (let y = 0; y < height; ++y) {
    for (let x = 0; x < width; ++x) {
      const depth = ((x - 37) ** 2 + 2 * (y - 30) ** 2) >> steepness;
      ranks[y * width + x] = depth < 11 ? 11 - depth : Number((x * y) % 97 === 0);
    }
  }
  return ranks;
}

// What `layer_filter` makes of the same pictures.
const known = [
  { width: 80, height: 60, steepness: 6, stride: 1,
    weights: [0.06206251043314532, 0.064120702802835758, 0.08842099780696161, -0.0013237870823029198, 0.029972111401268126] },
  { width: 150, height: 300, steepness: 3, stride: 1,
    weights: [0.65623225384114248, -0.066308095434479797, 0.52886272574875992, -0.21818697695265943, -0.0541376792120516] },
  { width: 200, height: 90, steepness: 12, stride: 12,
    weights: [0.11042350980902667, 0.075218448650408234, 0.074434852068483034, 0.028001272433032746, -0.067108611836097662] },
];

test("weights are those of the command", () => {
  for (const { width, height, steepness, stride, weights } of known) {
    const filter = layerFilter(hill(width, height, steepness), width, height);
    assert.equal(filter.stride, stride);
    filter.weights.forEach((weight, i) => assert.ok(Math.abs(weight - weights[i]) < 1e-12, `${weight} and ${weights[i]}`));
  }
});

test("a black picture and one of one layer have weights that change nothing", () => {
  assert.deepEqual(layerFilter(new Uint16Array(35), 7, 5).weights, [0, 0, 0, 0, 0]);
  assert.ok(layerFilter(new Uint16Array(35).fill(3), 7, 5).weights.every((weight) => weight === 0));
});

test("layers lie between levels, if their representatives do", () => {
  const levels = [{ emission: 0.25, representative: 0.5 }, { emission: 0.75, representative: 1 }];
  assert.deepEqual(layerRanges(levels, 1),
    [{ lo: 0, shown: 0, hi: 0.25 }, { lo: 0.25, shown: 0.5, hi: 0.75 }, { lo: 0.75, shown: 1, hi: 1 }]);
  assert.deepEqual(layersOfRanks(levels, 0.5, [0, 0.5]), [{ lo: 0, shown: 0, hi: 0.125 }, { lo: 0.375, shown: 0.5, hi: 0.5 }]);
  assert.deepEqual(layersOfRanks([{ emission: 0.5, representative: 0.25 }], 1, [0, 0.25]), []);
});

const browser = await launch();
after(() => browser.close());
const side = 256;

// Single pixels at layers' edges fall to either side, and those around take part in that.
const mostBeyondOne = 0.03;
const mostBeyondEight = 0.005;
const smooth = ["", "azimuth=25&elevation=15&zoom=1.3", "zoom=8&look-at=-36.5,0,-23", "azimuth=25&perspective=50", "slab=-8,9",
  "azimuth=15&perspective=90&distance=40&look-at=-10,-10,-20", "cue=0,0.5,0.2"];

let url;
let page;
let drawn = [];
before(async () => {
  url = makeAngiogram();
  const render = (hash, layers, name) => ["render", "angiogram.glb", "--size", `${side}x${side}`,
    ...hash.split("&").filter(Boolean).map((flag) => `--${flag}`), "--layers", layers, "-o", name, "-q"];
  drawn = nacreAll([...smooth.map((hash, k) => render(hash, "smooth", `${k}.png`)),
    render("", "flat", "flat.png"), render("hide=2,3", "flat", "hidden.png")]);
  page = await open(browser, `${url}?hint=off`, { width: 800, height: 300 });
});

for (const [k, hash] of smooth.entries()) {
  test(`between the levels: ${hash || "the first view"}`, async () => {
    await drawn[k];
    await goTo(page, hash);
    assert.match(await page.textContent("#command"), /--layers smooth/);
    const found = await differences(page, await savePicture(page, "page.png", side, side), inFolder(`${k}.png`));
    console.log(`off by more than 1/255: ${(100 * found.one).toFixed(2)} % of the pixels, 8/255: ${(100 * found.eight).toFixed(2)} %`);
    assert.ok(found.one <= mostBeyondOne && found.eight <= mostBeyondEight, JSON.stringify(found));
  });
}

for (const [name, hash, file] of [["under a cue", "cue=0.0001,1,0", "flat.png"], ["shells hidden", "hide=2,3", "hidden.png"]]) {
  test(`layers as they are: ${name}`, async () => {
    await Promise.all(drawn);
    await goTo(page, hash);
    assert.doesNotMatch(await page.textContent("#command"), /--layers/);
    const found = await differences(page, await savePicture(page, "page.png", side, side), inFolder(file));
    console.log(`${name}: off by more than 1/255: ${(100 * found.one).toFixed(2)} % of the pixels`);
    assert.ok(found.one <= mostBeyondEight, JSON.stringify(found));
  });
}

test("a picture that has come to rest is as one that never moved", async () => {
  await goTo(page, "zoom=4");
  await page.focus("#picture");
  for (let turn = 0; turn < 3; ++turn) await page.keyboard.press("ArrowRight");
  await settled(page);
  const azimuth = (await page.textContent("#command")).match(/--azimuth (\S+)/)[1];
  const other = await open(browser, `${url}?hint=off#zoom=4&azimuth=${azimuth}`, { width: 800, height: 300 });
  await page.evaluate(() => document.activeElement.blur()); // what has the keys is framed
  await settled(page);
  const [moved, still] = [await look(page), await look(other)];
  assert.ok(moved === still, "both look alike");
  assert.deepEqual([...page.problems, ...other.problems], []);
});
