// The page: reads the run, lays out picture, controls and charts, and keeps them at one time.

const SPEEDS = [0.05, 0.1, 0.25, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500];
const LONGEST = 30; // s that a run takes to be seen, unless asked otherwise
const at = (id) => document.getElementById(id);

// For scripts: the time, and where the bodies are in the picture. `ready` is a promise.
window.lgvi = { ready: start().catch((error) => { trouble(error); throw error; }) };

function trouble(error) {
  at("trouble").hidden = false;
  at("trouble").textContent = `This run cannot be shown: ${error.message}`;
}

async function start() {
  const run = JSON.parse(at("run").textContent);
  const motions = await Promise.all(run.motions.map(async (motion) => new Motion(run.bodies, motion, await columns(motion))));
  const end = Math.max(...motions.map((motion) => motion.end));
  at("title").textContent = run.title;
  theme(localTheme());
  const camera = new Camera(motions, run.has_weight), picture = new Picture(at("picture"), motions, camera);
  const charts = new Charts(at("charts"), chartsOf(run, motions), end, (t) => go(t));
  const state = { t: 0, speed: SPEEDS.find((speed) => end / speed <= LONGEST) || 500, isPlaying: false, last: 0, dirty: true };

  legend(motions, picture, () => { state.dirty = true; });
  controls(state, { end, motions, camera, go, play, restyle, fit });
  hand(at("picture"), camera, () => { state.dirty = true; }, fit);
  new ResizeObserver(resize).observe(at("stage"));
  new ResizeObserver(() => { charts.draw(); charts.mark(state.t); }).observe(at("charts"));
  resize();
  fit();
  charts.draw();
  go(0);
  requestAnimationFrame(tick);

  function resize() {
    const canvas = at("picture"), ratio = Math.min(devicePixelRatio, 2);
    [canvas.width, canvas.height] = [Math.max(1, canvas.clientWidth * ratio), Math.max(1, canvas.clientHeight * ratio)];
    const aspect = canvas.width / canvas.height, changed = Math.abs(aspect / camera.aspect - 1) > 0.01;
    camera.aspect = aspect;
    if (changed) fit();
    state.dirty = true;
  }

  function fit() {
    camera.frame();
    state.dirty = true;
  }

  function go(t) {
    state.t = clamp(t, 0, end);
    at("scrubber").value = state.t;
    at("clock").textContent = `${state.t.toFixed(end < 10 ? 2 : 1)} / ${shortly(end)} s`;
    charts.mark(state.t);
    state.dirty = true;
  }

  function play(isPlaying = !state.isPlaying) {
    if (isPlaying && state.t >= end) go(0);
    state.isPlaying = isPlaying;
    at("play").textContent = isPlaying ? "❚❚" : "▶";
  }

  function restyle() {
    charts.draw();
    go(state.t);
  }

  function tick(now) {
    if (state.isPlaying) {
      go(state.t + (Math.min(now - state.last, 200) / 1000) * state.speed);
      if (state.t >= end) play(false);
    }
    state.last = now;
    if (state.dirty) {
      picture.draw(state.t);
      at("scale").textContent = `grid ${shortly(picture.cell)} m`;
      state.dirty = false;
      window.lgvi.drawn = (window.lgvi.drawn || 0) + 1;
    }
    requestAnimationFrame(tick);
  }

  play(false);
  Object.assign(window.lgvi, { end, go, play, theme, camera, draw: () => picture.draw(state.t), time: () => state.t, places: (t) => picture.places(t) });
  return true;
}

// The charts of the file, and the angles of the joints, which follow from the attitudes.
function chartsOf(run, motions) {
  const charts = run.charts.map(({ title, unit, log, lines: all }) => ({
    title, unit, log,
    lines: all.map(({ name, motion, curve }, k) => ({
      name, motion: motions[motion], data: motions[motion].curves[curve][0], dashed: motion > 0,
      colour: LINES[k % LINES.length],
    })),
  }));
  const moving = run.bodies.map((body, i) => i).filter((i) => run.bodies[i].joint?.moves);
  if (!moving.length) return charts;
  const angles = { title: "joint angles", unit: "degrees", log: false };
  if (moving.length > FEW) return [...charts, { ...angles, map: true, motion: motions[0], rows: moving.map((i) => motions[0].angle(i)), lines: [] }];
  const all = motions.flatMap((motion, m) => moving.map((i, k) => ({
    name: m ? motion.name : run.bodies[i].joint.name, motion, data: motion.angle(i), colour: LINES[k % LINES.length], dashed: m > 0,
  })));
  return [...charts, { ...angles, lines: all }];
}

// What is shown, and a box to hide it where there are two.
function legend(motions, picture, changed) {
  motions.forEach((motion, m) => {
    const row = at("motions").appendChild(document.createElement("li")), label = row.appendChild(document.createElement("label"));
    if (motions.length > 1) {
      const box = label.appendChild(Object.assign(document.createElement("input"), { type: "checkbox", checked: true }));
      box.style.accentColor = m ? GHOST : HEAD;
      box.addEventListener("change", () => { picture.shown[m] = box.checked; changed(); });
    }
    label.append(Object.assign(document.createElement("b"), { textContent: motion.name }), ` ${motion.facts}`);
  });
}

function localTheme() {
  return matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
}

function theme(name) {
  document.documentElement.dataset.theme = name;
  at("theme").textContent = name === "dark" ? "☀" : "☾";
}
