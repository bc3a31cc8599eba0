// Packages: records as JSON and their arrays in one block of bytes. The layout is described in package.py.
import { PROTOCOL, type Package, type Packed, type Steps } from "./generated/records";

const KINDS = { f4: Float32Array, f8: Float64Array, u4: Uint32Array, u2: Uint16Array } as const;
type Numbers = Float32Array | Float64Array | Uint32Array | Uint16Array;

/** The arrays of a package. */
export class Arrays {
  constructor(private readonly block: Uint8Array) {}

  floats(packed: Packed): Float32Array {
    return this.read(packed, "f4") as Float32Array;
  }

  times(packed: Packed): Float64Array {
    return this.read(packed, "f8") as Float64Array;
  }

  indices(packed: Packed): Uint32Array {
    return this.read(packed, "u4") as Uint32Array;
  }

  /** Whole numbers of 16 bits, negative ones behind 65536. */
  signed(packed: Packed): Int16Array {
    return new Int16Array(this.read(packed, "u2").buffer);
  }

  /** Numbers that came as steps. */
  rounded({ numbers, low, step }: Steps): Float32Array {
    const whole = this.read(numbers, "u2");
    const each = whole.length / low.length;
    const out = new Float32Array(whole.length);
    for (let k = 0; k < whole.length; k++) {
      const i = Math.floor(k / each);
      out[k] = low[i]! + step[i]! * whole[k]!;
    }
    return out;
  }

  private read(packed: Packed, kind: keyof typeof KINDS): Numbers {
    if (packed.kind !== kind) throw new Error(`an array of ${kind} was expected, got ${packed.kind}`);
    const count = packed.shape.reduce((a, b) => a * b, 1);
    const width = KINDS[kind].BYTES_PER_ELEMENT;
    const from = this.block.subarray(packed.start, packed.start + count * width);
    if (from.length !== count * width) throw new Error("the data are cut short");
    const bytes = new Uint8Array(count * width);
    for (let byte = 0; byte < width; byte++) {
      const plane = from.subarray(byte * count, (byte + 1) * count);
      for (let k = 0; k < count; k++) bytes[k * width + byte] = plane[k]!;
    }
    return new KINDS[kind](bytes.buffer);
  }
}

export interface Opened {
  content: Package;
  arrays: Arrays;
}

export function openPackage(bytes: Uint8Array): Opened {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const magic = new TextDecoder().decode(bytes.subarray(0, 4));
  if (magic !== "NVL1") throw new Error("these are no data of a machine");
  const length = view.getUint32(4, true);
  const content = JSON.parse(new TextDecoder().decode(bytes.subarray(8, 8 + length))) as Package;
  if (content.protocol !== PROTOCOL) throw new Error("page and data are of different versions of nivel");
  return { content, arrays: new Arrays(bytes.subarray(8 + length)) };
}

/** Deflated bytes in base64, as they stand in an exported page. */
export async function inflate(text: string): Promise<Uint8Array> {
  const raw = Uint8Array.from(atob(text.trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([raw]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}
