/**
 * Maxima that the server draws: `nacre view` draws them with the machine's processor in a few
 * milliseconds, a browser without a GPU in a tenth of a second and more.
 */
import { colorMapBytes } from "./color_maps";
import { flagsOf, type State } from "./state";

const softwareNames = /swiftshader|llvmpipe|softpipe|software|basic render/i;

/** Whether WebGL is drawn by the processor, as far as the browser tells. */
export function drawsInSoftware(gl: WebGL2RenderingContext): boolean {
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  return softwareNames.test(String(gl.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : gl.RENDERER)));
}

/** Flags of how a picture is shown, which is done here. */
const shownHere = ["colormap", "tool-blend"];

/** The colours of the 256 steps of the window. */
const paletteOf = (name: string): Uint32Array<ArrayBuffer> => new Uint32Array(colorMapBytes(name, 256).slice().buffer);

/**
 * The colours of bytes that the server has packed: how many zeros, how many others (two bytes each,
 * the lower first), then those; again until all are said.
 */
export function unpackRuns(packed: Uint8Array, palette: Uint32Array, colors: Uint32Array): void {
  let to = 0;
  for (let from = 0; from < packed.length;) {
    const zeros = packed[from] | (packed[from + 1] << 8);
    const others = packed[from + 2] | (packed[from + 3] << 8);
    from += 4;
    if (from + others > packed.length || to + zeros + others > colors.length) break;
    colors.fill(palette[0], to, to + zeros);
    to += zeros;
    for (const end = from + others; from < end; ++from, ++to) colors[to] = palette[packed[from]];
  }
  if (to !== colors.length) throw new Error(`found ${to} pixels, expected ${colors.length}`);
}

/** A picture longer under way than this will not come, ms. */
const patience = 30_000;

/** The server is there, but does not draw what was asked for. */
export class Refused extends Error {}

export class ServedPictures {
  private underWay: AbortController | null = null;

  /** @param address  of the server's pictures */
  constructor(private readonly address: string) {}

  /** Ends what is under way: nobody waits for it any more. */
  stop(): void { this.underWay?.abort(new Refused("not wanted any more")); }

  /** Whether the server draws what the state asks for, tools aside. */
  draws(state: State): boolean { return state.mode === "max"; }

  /**
   * The state's picture, window and colour map included.
   * @param soon      smooth layers in place of fine ones
   * @throws Refused  if the server does not draw it, or it is stopped; other errors if it is gone
   */
  async picture(
    state: State, width: number, height: number, soon: boolean,
  ): Promise<ImageData> {
    const flags = flagsOf(state).filter(([name]) => !shownHere.includes(name));
    const all = new URLSearchParams([...flags, ["size", `${width}x${height}`], ["layers", soon ? "smooth" : "fine"]]);
    const palette = paletteOf(state.colorMap);
    const stopped = new AbortController();
    this.underWay = stopped;
    const timer = setTimeout(() => stopped.abort(), patience);
    try {
      const answer = await fetch(`${this.address}?${all}`, { signal: stopped.signal });
      if (!answer.ok) throw new Refused(await answer.text());
      const picture = new ImageData(width, height);
      unpackRuns(new Uint8Array(await answer.arrayBuffer()), palette, new Uint32Array(picture.data.buffer));
      return picture;
    } finally {
      clearTimeout(timer);
    }
  }
}
