// Camera that orbits around a target, with z up.

/** Half of the vertical view angle, in radians. */
const HALF = Math.PI / 12;

/** Ratio of the size of the picture to that of the fitted mesh. */
const MARGIN = 1.06;

/** Standard views, as angles around z and above the plane x, y, in radians. */
const DIRECTIONS = {
  iso: [Math.atan2(-1.3, 1), Math.atan2(0.8, Math.hypot(1, 1.3))],
  x: [0, 0],
  y: [Math.PI / 2, 0],
  z: [-Math.PI / 2, Math.PI / 2],
};

class Camera {
  /** @param {Float32Array} points Points to fit, centred at the origin, (n, 3). */
  constructor(points) {
    this.points = points;
    this.radius = 0;
    for (let k = 0; k < points.length; k += 3) {
      this.radius = Math.max(this.radius, Math.hypot(points[k], points[k + 1], points[k + 2]));
    }
    this.aspect = 1.5;
    this.reset();
  }

  /** Fit the mesh in the isometric view. */
  reset() {
    this.target = [0, 0, 0];
    this.zoom = 1;
    this.look("iso");
  }

  /** Set a standard view. */
  look(name) {
    [this.round, this.above] = DIRECTIONS[name];
    this.fit();
  }

  /** Set the distance that fits all points, for a ratio of width to height of the picture. */
  fit(aspect = this.aspect) {
    this.aspect = aspect;
    const [x, y, z] = this.axes();
    const [up, right] = [Math.tan(HALF), Math.tan(HALF) * aspect];
    this.away = 0;
    for (let k = 0; k < this.points.length; k += 3) {
      const along = (axis) => axis[0] * this.points[k] + axis[1] * this.points[k + 1] + axis[2] * this.points[k + 2];
      const wide = Math.max(Math.abs(along(x)) / right, Math.abs(along(y)) / up);
      this.away = Math.max(this.away, MARGIN * wide + along(z));
    }
  }

  /** Look at a sphere. */
  approach(middle, radius) {
    this.target = [...middle];
    this.zoom = Math.min(500, (this.away * Math.sin(HALF)) / radius);
  }

  /** Rotate by angles. */
  turn(round, above) {
    this.round += round;
    this.above = Math.min(Math.PI / 2, Math.max(-Math.PI / 2, this.above + above));
  }

  /** Zoom by a factor. */
  closer(factor) {
    this.zoom = Math.min(200, Math.max(0.2, this.zoom * factor));
  }

  /** Pan by fractions of the height of the picture. */
  shift(right, up) {
    const [x, y] = this.axes();
    const height = 2 * this.distance() * Math.tan(HALF);
    this.target = this.target.map((place, k) => place - height * (right * x[k] + up * y[k]));
  }

  /** Distance from the target; a zoom of 1 fits the mesh. */
  distance() {
    return this.away / this.zoom;
  }

  /** Unit vectors to the right, up, and towards the viewer. */
  axes() {
    const [c, s, ca, sa] = [this.round, this.above].flatMap((angle) => [Math.cos(angle), Math.sin(angle)]);
    return [[-s, c, 0], [-sa * c, -sa * s, ca], [ca * c, ca * s, sa]];
  }

  /** View and projection matrices, in column-major order. */
  matrices() {
    const axes = this.axes();
    const away = this.distance();
    const view = new Float32Array(16);
    axes.forEach((axis, row) => {
      for (let k = 0; k < 3; k++) view[4 * k + row] = axis[k];
      view[12 + row] = -axis.reduce((sum, part, k) => sum + part * this.target[k], 0) - (row === 2 ? away : 0);
    });
    view[15] = 1;
    const reach = this.radius + Math.hypot(...this.target);
    const near = Math.max(away - reach, away / 1000);
    const far = away + reach;
    const f = 1 / Math.tan(HALF);
    const projection = new Float32Array(16);
    projection[0] = f / this.aspect;
    projection[5] = f;
    projection[10] = (near + far) / (near - far);
    projection[11] = -1;
    projection[14] = (2 * near * far) / (near - far);
    return { view, projection };
  }
}
