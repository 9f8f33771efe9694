// Interactive viewer of the page: controls, state and drawing.

class Viewer {
  /**
   * @param {HTMLElement} root Element with the controls, each named by `data-is`.
   * @param {HexMesh} mesh
   */
  constructor(root, mesh) {
    this.root = root;
    this.mesh = mesh;
    this.is = Object.fromEntries([...root.querySelectorAll("[data-is]")].map((control) => [control.dataset.is, control]));
    this.painter = new Painter(this.is.canvas);
    this.camera = new Camera(mesh.states[0].points);
    this.chosen = -1;
    this.alone = false; // only the chosen hex is shown, with its surroundings as ghost
    this.fill();
    this.listen();
    this.reset();
    new ResizeObserver(() => this.soon()).observe(this.is.canvas);
    root.classList.add("alive");
    this.skin = mesh.skin(new Uint8Array(mesh.count).fill(1));
    this.chooseMetric();
  }

  /** Fill the lists with the states, metrics and colour maps. */
  fill() {
    const { states, metrics } = this.mesh.head;
    options(this.is.metric, metrics.map((metric) => metric.title));
    options(this.is.map, this.mesh.maps.map((map) => map.name));
    options(this.is.method, states.slice(1).map((state) => state.name));
    this.is.movement.hidden = states.length < 2;
    this.is.method.parentElement.hidden = states.length < 3;
  }

  listen() {
    const { is } = this;
    is.metric.addEventListener("change", () => this.chooseMetric());
    is.map.addEventListener("change", () => this.rebuild());
    is.method.addEventListener("change", () => {
      is.between.value = 1; // who selects a method wants to see its result
      this.rebuild();
    });
    for (const name of ["axis", "at", "other", "low", "high", "invalid"]) {
      is[name].addEventListener("input", () => (this.alone = false));
    }
    is.axis.addEventListener("input", () => {
      const axis = Number(is.axis.value);
      is.other.checked = axis >= 0 && this.camera.axes()[2][axis] < 0; // hide the side of the viewer
      this.rebuild();
    });
    for (const name of ["at", "other", "low", "high", "invalid"]) {
      is[name].addEventListener("input", () => this.rebuild());
    }
    is.between.addEventListener("input", () => this.go());
    for (const name of ["edges", "ghost"]) is[name].addEventListener("input", () => this.soon());
    is.reset.addEventListener("click", () => {
      this.reset();
      this.chooseMetric();
    });
    for (const button of this.root.querySelectorAll("[data-look]")) {
      button.addEventListener("click", () => {
        this.camera.look(button.dataset.look);
        this.soon();
      });
    }
    steer(is.canvas, this.camera, () => this.soon(), (x, y) => this.choose(x, y));
  }

  /** Restore the initial state of the page. */
  reset() {
    const { is } = this;
    this.root.querySelector("form").reset();
    this.camera.reset();
    this.chosen = -1;
    this.alone = false;
  }

  /** Index of the state that is nearer to the position between before and after. */
  get state() {
    return this.states[this.between < 0.5 ? 0 : 1];
  }

  get states() {
    const last = this.mesh.states.length - 1;
    return [0, Math.min(last, this.is.method.selectedIndex + 1)];
  }

  get between() {
    return this.mesh.states.length < 2 ? 0 : Number(this.is.between.value);
  }

  get metric() {
    return Math.max(0, this.is.metric.selectedIndex);
  }

  chooseMetric() {
    const metric = this.mesh.head.metrics[this.metric];
    for (const [name, value] of [["low", metric.from], ["high", metric.to]]) {
      Object.assign(this.is[name], { min: metric.from, max: metric.to, step: (metric.to - metric.from) / 1000 });
      this.is[name].value = value;
    }
    this.rebuild();
  }

  /** Update after a move between before and after; the faces depend on the nearer state. */
  go() {
    if (this.shownState !== this.state) this.rebuild();
    else this.soon();
    this.tell();
  }

  rebuild() {
    cancelAnimationFrame(this.building);
    this.building = requestAnimationFrame(() => this.build());
  }

  /** Set the visible faces and their colours. */
  build() {
    const { is, mesh, metric } = this;
    const kind = mesh.head.metrics[metric];
    const bounds = ["low", "high"].map((name) => Number(is[name].value));
    const ends = [bounds[0] > kind.from ? bounds[0] : -Infinity, bounds[1] < kind.to ? bounds[1] : Infinity];
    const axis = Number(is.axis.value);
    const cut = axis < 0 ? null : { axis, at: Number(is.at.value), other: is.other.checked };
    this.shownState = this.state;
    const filter = { state: this.state, metric, low: ends[0], high: ends[1], invalid: is.invalid.checked };
    const shown = this.alone ? new Uint8Array(mesh.count) : mesh.shown(cut, filter);
    if (this.alone) shown[this.chosen] = 1;
    const faces = mesh.skin(shown);
    const place = (state, hex) => {
      const share = (mesh.value(state, metric, hex) - kind.low) / (kind.high - kind.low);
      return kind.better < 0 ? 1 - share : share;
    };
    this.painter.take("faces", faces, mesh, this.states, place);
    this.hidden = shown.includes(0);
    const ghost = this.alone ? mesh.skin(mesh.around(this.chosen)) : this.skin;
    if (this.hidden) this.painter.take("ghost", ghost, mesh, this.states, place);
    const { table } = mesh.maps[is.map.selectedIndex];
    this.painter.colours(table);
    this.bar(kind, table);
    for (const name of ["at", "other"]) is[name].disabled = !cut;
    const count = shown.reduce((sum, flag) => sum + flag, 0);
    is.count.textContent = `${count.toLocaleString("en")} of ${mesh.count.toLocaleString("en")} ${mesh.head.nouns[1]}`;
    is.bounds.textContent = ends.every((end) => !Number.isFinite(end)) ? "all" : bounds.map(figure).join(" to ");
    this.tell();
    this.soon();
  }

