// The library, fetched and compiled once, and shared with the workers.

import init, * as library from './library.js';

export { library };

// Called by the library, here and in workers.
globalThis.pushplanProgress = () => {};
globalThis.pushplanSoFar = () => {};
globalThis.pushplanFailed = (message) => console.error(message);

/**
 * Loads and compiles the library, which is ready for calls afterwards. The file is compressed in
 * advance, because not every server compresses; its name keeps servers from decompressing it.
 */
export async function load() {
  const response = await fetch('library.wasm-gz');
  if (!response.ok) throw new Error(`cannot fetch the planner: ${response.status} ${response.statusText}`);
  const unpacked = response.body.pipeThrough(new DecompressionStream('gzip'));
  const headers = { 'Content-Type': 'application/wasm' };
  const module = await WebAssembly.compileStreaming(new Response(unpacked, { headers }));
  await init({ module_or_path: module });
  return module;
}
