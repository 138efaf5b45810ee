// Where the picture is taken from: all bodies stay in view, at all times.

const FIELD = 0.5; // rad, from bottom to top
const MARGIN = 0.86; // of the picture is for the bodies
const LOOKS = 150; // frames that are looked at

class Camera {
  constructor(motions, hasWeight) {
    this.motions = motions;
    this.hasWeight = hasWeight;
    this.aspect = 1.6;
    this.samples = seen(motions.map(sampled));
    this.box = hull(this.samples);
    this.size = Math.max(...this.samples.map((sample) => sample.radius), 1e-9);
    this.follows = norm(sub(this.box[1], this.box[0])) / 2 > 2.2 * this.size;
    this.track = smoothed(this.samples, motions[0].end);
    this.shift = [0, 0, 0];
    Object.assign(this, this.bestDirection());
    this.frame();
  }

  // Where it looks at a time, before it is shifted.
  target(t) {
    if (!this.follows) return scale(add(...this.box), 0.5);
    const { times, centres } = this.track;
    let k = times.findIndex((time) => time > t);
    if (k < 0) k = times.length - 1;
    if (k === 0) return centres[0];
    return mix(centres[k - 1], centres[k], clamp((t - times[k - 1]) / (times[k] - times[k - 1] || 1), 0, 1));
  }

  axes(azimuth = this.azimuth, elevation = this.elevation) {
    const [ca, sa, ce, se] = [Math.cos(azimuth), Math.sin(azimuth), Math.cos(elevation), Math.sin(elevation)];
    return { right: [-sa, ca, 0], up: [-se * ca, -se * sa, ce], back: [ce * ca, ce * sa, se] };
  }

  // How far away it must be, and how far aside, so that everything is in view: each half of the picture asks for a distance.
  fit(azimuth, elevation) {
    const { right, up, back } = this.axes(azimuth, elevation);
    const vertical = Math.tan(FIELD / 2) * MARGIN, sides = [vertical * this.aspect, vertical];
    const far = [[-Infinity, -Infinity], [-Infinity, -Infinity]];
    for (const { t, x, extents } of this.samples) {
      const target = this.target(t);
      x.forEach((centre, i) => {
        const from = sub(centre, target), depth = dot(from, back) + extents[i](back);
        [right, up].forEach((axis, side) => {
          const [along, reach] = [dot(from, axis), extents[i](axis)];
          far[side][0] = Math.max(far[side][0], depth + (along + reach) / sides[side]);
          far[side][1] = Math.max(far[side][1], depth + (reach - along) / sides[side]);
        });
      });
    }
    const distance = Math.max((far[0][0] + far[0][1]) / 2, (far[1][0] + far[1][1]) / 2, this.size * 0.1);
    const aside = far.map(([a, b], side) => (sides[side] * (a - b)) / 2);
    return { distance, shift: add(scale(right, aside[0]), scale(up, aside[1])) };
  }

  frame() {
    Object.assign(this, this.fit(this.azimuth, this.elevation));
  }

  // The side that shows most: the bodies' places are spread widely over the picture, and large.
  bestDirection() {
    const heights = this.hasWeight ? [0.15, 0.3] : [0.3, 0.45, 0.6];
    const all = heights.flatMap((elevation) => Array.from({ length: 24 }, (_, k) => ({ azimuth: -Math.PI + (k * Math.PI) / 12, elevation })));
    const kept = this.samples;
    this.samples = some(kept, 24).map(({ t, x, extents }) => ({ t, x: some(x, 40), extents: some(extents, 40) }));
    const score = ({ azimuth, elevation }) => {
      const { right, up } = this.axes(azimuth, elevation);
      const spread = [0, 0, 0];
      for (const { t, x, extents } of this.samples) {
        const target = this.target(t);
        x.forEach((centre, i) => {
          const from = sub(centre, target), [a, b] = [dot(from, right), dot(from, up)];
          spread[0] += a * a + extents[i](right) ** 2;
          spread[1] += b * b + extents[i](up) ** 2;
          spread[2] += a * b;
        });
      }
      const area = Math.sqrt(Math.max(0, spread[0] * spread[1] - spread[2] ** 2));
      // Of equal views the one from the front, and a little from the right.
      return (area / this.fit(azimuth, elevation).distance ** 2) * (1 + 0.04 * Math.cos(azimuth + 1.1));
    };
    const scores = all.map(score);
    this.samples = kept;
    return all[scores.indexOf(Math.max(...scores))];
  }

