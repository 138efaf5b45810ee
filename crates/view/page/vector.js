// Vectors and quaternions (w, x, y, z) as arrays of numbers.

const add = (a, b) => a.map((x, i) => x + b[i]);
const sub = (a, b) => a.map((x, i) => x - b[i]);
const scale = (a, s) => a.map((x) => x * s);
const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const norm = (a) => Math.hypot(...a);
const unit = (a) => scale(a, 1 / (norm(a) || 1));
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const mix = (a, b, s) => a.map((x, i) => x + (b[i] - x) * s);
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

const rotate = ([w, ...v], p) => {
  const t = scale(cross(v, p), 2);
  return add(add(p, scale(t, w)), cross(v, t));
};
const conjugate = ([w, x, y, z]) => [w, -x, -y, -z];
const compose = ([a, b, c, d], [e, f, g, h]) => [
  a * e - b * f - c * g - d * h,
  a * f + b * e + c * h - d * g,
  a * g - b * h + c * e + d * f,
  a * h + b * g - c * f + d * e,
];
// The shortest turn of the x axis onto a direction.
const towards = (direction) => {
  const [x, y, z] = unit(direction);
  return x < -0.999999 ? [0, 0, 1, 0] : unit([1 + x, 0, -z, y]);
};

// 4 x 4 matrices by columns.
const product = (a, b) => Array.from({ length: 16 }, (_, k) => {
  let sum = 0;
  for (let i = 0; i < 4; i++) sum += a[i * 4 + (k % 4)] * b[(k >> 2) * 4 + i];
  return sum;
});

// The largest of 1, 2 and 5 times a power of ten that does not exceed x.
const round = (x) => {
  const power = 10 ** Math.floor(Math.log10(x));
  return power * [5, 2, 1].find((step) => step * power <= x * 1.000001);
};
