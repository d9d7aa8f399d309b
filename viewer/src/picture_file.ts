/** Pictures as files. */

/** Longer side of the picture that a mode's own window is found in, pixels. */
export const ownWindowSide = 256;

/** Draws into a target of that size and gives it back as a PNG. */
export async function pngOf(
  gl: WebGL2RenderingContext, width: number, height: number,
  draw: (target: WebGLFramebuffer) => void,
): Promise<Blob> {
  const most = gl.getParameter(gl.MAX_RENDERBUFFER_SIZE) as number;
  if (width > most || height > most) throw new Error(`pictures here have at most ${most} pixels a side`);
  const target = gl.createFramebuffer()!;
  const color = gl.createRenderbuffer()!;
  gl.bindRenderbuffer(gl.RENDERBUFFER, color);
  gl.renderbufferStorage(gl.RENDERBUFFER, gl.RGBA8, width, height);
  gl.bindFramebuffer(gl.FRAMEBUFFER, target);
  gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.RENDERBUFFER, color);
  draw(target);
  gl.bindFramebuffer(gl.FRAMEBUFFER, target);
  const pixels = new Uint8ClampedArray(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(pixels.buffer));
  gl.deleteFramebuffer(target);
  gl.deleteRenderbuffer(color);
  return encoded(new ImageData(flipped(pixels, width, height), width, height));
}

/** Rows in the other order: OpenGL's first is the lowest. */
function flipped(pixels: Uint8ClampedArray, width: number, height: number): Uint8ClampedArray<ArrayBuffer> {
  const rows = new Uint8ClampedArray(pixels.length);
  for (let y = 0; y < height; ++y) {
    const from = 4 * width * (height - 1 - y);
    rows.set(pixels.subarray(from, from + 4 * width), 4 * width * y);
  }
  return rows;
}

/** As a PNG. */
export function encoded(picture: ImageData): Promise<Blob> {
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [picture.width, picture.height];
  canvas.getContext("2d")!.putImageData(picture, 0, 0);
  return new Promise((resolve, reject) => canvas.toBlob(
    (blob) => (blob ? resolve(blob) : reject(new Error("the browser made no PNG"))), "image/png"));
}

/** Hands a file to the user. */
export function download(blob: Blob, name: string): void {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}
