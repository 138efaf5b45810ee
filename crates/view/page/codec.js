// How the numbers of a run are packed: quantised columns, their second differences as variable-length integers, deflated, in base 64.

async function unpack(text) {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

// One Float32Array a column; `groups` says how many columns of which range follow each other.
async function columns({ frames, groups, data }) {
  const bytes = await unpack(data);
  let at = 0;
  const integer = () => {
    let value = 0, scale = 1, byte;
    do {
      byte = bytes[at++];
      value += (byte & 127) * scale;
      scale *= 128;
    } while (byte > 127);
    return value % 2 ? -(value + 1) / 2 : value / 2;
  };
  const named = {};
  for (const { name, count, low, high, levels } of groups) {
    const step = (high - low) / levels;
    named[name] = Array.from({ length: count }, () => {
      const column = new Float32Array(frames);
      for (let k = 0, value = 0, slope = 0; k < frames; k++) {
        slope += integer();
        value += slope;
        column[k] = low + value * step;
      }
      return column;
    });
  }
  return named;
}
