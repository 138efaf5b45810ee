// The bodies, and what holds them together: each part with the body that it is fixed to.

const ALONG_X = [1, 0, 0, 0];
const DARK = [0.3, 0.34, 0.38, 1];
const PALE = [0.93, 0.94, 0.95, 1];
const THIN = 0.45; // a rod's radius, by that of its joint

function solids(bodies, isGhost) {
  const paint = (own) => (isGhost ? [...rgb(GHOST), 0.5] : own);
  const shown = bodies.map(({ axes, colour }, body) => ({ body, at: null, turn: ALONG_X, axes, stretch: 0, colour: paint([...colour, 1]) }));
  const fittings = bodies.flatMap((body, i) => (body.joint ? joint(bodies, i) : []));
  return { bodies: shown, fittings: fittings.map((part) => ({ ...part, colour: paint(part.colour) })) };
}

// A ball, or a pin along the axis of a hinge, and rods to it where it lies outside of its bodies.
function joint(bodies, i) {
  const body = bodies[i], parent = bodies[body.parent], { at_parent, at_child, axis } = body.joint;
  const radius = 0.26 * Math.min(middle(body.axes), parent ? middle(parent.axes) : Infinity);
  const parts = [];
  const rod = (on, at) => {
    if (norm(at.map((x, c) => x / bodies[on].axes[c])) <= 1.01) return;
    const axes = Array(3).fill(THIN * radius);
    parts.push({ body: on, at: scale(at, 0.5), turn: towards(at), axes, stretch: norm(at) / 2, colour: DARK });
  };
  rod(i, at_child);
  if (parent) rod(body.parent, at_parent);
  // What hangs on the world has a dark pin through it.
  const [size, length] = parent ? [1, axis ? 0.9 : 0] : [0.8, 4.8];
  const turn = axis ? towards(axis) : ALONG_X;
  return [...parts, { body: i, at: at_child, turn, axes: Array(3).fill(size * radius), stretch: length * radius, colour: parent ? PALE : DARK }];
}

const middle = (axes) => [...axes].sort((a, b) => a - b)[1];
