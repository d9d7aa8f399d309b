/** Programs and targets of WebGL2. */

export type UniformValue = number | boolean | readonly number[];
type Setter = (value: UniformValue) => void;

function setterOf(gl: WebGL2RenderingContext, type: number, at: WebGLUniformLocation): Setter {
  const list = (value: UniformValue): number[] => value as number[];
  switch (type) {
    case gl.FLOAT: return (v) => gl.uniform1f(at, v as number);
    case gl.FLOAT_VEC2: return (v) => gl.uniform2fv(at, list(v));
    case gl.FLOAT_VEC3: return (v) => gl.uniform3fv(at, list(v));
    case gl.FLOAT_VEC4: return (v) => gl.uniform4fv(at, list(v));
    case gl.FLOAT_MAT3: return (v) => gl.uniformMatrix3fv(at, false, list(v));
    case gl.INT_VEC3: return (v) => gl.uniform3iv(at, list(v));
    default: return (v) => gl.uniform1i(at, Number(v)); // int, bool, samplers
  }
}

export class Program {
  private readonly setters = new Map<string, Setter>();

  constructor(private readonly gl: WebGL2RenderingContext, readonly id: WebGLProgram) {
    const count = gl.getProgramParameter(id, gl.ACTIVE_UNIFORMS) as number;
    for (let i = 0; i < count; ++i) {
      const info = gl.getActiveUniform(id, i)!;
      this.setters.set(info.name, setterOf(gl, info.type, gl.getUniformLocation(id, info.name)!));
    }
  }

  use(uniforms: Record<string, UniformValue>): void {
    this.gl.useProgram(this.id);
    this.set(uniforms);
  }

  /** A uniform without effect in the program is passed over. */
  set(uniforms: Record<string, UniformValue>): void {
    for (const name in uniforms) this.setters.get(name)?.(uniforms[name]);
  }
}

function compile(gl: WebGL2RenderingContext, type: number, source: string): WebGLShader {
  const shader = gl.createShader(type)!;
  gl.shaderSource(shader, source);
  gl.compileShader(shader);
  return shader;
}

function link(gl: WebGL2RenderingContext, vertex: string, fragment: string): WebGLProgram {
  const program = gl.createProgram()!;
  const shaders = [
    compile(gl, gl.VERTEX_SHADER, vertex), compile(gl, gl.FRAGMENT_SHADER, fragment),
  ];
  for (const shader of shaders) gl.attachShader(program, shader);
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
    const logs = shaders.map((shader) => gl.getShaderInfoLog(shader)).join("\n");
    throw new Error(`shader refused: ${logs}${gl.getProgramInfoLog(program)}`);
  }
  for (const shader of shaders) gl.deleteShader(shader);
  return program;
}

/** Programs of one source, compiled when a combination of features is first used. */
export class ProgramFamily {
  private readonly programs = new Map<string, Program>();

  constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly vertex: string,
    private readonly fragment: string,
  ) {}

  /** @param defines  names, or "NAME value" */
  with(defines: readonly string[]): Program {
    const key = defines.join("|");
    let program = this.programs.get(key);
    if (!program) {
      const head = `#version 300 es\n${defines.map((define) => `#define ${define}\n`).join("")}`;
      program = new Program(this.gl, link(this.gl, head + this.vertex, head + this.fragment));
      this.programs.set(key, program);
    }
    return program;
  }
}

export function texture(
  gl: WebGL2RenderingContext, format: number, width: number, height: number,
  filter: number = gl.NEAREST,
): WebGLTexture {
  const made = gl.createTexture()!;
  gl.bindTexture(gl.TEXTURE_2D, made);
  gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
  for (const side of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) {
    gl.texParameteri(gl.TEXTURE_2D, side, filter);
  }
  for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) {
    gl.texParameteri(gl.TEXTURE_2D, wrap, gl.CLAMP_TO_EDGE);
  }
  return made;
}

/** What passes draw into: a colour or a depth texture, or both; 0: none. */
export class Target {
  color: WebGLTexture | null = null;
  depth: WebGLTexture | null = null;
  private framebuffer: WebGLFramebuffer | null = null;
  private width = 0;
  private height = 0;

  constructor(
    private readonly gl: WebGL2RenderingContext,
    private readonly colorFormat: number,
    private readonly depthFormat: number,
  ) {}

  /** Binds it, cleared to the depth and to colour 0 (null: not cleared), with the size given. */
  begin(width: number, height: number, depth: number | null): void {
    const { gl } = this;
    if (this.width !== width || this.height !== height) this.resize(width, height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.framebuffer);
    gl.viewport(0, 0, width, height);
    if (depth === null) return;
    gl.depthMask(true);
    gl.clearDepth(depth);
    gl.clearColor(0, 0, 0, 0);
    gl.clear((this.color ? gl.COLOR_BUFFER_BIT : 0) | (this.depth ? gl.DEPTH_BUFFER_BIT : 0));
  }

  bind(): void {
    this.gl.bindFramebuffer(this.gl.FRAMEBUFFER, this.framebuffer);
  }

  private resize(width: number, height: number): void {
    const { gl } = this;
    this.delete();
    [this.width, this.height] = [width, height];
    this.framebuffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.framebuffer);
    const attach = (point: number, format: number): WebGLTexture => {
      const made = texture(gl, format, width, height);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, point, gl.TEXTURE_2D, made, 0);
      return made;
    };
    if (this.colorFormat !== 0) this.color = attach(gl.COLOR_ATTACHMENT0, this.colorFormat);
    else gl.drawBuffers([gl.NONE]);
    if (this.depthFormat !== 0) this.depth = attach(gl.DEPTH_ATTACHMENT, this.depthFormat);
  }

  delete(): void {
    this.gl.deleteFramebuffer(this.framebuffer);
    this.gl.deleteTexture(this.color);
    this.gl.deleteTexture(this.depth);
    this.color = this.depth = null;
    this.width = this.height = 0;
  }
}
