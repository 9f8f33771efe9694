// Drawing of the faces of a mesh with WebGL 2, independent of the page.

const VERTEX = `#version 300 es
precision highp float;
layout(location = 0) in vec3 before;
layout(location = 1) in vec3 after;
layout(location = 2) in vec2 values;
layout(location = 3) in uvec2 hexAndKinds;
uniform mat4 view, projection;
uniform float between;
out vec3 place;
out vec2 corner;
flat out float value;
flat out uint hex, kind, triangle;
void main() {
  vec4 seen = view * vec4(mix(before, after, between), 1.0);
  place = seen.xyz;
  gl_Position = projection * seen;
  int k = gl_VertexID & 3;
  corner = vec2(k == 1 || k == 2 ? 1.0 : 0.0, k >= 2 ? 1.0 : 0.0);
  value = mix(values.x, values.y, between);
  hex = hexAndKinds.x;
  kind = (between < 0.5 ? hexAndKinds.y : hexAndKinds.y >> 2u) & 3u;
  triangle = hexAndKinds.y >> 4u;
}`;

const FRAGMENT = `#version 300 es
precision highp float;
in vec3 place;
in vec2 corner;
flat in float value;
flat in uint hex, kind, triangle;
uniform sampler2D map;
uniform vec3 inverted, inside;
uniform uint chosen;
uniform float edges, opacity;
uniform bool picking;
out vec4 colour;
void main() {
  if (picking) {
    uint n = hex + 1u;
    colour = vec4(n & 255u, (n >> 8u) & 255u, (n >> 16u) & 255u, n >> 24u) / 255.0;
    return;
  }
  vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
  float light = 0.56 + 0.34 * abs(normal.z) + 0.12 * abs(dot(normal, normalize(vec3(0.5, 0.8, 0.3))));
  vec3 base = kind == 1u ? inverted : kind == 2u ? inside : texture(map, vec2(clamp(value, 0.001, 0.999), 0.5)).rgb;
  if (hex == chosen) base = mix(base, vec3(1.0), 0.55);
  vec2 wide = fwidth(corner);
  vec2 away = min(corner, 1.0 - corner) / max(wide, vec2(1e-6)); // in pixels
  float thick = hex == chosen ? 2.4 : 0.55;
  float slope = corner.x - corner.y; // 0 on the third edge of a triangle
  float near = min(away.x, away.y);
  if (triangle == 1u) near = min(near, abs(slope) / max(fwidth(slope), 1e-6));
  float line = 1.0 - smoothstep(thick - 0.5, thick + 0.7, near);
  float fade = smoothstep(1.5, 9.0, 1.0 / max(max(wide.x, wide.y), 1e-6)); // fade the edges of small faces
  float ink = hex == chosen ? line : line * fade * edges * 0.55;
  colour = vec4(mix(base * light, vec3(0.106, 0.122, 0.165), ink), 1.0) * opacity;
}`;

/** Numbers per vertex: positions before and after (6), values before and after (2), hex, kinds. */
const STRIDE = 10;

class Painter {
  /**
   * @param {HTMLCanvasElement} canvas
   * @throws {Error} If WebGL 2 is not available.
   */
  constructor(canvas) {
    const gl = canvas.getContext("webgl2", { antialias: true, alpha: true, premultipliedAlpha: true });
    if (!gl) throw new Error("WebGL 2 is not available");
    this.gl = gl;
    this.program = linked(gl);
    this.uniforms = {};
    for (let k = 0; k < gl.getProgramParameter(this.program, gl.ACTIVE_UNIFORMS); k++) {
      const { name } = gl.getActiveUniform(this.program, k);
      this.uniforms[name] = gl.getUniformLocation(this.program, name);
    }
    this.texture = gl.createTexture();
    this.parts = { faces: this.part(), ghost: this.part() };
  }

