/**
 * Maxima between the levels, as `nacre render --layers smooth` draws them: ranks are drawn as colours,
 * and read back once a picture has come to rest, for its own weights. Until then it has the last
 * one's: no pixel leaves its layer, whatever the weights.
 */
import { ProgramFamily, Target, type UniformValue } from "./gl_objects";
import { layerFilter, type LayerFilter } from "./layer_statistics";
import { columnsSource, rankSource } from "./layer_shaders";
import type { Plan } from "./plan";
import { screenVertexSource } from "./shaders";

const timing = "layers";

const none: LayerFilter = { stride: 0, weights: [0, 0, 0, 0, 0] };

export class LayerEstimate {
  /** Two bytes of the rank, and whether background stays black. */
  readonly ranks: Target;
  /** Ranks with sums of those above and below: what the display reads. */
  readonly columns: Target;
  private readonly families: Record<"ranks" | "columns", ProgramFamily>;
  private filter = none;
  private pixels = new Uint8Array(0);

  constructor(private readonly gl: WebGL2RenderingContext) {
    this.ranks = new Target(gl, gl.RGBA8, 0);
    this.columns = new Target(gl, gl.RGBA16UI, 0);
    this.families = {
      ranks: new ProgramFamily(gl, screenVertexSource, rankSource),
      columns: new ProgramFamily(gl, screenVertexSource, columnsSource),
    };
  }

  /** Whether some picture has had weights. */
  get isKnown(): boolean { return this.filter.weights.some((weight) => weight !== 0); }

  get uniforms(): Record<string, UniformValue> {
    const { stride, weights } = this.filter;
    return { stride: this.isKnown ? stride : 0, weights: weights.slice(0, 4), far_weight: weights[4] };
  }

  /** What numbers the display and `drawRanks` look up. */
  tablesOf(plan: Plan): number[][] {
    const { layers } = plan;
    const starts = plan.passes.find((pass) => pass.kind === "startCounts");
    return [
      layers.map(({ shown }) => shown), starts?.rankOfCount ?? [0], [0],
      layers.map(({ lo, shown }) => 2 * (shown - lo)), layers.map(({ shown, hi }) => 2 * (hi - shown)),
    ];
  }

  /** Draws the ranks; their target and textures are bound. */
  drawRanks(defines: string[], uniforms: Record<string, UniformValue>): void {
    this.families.ranks.with(defines).use(uniforms);
    this.gl.drawArrays(this.gl.TRIANGLES, 0, 3);
  }

  /** Adds ranks up, a column of five at a time. */
  drawColumns(width: number, height: number): void {
    const { gl } = this;
    this.columns.begin(width, height, null);
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, this.ranks.color);
    this.families.columns.with([]).use({ ranks: 0, stride: this.filter.stride });
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  /** Takes the weights from what was drawn; false if they stay. */
  measure(width: number, height: number): boolean {
    const { gl, filter } = this;
    const start = performance.now();
    const count = 4 * width * height;
    if (this.pixels.length < count) this.pixels = new Uint8Array(count);
    this.ranks.bind();
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, this.pixels);
    const ranks = new Uint16Array(this.pixels.buffer, 0, width * height);
    const bytes = this.pixels; // ranks are written before where they are read
    for (let i = 0; i < width * height; ++i) ranks[i] = bytes[4 * i] | (bytes[4 * i + 1] << 8);
    this.filter = layerFilter(ranks, width, height);
    performance.clearMeasures(timing); // user timing, for those who measure
    performance.measure(timing, { start });
    return this.filter.stride !== filter.stride || this.filter.weights.some((weight, i) => weight !== filter.weights[i]);
  }
}
