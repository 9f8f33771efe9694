// A mesh as the page holds it: what is drawn of it is found here, and nothing is known of how.

/** Corners of the faces of a hexahedron, each going round it. */
const FACES = [[0, 4, 7, 3], [1, 2, 6, 5], [0, 1, 5, 4], [3, 7, 6, 2], [0, 3, 2, 1], [4, 5, 6, 7]];

/** Unpack what is kept as base64 of gzip. */
async function unpacked(text) {
  const bytes = Uint8Array.from(atob(text.trim()), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** An array whose bytes are kept in planes: all the first ones, all the second ones, ... */
function joined(bytes, [start, count], Type) {
  const width = Type.BYTES_PER_ELEMENT;
  const answer = new Uint8Array(count * width);
  for (let plane = 0; plane < width; plane++) {
    const from = start + plane * count;
    for (let k = 0; k < count; k++) answer[k * width + plane] = bytes[from + k];
  }
  return new Type(answer.buffer);
}

/** A number in four figures. */
function figure(value) {
  return Number.isNaN(value) ? "none" : Number(value.toPrecision(4)).toString();
}

/** Points, hexes and values of a mesh in one state or several: as it was given, and as methods left it. */
class HexMesh {
  /**
   * @param {object} head What the arrays are, and where among the bytes they begin.
   * @param {Uint8Array} bytes
   */
  constructor(head, bytes) {
    this.head = head;
    this.hexes = joined(bytes, head.hexes, Int32Array); // (m, 8), each hex less the one before it
    for (let k = 8; k < this.hexes.length; k++) this.hexes[k] += this.hexes[k - 8];
    this.count = this.hexes.length / 8;
    this.states = head.states.map((state) => ({
      ...state,
      points: joined(bytes, state.points, Float32Array),
      inverted: joined(bytes, state.inverted, Uint8Array),
      values: state.values.map((place) => joined(bytes, place, Uint16Array)),
    }));
    this.maps = head.maps.map((map) => ({ name: map.name, table: joined(bytes, map.table, Uint8Array) }));
    this.neighbours = this.foundNeighbours();
    this.centres = this.foundCentres(this.states[0].points);
  }

  /** The node of a face's corner. */
  node(hex, face, corner) {
    return this.hexes[8 * hex + FACES[face][corner]];
  }

  /** The hex across each face, (6 m); -1 where there is none. */
  foundNeighbours() {
    const answer = new Int32Array(6 * this.count).fill(-1);
    const keys = new Int32Array(4 * answer.length); // nodes of each face in ascending order
    const first = new Int32Array(this.states[0].points.length / 3).fill(-1); // by least node, the last face met
    const next = new Int32Array(answer.length).fill(-1); // and the one before it
    for (let place = 0; place < answer.length; place++) {
      const hex = Math.floor(place / 6);
      const nodes = [0, 1, 2, 3].map((corner) => this.node(hex, place % 6, corner)).sort((a, b) => a - b);
      keys.set(nodes, 4 * place);
      let other = first[nodes[0]];
      while (other >= 0 && !nodes.every((node, k) => node === keys[4 * other + k])) other = next[other];
      if (other >= 0 && answer[other] < 0) {
        answer[place] = Math.floor(other / 6);
        answer[other] = hex;
      }
      next[place] = first[nodes[0]];
      first[nodes[0]] = place;
    }
    return answer;
  }

  /** Middles of the hexes, (m, 3). */
  foundCentres(points) {
    const answer = new Float32Array(3 * this.count);
    for (let k = 0; k < this.hexes.length; k++) {
      for (let axis = 0; axis < 3; axis++) answer[3 * (k >> 3) + axis] += points[3 * this.hexes[k] + axis] / 8;
    }
    return answer;
  }

  /** A value of a hex in its unit; NaN where there is none. */
  value(state, metric, hex) {
    const { from, to, steps } = this.head.metrics[metric];
    const step = this.states[state].values[metric][hex]; // the number after the last step is none
    return step > steps ? NaN : from + ((to - from) * step) / steps;
  }

  /** A value of a hex in words; of what lies beyond the values that are kept, their end is known alone. */
  said(state, metric, hex) {
    const { open, steps } = this.head.metrics[metric];
    const step = this.states[state].values[metric][hex];
    const beyond = open && step === 0 ? "≤ " : open && step === steps ? "≥ " : "";
    return beyond + figure(this.value(state, metric, hex));
  }

  /**
   * Which hexes are shown, (m).
   *
   * @param {?{axis: number, at: number, other: boolean}} cut A plane through the box of the mesh, from 0 to 1; hidden is
   *   what lies beyond it, or with `other` what lies before it. Hexes stay whole, and are judged where they were at
   *   first, so that the cut is the same in every state.
   * @param {{state: number, metric: number, low: number, high: number, inverted: boolean}} some Bounds of the values;
   *   inverted hexes are shown with `inverted`, whatever theirs.
   */
  shown(cut, some) {
    const { inverted } = this.states[some.state];
    const { low, high } = this.head.box;
    const answer = new Uint8Array(this.count);
    for (let hex = 0; hex < this.count; hex++) {
      const value = this.value(some.state, some.metric, hex);
      const apart = inverted[hex] > 0 || Number.isNaN(value);
      let show = apart ? some.inverted : value >= some.low && value <= some.high;
      if (cut && show) {
        const plane = low[cut.axis] + (high[cut.axis] - low[cut.axis]) * cut.at;
        show = this.centres[3 * hex + cut.axis] > plane === cut.other;
      }
      answer[hex] = show ? 1 : 0;
    }
    return answer;
  }

  /** A hex and those that share a node with it, (m). */
  around(hex) {
    const nodes = new Set(this.hexes.subarray(8 * hex, 8 * hex + 8));
    const answer = new Uint8Array(this.count);
    for (let k = 0; k < this.hexes.length; k++) if (nodes.has(this.hexes[k])) answer[k >> 3] = 1;
    return answer;
  }

  /** The faces that can be seen, as 6 hex + face: those of shown hexes beyond which none is shown. */
  skin(shown) {
    const answer = [];
    for (let place = 0; place < this.neighbours.length; place++) {
      const other = this.neighbours[place];
      if (shown[Math.floor(place / 6)] && (other < 0 || !shown[other])) answer.push(place);
    }
    return answer;
  }
}
