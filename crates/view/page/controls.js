// Buttons, keys and the hand on the picture.

function controls(state, { end, motions, camera, go, play, restyle, fit }) {
  const scrubber = at("scrubber"), speed = at("speed");
  scrubber.max = end;
  scrubber.addEventListener("input", () => go(Number(scrubber.value)));
  speed.append(...SPEEDS.map((times) => new Option(`${times} ×`, times, false, times === state.speed)));
  speed.addEventListener("change", () => { state.speed = Number(speed.value); });
  const faster = (by) => {
    const k = clamp(SPEEDS.indexOf(state.speed) + by, 0, SPEEDS.length - 1);
    speed.value = state.speed = SPEEDS[k];
  };
  const step = (by) => {
    const { t, frames } = motions[0], [k] = motions[0].locate(state.t);
    play(false);
    const near = Math.abs(t[Math.min(k + 1, frames - 1)] - state.t) < 1e-9 * end ? k + 1 : k;
    go(t[clamp(near + by, 0, frames - 1)]);
  };
  const name = () => { at("follow").textContent = camera.follows ? "whole way" : "follow"; };
  const follow = () => { camera.follows = !camera.follows; name(); fit(); };
  const turn = () => { theme(document.documentElement.dataset.theme === "dark" ? "light" : "dark"); restyle(); };
  name();
  at("play").addEventListener("click", () => play());
  at("follow").addEventListener("click", follow);
  at("frame").addEventListener("click", fit);
  at("theme").addEventListener("click", turn);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => { theme(localTheme()); restyle(); });
  const keys = {
    " ": () => play(), ArrowLeft: () => step(-1), ArrowRight: () => step(1), Home: () => go(0), End: () => go(end),
    "[": () => faster(-1), "]": () => faster(1), f: follow, r: fit, t: turn,
  };
  addEventListener("keydown", (event) => {
    const isOfField = event.target === speed || (event.key === " " && event.target.tagName === "BUTTON");
    const act = keys[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!act || isOfField || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act();
  });
}

// One finger or button turns, two fingers zoom, shift or another button moves.
function hand(canvas, camera, changed, fit) {
  const down = new Map();
  const spread = () => {
    const [a, b] = [...down.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    down.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  canvas.addEventListener("pointermove", (event) => {
    const last = down.get(event.pointerId);
    if (!last) return;
    const [dx, dy, before] = [event.clientX - last.x, event.clientY - last.y, down.size === 2 && spread()];
    Object.assign(last, { x: event.clientX, y: event.clientY });
    if (before) camera.zoom(before / spread());
    else if (event.shiftKey || event.buttons > 1) camera.move(dx, dy);
    else camera.turn(dx, dy);
    changed();
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => down.delete(event.pointerId));
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("dblclick", fit);
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    camera.zoom(Math.exp(event.deltaY * 0.001));
    changed();
  }, { passive: false });
}
