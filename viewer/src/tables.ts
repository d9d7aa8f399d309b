/** What the display looks brightness and colours up in. */
import { colorMapBytes } from "./color_maps";
import { texture } from "./gl_objects";

const mapSteps = 1024;

export class Tables {
  readonly numbers: WebGLTexture;
  readonly colors: WebGLTexture;
  private shownMap = "";

  constructor(private readonly gl: WebGL2RenderingContext) {
    this.numbers = gl.createTexture()!;
    this.colors = texture(gl, gl.RGBA8, mapSteps, 1, gl.LINEAR);
  }

  /** Fills the texture of numbers; the lengths of the first three rows. */
  fill(rows: readonly (readonly number[])[]): number[] {
    const { gl } = this;
    const width = Math.max(...rows.map((row) => row.length));
    const texels = new Float32Array(width * rows.length);
    rows.forEach((row, i) => texels.set(row, i * width));
    gl.bindTexture(gl.TEXTURE_2D, this.numbers);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.R32F, width, rows.length, 0, gl.RED, gl.FLOAT, texels);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    return rows.slice(0, 3).map((row) => row.length);
  }

  fillColors(name: string): void {
    if (name === this.shownMap) return;
    const { gl } = this;
    gl.bindTexture(gl.TEXTURE_2D, this.colors);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, mapSteps, 1, gl.RGBA, gl.UNSIGNED_BYTE,
      colorMapBytes(name, mapSteps));
    this.shownMap = name;
  }
}
