/** Triangles on the graphics side. */

export interface GpuMesh {
  vertexArray: WebGLVertexArrayObject;
  buffers: WebGLBuffer[];
  corners: number;
  indexType: number;
  hasNormals: boolean;
}

export interface MeshData {
  positions: Float32Array;
  indices: Uint16Array | Uint32Array;
  normals: Float32Array | null;
}

export function uploadMesh(gl: WebGL2RenderingContext, mesh: MeshData): GpuMesh {
  const vertexArray = gl.createVertexArray()!;
  gl.bindVertexArray(vertexArray);
  const buffers: WebGLBuffer[] = [];
  const copy = (target: number, data: Float32Array | Uint16Array | Uint32Array): void => {
    const buffer = gl.createBuffer()!;
    gl.bindBuffer(target, buffer);
    gl.bufferData(target, data, gl.STATIC_DRAW);
    buffers.push(buffer);
  };
  const attribute = (index: number, data: Float32Array): void => {
    copy(gl.ARRAY_BUFFER, data);
    gl.enableVertexAttribArray(index);
    gl.vertexAttribPointer(index, 3, gl.FLOAT, false, 0, 0);
  };
  copy(gl.ELEMENT_ARRAY_BUFFER, mesh.indices);
  attribute(0, mesh.positions);
  if (mesh.normals) attribute(1, mesh.normals);
  gl.bindVertexArray(null);
  return {
    vertexArray, buffers, corners: mesh.indices.length, hasNormals: mesh.normals !== null,
    indexType: mesh.indices instanceof Uint16Array ? gl.UNSIGNED_SHORT : gl.UNSIGNED_INT,
  };
}

export function deleteMesh(gl: WebGL2RenderingContext, mesh: GpuMesh): void {
  gl.deleteVertexArray(mesh.vertexArray);
  for (const buffer of mesh.buffers) gl.deleteBuffer(buffer);
}

export function drawMesh(gl: WebGL2RenderingContext, mesh: GpuMesh): void {
  gl.bindVertexArray(mesh.vertexArray);
  gl.drawElements(gl.TRIANGLES, mesh.corners, mesh.indexType, 0);
}