  part() {
    const { gl } = this;
    const part = { array: gl.createVertexArray(), vertices: gl.createBuffer(), corners: gl.createBuffer(), count: 0 };
    gl.bindVertexArray(part.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, part.vertices);
    [[3, 0], [3, 3], [2, 6]].forEach(([size, from], location) => {
      gl.enableVertexAttribArray(location);
      gl.vertexAttribPointer(location, size, gl.FLOAT, false, 4 * STRIDE, 4 * from);
    });
    gl.enableVertexAttribArray(3);
    gl.vertexAttribIPointer(3, 2, gl.UNSIGNED_INT, 4 * STRIDE, 4 * 8);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, part.corners);
    gl.bindVertexArray(null);
    return part;
  }

  /**
   * Set the faces to draw.
   *
   * @param {string} which "faces", or "ghost" for translucent faces.
   * @param {number[]} places Faces as 6 hex + face.
   * @param {HexMesh} mesh
   * @param {[number, number]} states Before and after.
   * @param {(state: number, hex: number) => number} place Position of the value of a hex in the colour map, from 0 to 1.
   */
  take(which, places, mesh, states, place) {
    const { gl } = this;
    const floats = new Float32Array(4 * STRIDE * places.length);
    const integers = new Uint32Array(floats.buffer);
    const corners = new Uint32Array(6 * places.length);
    const [before, after] = states.map((state) => mesh.states[state]);
    places.forEach((face, k) => {
      const hex = Math.floor(face / 6);
      const values = states.map((state) => place(state, hex));
      const nodes = mesh.nodes(hex, face % 6);
      const kinds = before.kinds[hex] | (after.kinds[hex] << 2) | (nodes[2] === nodes[3] ? 1 << 4 : 0);
      for (let corner = 0; corner < 4; corner++) {
        const at = STRIDE * (4 * k + corner);
        const node = 3 * nodes[corner];
        for (let axis = 0; axis < 3; axis++) {
          floats[at + axis] = before.points[node + axis];
          floats[at + 3 + axis] = after.points[node + axis];
        }
        floats.set(values, at + 6);
        integers[at + 8] = hex;
        integers[at + 9] = kinds;
      }
      // Flat values of a triangle are those of its last vertex; all four vertices have the same.
      corners.set([0, 1, 2, 0, 2, 3].map((corner) => 4 * k + corner), 6 * k);
    });
    const part = this.parts[which];
    part.count = corners.length;
    gl.bindVertexArray(part.array);
    gl.bindBuffer(gl.ARRAY_BUFFER, part.vertices);
    gl.bufferData(gl.ARRAY_BUFFER, floats, gl.DYNAMIC_DRAW);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, corners, gl.DYNAMIC_DRAW);
    gl.bindVertexArray(null);
  }

  /** Set the colour map, (256, 3). */
  colours(table) {
    const { gl } = this;
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB8, 256, 1, 0, gl.RGB, gl.UNSIGNED_BYTE, table);
    for (const [key, value] of [
      [gl.TEXTURE_MIN_FILTER, gl.LINEAR],
      [gl.TEXTURE_MAG_FILTER, gl.LINEAR],
      [gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE],
      [gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE],
    ]) gl.texParameteri(gl.TEXTURE_2D, key, value);
  }

  /**
   * Draw.
   *
   * @param {{view: Float32Array, projection: Float32Array}} camera
   * @param {{between: number, edges: boolean, inverted: number[], inside: number[], chosen: number, ghost: number}} how `ghost` is the opacity
   *   of ghost faces; 0 hides them.
   */
  draw(camera, how) {
    const { gl, uniforms } = this;
    this.begin(camera, how);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.drawPart(this.parts.faces);
    if (how.ghost) {
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
      gl.depthMask(false);
      gl.uniform1f(uniforms.opacity, how.ghost);
      gl.uniform1f(uniforms.edges, 0);
      this.drawPart(this.parts.ghost);
      gl.depthMask(true);
      gl.disable(gl.BLEND);
    }
  }

  begin(camera, how) {
    const { gl, uniforms } = this;
    gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.enable(gl.DEPTH_TEST);
    gl.useProgram(this.program);
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.uniformMatrix4fv(uniforms.view, false, camera.view);
    gl.uniformMatrix4fv(uniforms.projection, false, camera.projection);
    gl.uniform1f(uniforms.between, how.between);
    gl.uniform1f(uniforms.edges, how.edges ? 1 : 0);
    gl.uniform1f(uniforms.opacity, 1);
    gl.uniform3fv(uniforms.inverted, how.inverted);
    gl.uniform3fv(uniforms.inside, how.inside);
    gl.uniform1ui(uniforms.chosen, how.chosen < 0 ? 0xffffffff : how.chosen);
    gl.uniform1i(uniforms.picking, 0);
  }

  drawPart(part) {
    const { gl } = this;
    gl.bindVertexArray(part.array);
    gl.drawElements(gl.TRIANGLES, part.count, gl.UNSIGNED_INT, 0);
    gl.bindVertexArray(null);
  }

  /** Return the number of the hex at a pixel, counted from the lower left corner; -1 if there is none. */
  pick(camera, how, x, y) {
    const { gl } = this;
    const frame = gl.createFramebuffer();
    const [ids, depth] = [gl.createRenderbuffer(), gl.createRenderbuffer()];
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    for (const [buffer, format, point] of [
      [ids, gl.RGBA8, gl.COLOR_ATTACHMENT0],
      [depth, gl.DEPTH_COMPONENT24, gl.DEPTH_ATTACHMENT],
    ]) {
      gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
      gl.renderbufferStorage(gl.RENDERBUFFER, format, gl.drawingBufferWidth, gl.drawingBufferHeight);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, point, gl.RENDERBUFFER, buffer);
    }
    this.begin(camera, how);
    gl.uniform1i(this.uniforms.picking, 1);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.drawPart(this.parts.faces);
    const pixel = new Uint8Array(4);
    gl.readPixels(x, y, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.deleteFramebuffer(frame);
    gl.deleteRenderbuffer(ids);
    gl.deleteRenderbuffer(depth);
    return (pixel[0] | (pixel[1] << 8) | (pixel[2] << 16) | (pixel[3] << 24)) - 1;
  }
}

function linked(gl) {
  const program = gl.createProgram();
  for (const [kind, source] of [[gl.VERTEX_SHADER, VERTEX], [gl.FRAGMENT_SHADER, FRAGMENT]]) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  return program;
}
