// A model in the fragment of the address: packed, so that no server sees it, and unpacked within bounds.

const PREFIX = "#m=";
/** No model is longer than this many bytes. */
const LONGEST = 1 << 20;

async function collect(stream: ReadableStream<Uint8Array>, most: number): Promise<Uint8Array<ArrayBuffer>> {
  const reader = stream.getReader();
  const parts: Uint8Array[] = [];
  let size = 0;
  for (;;) {
    const { done, value } = await reader.read();
    if (done) break;
    size += value.length;
    if (size > most) {
      await reader.cancel();
      throw new Error("the model of the link is too long");
    }
    parts.push(value);
  }
  const all = new Uint8Array(size);
  let at = 0;
  for (const part of parts) { all.set(part, at); at += part.length; }
  return all;
}

export async function pack(text: string): Promise<string> {
  const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw") as ReadableWritablePair<Uint8Array, Uint8Array>);
  const bytes = await collect(stream, LONGEST);
  let binary = "";
  for (const byte of bytes) binary += String.fromCharCode(byte);
  return PREFIX + btoa(binary).replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

/** The text of a fragment; null where it holds none. */
export async function unpack(fragment: string): Promise<string | null> {
  if (!fragment.startsWith(PREFIX) || fragment.length > 2 * LONGEST) return null;
  const binary = atob(fragment.slice(PREFIX.length).replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = Uint8Array.from(binary, (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw") as ReadableWritablePair<Uint8Array, Uint8Array>);
  return new TextDecoder("utf-8", { fatal: true }).decode(await collect(stream, LONGEST));
}

/** The model of the gallery that a fragment names. */
export function galleryName(fragment: string): string | null {
  const found = /^#gallery=([\w/-]{1,80})$/.exec(fragment.replaceAll("%2F", "/"));
  return found ? found[1] : null;
}
