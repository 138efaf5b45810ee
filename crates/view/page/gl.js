// A thin layer over WebGL2: programs with named inputs, and buffers of instances.

class Program {
  constructor(gl, { vertex, fragment }) {
    this.gl = gl;
    this.program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(this.program, shader);
    }
    gl.linkProgram(this.program);
    if (!gl.getProgramParameter(this.program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(this.program));
    this.places = {};
    for (let k = 0; k < gl.getProgramParameter(this.program, gl.ACTIVE_UNIFORMS); k++) {
      const { name } = gl.getActiveUniform(this.program, k);
      this.places[name] = gl.getUniformLocation(this.program, name);
    }
  }

  // Values of uniforms: a number, or an array of two to sixteen.
  set(values) {
    const gl = this.gl;
    gl.useProgram(this.program);
    for (const [name, value] of Object.entries(values)) {
      const place = this.places[name];
      if (!Array.isArray(value)) gl.uniform1f(place, value);
      else if (value.length === 16) gl.uniformMatrix4fv(place, false, value);
      else gl[`uniform${value.length}fv`](place, value);
    }
  }

  // A vertex array of the buffers: [data or buffer, whether it goes on by instances, ["name", numbers], ...].
  arrange(...sources) {
    const gl = this.gl, array = gl.createVertexArray();
    gl.bindVertexArray(array);
    const buffers = sources.map(([data, byInstance, ...inputs]) => {
      const buffer = data instanceof WebGLBuffer ? data : gl.createBuffer();
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      if (data instanceof Float32Array) gl.bufferData(gl.ARRAY_BUFFER, data, gl.DYNAMIC_DRAW);
      const stride = 4 * inputs.reduce((sum, [, size]) => sum + size, 0);
      let offset = 0;
      for (const [name, size] of inputs) {
        const place = gl.getAttribLocation(this.program, name);
        if (place >= 0) {
          gl.enableVertexAttribArray(place);
          gl.vertexAttribPointer(place, size, gl.FLOAT, false, stride, offset);
          gl.vertexAttribDivisor(place, byInstance ? 1 : 0);
        }
        offset += 4 * size;
      }
      return buffer;
    });
    return { array, buffers };
  }
}

// A unit sphere whose equator is split, so that it can be drawn out along x to a capsule.
function sphere(rings, sectors) {
  const points = [], triangles = [];
  const latitudes = Array.from({ length: rings + 1 }, (_, i) => Math.PI * (i / rings) - Math.PI / 2);
  latitudes.splice(rings / 2, 1, -1e-4, 1e-4);
  latitudes.forEach((latitude) => {
    for (let j = 0; j <= sectors; j++) {
      const longitude = (2 * Math.PI * j) / sectors;
      points.push(Math.sin(latitude), Math.cos(latitude) * Math.cos(longitude), Math.cos(latitude) * Math.sin(longitude));
    }
  });
  for (let i = 0; i < latitudes.length - 1; i++) {
    for (let j = 0; j < sectors; j++) {
      const a = i * (sectors + 1) + j, b = a + sectors + 1;
      triangles.push(a, a + 1, b, b, a + 1, b + 1);
    }
  }
  return { points: new Float32Array(points), triangles: new Uint16Array(triangles) };
}
