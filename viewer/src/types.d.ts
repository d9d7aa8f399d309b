declare module "draco3dgltf" {
  export function createDecoderModule(options: { wasmBinary: Uint8Array }): Promise<any>;
}
declare module "*.wasm" {
  const bytes: Uint8Array;
  export default bytes;
}
