/**
 * The filter that estimates a maximum between the levels, from the picture's own covariances:
 * core/dequantization.cpp for one ray a pixel, docs/derivations.md, 3.5. The same ranks give the same
 * numbers as there: all sums are of whole numbers.
 */
import { clamp } from "./vector";

/** Weights of the pixels around, those 1, 1.4, 2, 2.2 and 2.8 steps away, a step of so many pixels. */
export interface LayerFilter { stride: number; weights: readonly number[] }

const classes = 5;
/** Mean squared difference of neighbours, in squared layers, up to which steps are made wider. */
const alike = 0.3;
/** Variance of what contours and simplifying leave in each class's sum, in squared layers. */
const otherErrors = 0.2;
const sampledRows = 128;
const mostStride = 16;
/** What quantising leaves, in squared layers. */
const variance = 1 / 12;
/** Neighbours beside and below: steps aside and down, the class. The others lie opposite. */
const neighbours = [
  [1, 0, 0], [0, 1, 0], [1, 1, 1], [-1, 1, 1], [2, 0, 2], [0, 2, 2],
  [2, 1, 3], [-2, 1, 3], [1, 2, 3], [-1, 2, 3], [2, 2, 4], [-2, 2, 4],
];
const asideOf = Int32Array.from(neighbours, ([x]) => x + 2);
const belowOf = Int32Array.from(neighbours, ([, y]) => y + 2);
const classOf = Int32Array.from(neighbours, ([, , index]) => index);

/** Sums over pixels that show a shell. */
interface Statistics {
  /** Of the classes' differences, row by row. */
  products: Float64Array;
  /** Of the differences to single neighbours. */
  squares: Float64Array;
  pixels: number;
}

/** Adds up row y; what lies outside the picture is as its border. */
function addRow(
  sums: Statistics, ranks: Uint16Array, width: number, height: number, stride: number, y: number,
): void {
  const { products, squares } = sums;
  const rows = new Int32Array(5); // where they begin
  const columns = new Int32Array(5);
  const differences = new Float64Array(classes);
  for (let i = 0; i < 5; ++i) rows[i] = width * clamp(y + (i - 2) * stride, 0, height - 1);
  for (let x = 0; x < width; ++x) {
    const center = ranks[rows[2] + x];
    if (center === 0) continue;
    sums.pixels += 1;
    for (let i = 0; i < 5; ++i) columns[i] = clamp(x + (i - 2) * stride, 0, width - 1);
    differences.fill(0);
    for (let i = 0; i < classOf.length; ++i) {
      const aside = asideOf[i];
      const below = belowOf[i];
      const difference = ranks[rows[below] + columns[aside]] - center;
      const opposite = ranks[rows[4 - below] + columns[4 - aside]] - center;
      squares[i] += difference * difference;
      differences[classOf[i]] += difference + opposite;
    }
    for (let i = 0; i < classes; ++i) {
      for (let j = 0; j <= i; ++j) products[classes * i + j] += differences[i] * differences[j];
    }
  }
}

function statisticsOf(ranks: Uint16Array, width: number, height: number, stride: number): Statistics {
  const sums = {
    products: new Float64Array(classes * classes), squares: new Float64Array(classOf.length), pixels: 0,
  };
  const step = Math.max(Math.floor(height / sampledRows), 1);
  for (let y = 0; y < height; y += step) addRow(sums, ranks, width, height, stride, y);
  return sums;
}

/** -E[(k(n) - k(p)) u(p)], u what quantising leaves, for a neighbour's mean squared difference. */
const covarianceWithError = (meanSquare: number): number =>
  meanSquare < 0.5 ? Math.min(variance, 0.5 * meanSquare * (1 - meanSquare)) : variance;

/** By Cholesky's factors, in place of the lower half of `a`, row by row. */
function solve(a: Float64Array, b: Float64Array): number[] {
  for (let i = 0; i < classes; ++i) {
    for (let j = 0; j <= i; ++j) {
      let rest = a[classes * i + j];
      for (let k = 0; k < j; ++k) rest -= a[classes * i + k] * a[classes * j + k];
      if (i === j && !(rest > 0)) return Array(classes).fill(0);
      a[classes * i + j] = i === j ? Math.sqrt(rest) : rest / a[classes * j + j];
    }
    for (let k = 0; k < i; ++k) b[i] -= a[classes * i + k] * b[k];
    b[i] /= a[classes * i + i];
  }
  for (let i = classes - 1; i >= 0; --i) {
    for (let k = i + 1; k < classes; ++k) b[i] -= a[classes * k + i] * b[k];
    b[i] /= a[classes * i + i];
  }
  return [...b];
}

/** All 0 where nothing is to be told. */
function weightsOf({ products, squares, pixels }: Statistics): number[] {
  if (pixels === 0) return Array(classes).fill(0);
  const right = new Float64Array(classes);
  for (let i = 0; i < classes; ++i) products[classes * i + i] += otherErrors * pixels;
  squares.forEach((sum, i) => { // each stands for the opposite one as well
    right[classOf[i]] += 2 * pixels * covarianceWithError(sum / pixels);
  });
  return solve(products, right);
}

const meanSquare = ({ squares, pixels }: Statistics): number =>
  pixels > 0 ? (0.5 * (squares[0] + squares[1])) / pixels : 1;

/** 1, 2, 3, 4, 6, 8, 12, 16 */
const widerThan = (stride: number): number =>
  (stride & (stride - 1)) === 0 ? Math.max(stride + (stride >> 1), stride + 1) : (stride / 3) * 4;

/** @param ranks  the layers that pixels show, by number, the background's being 0; row by row */
export function layerFilter(ranks: Uint16Array, width: number, height: number): LayerFilter {
  let stride = 1;
  let sums = statisticsOf(ranks, width, height, 1);
  for (let next = 2; next <= mostStride; next = widerThan(stride)) {
    // Differences grow at least as the distance does.
    if (meanSquare(sums) * next > alike * stride) break;
    const wider = statisticsOf(ranks, width, height, next);
    if (meanSquare(wider) > alike) break;
    stride = next;
    sums = wider;
  }
  return { stride, weights: weightsOf(sums) };
}