  // From points of the world to the picture, and the place of the eye.
  view(t) {
    const { right, up, back } = this.axes();
    const target = add(this.target(t), this.shift), eye = add(target, scale(back, this.distance));
    const f = 1 / Math.tan(FIELD / 2), near = this.distance / 50, far = this.distance * 50;
    const rotation = [0, 1, 2].flatMap((i) => [right[i], up[i], back[i], 0]);
    const look = [...rotation, -dot(right, eye), -dot(up, eye), -dot(back, eye), 1];
    const lens = [f / this.aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / (near - far), -1, 0, 0, (2 * far * near) / (near - far), 0];
    return { matrix: product(lens, look), eye, target, right, up, back };
  }

  turn(dx, dy) {
    this.azimuth -= dx * 0.006;
    this.elevation = clamp(this.elevation + dy * 0.006, -1.5, 1.5);
  }

  move(dx, dy) {
    const { right, up } = this.axes(), step = this.distance * 0.0012;
    this.shift = add(this.shift, add(scale(right, -dx * step), scale(up, dy * step)));
  }

  zoom(times) {
    this.distance = clamp(this.distance * times, this.size * 0.05, this.size * 1e4);
  }
}

// A few times of a motion, with the bodies' places and how far each reaches in a direction.
function sampled(motion) {
  const count = Math.min(LOOKS, motion.frames);
  return Array.from({ length: count }, (_, j) => {
    const k = Math.round((j * (motion.frames - 1)) / Math.max(1, count - 1));
    const { q, x } = motion.poseAt(k, 0);
    const extents = motion.bodies.map(({ axes }, i) => {
      const columns = [0, 1, 2].map((c) => rotate(q[i], [0, 1, 2].map((d) => (c === d ? axes[c] : 0))));
      return (direction) => Math.hypot(dot(columns[0], direction), dot(columns[1], direction), dot(columns[2], direction));
    });
    const low = [0, 1, 2].map((c) => Math.min(...x.map((p, i) => p[c] - extents[i](UNITS[c]))));
    const high = [0, 1, 2].map((c) => Math.max(...x.map((p, i) => p[c] + extents[i](UNITS[c]))));
    const centre = scale(add(low, high), 0.5);
    return { t: motion.t[k], x, extents, low, high, centre, radius: norm(sub(high, low)) / 2 };
  });
}

// The first motion, and the others unless they run away from it.
function seen([first, ...others]) {
  const size = (samples) => norm(sub(...hull(samples)));
  return [first, ...others.filter((samples) => size([...first, ...samples]) <= 3 * size(first))].flat();
}

const some = (all, most) => all.filter((_, k) => k % Math.ceil(all.length / most) === 0);
const UNITS = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];

function hull(samples) {
  const each = (pick, key) => [0, 1, 2].map((c) => samples.reduce((best, sample) => pick(best, sample[key][c]), samples[0][key][c]));
  return [each(Math.min, "low"), each(Math.max, "high")];
}

// The centre of all bodies over time, without what is faster than a sixteenth of the run.
function smoothed(samples, end) {
  const times = [...new Set(samples.map((sample) => sample.t))].sort((a, b) => a - b);
  const width = end / 16 || 1;
  const centres = times.map((t) => {
    let [sum, total] = [[0, 0, 0], 0];
    for (const sample of samples) {
      const weight = Math.exp(-(((sample.t - t) / width) ** 2) * 2);
      sum = add(sum, scale(sample.centre, weight));
      total += weight;
    }
    return scale(sum, 1 / total);
  });
  return { times, centres };
}