  /** Update the colour bar. */
  bar(kind, table) {
    const reversed = kind.better < 0;
    const stops = Array.from({ length: 33 }, (_, k) => {
      const at = 3 * Math.round((255 * (reversed ? 32 - k : k)) / 32);
      return `rgb(${table[at]},${table[at + 1]},${table[at + 2]})`;
    });
    this.is.gradient.style.background = `linear-gradient(to right, ${stops.join(",")})`;
    const ticks = Array.from({ length: 5 }, (_, k) => figure(kind.low + ((kind.high - kind.low) * k) / 4));
    this.is.ticks.replaceChildren(...ticks.map((text) => element("span", text)));
    this.is.title.textContent = kind.unit ? `${kind.title}, ${kind.unit}` : kind.title;
  }

  /** Show the name of the state, and the values of the chosen hex. */
  tell() {
    const { mesh, chosen, is } = this;
    const names = this.states.map((state) => mesh.head.states[state].name);
    const share = this.between;
    is.moment.textContent = share <= 0 ? names[0] : share >= 1 ? names[1] : `${Math.round(100 * share)} % from before to after`;
    if (chosen < 0) {
      is.told.textContent = `Click a ${mesh.head.nouns[0]} to show its number and values.`;
      return;
    }
    const [first, second] = [...new Set(this.states)].map((state) => {
      const texts = mesh.head.metrics.map(({ title }, metric) => `${title} ${mesh.text(state, metric, chosen)}`);
      const values = texts.filter((_, metric) => metric < 2 || metric === this.metric).join(", ");
      return `${values}${["", ", inverted", ", invalid inside"][mesh.states[state].kinds[chosen]]}`;
    });
    const after = second ? `; ${names[1]}: ${second}` : "";
    const noun = mesh.head.nouns[0];
    is.told.textContent = `${noun[0].toUpperCase()}${noun.slice(1)} ${chosen.toLocaleString("en")} – ${names[0]}: ${first}${after}.`;
  }

  /** Choose the hex at a position on the canvas, in CSS pixels. */
  choose(x, y) {
    const { canvas } = this.is;
    const share = canvas.width / canvas.clientWidth;
    const below = canvas.height - 1 - Math.floor(y * share);
    const found = this.painter.pick(this.camera.matrices(), this.how, Math.floor(x * share), below);
    if (this.alone && found < 0) return;
    this.chosen = found;
    this.tell();
    this.soon();
  }

  /** Show a hex in a state, with the hexes around it as ghost. */
  approach(hex, state) {
    this.reset();
    this.is.method.selectedIndex = Math.max(0, state - 1);
    this.is.between.value = Math.min(1, state);
    [this.chosen, this.alone] = [hex, true];
    const { points } = this.mesh.states[state];
    const corners = Array.from({ length: 8 }, (_, k) => this.mesh.hexes[8 * hex + k]);
    const places = corners.map((node) => points.subarray(3 * node, 3 * node + 3));
    const middle = [0, 1, 2].map((axis) => places.reduce((sum, place) => sum + place[axis] / 8, 0));
    const radius = Math.max(...places.map((place) => Math.hypot(...place.map((part, axis) => part - middle[axis]))));
    this.camera.approach(middle, 3 * radius);
    this.chooseMetric();
    this.root.scrollIntoView({ block: "nearest" });
  }

  get how() {
    const { is } = this;
    const [inverted, inside] = this.mesh.head.apart.map((colour) => colour.map((part) => part / 255));
    const ghost = this.hidden && is.ghost.checked ? (this.alone ? 0.16 : 0.07) : 0;
    const chosen = this.alone ? -1 : this.chosen; // a single hex needs no highlight
    return { between: this.between, edges: is.edges.checked, inverted, inside, chosen, ghost };
  }

  /** Draw once before the next frame. */
  soon() {
    this.due ??= requestAnimationFrame(() => {
      this.due = undefined;
      this.draw();
    });
  }

  draw() {
    const { canvas } = this.is;
    const share = Math.min(2, window.devicePixelRatio || 1);
    const size = [canvas.clientWidth, canvas.clientHeight].map((side) => Math.max(1, Math.round(side * share)));
    if (canvas.width !== size[0] || canvas.height !== size[1]) [canvas.width, canvas.height] = size;
    if (this.camera.aspect !== size[0] / size[1]) this.camera.fit(size[0] / size[1]);
    this.painter.draw(this.camera.matrices(), this.how);
  }
}

function element(name, text) {
  const created = document.createElement(name);
  created.textContent = text;
  return created;
}

function options(list, texts) {
  list.replaceChildren(...texts.map((text) => element("option", text)));
}
