// Charts over time, with the picture's time marked on them.

const FEW = 8; // lines in a chart; more joints are a map of tiles
const NOTHING = -17.9; // the logarithm of what stands for zero

class Charts {
  constructor(place, charts, end, go) {
    this.end = end;
    this.charts = charts.map((chart) => this.make(place, chart, go));
  }

  make(place, chart, go) {
    const figure = place.appendChild(document.createElement("figure"));
    const caption = figure.appendChild(document.createElement("figcaption"));
    caption.appendChild(document.createElement("strong")).textContent = chart.unit ? `${chart.title}, ${chart.unit}` : chart.title;
    const values = chart.map ? [] : chart.lines.map((line) => {
      const label = caption.appendChild(document.createElement("span"));
      const mark = label.appendChild(document.createElement("i"));
      Object.assign(mark.style, { borderTopColor: line.colour, borderTopStyle: line.dashed ? "dashed" : "solid" });
      return label.appendChild(document.createElement("span"));
    });
    const plot = figure.appendChild(document.createElement("div"));
    plot.className = "plot";
    const canvas = plot.appendChild(document.createElement("canvas")), cursor = plot.appendChild(document.createElement("div"));
    const made = { ...chart, values, plot, canvas, cursor, left: 46, right: 8, bottom: 16 };
    const seek = (event) => {
      const box = plot.getBoundingClientRect();
      go(clamp((event.clientX - box.left - made.left) / (box.width - made.left - made.right), 0, 1) * this.end);
    };
    plot.addEventListener("pointerdown", (event) => { plot.setPointerCapture(event.pointerId); seek(event); });
    plot.addEventListener("pointermove", (event) => { if (event.buttons) seek(event); });
    return made;
  }

  draw() {
    for (const chart of this.charts) {
      const { canvas, plot } = chart, ratio = devicePixelRatio;
      [canvas.width, canvas.height] = [plot.clientWidth * ratio, plot.clientHeight * ratio];
      const pen = canvas.getContext("2d");
      pen.scale(ratio, ratio);
      const area = { x: chart.left, y: 4, w: plot.clientWidth - chart.left - chart.right, h: plot.clientHeight - chart.bottom - 4 };
      chart.area = area;
      if (chart.map) tiles(pen, chart, area); else lines(pen, chart, area, this.end);
      timeAxis(pen, area, this.end);
    }
  }

  mark(t) {
    for (const { cursor, area, lines: all, values, log } of this.charts) {
      cursor.style.left = `${area.x + (area.w * t) / this.end}px`;
      values.forEach((label, k) => {
        const { name, motion, data } = all[k], value = data[motion.locate(t)[0]];
        label.textContent = `${name} ${log ? shortly(10 ** value) : shortly(value)}`;
      });
    }
  }
}

const shortly = (x) => (x === 0 ? "0" : Math.abs(x) < 1e-2 || Math.abs(x) >= 1e4 ? x.toExponential(1) : String(Number(x.toPrecision(3))));

// The range of all lines, and values for lines across.
function range({ lines: all, log }) {
  let [low, high] = [Infinity, -Infinity];
  for (const { data } of all) for (const y of data) { if (y < low) low = y; if (y > high) high = y; }
  if (!(low <= high)) [low, high] = [0, 1];
  if (log) {
    // What is zero for a while, as an error at the start, does not set the scale.
    const sorted = Float32Array.from(all.flatMap(({ data }) => [...data.filter((y) => y > NOTHING)])).sort();
    low = sorted.length ? sorted[Math.floor(sorted.length / 50)] : high;
    [low, high] = [Math.floor(low), Math.max(Math.ceil(high), Math.floor(low) + 1)];
  }
  if (high - low < 1e-12 * Math.max(Math.abs(low), Math.abs(high), 1e-300) || high === low) [low, high] = [low - (Math.abs(low) || 1), high + (Math.abs(high) || 1)];
  const pad = log ? 0.02 * (high - low) : 0.06 * (high - low);
  const step = log ? Math.max(1, Math.ceil((high - low) / 3)) : round((high - low) / 2.4);
  const ticks = [];
  for (let y = Math.ceil(low / step - 1e-9) * step; y <= high + 1e-9 * step; y += step) ticks.push(Math.abs(y) < 1e-9 * step ? 0 : y);
  return { low: low - pad, high: high + pad, ticks };
}

function lines(pen, chart, area, end) {
  const { low, high, ticks } = range(chart);
  const down = (y) => area.y + (area.h * (high - y)) / (high - low);
  pen.font = "11px system-ui, sans-serif";
  pen.textAlign = "right";
  pen.textBaseline = "middle";
  for (const y of ticks) {
    pen.strokeStyle = variable("--line");
    pen.strokeRect(area.x, Math.round(down(y)) + 0.5, area.w, 0);
    pen.fillStyle = variable("--soft");
    pen.fillText(chart.log ? `1e${Math.round(y)}` : shortly(y), area.x - 6, down(y));
  }
  pen.save();
  pen.beginPath();
  pen.rect(area.x, area.y - 1, area.w, area.h + 2);
  pen.clip();
  pen.lineJoin = "round";
  for (const { data, motion, colour, dashed } of chart.lines) {
    pen.beginPath();
    data.forEach((y, k) => {
      if (!chart.log || y > NOTHING) pen.lineTo(area.x + (area.w * motion.t[k]) / end, down(y));
    });
    Object.assign(pen, { strokeStyle: colour, lineWidth: 1.4 });
    pen.setLineDash(dashed ? [5, 3] : []);
    pen.stroke();
  }
  pen.restore();
}

// One row of tiles a joint, from the head down.
function tiles(pen, { rows, motion, unit }, area) {
  const [w, h] = [Math.max(1, Math.round(area.w)), rows.length], image = new ImageData(w, h);
  let size = 1e-12;
  for (const row of rows) for (const y of row) size = Math.max(size, Math.abs(y));
  const signed = rows.some((row) => row.some((y) => y < 0));
  for (let x = 0; x < w; x++) {
    const [k] = motion.locate((motion.end * x) / (w - 1 || 1));
    rows.forEach((row, y) => image.data.set([...heat(signed ? 0.5 + row[k] / size / 2 : row[k] / size), 255], 4 * (y * w + x)));
  }
  const small = new OffscreenCanvas(w, h);
  small.getContext("2d").putImageData(image, 0, 0);
  pen.imageSmoothingEnabled = false;
  pen.drawImage(small, area.x, area.y, area.w, area.h);
  pen.font = "11px system-ui, sans-serif";
  pen.fillStyle = variable("--soft");
  pen.textAlign = "right";
  pen.textBaseline = "top";
  pen.fillText("head", area.x - 6, area.y);
  pen.textBaseline = "bottom";
  pen.fillText("tail", area.x - 6, area.y + area.h);
  pen.textBaseline = "middle";
  pen.fillText(`${signed ? "±" : "0–"}${shortly(size)}${unit === "degrees" ? "°" : ""}`, area.x - 6, area.y + area.h / 2);
}

function timeAxis(pen, area, end) {
  const step = round(end / 4);
  Object.assign(pen, { font: "11px system-ui, sans-serif", fillStyle: variable("--soft"), textBaseline: "top", textAlign: "center" });
  for (let k = 0; k * step <= end * 1.000001; k++) {
    const x = area.x + (area.w * k * step) / end;
    pen.textAlign = x > area.x + area.w - 12 ? "right" : "center";
    pen.fillText(shortly(k * step) + (k ? "" : " s"), x, area.y + area.h + 3);
  }
}
