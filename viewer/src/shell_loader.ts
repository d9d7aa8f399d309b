/**
 * Keeps the meshes of shells that pictures want: compressed ones are decoded brightest first, one at
 * a time, so that a changed wish takes effect at once.
 */
import type { DecodeReply, DecodeRequest } from "./decoder";
import { deleteMesh, uploadMesh, type GpuMesh } from "./meshes";
import { trianglesOf, type Surface } from "./shell_set";

interface Decoder { send(request: DecodeRequest): void }

type Serve = (post: (reply: DecodeReply) => void) => (request: DecodeRequest) => void;

/** A worker; where the browser refuses one, the same code in the page. */
function startDecoder(source: string, receive: (reply: DecodeReply) => void): Decoder {
  const inPage = (): Decoder => {
    const script = document.createElement("script");
    script.textContent = source;
    document.head.append(script);
    const serve = (globalThis as { nacreDecoder?: Serve }).nacreDecoder!;
    const answer = serve(receive);
    return { send: (request) => void setTimeout(() => answer(request)) };
  };
  try {
    const url = URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
    const worker = new Worker(url);
    let decoder: Decoder = { send: (request) => worker.postMessage(request) };
    let last: DecodeRequest | null = null;
    worker.onmessage = (event: MessageEvent<DecodeReply>) => receive(event.data);
    worker.onerror = () => {
      decoder = inPage();
      if (last) decoder.send(last);
    };
    return { send: (request) => { last = request; decoder.send(request); } };
  } catch {
    return inPage();
  }
}

export interface LoadingState { wanted: number; loaded: number; problem: string }

export class ShellLoader {
  problem = "";
  private readonly meshes = new Map<Surface, GpuMesh>();
  /** Surfaces that show the mesh of another until their own is there. */
  private readonly borrowed = new Set<Surface>();
  private readonly refused = new Set<Surface>();
  private queue: Surface[] = [];
  private wanted: Surface[] = [];
  private normals = false;
  private inFlight: { id: number; surface: Surface; normals: boolean } | null = null;
  private nextId = 1;
  private readonly decoder: Decoder;

  constructor(
    private readonly gl: WebGL2RenderingContext,
    source: string,
    private readonly changed: () => void,
  ) {
    this.decoder = startDecoder(source, (reply) => this.receive(reply));
  }

  /** What there is to draw it with; where normals are needed, only what has them. */
  meshOf(surface: Surface, normals: boolean): GpuMesh | undefined {
    const mesh = this.meshes.get(surface);
    return mesh && (mesh.hasNormals || !normals) ? mesh : undefined;
  }

  /** Says which surfaces are wanted, the most urgent first. */
  want(surfaces: Surface[], normals: boolean): void {
    this.wanted = surfaces.filter((surface) => surface.bytes.length > 0);
    this.normals = normals;
    this.queue = this.wanted.filter((surface) => !this.isThere(surface) && !this.refused.has(surface));
    this.next();
  }

  /** Progress, in triangles: what decoding time goes with. */
  state(): LoadingState {
    return {
      wanted: trianglesOf(this.wanted),
      loaded: trianglesOf(this.wanted.filter((surface) => this.isThere(surface) || this.refused.has(surface))),
      problem: this.problem,
    };
  }

  /** A surface in place of another: shows its mesh until its own is decoded. */
  replace(old: Surface, by: Surface): void {
    const mesh = this.meshes.get(old);
    this.meshes.delete(old);
    this.forget(old);
    if (!mesh) return;
    this.meshes.set(by, mesh);
    this.borrowed.add(by);
  }

  /** Whether the surface shows its own shell, or has none. */
  isSettled(surface: Surface): boolean {
    return surface.bytes.length === 0 || this.refused.has(surface) || (this.meshes.has(surface) && !this.borrowed.has(surface));
  }

  forget(surface: Surface): void {
    const mesh = this.meshes.get(surface);
    if (mesh) deleteMesh(this.gl, mesh);
    this.meshes.delete(surface);
    this.refused.delete(surface);
    this.borrowed.delete(surface);
    if (this.inFlight?.surface === surface) this.inFlight = null; // its answer is then passed over
  }

  /** Whether its bytes were damaged: it is not shown at all. */
  isRefused(surface: Surface): boolean { return this.refused.has(surface); }

  /** After a lost context: nothing is there any more. */
  forgetAll(): void {
    this.meshes.clear();
    this.borrowed.clear();
  }

  private isThere(surface: Surface): boolean {
    const mesh = this.meshes.get(surface);
    return mesh !== undefined && !this.borrowed.has(surface) && (mesh.hasNormals || !this.normals);
  }

  private next(): void {
    if (this.inFlight) return;
    const surface = this.queue.shift();
    if (!surface) return;
    this.inFlight = { id: this.nextId++, surface, normals: this.normals };
    this.decoder.send({
      id: this.inFlight.id, bytes: surface.bytes.slice(), checksum: surface.checksum,
      triangles: surface.triangles, vertices: surface.vertices, lo: surface.bounds.lo,
      hi: surface.bounds.hi, border: surface.border, normals: this.normals,
    });
  }

  private receive(reply: DecodeReply): void {
    const done = this.inFlight;
    if (!done || done.id !== reply.id) return;
    this.inFlight = null;
    if (reply.mesh && !this.gl.isContextLost()) {
      this.forget(done.surface);
      this.meshes.set(done.surface, uploadMesh(this.gl, reply.mesh));
    } else if (reply.problem) {
      this.refused.add(done.surface);
      this.problem = `${done.surface.name}: ${reply.problem}`;
    }
    this.want(this.wanted, this.normals);
    this.changed();
  }
}
