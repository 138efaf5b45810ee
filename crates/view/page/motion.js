// A motion of a tree of bodies: attitudes at the frames, and what follows from them at any time.

class Motion {
  constructor(bodies, description, named) {
    this.bodies = bodies;
    this.name = description.name;
    this.facts = description.facts;
    this.curves = named;
    this.t = named.t[0];
    this.frames = this.t.length;
    this.end = this.t[this.frames - 1];
    this.place = [...named.x, ...named.y, ...named.z];
    this.attitudes = bodies.map((_, i) => quaternions(named, i, this.frames));
  }

  // The frame at or before a time, and how far the time is on the way to the next one.
  locate(t) {
    let low = 0, high = this.frames - 1;
    while (high - low > 1) {
      const middle = (low + high) >> 1;
      if (this.t[middle] <= t) low = middle; else high = middle;
    }
    const length = this.t[high] - this.t[low];
    return [low, length > 0 ? clamp((t - this.t[low]) / length, 0, 1) : 0];
  }

  attitude(i, k, s) {
    const q = this.attitudes[i], last = this.frames - 1;
    const at = (frame) => q.subarray(4 * frame, 4 * frame + 4);
    const [a, b] = [at(k), at(Math.min(k + 1, last))];
    return unit([0, 1, 2, 3].map((c) => a[c] + (b[c] - a[c]) * s));
  }

  // Attitudes and mass centres; what hangs on a joint stays on it between the frames.
  pose(t) {
    return this.poseAt(...this.locate(t));
  }

  poseAt(k, s) {
    const last = Math.min(k + 1, this.frames - 1);
    const first = this.place.map((x) => x[k] + (x[last] - x[k]) * s);
    const q = this.bodies.map((_, i) => this.attitude(i, k, s));
    const x = [];
    this.bodies.forEach(({ parent, joint }, i) => {
      if (parent === null) x.push(first);
      else x.push(sub(add(x[parent], rotate(q[parent], joint.at_parent)), rotate(q[i], joint.at_child)));
    });
    return { q, x };
  }

  // The angle of a joint at all frames: about the axis of a hinge with its sign and not wrapped, of a ball its size; degrees.
  angle(i) {
    const { parent, joint } = this.bodies[i], { axis } = joint, out = new Float32Array(this.frames);
    const own = this.attitudes[i], other = parent === null ? null : this.attitudes[parent];
    for (let k = 0, last = 0; k < this.frames; k++) {
      const [e, f, g, h] = own.subarray(4 * k, 4 * k + 4);
      const [a, b, c, d] = other ? other.subarray(4 * k, 4 * k + 4) : [1, 0, 0, 0];
      const w = a * e + b * f + c * g + d * h;
      const x = a * f - b * e - c * h + d * g, y = a * g + b * h - c * e - d * f, z = a * h - b * g + c * f - d * e;
      let angle = axis ? Math.atan2(x * axis[0] + y * axis[1] + z * axis[2], w) : Math.atan2(Math.hypot(x, y, z), Math.abs(w));
      angle *= 360 / Math.PI;
      if (axis) angle -= 720 * Math.round((angle - last) / 720);
      if (axis && Math.abs(angle - last) > 180) angle -= 360 * Math.sign(angle - last);
      last = angle;
      out[k] = angle;
    }
    return out;
  }
}

// Three of the four numbers are given: the other one is positive, and `left_out` says which it is. Signs are made continuous.
function quaternions(named, i, frames) {
  const out = new Float32Array(4 * frames), given = named.attitudes.slice(3 * i, 3 * i + 3), leftOut = named.left_out[i];
  for (let k = 0; k < frames; k++) {
    const place = Math.round(leftOut[k]), q = given.map((c) => c[k]);
    q.splice(place, 0, Math.sqrt(Math.max(0, 1 - dot(q, q))));
    const before = k ? out.subarray(4 * k - 4, 4 * k) : q;
    const sign = q[0] * before[0] + q[1] * before[1] + q[2] * before[2] + q[3] * before[3] < 0 ? -1 : 1;
    q.forEach((x, c) => { out[4 * k + c] = sign * x; });
  }
  return out;
}
