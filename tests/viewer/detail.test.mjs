// How much detail a moving picture has, judged by made-up frame times: no browser, no clock.
import assert from "node:assert/strict";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";

const modules = process.env.NACRE_VIEWER_MODULES;
const source = join(dirname(fileURLToPath(import.meta.url)), "../../viewer/src/detail.ts");
const { build } = createRequire(join(modules, "here.js"))("esbuild");
const bundle = await build({ entryPoints: [source], bundle: true, write: false, format: "esm" });
const { Detail } = await import(`data:text/javascript,${encodeURIComponent(bundle.outputFiles[0].text)}`);

const isWhole = ({ scale, stride, isCoarse }) => scale === 1 && stride === 1 && !isCoarse;

/** Draws frames that take `milliseconds(amount)`; what each had. */
function drawn(detail, frames, milliseconds) {
  return Array.from({ length: frames }, () => {
    const amount = { ...detail.amount };
    detail.account(milliseconds(amount));
    return amount;
  });
}

const ofTriangles = (whole) => ({ stride }) => whole / stride;
const always = (milliseconds) => () => milliseconds;

function detailOfSet(copies = 1) {
  const detail = new Detail();
  detail.begin(copies);
  return detail;
}

test("frames in time are whole", () => {
  assert.ok(drawn(detailOfSet(), 200, always(20)).every(isWhole));
});

test("less detail stays where it helps", () => {
  const amounts = drawn(detailOfSet(), 200, ofTriangles(60));
  assert.equal(amounts.at(-1).stride, 2);
  assert.ok(amounts.filter(isWhole).length < 40);
});

test("detail that helps no longer is given back, each time", () => {
  const detail = detailOfSet();
  for (const time of ["first", "second", "third"]) {
    drawn(detail, 100, ofTriangles(60));
    assert.ok(!isWhole(drawn(detail, 12, ofTriangles(60)).at(-1)), `${time} time: it helped`);
    const amounts = drawn(detail, 700, always(50));
    assert.ok(isWhole(amounts.at(-1)), `${time} time: ${JSON.stringify(amounts.at(-1))}`);
  }
});

test("what stays late but helps is not shown whole again and again", () => {
  const amounts = drawn(detailOfSet(), 20_000, ({ stride }) => 2000 / stride);
  const whole = amounts.slice(100).filter(isWhole).length;
  assert.ok(whole <= 10, `${whole} of ${amounts.length} frames were whole, 2 s each`);
  assert.equal(amounts.at(-1).stride, 6);
});

test("copies come first, where the set has them and they are worth it", () => {
  const cost = ({ isCoarse, stride }) => (isCoarse ? 20 : 60) / stride;
  const amounts = drawn(detailOfSet(0.3), 60, cost);
  assert.ok(amounts.at(-1).isCoarse);
  assert.ok(amounts.every(({ stride, scale }) => stride === 1 && scale === 1));
});
