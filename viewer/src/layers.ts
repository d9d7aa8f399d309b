/** Between which levels a maximum is estimated: plan_layers of render/planning_max.cpp, core/dequantization.h. */

/** What the pixels of one layer show, and may really be. */
export interface LayerRange {
  /** Its level; 0 for the background. */
  lo: number;
  /** The representative. */
  shown: number;
  /** The next level, or the largest emission. */
  hi: number;
}

/** A shell's level and its representative. */
export interface LayerLevel { emission: number; representative: number }

/** Sums of two ranks are drawn as two bytes. */
const mostLayers = 32768;

/**
 * The layers between levels that are all shown, the background first; those that are shown alike are
 * one. None where a layer does not contain its representative. In floats, as the command has them.
 *
 * @param factor  of all emissions: that of a cue which is the same at all depths
 */
export function layerRanges(levels: readonly LayerLevel[], factor: number): LayerRange[] {
  const most = Math.fround(factor);
  const layers: LayerRange[] = [{ lo: 0, shown: 0, hi: most }];
  for (const level of levels) {
    const last = layers[layers.length - 1];
    const emission = Math.fround(factor * level.emission);
    const shown = Math.fround(factor * level.representative);
    if (shown === last.shown) continue;
    last.hi = emission;
    layers.push({ lo: emission, shown, hi: most });
  }
  const areContained = layers.every(({ lo, shown, hi }) => lo <= shown && shown <= hi);
  return areContained ? layers : [];
}

/** The layers that pixels show, one for each rank; none where a rank is no layer's. */
export function layersOfRanks(
  levels: readonly LayerLevel[], factor: number, emissionOfRank: readonly number[],
): LayerRange[] {
  if (factor === 0) return [];
  const known = new Map(layerRanges(levels, factor).map((layer) => [layer.shown, layer]));
  const layers = emissionOfRank.flatMap((emission) => known.get(Math.fround(emission)) ?? []);
  const isWhole = layers.length === emissionOfRank.length && layers.length <= mostLayers;
  return isWhole ? layers : [];
}
