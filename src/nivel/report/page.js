// Plots of the report. One cursor and one time range for all of them.
(() => {
  "use strict";
  const data = JSON.parse(document.getElementById("data").textContent);
  const root = document.documentElement;
  const colour = (name) => getComputedStyle(root).getPropertyValue(`--${name}`).trim();
  const font = `12px ${getComputedStyle(document.body).fontFamily}`;
  const HEIGHT = 250;
  const DASHES = [undefined, [7, 4], [2, 3]]; // of the curves of a plot, in turn, and of their marks in its legend
  const BORDERS = ["solid", "dashed", "dotted"];
  const FLOOR = 1e-18; // below round-off: a violation this small is drawn as this

  function floats(text, Kind) {
    const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
    return new Kind(bytes.buffer);
  }

  const time = floats(data.time, Float64Array);
  const start = time[0];
  const end = time[time.length - 1];
  const whole = [start, end > start ? end : start + 1];
  let range = whole;

  // values that are not numbers are gaps
  function values(curve, log) {
    if (!curve.decoded) {
      curve.decoded = Array.from(floats(curve.values, Float32Array), (v) => (!Number.isFinite(v) ? null : log ? Math.max(v, FLOOR) : v));
    }
    return curve.decoded;
  }

  function short(v) {
    if (v == null) return "";
    const size = Math.abs(v);
    if (size === 0) return "0";
    if (size >= 1e-3 && size < 1e6) return String(+v.toPrecision(5));
    return v.toExponential(2).replace(/\.?0+e/, "e").replace("e+", "e");
  }

  function axisWidth(u, labels, index, cycle) {
    const axis = u.axes[index];
    if (cycle > 1) return axis._size;
    let size = axis.ticks.size + axis.gap;
    const longest = (labels ?? []).reduce((a, b) => (String(b ?? "").length > a.length ? String(b) : a), "");
    if (longest) {
      u.ctx.font = axis.font[0];
      size += u.ctx.measureText(longest).width / devicePixelRatio + 4;
    }
    return Math.ceil(Math.max(size, 34));
  }

  // about seven powers of ten
  function decades(u, index, min, max) {
    const low = Math.ceil(Math.log10(min) - 1e-9);
    const high = Math.floor(Math.log10(max) + 1e-9);
    const step = Math.max(1, Math.ceil((high - low) / 7));
    return Array.from({ length: Math.floor((high - low) / step) + 1 }, (_, k) => Number(`1e${low + k * step}`));
  }

  // room around the curves, ten times `floor` where they change by less, so that round-off is drawn as a straight line
  function span(min, max, floor) {
    if (min == null) return [-1, 1];
    const least = Math.max(floor, 1e-9 * Math.max(Math.abs(min), Math.abs(max)), 1e-30);
    if (max - min >= least) return uPlot.rangeNum(min, max, 0.08, true);
    const middle = 0.5 * (min + max);
    const half = Math.max(5 * floor, 0.1 * Math.max(Math.abs(middle), least));
    return [middle - half, middle + half];
  }

  function limitLines(limits) {
    return (u) => {
      const { ctx, bbox } = u;
      for (const limit of limits) {
        const scale = u.scales.y;
        if (!(limit.value >= scale.min && limit.value <= scale.max)) continue;
        const y = Math.round(u.valToPos(limit.value, "y", true));
        ctx.save();
        ctx.strokeStyle = ctx.fillStyle = colour(limit.tone);
        ctx.lineWidth = devicePixelRatio;
        ctx.setLineDash([5 * devicePixelRatio, 4 * devicePixelRatio]);
        ctx.beginPath();
        ctx.moveTo(bbox.left, y);
        ctx.lineTo(bbox.left + bbox.width, y);
        ctx.stroke();
        ctx.font = `${11 * devicePixelRatio}px sans-serif`;
        ctx.textAlign = "right";
        ctx.textBaseline = "bottom";
        ctx.fillText(`${limit.tone} below`, bbox.left + bbox.width - 4, y - 2);
        ctx.restore();
      }
    };
  }

  // a dotted line at the time of each event, with its name where there is room
  function eventMarks(u) {
    const { ctx, bbox } = u;
    let free = bbox.left;
    ctx.save();
    ctx.strokeStyle = ctx.fillStyle = colour("faint");
    ctx.lineWidth = devicePixelRatio;
    ctx.setLineDash([2 * devicePixelRatio, 3 * devicePixelRatio]);
    ctx.font = `${11 * devicePixelRatio}px sans-serif`;
    ctx.textBaseline = "top";
    for (const event of data.events) {
      const scale = u.scales.x;
      if (!(event.time >= scale.min && event.time <= scale.max)) continue;
      const x = Math.round(u.valToPos(event.time, "x", true));
      ctx.beginPath();
      ctx.moveTo(x, bbox.top);
      ctx.lineTo(x, bbox.top + bbox.height);
      ctx.stroke();
      const width = ctx.measureText(event.name).width;
      const place = x + width + 4 > bbox.left + bbox.width ? x - width - 3 : x + 3;
      if (place < free) continue;
      ctx.fillText(event.name, place, bbox.top + 2);
      free = Math.max(x, place + width) + 4;
    }
    ctx.restore();
  }

  // pressures in the diagram of a circuit: of the frame at the cursor, at first and without a cursor those of the first one
  const inBar = data.panels.flatMap((panel) => panel.groups.filter((group) => group.unit === "bar").flatMap((group) => group.curves));
  const shown = [...document.querySelectorAll("[data-pressure]")].map((place) => {
    return { place, curve: inBar.find((curve) => curve.label === place.dataset.pressure) };
  });
  const levels = [...document.querySelectorAll("[data-level]")].map((line) => {
    return { line, curve: inBar.find((curve) => curve.label === line.dataset.level) };
  });
  const highest = levels.reduce((most, { curve }) => (curve ? values(curve, false).reduce((a, b) => Math.max(a, b ?? 0), most) : most), 0);
  const key = document.querySelector("[data-highest]");
  if (key && highest > 0) key.textContent = `${+highest.toPrecision(4)}`;
  function showPressures(index) {
    for (const { line, curve } of levels) {
      const share = curve && highest > 0 ? Math.min(Math.max((values(curve, false)[index ?? 0] ?? 0) / highest, 0), 1) : null;
      if (share !== null) line.style.stroke = `hsl(${Math.round(220 * (1 - share))} 80% 42%)`; // as in the diagram at the start
    }
    for (const { place, curve } of shown) {
      if (curve) place.textContent = `${+(values(curve, false)[index ?? 0] ?? 0).toPrecision(4)} bar`;
    }
  }

  const plots = new Map(); // over time, by their cards
  const spectra = new Map();

  function setRange(min, max, from) {
    range = [min, max];
    document.getElementById("reset").hidden = min <= whole[0] && max >= whole[1];
    for (const plot of plots.values()) {
      if (plot !== from && (plot.scales.x.min !== min || plot.scales.x.max !== max)) plot.setScale("x", { min, max });
    }
  }

  // unit: of the axis below
  function options(panel, group, width, unit = data.abscissa === "time" ? "s" : "") {
    const axis = { stroke: () => colour("faint"), font, grid: { stroke: () => colour("grid"), width: 1 }, ticks: { show: false, size: 4 }, gap: 4 };
    const highest = Math.max(0, ...group.limits.filter((l) => l.tone === "green").map((l) => l.value));
    const y = panel.log
      ? { distr: 3, range: (u, min, max) => uPlot.rangeLog(Math.max(min ?? FLOOR, FLOOR), Math.max(max ?? FLOOR, 2 * highest, 10 * FLOOR), 10, true) }
      : { range: (u, min, max) => span(min, max, group.floor) };
    return {
      width,
      height: HEIGHT,
      scales: { x: { time: false }, y },
      cursor: { sync: { key: "nivel" }, drag: { x: true, y: false, dist: 6 }, points: { size: 6 }, focus: { prox: 18 } },
      focus: { alpha: 0.3 },
      axes: [
        { ...axis, values: (u, splits) => splits.map((v, k) => (k === splits.length - 1 && unit ? `${short(v)} ${unit}` : short(v))), size: 26 },
        { ...axis, size: axisWidth, ...(panel.log ? { splits: decades, filter: (u, splits) => splits } : {}), values: (u, splits) => splits.map((v) => (v == null ? "" : short(v))) },
      ],
      series: [
        { label: data.abscissa, value: (u, v) => (v == null ? "" : `${+v.toPrecision(6)} ${unit}`.trim()) },
        ...group.curves.map((curve, k) => ({
          label: curve.label,
          stroke: () => colour(`tone-${/\d/.test(curve.tone) ? Number(curve.tone) % 8 : curve.tone}`),
          dash: DASHES[k % DASHES.length],
          width: 1.6,
          pxAlign: 0,
          points: { show: false },
          value: (u, v) => (v == null ? "" : quantity(v, group.unit)),
        })),
      ],
      legend: { markers: { dash: (u, k) => BORDERS[(k - 1) % BORDERS.length] } },
      hooks: {
        draw: [limitLines(group.limits), eventMarks],
        setScale: [(u, key) => key === "x" && u.ready && setRange(u.scales.x.min, u.scales.x.max, u)],
        ready: [(u) => { u.ready = true; }],
        setCursor: [(u) => showPressures(u.cursor.idx)],
      },
    };
  }

  // the value that a curve keeps, or null where it changes or has gaps
  function constant(curve, floor) {
    const all = values(curve, false);
    let low = Infinity, high = -Infinity;
    for (const v of all) {
      if (v === null) return null;
      low = Math.min(low, v);
      high = Math.max(high, v);
    }
    return high - low <= Math.max(floor, 1e-7 * Math.max(Math.abs(low), Math.abs(high))) ? 0.5 * (low + high) : null;
  }

  // what is constant in a plot is said, and what changes is drawn
  function parted(panel, group) {
    if (panel.log || time.length < 2) return [group, ""];
    const kept = group.curves.map((curve) => constant(curve, group.floor));
    const said = group.curves
      .map((curve, k) => [curve.label, kept[k]])
      .filter(([, value]) => value !== null)
      .map(([label, value]) => `${label} = ${quantity(Math.abs(value) <= group.floor ? 0 : value, group.unit)}`);
    const moving = group.curves.filter((curve, k) => kept[k] === null);
    return [{ ...group, curves: moving.length ? moving : group.curves }, said.length ? `Constant: ${said.join(", ")}.` : ""];
  }

  function quantity(v, unit) {
    if (unit === "1") return short(v);
    return unit === "rad" ? `${short(v)} rad (${short(+((v * 180) / Math.PI).toPrecision(4))}°)` : `${short(v)} ${unit}`;
  }

  // the curves of a group whose values are all there, over evenly spaced frames
  const even = data.thinned > 1 || data.abscissa !== "time" ? null : Spectra.evenly(time);
  const complete = (group) => group.curves.filter((curve) => values(curve, false).every((v) => v !== null));

  // an axis of frequencies below, or at the side
  function spectral(group, width, curves, more, unit = "Hz") {
    const { axes, series, ...rest } = options({ log: false }, { ...group, curves, limits: [], floor: 0 }, width, unit);
    return { ...rest, axes, series, cursor: { drag: { x: true, y: false, dist: 6 } }, hooks: {}, ...more };
  }

  function spectrum(group, place) {
    const curves = complete(group);
    const found = curves.map((curve) => Spectra.amplitudes(values(curve, false).slice(0, even.count), even.dt));
    const made = spectral(group, place.clientWidth || 400, curves, { scales: { x: { time: false }, y: { range: (u, min, max) => [0, (max || 1) * 1.08] } } });
    made.series[0] = { label: "frequency", value: (u, v) => (v == null ? "" : `${short(v)} Hz`) };
    return new uPlot(made, [found[0]?.frequency ?? [0], ...found.map(({ amplitude }) => amplitude)], place);
  }

  // amplitudes of one curve in colours, over time and frequency; 60 dB from the largest down to nothing
  function waterfall(group, place) {
    const [curve] = complete(group);
    const { middles, frequency, rows, half } = Spectra.waterfall(time, values(curve, false).slice(0, even.count), even.dt);
    const largest = Math.max(...rows.map((row) => Math.max(...row)), 1e-300);
    const step = frequency[0];
    const paint = (u) => {
      const { ctx } = u;
      ctx.save();
      ctx.fillStyle = colour("accent");
      rows.forEach((row, k) => {
        const [left, right] = [middles[k] - half, middles[k] + half].map((t) => u.valToPos(t, "x", true));
        row.forEach((amplitude, m) => {
          const level = 1 + (20 * Math.log10(Math.max(amplitude / largest, 1e-9))) / 60;
          if (level <= 0) return;
          const [low, high] = [frequency[m] - 0.5 * step, frequency[m] + 0.5 * step].map((f) => u.valToPos(f, "y", true));
          ctx.globalAlpha = level;
          ctx.fillRect(left, high, right - left + 0.5, low - high + 0.5);
        });
      });
      ctx.restore();
    };
    const made = spectral({ ...group, unit: "Hz" }, place.clientWidth || 400, [{ label: curve.label, tone: "0" }], {
      scales: { x: { time: false, range: [whole[0], whole[1]] }, y: { range: [0, frequency[frequency.length - 1]] } },
      hooks: { draw: [paint] },
    }, "s");
    made.series[1] = { label: `amplitudes of ${curve.label}, frequency`, show: true, stroke: "transparent", points: { show: false }, value: () => "" };
    return new uPlot(made, [middles, middles.map(() => null)], place);
  }

  function build(card) {
    const panel = data.panels[card.dataset.panel];
    const [group, said] = parted(panel, panel.groups[card.querySelector("select.group")?.value ?? 0]);
    const place = card.querySelector(".canvas");
    const chosen = card.querySelector("select.view");
    chosen.hidden = !even || panel.log || !complete(group).length;
    const view = chosen.hidden ? "time" : chosen.value;
    (plots.get(card) ?? spectra.get(card))?.destroy();
    plots.delete(card);
    spectra.delete(card);
    card.querySelector(".unit").textContent = view === "waterfall" ? "[Hz]" : group.unit === "1" ? "" : `[${group.unit}]`;
    card.querySelector(".constant").textContent = said;
    if (view !== "time") {
      spectra.set(card, (view === "spectrum" ? spectrum : waterfall)(group, place));
      return;
    }
    const lines = [time, ...group.curves.map((curve) => values(curve, panel.log))];
    const plot = new uPlot(options(panel, group, place.clientWidth || 400), lines, place);
    plots.set(card, plot);
    if (range !== whole) plot.setScale("x", { min: range[0], max: range[1] });
  }

  // one finger moves the cursor, two fingers zoom
  function touch(place, card) {
    let pinch = null;
    const isOverTime = () => plots.has(card);
    const at = (finger) => finger.clientX - plots.get(card).over.getBoundingClientRect().left;
    place.addEventListener("touchstart", (event) => {
      if (event.touches.length === 2 && isOverTime()) {
        const plot = plots.get(card);
        pinch = [...event.touches].map((finger) => plot.posToVal(at(finger), "x")).sort((a, b) => a - b);
      }
    }, { passive: true });
    place.addEventListener("touchmove", (event) => {
      const plot = plots.get(card);
      if (!plot) return;
      if (event.touches.length === 1) {
        plot.setCursor({ left: at(event.touches[0]), top: plot.over.clientHeight / 2 });
      } else if (pinch) {
        event.preventDefault();
        const [a, b] = [...event.touches].map(at).sort((m, n) => m - n);
        const perPixel = (pinch[1] - pinch[0]) / Math.max(b - a, 20);
        const min = Math.max(whole[0], pinch[0] - a * perPixel);
        setRange(min, Math.min(whole[1], min + plot.over.clientWidth * perPixel));
      }
    }, { passive: false });
    place.addEventListener("touchend", () => { pinch = null; });
  }

  const cards = [...document.querySelectorAll(".plot")];
  // the header is as wide as the plot, and does not change when the plot does
  const watch = new ResizeObserver((entries) => {
    for (const { target } of entries) {
      const card = target.parentElement;
      const width = card.querySelector(".canvas").clientWidth;
      const plot = plots.get(card) ?? spectra.get(card);
      if (width && plot.width !== width) plot.setSize({ width, height: HEIGHT });
    }
  });
  for (const card of cards) {
    build(card);
    for (const choice of card.querySelectorAll("select")) choice.addEventListener("change", () => build(card));
    const place = card.querySelector(".canvas");
    touch(place, card);
    watch.observe(card.querySelector("header"));
  }
  document.getElementById("reset").addEventListener("click", () => setRange(...whole));
  if (data.thinned > 1) {
    document.querySelector(".thinned").textContent = ` Each point pair is the least and the largest of ${data.thinned} frames; the result file has them all.`;
  }
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => cards.forEach(build));
})();
