// Mesh data of the page: decoding, values, and the faces to draw.

/** Corners of the faces of a hexahedron, in cyclic order. */
const FACES = [[0, 4, 7, 3], [1, 2, 6, 5], [0, 1, 5, 4], [3, 7, 6, 2], [0, 3, 2, 1], [4, 5, 6, 7]];

/** Decode base64 and gzip. */
async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text.trim()), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Join an array from byte planes: the first bytes of all entries, then the second bytes, ... */
function joined(bytes, [start, count], Type) {
  const width = Type.BYTES_PER_ELEMENT;
  const array = new Uint8Array(count * width);
  for (let plane = 0; plane < width; plane++) {
    const from = start + plane * count;
    for (let k = 0; k < count; k++) array[k * width + plane] = bytes[from + k];
  }
  return new Type(array.buffer);
}

/** Text of a number with four significant digits. */
function figure(value) {
  return Number.isNaN(value) ? "none" : Number(value.toPrecision(4)).toString();
}

/** Points, hexes and values of a mesh in one or several states: the original and the results of methods. */
class HexMesh {
  /**
   * @param {object} head Metadata, with the positions of the arrays in `bytes`.
   * @param {Uint8Array} bytes
   */
  constructor(head, bytes) {
    this.head = head;
    this.hexes = joined(bytes, head.hexes, Int32Array); // (m, 8), differences to the previous hex
    for (let k = 8; k < this.hexes.length; k++) this.hexes[k] += this.hexes[k - 8];
    this.count = this.hexes.length / 8;
    this.states = head.states.map((state) => ({
      ...state,
      points: joined(bytes, state.points, Float32Array),
      kinds: joined(bytes, state.kinds, Uint8Array), // 1 inverted, 2 invalid inside, 0 valid
      values: state.values.map((place) => joined(bytes, place, Uint16Array)),
    }));
    this.maps = head.maps.map((map) => ({ name: map.name, table: joined(bytes, map.table, Uint8Array) }));
    this.neighbours = this.findNeighbours();
    this.centres = this.findCentres(this.states[0].points);
  }

  /** Return the nodes of a face: four, of which a triangle repeats its last; two or one of a face that a cell lacks. */
  nodes(hex, face) {
    const nodes = [...new Set(FACES[face].map((corner) => this.hexes[8 * hex + corner]))];
    return nodes.length === 3 ? [...nodes, nodes[2]] : nodes;
  }

  /** Return the neighbour of each hex across each face, (6 m); -1 at the boundary. */
  findNeighbours() {
    const neighbours = new Int32Array(6 * this.count).fill(-1);
    const keys = new Int32Array(4 * neighbours.length).fill(-1); // nodes of each face in ascending order
    const first = new Int32Array(this.states[0].points.length / 3).fill(-1); // last visited face by smallest node
    const next = new Int32Array(neighbours.length).fill(-1); // previous face with the same smallest node
    for (let place = 0; place < neighbours.length; place++) {
      const hex = Math.floor(place / 6);
      const nodes = [...new Set(this.nodes(hex, place % 6))].sort((a, b) => a - b);
      if (nodes.length < 3) {
        neighbours[place] = hex; // not drawn
        continue;
      }
      keys.set(nodes, 4 * place);
      const same = (other) => [0, 1, 2, 3].every((k) => keys[4 * place + k] === keys[4 * other + k]);
      let other = first[nodes[0]];
      while (other >= 0 && !same(other)) other = next[other];
      if (other >= 0 && neighbours[other] < 0) {
        neighbours[place] = Math.floor(other / 6);
        neighbours[other] = hex;
      }
      next[place] = first[nodes[0]];
      first[nodes[0]] = place;
    }
    return neighbours;
  }

  /** Return the centres of the hexes, (m, 3). */
  findCentres(points) {
    const centres = new Float32Array(3 * this.count);
    for (let k = 0; k < this.hexes.length; k++) {
      for (let axis = 0; axis < 3; axis++) centres[3 * (k >> 3) + axis] += points[3 * this.hexes[k] + axis] / 8;
    }
    return centres;
  }

  /** Return a value of a hex in its unit; NaN if it has none. */
  value(state, metric, hex) {
    const { from, to, steps } = this.head.metrics[metric];
    const step = this.states[state].values[metric][hex]; // steps + 1 stands for no value
    return step > steps ? NaN : from + ((to - from) * step) / steps;
  }

  /** Return a value of a hex as text; a value beyond the stored range as ≤ or ≥ its end. */
  text(state, metric, hex) {
    const { open, steps } = this.head.metrics[metric];
    const step = this.states[state].values[metric][hex];
    const beyond = open && step === 0 ? "≤ " : open && step === steps ? "≥ " : "";
    return beyond + figure(this.value(state, metric, hex));
  }

  /**
   * Return 1 for each shown hex, else 0, (m).
   *
   * @param {?{axis: number, at: number, other: boolean}} cut Plane at a fraction of the bounding box; hexes
   *   beyond it are hidden, or with `other` those before it. Centres in the first state are compared, so that the cut
   *   is the same in every state.
   * @param {{state: number, metric: number, low: number, high: number, invalid: boolean}} filter Bounds of the values;
   *   `invalid` shows invalid hexes, regardless of their values.
   */
  shown(cut, filter) {
    const { kinds } = this.states[filter.state];
    const { low, high } = this.head.box;
    const shown = new Uint8Array(this.count);
    for (let hex = 0; hex < this.count; hex++) {
      const value = this.value(filter.state, filter.metric, hex);
      const isInvalid = kinds[hex] > 0 || Number.isNaN(value);
      let show = isInvalid ? filter.invalid : value >= filter.low && value <= filter.high;
      if (cut && show) {
        const plane = low[cut.axis] + (high[cut.axis] - low[cut.axis]) * cut.at;
        show = this.centres[3 * hex + cut.axis] > plane === cut.other;
      }
      shown[hex] = show ? 1 : 0;
    }
    return shown;
  }

  /** Return 1 for a hex and those that share a node with it, else 0, (m). */
  around(hex) {
    const nodes = new Set(this.hexes.subarray(8 * hex, 8 * hex + 8));
    const near = new Uint8Array(this.count);
    for (let k = 0; k < this.hexes.length; k++) if (nodes.has(this.hexes[k])) near[k >> 3] = 1;
    return near;
  }

  /** Return the outer faces of the shown hexes, as 6 hex + face. */
  skin(shown) {
    const faces = [];
    for (let place = 0; place < this.neighbours.length; place++) {
      const other = this.neighbours[place];
      if (shown[Math.floor(place / 6)] && (other < 0 || !shown[other])) faces.push(place);
    }
    return faces;
  }
}
