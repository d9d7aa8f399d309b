/**
 * Keeps the meshes of shells that pictures want: compressed ones are decoded brightest first, one at
 * a time, so that a changed wish takes effect at once.
 */
import type { DecodeReply, DecodeRequest } from "./decoder";
import { deleteMesh, uploadMesh, type GpuMesh } from "./meshes";
import type { Level } from "./shell_set";

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
  private readonly meshes = new Map<Level, GpuMesh>();
  /** Levels that show the mesh of another until their own is there. */
  private readonly borrowed = new Set<Level>();
  private readonly refused = new Set<Level>();
  private queue: Level[] = [];
  private wanted: Level[] = [];
  private normals = false;
  private inFlight: { id: number; level: Level; normals: boolean } | null = null;
  private nextId = 1;
  private readonly decoder: Decoder;

  constructor(
    private readonly gl: WebGL2RenderingContext,
    source: string,
    private readonly changed: () => void,
  ) {
    this.decoder = startDecoder(source, (reply) => this.receive(reply));
  }

  meshOf(level: Level): GpuMesh | undefined { return this.meshes.get(level); }

  /** Says which shells are wanted, the most urgent first. */
  want(levels: Level[], normals: boolean): void {
    this.wanted = levels.filter((level) => level.bytes.length > 0);
    this.normals = normals;
    this.queue = this.wanted.filter((level) => !this.isThere(level) && !this.refused.has(level));
    this.next();
  }

  /** Progress, in triangles: what decoding time goes with. */
  state(): LoadingState {
    const triangles = (levels: Level[]): number => levels.reduce((sum, l) => sum + l.triangles, 0);
    return {
      wanted: triangles(this.wanted),
      loaded: triangles(this.wanted.filter((level) => this.isThere(level) || this.refused.has(level))),
      problem: this.problem,
    };
  }

  /** A level in place of another: shows its mesh until its own is decoded. */
  replace(old: Level, by: Level): void {
    const mesh = this.meshes.get(old);
    this.meshes.delete(old);
    this.forget(old);
    if (!mesh) return;
    this.meshes.set(by, mesh);
    this.borrowed.add(by);
  }

  /** Whether the level shows its own shell, or has none. */
  isSettled(level: Level): boolean {
    return level.bytes.length === 0 || this.refused.has(level) || (this.meshes.has(level) && !this.borrowed.has(level));
  }

  forget(level: Level): void {
    const mesh = this.meshes.get(level);
    if (mesh) deleteMesh(this.gl, mesh);
    this.meshes.delete(level);
    this.refused.delete(level);
    this.borrowed.delete(level);
    if (this.inFlight?.level === level) this.inFlight = null; // its answer is then passed over
  }

  /** After a lost context: nothing is there any more. */
  forgetAll(): void {
    this.meshes.clear();
    this.borrowed.clear();
  }

  private isThere(level: Level): boolean {
    const mesh = this.meshes.get(level);
    return mesh !== undefined && !this.borrowed.has(level) && (mesh.hasNormals || !this.normals);
  }

  private next(): void {
    if (this.inFlight) return;
    const level = this.queue.shift();
    if (!level) return;
    this.inFlight = { id: this.nextId++, level, normals: this.normals };
    this.decoder.send({
      id: this.inFlight.id, bytes: level.bytes.slice(), checksum: level.checksum,
      triangles: level.triangles, vertices: level.vertices, lo: level.bounds.lo,
      hi: level.bounds.hi, normals: this.normals,
    });
  }

  private receive(reply: DecodeReply): void {
    const done = this.inFlight;
    if (!done || done.id !== reply.id) return;
    this.inFlight = null;
    if (reply.mesh && !this.gl.isContextLost()) {
      this.forget(done.level);
      this.meshes.set(done.level, uploadMesh(this.gl, reply.mesh));
    } else if (reply.problem) {
      this.refused.add(done.level);
      this.problem = `Shell at emission ${done.level.emission.toPrecision(3)}: ${reply.problem}`;
    }
    this.want(this.wanted, this.normals);
    this.changed();
  }
}
