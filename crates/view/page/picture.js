// The picture: ground and shadows, the ways of the heads, joints and bodies with outlines.

const NUMBERS = 15; // of an instance
const MANY = 60; // bodies, beyond which they are drawn more coarsely
const LAYOUT = [["centre", 3], ["attitude", 4], ["axes", 3], ["stretch", 1], ["colour", 4]];

class Picture {
  constructor(canvas, motions, camera) {
    const gl = canvas.getContext("webgl2", { antialias: true, preserveDrawingBuffer: true });
    if (!gl) throw new Error("this browser offers no WebGL2; try another one");
    Object.assign(this, { gl, canvas, motions, camera, shown: motions.map(() => true) });
    this.solid = new Program(gl, SOLID);
    this.way = new Program(gl, WAY);
    this.ground = new Program(gl, GROUND);
    const count = motions[0].bodies.length, fine = count > MANY ? [10, 16] : count > 12 ? [20, 32] : [28, 48];
    this.parts = motions.map((motion, m) => {
      const { bodies, fittings } = solids(motion.bodies, m > 0);
      return [this.batch(bodies, fine), this.batch(fittings, count > MANY ? [4, 8] : [10, 16])];
    });
    const square = new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]);
    this.plane = this.ground.arrange([square, false, ["corner", 2]]);
    this.ways = motions.map((motion) => this.wayOf(motion));
    this.low = camera.box[0][2] - 0.25 * camera.size;
  }

  batch(list, [rings, sectors]) {
    const gl = this.gl, { points, triangles } = sphere(rings, sectors);
    const instances = new Float32Array(list.length * NUMBERS);
    list.forEach(({ axes, stretch, colour }, k) => instances.set([...axes, stretch, ...colour], k * NUMBERS + 7));
    const { array, buffers } = this.solid.arrange([points, false, ["point", 3]], [instances, true, ...LAYOUT]);
    const index = gl.createBuffer();
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, index);
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, triangles, gl.STATIC_DRAW);
    return { list, instances, array, buffer: buffers[1], count: triangles.length };
  }

  // Two triangles a piece: thousands of instances of two triangles are slow without a graphics card.
  wayOf(motion) {
    const corners = [[0, -1], [1, -1], [0, 1], [0, 1], [1, -1], [1, 1]];
    const point = (k) => motion.place.map((x) => x[k]);
    const numbers = new Float32Array((motion.frames - 1) * 6 * 9);
    for (let k = 0; k + 1 < motion.frames; k++) {
      corners.forEach((corner, c) => numbers.set([...corner, ...point(k), ...point(k + 1), motion.t[k]], (6 * k + c) * 9));
    }
    const { array } = this.way.arrange([numbers, false, ["corner", 2], ["from", 3], ["to", 3], ["when", 1]]);
    return { array, count: 6 * (motion.frames - 1) };
  }

  // Puts the instances where a pose has them.
  place({ list, instances, buffer }, { q, x }) {
    list.forEach(({ body, at, turn }, k) => {
      const centre = at ? add(x[body], rotate(q[body], at)) : x[body];
      instances.set(centre, k * NUMBERS);
      instances.set(turn === ALONG_X ? q[body] : compose(q[body], turn), k * NUMBERS + 3);
    });
    this.gl.bindBuffer(this.gl.ARRAY_BUFFER, buffer);
    this.gl.bufferSubData(this.gl.ARRAY_BUFFER, 0, instances);
  }

  draw(t) {
    const { gl, canvas, camera } = this;
    const view = camera.view(t), pixels = [canvas.width, canvas.height];
    const paper = rgb(variable("--water")), ink = rgb(variable("--ink"));
    gl.viewport(0, 0, ...pixels);
    gl.clearColor(...paper, 1);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.CULL_FACE);
    const parts = this.parts.filter((_, m) => this.shown[m]);
    this.motions.forEach((motion, m) => {
      const pose = this.shown[m] && motion.pose(t);
      if (pose) this.parts[m].forEach((part) => this.place(part, pose));
    });
    const ground = this.drawGround(view, paper);
    // Over the left shoulder of who looks.
    const light = unit(add(add(scale(view.right, -0.45), scale(view.up, 0.7)), scale(view.back, 0.6)));
    const solid = { matrix: view.matrix, pixels, eye: view.eye, light };
    this.solid.set({ ...solid, rim: 0, ground, flat_colour: [...mix(paper, ink, 0.13), 1] });
    parts.forEach(([bodies]) => this.instances(bodies));
    gl.enable(gl.DEPTH_TEST);
    this.drawWays(view, t, pixels, paper);
    this.solid.set({ ...solid, rim: this.rim(), ground: -2e30, flat_colour: [0.05, 0.07, 0.09, 1] });
    gl.cullFace(gl.FRONT);
    const outlined = parts.flatMap(([bodies, fittings]) => (bodies.list.length > MANY ? [bodies] : [bodies, fittings]));
    outlined.forEach((part) => this.instances(part));
    gl.cullFace(gl.BACK);
    parts.forEach((both) => both.forEach((part, isFitting) => {
      this.solid.set({ rim: 0, flat_colour: [0, 0, 0, 0], seam: isFitting ? 0 : 1 });
      this.instances(part);
    }));
  }

  // An outline is thin against what it is of, pixels.
  rim() {
    const { canvas, camera, motions } = this;
    const sizes = motions[0].bodies.map(({ axes }) => middle(axes)).sort((a, b) => a - b);
    const pixels = (sizes[sizes.length >> 1] / camera.distance) * (canvas.height / 2 / Math.tan(FIELD / 2));
    return clamp(0.15 * pixels, 0.3, 1.3 * (canvas.width / canvas.clientWidth || 1));
  }

  instances({ array, count, list }) {
    this.gl.bindVertexArray(array);
    this.gl.drawElementsInstanced(this.gl.TRIANGLES, count, this.gl.UNSIGNED_SHORT, 0, list.length);
  }

  // Under everything: it hides nothing. Where a motion goes far down, the ground goes along.
  drawGround({ matrix, target }, paper) {
    const { gl, camera } = this;
    const sinks = camera.follows && camera.box[1][2] - camera.box[0][2] > 3 * camera.size;
    const height = sinks ? target[2] - 1.1 * camera.size : this.low;
    this.cell = round(camera.distance / 24);
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.CULL_FACE);
    this.ground.set({ matrix, middle: [target[0], target[1], height], reach: 2.2 * camera.distance, cell: this.cell, paper, line: rgb(variable("--soft")) });
    gl.bindVertexArray(this.plane.array);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    gl.enable(gl.CULL_FACE);
    return height;
  }

  drawWays({ matrix }, now, pixels, paper) {
    const { gl } = this;
    gl.disable(gl.CULL_FACE);
    this.ways.forEach(({ array, count }, m) => {
      if (!this.shown[m]) return;
      this.way.set({ matrix, pixels, now, paper, width: 2.2 * devicePixelRatio, paint: rgb(m ? GHOST : HEAD) });
      gl.bindVertexArray(array);
      gl.drawArrays(gl.TRIANGLES, 0, count);
    });
    gl.enable(gl.CULL_FACE);
  }

  // Where the bodies' centres are in the picture, from -1 to 1 across and up; what is behind the eye is nowhere.
  places(t) {
    const { matrix } = this.camera.view(t);
    return this.motions.flatMap((motion) => motion.pose(t).x.map(([x, y, z]) => {
      const [a, b, w] = [0, 1, 3].map((row) => matrix[row] * x + matrix[4 + row] * y + matrix[8 + row] * z + matrix[12 + row]);
      return w > 0 ? [a / w, b / w] : [Infinity, Infinity];
    }));
  }
}
