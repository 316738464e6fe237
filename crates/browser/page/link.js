// Encoding of a task in a URL: `#example=NAME`, or `#task=` and the compressed text.

async function through(stream, bytes) {
  const body = new Response(bytes).body.pipeThrough(stream);
  return new Uint8Array(await new Response(body).arrayBuffer());
}

/** Returns the URL fragment that holds a text. */
export async function packed(text) {
  const bytes = await through(new CompressionStream('deflate-raw'), new TextEncoder().encode(text));
  const letters = btoa(String.fromCharCode(...bytes));
  return `task=${letters.replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '')}`;
}

/** Maximum length of a task's text, bytes. */
const LONGEST = 1 << 18;

/**
 * Returns the text in a URL fragment, or the name of a shipped task, or nothing.
 *
 * Throws for a truncated link.
 */
export async function unpacked(part) {
  const parts = new URLSearchParams(part);
  if (parts.has('example')) return { example: parts.get('example') };
  if (!parts.has('task')) return {};
  try {
    const letters = atob(parts.get('task').replaceAll('-', '+').replaceAll('_', '/'));
    const bytes = Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
    const text = await through(new DecompressionStream('deflate-raw'), bytes);
    if (text.length > LONGEST) throw new Error('too long');
    return { text: new TextDecoder('utf-8', { fatal: true }).decode(text) };
  } catch {
    throw new Error('the link is damaged, probably truncated: copy the whole link again');
  }
}
