// Colours that colour-blind readers can tell apart: those of M. Okabe and K. Ito.

const OKABE = {
  orange: "#e69f00", sky: "#56b4e9", green: "#009e73", yellow: "#f0e442", blue: "#0072b2", vermilion: "#d55e00", purple: "#cc79a7",
};
const HEAD = OKABE.orange;
const LINES = [OKABE.blue, OKABE.purple, OKABE.green, OKABE.vermilion, OKABE.orange, OKABE.sky];
const GHOST = OKABE.purple;

const rgb = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);
const variable = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// A scale from blue over grey to yellow, after cividis; `s` from 0 to 1.
function heat(s) {
  const stops = [[0, 34, 78], [65, 77, 107], [124, 123, 120], [188, 175, 111], [254, 232, 56]];
  const at = clamp(s, 0, 1) * 4, k = Math.min(3, Math.floor(at));
  return mix(stops[k], stops[k + 1], at - k);
}
