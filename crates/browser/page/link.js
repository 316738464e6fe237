// Encoding of a task in a URL: `#example=NAME`, or `#task=` and the compressed text.

/** Maximum length of a task's text, bytes. */
const LONGEST = 1 << 18;

/** Maximum length of a link, letters: four for three bytes of a text that cannot be compressed. */
const LONGEST_LINK = 1.4 * LONGEST;

/** Number of bytes that are packed or unpacked together; each may unpack to a thousand. */
const PIECE = 1 << 10;

const TOO_LONG = 'the link is too long for a task: open the task as a file';

/** Passes bytes through a stream in pieces, because a browser unpacks a whole piece at once. */
async function through(stream, bytes, longest = Infinity) {
  let at = 0;
  const source = new ReadableStream({
    pull(controller) {
      if (at >= bytes.length) return controller.close();
      controller.enqueue(bytes.subarray(at, at += PIECE));
    },
  });
  const reader = source.pipeThrough(stream).getReader();
  const pieces = [];
  let length = 0;
  for (let next = await reader.read(); !next.done; next = await reader.read()) {
    length += next.value.length;
    if (length > longest) {
      reader.cancel().catch(() => {});
      throw new RangeError(TOO_LONG);
    }
    pieces.push(next.value);
  }
  const all = new Uint8Array(length);
  pieces.reduce((begin, piece) => (all.set(piece, begin), begin + piece.length), 0);
  return all;
}

/** Returns the URL fragment that holds a text. */
export async function packed(text) {
  const bytes = await through(new CompressionStream('deflate-raw'), new TextEncoder().encode(text));
  const letters = btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(''));
  return `task=${letters.replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '')}`;
}

/**
 * Returns the text in a URL fragment, or the name of a shipped task, or nothing.
 *
 * Throws for a truncated link and, before it is unpacked, for a link that is too long.
 */
export async function unpacked(part) {
  if (part.length > LONGEST_LINK) throw new RangeError(TOO_LONG);
  const parts = new URLSearchParams(part);
  if (parts.has('example')) return { example: parts.get('example') };
  if (!parts.has('task')) return {};
  try {
    const letters = atob(parts.get('task').replaceAll('-', '+').replaceAll('_', '/'));
    const bytes = Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
    const text = await through(new DecompressionStream('deflate-raw'), bytes, LONGEST);
    return { text: new TextDecoder('utf-8', { fatal: true }).decode(text) };
  } catch (error) {
    if (error.message === TOO_LONG) throw error;
    throw new Error('the link is damaged, probably truncated: copy the whole link again');
  }
}
