// What is drawn, in three programs: solids (ellipsoids and capsules), ways as bands of even width, and the ground.

const SOLID = {
  vertex: `#version 300 es
    in vec3 point;
    in vec3 centre; in vec4 attitude; in vec3 axes; in float stretch; in vec4 colour;
    uniform mat4 matrix; uniform float rim; uniform vec2 pixels; uniform float ground;
    out vec3 normal; out vec3 place; out vec3 body; out vec4 paint;
    vec3 turned(vec3 v) { return v + 2.0 * cross(attitude.yzw, cross(attitude.yzw, v) + attitude.x * v); }
    void main() {
      vec3 cap = vec3(stretch * sign(point.x), 0.0, 0.0);
      place = centre + turned(point * axes + cap);
      normal = normalize(turned(point / axes));
      body = point; paint = colour;
      if (ground > -1e30) place.z = ground;
      gl_Position = matrix * vec4(place, 1.0);
      vec2 aside = (matrix * vec4(normal, 0.0)).xy * pixels;
      gl_Position.xy += rim * normalize(aside + 1e-9) / pixels * gl_Position.w * 2.0;
    }`,
  fragment: `#version 300 es
    precision highp float;
    in vec3 normal; in vec3 place; in vec3 body; in vec4 paint;
    uniform vec3 eye; uniform vec3 light; uniform vec4 flat_colour; uniform float seam;
    out vec4 colour;
    void main() {
      // A ghost is a lattice of points, so that nothing need be sorted.
      if (paint.a < 0.99 && mod(floor(gl_FragCoord.x) + floor(gl_FragCoord.y), 2.0) > 0.5) discard;
      if (flat_colour.a > 0.0) { colour = flat_colour; return; }
      vec3 n = normalize(normal), view = normalize(eye - place);
      float sky = 0.5 + 0.5 * n.z, sun = max(dot(n, light), 0.0);
      // Darker above than below, with a seam along the back: turns about the long axis are seen.
      vec3 skin = paint.rgb * mix(1.0, mix(1.14, 0.94, smoothstep(-0.25, 0.25, body.z)), seam);
      float aside = abs(body.y) / fwidth(body.y);
      if (body.z > 0.0) skin *= mix(1.0, mix(0.7, 1.0, smoothstep(0.6, 1.6, aside)), seam);
      vec3 lit = skin * (0.56 + 0.12 * sky + 0.46 * sun);
      float shine = pow(max(dot(n, normalize(light + view)), 0.0), 40.0);
      colour = vec4(lit + 0.16 * shine, 1.0);
    }`,
};

const WAY = {
  vertex: `#version 300 es
    in vec2 corner; in vec3 from; in vec3 to; in float when;
    uniform mat4 matrix; uniform vec2 pixels; uniform float width; uniform float now;
    out float passed;
    void main() {
      vec4 a = matrix * vec4(from, 1.0), b = matrix * vec4(to, 1.0);
      vec2 along = normalize((b.xy / b.w - a.xy / a.w) * pixels + 1e-9);
      gl_Position = mix(a, b, corner.x);
      gl_Position.xy += vec2(-along.y, along.x) * corner.y * width / pixels * gl_Position.w;
      passed = when <= now ? 1.0 : 0.0;
    }`,
  fragment: `#version 300 es
    precision highp float;
    in float passed; uniform vec3 paint; uniform vec3 paper; out vec4 colour;
    void main() { colour = vec4(mix(paper, paint, passed > 0.5 ? 0.95 : 0.3), 1.0); }`,
};

const GROUND = {
  vertex: `#version 300 es
    in vec2 corner; uniform mat4 matrix; uniform vec3 middle; uniform float reach; out vec2 place;
    void main() { place = middle.xy + corner * reach; gl_Position = matrix * vec4(place, middle.z, 1.0); }`,
  fragment: `#version 300 es
    precision highp float;
    in vec2 place; uniform vec3 middle; uniform float reach; uniform float cell; uniform vec3 paper; uniform vec3 line;
    out vec4 colour;
    float lattice(float size) {
      vec2 wide = fwidth(place) / size;
      vec2 far = abs(fract(place / size - 0.5) - 0.5) / max(wide, 1e-6);
      float even = 1.0 - smoothstep(0.15, 0.5, max(wide.x, wide.y));
      return even * (1.0 - smoothstep(0.4, 1.4, min(far.x, far.y)));
    }
    void main() {
      float fade = 1.0 - smoothstep(0.25, 1.0, length(place - middle.xy) / reach);
      float seen = max(0.16 * lattice(cell), 0.42 * lattice(cell * 5.0));
      colour = vec4(mix(paper, line, seen * fade), 1.0);
    }`,
};
