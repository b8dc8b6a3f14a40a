// Scenes in 3D. Turns each <figure class="scene-view">, with scenes as scene_json() has them, into a view that a reader
// turns, with its choices, its legend and a table of what each tube lost.
"use strict";

(() => {
  const NULL_LABEL = -1;
  const BIN_LABEL = 0;
  const BIN_COLOR = "#808080";
  const UNLABELLED_COLOR = "#c3b8a5";
  const NOT_SCORED_COLOR = "#9a9a9a";
  const RIGHT_COLOR = "#0072b2";
  const WRONG_COLOR = "#d55e00";
  const MISSED_COLOR = "#e8b400";
  const FIELD_OF_VIEW = 35;  // degrees, vertical
  const FOUND_LINE_COLOR = "#e6007a";
  const METHOD_COLORS = ["#009e73", "#cc79a7", "#56b4e9", "#8a63d2", "#b08900"];

  // ---- What a scene says

  const bytesOf = text => Uint8Array.from(atob(text), character => character.charCodeAt(0));

  function decodedScene(text) {
    const scene = JSON.parse(text);
    const { coordinates, origin, step, count, colors } = scene.points;
    const steps = new Uint16Array(bytesOf(coordinates).buffer);
    scene.count = count;
    scene.positions = Float32Array.from(steps, (value, i) => origin[i % 3] + step * value);
    scene.colors = colors && bytesOf(colors);
    for (const labelling of scene.labellings) {
      if (labelling.labels) labelling.labels = new Int16Array(bytesOf(labelling.labels).buffer);
    }
    scene.truth = scene.has_truth ? scene.labellings[0] : null;
    scene.found = scene.has_truth ? scene.labellings.slice(1) : scene.labellings;
    return scene;
  }

  const nameOfLabel = label => label === NULL_LABEL ? "no label" : label === BIN_LABEL ? "bin" : `tube ${label}`;

  const isScored = (scene, i) => scene.truth.labels[i] > BIN_LABEL;
  const isRight = (scene, labelling, i) => labelling.labels[i] === scene.truth.labels[i];

  // ---- Colourings: a legend, and for each point the entry of it that it belongs to

  function byLabel(scene, { labels }) {
    const largest = scene.palette.length - 1;
    const legend = [{ text: "no label", color: UNLABELLED_COLOR }, { text: "bin", color: BIN_COLOR }];
    for (let label = 1; label <= largest; ++label) legend.push({ text: `tube ${label}`, color: scene.palette[label] });
    return { legend, entryOf: i => labels[i] + 1 };
  }

  function byError(scene, found) {
    const legend = [
      { text: "right", color: RIGHT_COLOR },
      { text: "given to another tube or the bin", color: WRONG_COLOR },
      { text: "no label", color: MISSED_COLOR },
      { text: "not scored: no tube in truth", color: NOT_SCORED_COLOR },
    ];
    const entryOf = i => {
      if (!isScored(scene, i)) return 3;
      if (isRight(scene, found, i)) return 0;
      return found.labels[i] === NULL_LABEL ? 2 : 1;
    };
    return { legend, entryOf };
  }

  function byMethod(scene) {
    const methods = scene.found.filter(found => found.labels);
    const only = methods.map(({ name }, i) =>
      ({ text: `only ${name} is right`, color: METHOD_COLORS[i % METHOD_COLORS.length] }));
    const legend = [
      { text: "all are right", color: RIGHT_COLOR },
      { text: "none is right", color: WRONG_COLOR },
      { text: "not scored: no tube in truth", color: NOT_SCORED_COLOR },
      ...methods.length > 2 ? [{ text: "several are right", color: MISSED_COLOR }] : [],
      ...only,
    ];
    const first = legend.length - only.length;
    const entryOf = i => {
      if (!isScored(scene, i)) return 2;
      const right = methods.filter(found => isRight(scene, found, i));
      if (right.length === methods.length) return 0;
      if (right.length === 0) return 1;
      return right.length > 1 ? 3 : first + methods.indexOf(right[0]);
    };
    return { legend, entryOf };
  }

  function byHeight(scene) {
    const steps = 64;
    let low = Infinity, high = -Infinity;
    for (let i = 2; i < scene.positions.length; i += 3) {
      low = Math.min(low, scene.positions[i]);
      high = Math.max(high, scene.positions[i]);
    }
    const colors = Array.from({ length: steps }, (_, i) => {
      const share = i / (steps - 1);
      return `#${new THREE.Color().setHSL(0.72 - 0.58 * share, 0.6, 0.3 + 0.3 * share).getHexString()}`;
    });
    const legend = colors.map((color, i) => ({ color, text: i === 0 ? "low" : i === steps - 1 ? "high" : "" }));
    const range = Math.max(high - low, 1e-9);
    return { legend, entryOf: i => Math.min(steps - 1, Math.floor(steps * (scene.positions[3 * i + 2] - low) / range)) };
  }

  // In the order of the menu: [value, text, function of the scene and the chosen method's labelling].
  function colourings(scene) {
    const isLabelled = scene.found.some(found => found.labels);
    const choices = [];
    if (scene.truth?.labels) choices.push(["truth", "truth", () => byLabel(scene, scene.truth)]);
    if (isLabelled) choices.push(["label", "label found", found => byLabel(scene, found)]);
    if (scene.truth?.labels && isLabelled) choices.push(["error", "error", found => byError(scene, found)]);
    if (scene.truth?.labels && scene.found.filter(found => found.labels).length > 1)
      choices.push(["method", "which method is right", () => byMethod(scene)]);
    if (scene.colors) choices.push(["own", "the cloud's own colours", null]);
    choices.push(["height", "height", () => byHeight(scene)]);
    return choices;
  }

  // ---- Elements

  function element(name, properties = {}, ...children) {
    const result = Object.assign(document.createElement(name), properties);
    result.append(...children);
    return result;
  }

  const menu = (text, choices) => {
    const select = element("select", {}, ...choices.map(([value, shown]) => new Option(shown, value)));
    return { select, label: element("label", {}, text, select) };
  };

  const tick = (text, checked) => {
    const input = element("input", { type: "checkbox", checked });
    return { input, label: element("label", {}, input, text) };
  };

  function swatch(color) {
    const result = element("span", { className: "swatch", ariaHidden: "true" });
    result.style.background = color;
    return result;
  }

  const percent = (part, whole) => whole > 0 ? `${(100 * part / whole).toFixed(1)} %` : "–";

  // ---- Geometry

  function pointsOf(scene) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(scene.positions, 3));
    geometry.setAttribute("color", new THREE.BufferAttribute(new Uint8Array(3 * scene.count), 3, true));
    geometry.computeBoundingBox();
    const size = geometry.boundingBox.getSize(new THREE.Vector3());
    const spacing = Math.sqrt(size.x * size.y / Math.max(scene.count, 1));
    // three.js takes sizes as if the field of view were 90 degrees.
    const shown = 1.4 * spacing / Math.tan(THREE.Math.degToRad(FIELD_OF_VIEW / 2));
    const material = new THREE.PointsMaterial({ vertexColors: THREE.VertexColors, size: shown });
    return Object.assign(new THREE.Points(geometry, material), { userData: { spacing } });
  }

  // The tube as spheres and cylinders of a radius.
  function tubeOf(tube, radius, material) {
    const group = new THREE.Group();
    const nodes = tube.nodes.map(node => new THREE.Vector3(...node));
    const ball = new THREE.SphereBufferGeometry(radius, 20, 14);
    for (const node of nodes) {
      const mesh = new THREE.Mesh(ball, material);
      mesh.position.copy(node);
      group.add(mesh);
    }
    const cylinder = new THREE.CylinderBufferGeometry(radius, radius, 1, 20, 1, true);
    for (const [from, to] of tube.edges) {
      const direction = nodes[to].clone().sub(nodes[from]);
      const mesh = new THREE.Mesh(cylinder, material);
      mesh.position.copy(nodes[from]).addScaledVector(direction, 0.5);
      mesh.scale.y = direction.length();
      mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), direction.normalize());
      group.add(mesh);
    }
    return group;
  }

  function centreLines(tubes, color, share) {
    const group = new THREE.Group();
    const material = new THREE.MeshBasicMaterial({ color, depthTest: false });
    for (const tube of tubes) {
      const line = tubeOf(tube, share * tube.radius, material);
      line.userData.label = tube.label;
      group.add(line);
    }
    return group;
  }

  function solidTubes(scene, tubes) {
    const group = new THREE.Group();
    for (const tube of tubes) {
      const solid = tubeOf(tube, tube.radius, new THREE.MeshLambertMaterial({ color: scene.palette[tube.label] }));
      solid.userData.label = tube.label;
      group.add(solid);
    }
    return group;
  }

  // Its corners are those of the floor, in a circle, then those of the rim.
  function binOf(corners, color) {
    const ends = [];
    for (let i = 0; i < corners.length / 2; ++i) {
      const next = (i + 1) % 4;
      ends.push(corners[i], corners[next], corners[i + 4], corners[next + 4], corners[i], corners[i + 4]);
    }
    const geometry = new THREE.BufferGeometry().setFromPoints(ends.map(end => new THREE.Vector3(...end)));
    return new THREE.LineSegments(geometry, new THREE.LineBasicMaterial({ color }));
  }

  // ---- Shading by depth: eye-dome lighting (Boucheny 2009), which needs no normals

  const EYE_DOME_SHADER = {
    vertexShader: "varying vec2 at; void main() { at = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }",
    fragmentShader: `
      uniform sampler2D image, depths;
      uniform vec2 pixel;
      uniform float near, far;
      varying vec2 at;
      float logDepth(vec2 where) {
        float depth = texture2D(depths, where).x;
        return log2(near * far / (far - depth * (far - near)));
      }
      void main() {
        vec4 color = texture2D(image, at);
        float here = logDepth(at), rise = 0.0;
        for (int i = 0; i < 8; ++i) {
          float angle = 0.785398 * float(i);
          rise += max(0.0, here - logDepth(at + 1.6 * pixel * vec2(cos(angle), sin(angle))));
        }
        gl_FragColor = vec4(color.rgb * exp(-25.0 * min(rise, 0.06)), color.a);
      }`,
  };

  class EyeDome {
    constructor() {
      this.target = new THREE.WebGLRenderTarget(1, 1, { depthTexture: new THREE.DepthTexture() });
      this.target.depthTexture.type = THREE.UnsignedIntType;
      this.material = new THREE.ShaderMaterial({
        ...EYE_DOME_SHADER, depthTest: false, depthWrite: false, transparent: true,
        uniforms: { image: { value: this.target.texture }, depths: { value: this.target.depthTexture },
                    pixel: { value: new THREE.Vector2() }, near: { value: 0 }, far: { value: 1 } },
      });
      this.scene = new THREE.Scene();
      this.scene.add(new THREE.Mesh(new THREE.PlaneBufferGeometry(2, 2), this.material));
      this.camera = new THREE.Camera();
    }

    draw(renderer, scene, camera) {
      const size = renderer.getDrawingBufferSize(new THREE.Vector2());
      this.target.setSize(size.x, size.y);
      const { pixel, near, far } = this.material.uniforms;
      pixel.value.set(1 / size.x, 1 / size.y);
      near.value = camera.near;
      far.value = camera.far;
      renderer.setRenderTarget(this.target);
      renderer.clear();
      renderer.render(scene, camera);
      renderer.setRenderTarget(null);
      renderer.clear();
      renderer.render(this.scene, this.camera);
    }
  }

  // ---- The view

  class SceneView {
    constructor(figure) {
      this.texts = [...figure.querySelectorAll('script[type="application/json"]')].map(script => script.textContent);
      this.figure = figure;
      this.canvas = element("canvas", { tabIndex: 0 });
      this.canvas.setAttribute("role", "img");
      this.canvas.setAttribute("aria-label", "Scenes in 3D");
      const context = this.canvas.getContext("webgl2", { alpha: true, antialias: false });
      if (!context) throw new Error("no WebGL");
      this.renderer = new THREE.WebGLRenderer({ canvas: this.canvas, context, alpha: true });
      this.renderer.setPixelRatio(2);
      this.renderer.setClearColor(0, 0);
      this.renderer.autoClear = false;
      this.eyeDome = new EyeDome();
      this.camera = new THREE.PerspectiveCamera(FIELD_OF_VIEW, 1, 0.01, 100);
      this.camera.up.set(0, 0, 1);
      this.controls = new THREE.OrbitControls(this.camera, this.canvas);
      this.controls.enableKeys = false;
      this.controls.addEventListener("change", () => this.draw());
      this.addElements();
      this.listen();
      this.showWhenSeen();
      figure.opener = name => this.opener(name);
    }

    addElements() {
      this.names = this.texts.map(text => JSON.parse(text).name);
      this.scenes = menu("Scene", this.names.map((name, i) => [String(i), name]));
      this.colours = menu("Colour by", []);
      this.methods = menu("Method", []);
      this.trueLines = tick("true centre lines", true);
      this.foundLines = tick("found centre lines", true);
      this.others = tick("points on no tube", true);
      this.choices = element("div", { className: "scene-choices" }, this.scenes.label, this.colours.label,
                             this.methods.label, this.trueLines.label, this.foundLines.label, this.others.label);
      this.scenes.label.hidden = this.names.length < 2;
      this.hover = element("output", { className: "scene-hover" });
      this.legend = element("ul", { className: "scene-legend" });
      this.tubes = element("div", { className: "scene-tubes scroll" });
      this.note = element("figcaption", { className: "scene-help" });
      this.figure.replaceChildren(this.choices, this.canvas, this.hover, this.legend, this.note, this.tubes);
    }

    listen() {
      this.scenes.select.addEventListener("change", () => this.show(Number(this.scenes.select.value)));
      this.methods.select.addEventListener("change", () => this.update());
      for (const control of [this.colours.select, this.trueLines.input, this.foundLines.input, this.others.input])
        control.addEventListener("change", () => this.update());
      this.canvas.addEventListener("keydown", event => this.onKey(event));
      this.canvas.addEventListener("pointermove", event => this.onHover(event));
      this.canvas.addEventListener("pointerleave", () => { this.hover.value = ""; });
      new ResizeObserver(() => this.scene && this.resize()).observe(this.canvas);
      matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.scene && this.update());
    }

    // A page opens sooner if it does not draw what is far below.
    showWhenSeen() {
      const observer = new IntersectionObserver(entries => {
        if (!entries.some(entry => entry.isIntersecting)) return;
        observer.disconnect();
        if (!this.scene) this.show(0);
      });
      observer.observe(this.canvas);
    }

    show(number) {
      this.scenes.select.value = String(number);
      this.scene = decodedScene(this.texts[number]);
      this.highlighted = null;
      const { scene } = this;
      this.choicesOfColour = colourings(scene);
      this.colours.select.replaceChildren(...this.choicesOfColour.map(([value, text]) => new Option(text, value)));
      if (this.choicesOfColour.some(([value]) => value === "error")) this.colours.select.value = "error";
      this.colours.label.hidden = scene.count === 0;
      this.methods.select.replaceChildren(...scene.found.map(({ name }, i) => new Option(name, i)));
      this.methods.label.hidden = scene.found.length < 2;
      this.trueLines.label.hidden = scene.count === 0 || !(scene.truth?.tubes.length > 0);
      this.foundLines.label.hidden = scene.count === 0 || !scene.found.some(found => found.tubes.length > 0);
      this.points = pointsOf(scene);
      this.onTubes = this.indicesOnTubes();
      this.others.label.hidden = this.onTubes.length === scene.count;
      this.update();
      this.resetView();
    }

    // For the name of a scene, without the reasons why it is there, what shows it with the labels of a method; null if it is not there.
    opener(name) {
      const number = this.names.findIndex(other => other === name || other.startsWith(`${name} (`));
      if (number < 0) return null;
      return method => {
        this.show(number);
        this.methods.select.value = this.scene.found.findIndex(found => found.name === method);
        this.update();
        this.figure.scrollIntoView();
        this.canvas.focus({ preventScroll: true });
      };
    }

    get method() { return this.scene.found[Number(this.methods.select.value)] ?? null; }

    // Whose tubes the table lists: the truth's, if it says of which tube each point is.
    get labelling() { return this.scene.truth?.labels ? this.scene.truth : this.method ?? this.scene.truth; }

    get hasLabels() { return this.labelling?.labels !== undefined; }

    get coloured() { return this.choicesOfColour.find(([value]) => value === this.colours.select.value); }

    indicesOnTubes() {
      const labels = this.labelling?.labels;
      const indices = [];
      for (let i = 0; i < this.scene.count; ++i) if (!labels || labels[i] > BIN_LABEL) indices.push(i);
      return indices;
    }

    // ---- What is drawn

    update() {
      const { scene, method } = this;
      const ink = getComputedStyle(this.canvas).color;
      this.points.geometry.setIndex(this.others.input.checked ? null : this.onTubes);
      this.solids = new THREE.Scene();
      this.solids.add(new THREE.AmbientLight(0xffffff, 0.55));
      const light = new THREE.DirectionalLight(0xffffff, 0.6);
      light.position.set(0.4, -0.6, 1);
      this.solids.add(light);
      this.solids.add(scene.count > 0 ? this.points : solidTubes(scene, (scene.truth ?? method).tubes));
      if (scene.bin.length > 0) this.solids.add(binOf(scene.bin, ink));
      this.lines = new THREE.Scene();
      if (scene.count > 0 && scene.truth && this.trueLines.input.checked)
        this.lines.add(centreLines(scene.truth.tubes, ink, 0.16));
      if (scene.count > 0 && method && this.foundLines.input.checked)
        this.lines.add(centreLines(method.tubes, FOUND_LINE_COLOR, 0.08));
      this.colour();
      this.describe();
      this.draw();
    }

    colour() {
      const [, , colouringOf] = this.coloured;
      const colors = this.points.geometry.getAttribute("color");
      this.colouring = colouringOf?.(this.method);
      if (this.colouring) {
        const palette = this.colouring.legend.map(({ color }) => new THREE.Color(color).toArray().map(share => 255 * share));
        for (let i = 0; i < this.scene.count; ++i) colors.array.set(palette[this.colouring.entryOf(i)], 3 * i);
      } else {
        colors.array.set(this.scene.colors);
      }
      if (this.highlighted !== null) this.fadeOthers(colors.array);
      colors.needsUpdate = true;
      for (const group of [...this.lines.children, ...this.solids.children.filter(({ type }) => type === "Group")])
        for (const tube of group.children)
          tube.visible = this.highlighted === null || tube.userData.label === this.highlighted;
    }

    fadeOthers(colors) {
      const labels = this.labelling?.labels;
      if (!labels) return;
      for (let i = 0; i < this.scene.count; ++i) {
        if (labels[i] === this.highlighted) continue;
        for (let k = 3 * i; k < 3 * i + 3; ++k) colors[k] = 0.12 * colors[k] + 0.88 * 150;
      }
    }

    draw() {
      this.eyeDome.draw(this.renderer, this.solids, this.camera);
      this.renderer.render(this.lines, this.camera);
    }

    // ---- Words

    describe() {
      const { scene } = this;
      const { count, of } = scene.points;
      this.canvas.setAttribute("aria-label", `${scene.name} in 3D${count > 0 ? `, coloured by ${this.coloured[1]}` : ""}`);
      const points = count === 0 ? "" :
        count < of ? `${count.toLocaleString("en")} of ${of.toLocaleString("en")} points, drawn at random. `
                   : `${count.toLocaleString("en")} points. `;
      this.note.textContent = points + "Drag to turn, scroll or pinch to zoom, drag with two fingers or the right " +
        "button to move. Keys: arrows, + and −, Home.";
      this.writeLegend();
      this.writeTubes();
    }

    writeLegend() {
      const used = new Set();
      if (this.colouring) for (let i = 0; i < this.scene.count; ++i) used.add(this.colouring.entryOf(i));
      const entries = (this.colouring?.legend ?? []).filter(({ text }, i) => text && used.has(i));
      const isOn = ({ input, label }) => input.checked && !label.hidden;
      if (isOn(this.trueLines)) entries.push({ text: "true centre line", color: getComputedStyle(this.canvas).color });
      if (isOn(this.foundLines)) entries.push({ text: "found centre line", color: FOUND_LINE_COLOR });
      this.legend.replaceChildren(...entries.map(({ text, color }) => element("li", {}, swatch(color), text)));
    }

    writeTubes() {
      const score = this.method?.score;
      const rows = score ? score.tubes.map(tube => this.scoredRow(tube)) : this.countedRows();
      this.tubes.hidden = rows.length === 0;
      const headings = score ? ["Tube", "points", "right", "given away", "no label", "IoU"]
                             : this.hasLabels ? ["Tube", "points shown"] : ["Tube"];
      const caption = score ? `What each tube lost with ${this.method.name}: micro-recall ${score.micro_recall.toFixed(4)}` : "Tubes";
      this.tubes.replaceChildren(element("table", {},
        element("caption", { textContent: `${caption}. Choose a tube to see it alone.` }),
        element("thead", {}, element("tr", {}, ...headings.map(text => element("th", { scope: "col", textContent: text })))),
        element("tbody", {}, ...rows)));
    }

    row(label, cells) {
      const button = element("button", { type: "button", textContent: String(label) });
      button.setAttribute("aria-pressed", String(label === this.highlighted));
      button.addEventListener("click", () => this.highlight(label));
      return element("tr", {}, element("th", { scope: "row" }, swatch(this.scene.palette[label]), button),
                     ...cells.map(cell => element("td", { textContent: cell })));
    }

    scoredRow({ label, points, correct, unlabelled, iou }) {
      const given = points - correct - unlabelled;
      return this.row(label, [points.toLocaleString("en"), percent(correct, points), percent(given, points),
                              percent(unlabelled, points), iou.toFixed(3)]);
    }

    countedRows() {
      const { labelling } = this;
      if (!labelling) return [];
      const counts = new Map(labelling.tubes.map(({ label }) => [label, 0]));
      for (const label of labelling.labels ?? []) if (label > BIN_LABEL) counts.set(label, (counts.get(label) ?? 0) + 1);
      return [...counts].sort(([a], [b]) => a - b)
        .map(([label, count]) => this.row(label, this.hasLabels ? [count.toLocaleString("en")] : []));
    }

    highlight(label) {
      this.highlighted = this.highlighted === label ? null : label;
      this.colour();
      this.draw();
      for (const button of this.tubes.querySelectorAll("button"))
        button.setAttribute("aria-pressed", String(Number(button.textContent) === this.highlighted));
    }

    // ---- Where it is seen from

    resetView() {
      const box = new THREE.Box3().setFromObject(this.solids);
      const sphere = box.getBoundingSphere(new THREE.Sphere());
      const distance = 0.95 * sphere.radius / Math.sin(THREE.Math.degToRad(FIELD_OF_VIEW / 2));
      const [azimuth, elevation] = [THREE.Math.degToRad(-60), THREE.Math.degToRad(60)];
      this.camera.near = 0.02 * distance;
      this.camera.far = 20 * distance;
      this.camera.position.set(Math.cos(azimuth) * Math.cos(elevation), Math.sin(azimuth) * Math.cos(elevation), Math.sin(elevation))
        .multiplyScalar(distance).add(sphere.center);
      this.controls.target.copy(sphere.center);
      this.resize();
    }

    resize() {
      const { clientWidth, clientHeight } = this.canvas;
      if (clientWidth === 0) return;
      this.renderer.setSize(clientWidth, clientHeight, false);
      this.camera.aspect = clientWidth / clientHeight;
      this.camera.zoom = Math.min(1, this.camera.aspect);
      this.camera.updateProjectionMatrix();
      this.controls.update();
      this.draw();
    }

    onKey(event) {
      if (!this.scene) return;
      const turn = 0.1;
      const moves = {
        ArrowLeft: [-turn, 0, 1], ArrowRight: [turn, 0, 1], ArrowUp: [0, -turn, 1], ArrowDown: [0, turn, 1],
        "+": [0, 0, 0.85], "=": [0, 0, 0.85], "-": [0, 0, 1 / 0.85],
      };
      if (event.key === "Home") this.resetView();
      else if (moves[event.key]) this.move(...moves[event.key]);
      else return;
      event.preventDefault();
    }

    // Turns by angles, rad, and multiplies the distance.
    move(azimuth, polar, zoom) {
      const toY = new THREE.Quaternion().setFromUnitVectors(this.camera.up, new THREE.Vector3(0, 1, 0));
      const offset = this.camera.position.clone().sub(this.controls.target).applyQuaternion(toY);
      const place = new THREE.Spherical().setFromVector3(offset);
      place.theta += azimuth;
      place.phi += polar;
      place.radius *= zoom;
      place.makeSafe();
      offset.setFromSpherical(place).applyQuaternion(toY.inverse());
      this.camera.position.copy(this.controls.target).add(offset);
      this.controls.update();
    }

    onHover(event) {
      if (event.buttons !== 0 || !(this.scene?.count > 0)) return;
      const { left, top, width, height } = this.canvas.getBoundingClientRect();
      const at = new THREE.Vector2(2 * (event.clientX - left) / width - 1, 1 - 2 * (event.clientY - top) / height);
      const ray = new THREE.Raycaster();
      ray.params.Points.threshold = this.points.userData.spacing;
      ray.setFromCamera(at, this.camera);
      const [hit] = ray.intersectObject(this.points);
      this.hover.value = hit ? this.wordsOf(hit.index) : "";
    }

    wordsOf(i) {
      const millimetres = [...this.scene.positions.subarray(3 * i, 3 * i + 3)].map(value => (1000 * value).toFixed(1));
      const words = [`x ${millimetres[0]}, y ${millimetres[1]}, z ${millimetres[2]} mm`];
      for (const { name, labels } of this.scene.labellings) if (labels) words.push(`${name}: ${nameOfLabel(labels[i])}`);
      return words.join(" · ");
    }
  }

  for (const figure of document.querySelectorAll("figure.scene-view")) {
    try {
      new SceneView(figure);
    } catch (error) {
      console.error(error);  // the picture stays
    }
  }
})();
