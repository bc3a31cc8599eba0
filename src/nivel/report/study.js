"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const numbers = [...data.parameters, ...data.outputs];
  const count = data.variants.length;
  const byId = (name) => document.getElementById(name);
  const escaped = (text) => String(text).replace(/[&<>"]/g, (each) => ({ "&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;" })[each]);
  const shown = (value) => {
    if (value === null || !Number.isFinite(value)) return "–";
    if (value === 0) return "0";
    const size = Math.abs(value);
    return size >= 1e-3 && size < 1e6 ? String(Number(value.toPrecision(5))) : value.toExponential(2).replace("e+", "e");
  };
  const titled = (each) => (each.unit && each.unit !== "1" ? `${each.name} [${each.unit}]` : each.name);
  // the last parts of a path, as much as fits
  const short = (text, most) => (text.length <= most ? text : `…${text.slice(text.length - most + 1)}`);
  const svg = (width, height, inner, label) =>
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" role="img" aria-label="${escaped(label)}">${inner}</svg>`;
  const known = (values) => values.filter((value) => value !== null);
  const extent = (values) => {
    const some = known(values);
    if (!some.length) return [0, 1];
    const low = Math.min(...some), high = Math.max(...some);
    if (high - low > 1e-12 * Math.max(Math.abs(low), Math.abs(high))) return [low, high];
    const room = Math.max(Math.abs(low), 1) * 0.5;
    return [low - room, high + room];
  };
  const ticks = (low, high, about) => {
    const rough = (high - low) / about, power = 10 ** Math.floor(Math.log10(rough));
    const step = [1, 2, 5, 10].map((each) => each * power).find((each) => each >= rough);
    const out = [];
    for (let k = Math.ceil(low / step); k * step <= high + 1e-9 * step; k++) out.push(k * step);
    return out;
  };
  // viridis, by five of its colours
  const COLOURS = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
  const colour = (share) => {
    const at = Math.min(Math.max(share, 0), 1) * (COLOURS.length - 1), k = Math.min(Math.floor(at), COLOURS.length - 2);
    return `rgb(${COLOURS[k].map((value, i) => Math.round(value + (at - k) * (COLOURS[k + 1][i] - value))).join(" ")})`;
  };

  let chosen = data.outputs.length ? data.outputs[0] : data.parameters[0];
  const ranges = new Map(); // axis number: [low, high] that is chosen on it

  const inRanges = (k) => {
    for (const [axis, [low, high]] of ranges) {
      const value = numbers[axis].values[k];
      if (value === null || value < low || value > high) return false;
    }
    return true;
  };

  const bar = (low, high, x, y, width) => {
    const cells = [];
    for (let k = 0; k < 60; k++) cells.push(`<rect x="${x + (k * width) / 60}" y="${y}" width="${width / 60 + 0.5}" height="8" fill="${colour(k / 59)}"/>`);
    return `${cells.join("")}<text x="${x}" y="${y + 20}">${shown(low)}</text><text x="${x + width}" y="${y + 20}" text-anchor="end">${shown(high)}</text>`;
  };

  const parallel = () => {
    const place = byId("parallel");
    const width = Math.max(760, 110 * numbers.length), height = 330, top = 44, bottom = 300, left = 90, right = width - 70;
    const x = (axis) => (numbers.length > 1 ? left + (axis * (right - left)) / (numbers.length - 1) : width / 2);
    const scales = numbers.map((each) => extent(each.values));
    const y = (axis, value) => bottom - ((value - scales[axis][0]) / (scales[axis][1] - scales[axis][0])) * (bottom - top);
    const [low, high] = extent(chosen.values);
    const lines = [[], [], []];
    for (let k = 0; k < count; k++) {
      const points = numbers.map((each, axis) => (each.values[k] === null ? null : `${x(axis).toFixed(1)} ${y(axis, each.values[k]).toFixed(1)}`));
      if (points.includes(null)) continue;
      const value = chosen.values[k], d = `M${points.join("L")}`;
      const title = `<title>variant ${data.variants[k]}</title>`;
      if (!inRanges(k)) lines[0].push(`<path class="variant faint" d="${d}"/>`);
      else if (data.limited && !data.accepted[k]) lines[1].push(`<path class="variant" d="${d}" stroke="var(--faint)" opacity=".45">${title}</path>`);
      else lines[2].push(`<path class="variant" d="${d}" stroke="${colour(value === null ? 0 : (value - low) / (high - low))}" opacity="${count > 300 ? 0.45 : 0.75}">${title}</path>`);
    }
    const axes = numbers.map((each, axis) => {
      const at = x(axis), [least, most] = scales[axis];
      const marks = each.words && each.words.length
        ? each.words.map((word, k) => `<text x="${at + 6}" y="${y(axis, k) + 4}">${escaped(short(word, 12))}</text>`)
        : ticks(least, most, 4).map((value) => `<path class="axis" d="M${at - 4} ${y(axis, value).toFixed(1)}h8"/><text x="${at + 7}" y="${(y(axis, value) + 4).toFixed(1)}">${shown(value)}</text>`);
      const limits = (each.limits || []).map((value) => (value !== null && value >= least && value <= most ? `<path class="limit" d="M${at - 14} ${y(axis, value).toFixed(1)}h28"/>` : ""));
      const range = ranges.get(axis);
      const brush = range ? `<rect class="brush" x="${at - 9}" width="18" y="${y(axis, range[1])}" height="${Math.max(1, y(axis, range[0]) - y(axis, range[1]))}"/>` : "";
      const lift = axis % 2 ? 16 : 30;
      return `<path class="axis" d="M${at} ${top}V${bottom}"/>${marks.join("")}${limits.join("")}${brush}` +
        `<text class="name" x="${at}" y="${lift}" text-anchor="middle">${escaped(short(titled(each), 30))}<title>${escaped(titled(each))}</title></text>` +
        `<rect class="handle" data-axis="${axis}" x="${at - 14}" y="${top}" width="28" height="${bottom - top}"/>`;
    });
    place.innerHTML = svg(width, height, lines.flat().join("") + axes.join("") + bar(low, high, right - 220, height - 22, 220) +
      `<text class="name" x="${right - 228}" y="${height - 14}" text-anchor="end">${escaped(titled(chosen))}</text>`, "parallel coordinates");
    const drawing = place.firstElementChild;
    for (const handle of drawing.querySelectorAll(".handle")) {
      handle.addEventListener("pointerdown", (begin) => {
        const axis = Number(handle.dataset.axis), box = drawing.getBoundingClientRect();
        const valueAt = (event) => {
          const at = Math.min(Math.max(((event.clientY - box.top) / box.height) * height, top), bottom);
          return scales[axis][0] + ((bottom - at) / (bottom - top)) * (scales[axis][1] - scales[axis][0]);
        };
        const first = valueAt(begin);
        const end = (event) => {
          window.removeEventListener("pointerup", end);
          const last = valueAt(event);
          if (Math.abs(last - first) < 0.01 * (scales[axis][1] - scales[axis][0])) ranges.delete(axis);
          else ranges.set(axis, [Math.min(first, last), Math.max(first, last)]);
          draw();
        };
        window.addEventListener("pointerup", end);
        begin.preventDefault();
      });
    }
  };

  const frame = (width, height, [left, low], [right, high], x, y) => {
    const out = [];
    for (const value of ticks(left, right, 5)) out.push(`<path class="grid" d="M${x(value).toFixed(1)} 14V${height - 40}"/><text x="${x(value).toFixed(1)}" y="${height - 26}" text-anchor="middle">${shown(value)}</text>`);
    for (const value of ticks(low, high, 5)) out.push(`<path class="grid" d="M66 ${y(value).toFixed(1)}H${width - 16}"/><text x="60" y="${(y(value) + 4).toFixed(1)}" text-anchor="end">${shown(value)}</text>`);
    return out.join("");
  };

  const tornado = () => {
    const place = byId("tornado"), found = (chosen.effects || []).slice(0, 14), surface = chosen.surface;
    byId("tornado-note").textContent = found.length
      ? `${chosen.name} at the 5 % and the 95 % quantile of each parameter, the others at their medians, on the response surface.`
      : "There are too few variants for a response surface, or nothing numeric varies.";
    if (!found.length) { place.innerHTML = ""; return; }
    const width = 560, row = 34, height = found.length * row + 54, left = 190, right = width - 24;
    const [least, most] = extent(found.flatMap((each) => [each.at_low, each.at_high]));
    const room = 0.04 * (most - least), low = least - room, high = most + room;
    const x = (value) => left + ((value - low) / (high - low)) * (right - left);
    const middle = surface ? found[0] && valueOf(surface, surface.middle) : (low + high) / 2;
    const out = ticks(low, high, 4).map((value) => `<path class="grid" d="M${x(value)} 6V${height - 44}"/><text x="${x(value)}" y="${height - 28}" text-anchor="middle">${shown(value)}</text>`);
    found.forEach((each, k) => {
      const y = 10 + k * row;
      const piece = (end, kind) => `<rect class="bar ${kind}" x="${Math.min(x(middle), x(end))}" y="${y}" width="${Math.max(1, Math.abs(x(end) - x(middle)))}" height="18" rx="2"/>`;
      out.push(`<text class="name" x="${left - 8}" y="${y + 13}" text-anchor="end">${escaped(short(each.parameter, 28))}<title>${escaped(each.parameter)}</title></text>`);
      out.push(piece(each.at_low, "second"), piece(each.at_high, ""));
    });
    out.push(`<path class="axis" d="M${x(middle)} 4V${height - 44}"/><text class="name" x="${(left + right) / 2}" y="${height - 8}" text-anchor="middle">${escaped(titled(chosen))}</text>`);
    out.push(`<rect class="bar second" x="4" y="${height - 18}" width="10" height="10"/><text x="18" y="${height - 9}">5 %</text><rect class="bar" x="52" y="${height - 18}" width="10" height="10"/><text x="66" y="${height - 9}">95 %</text>`);
    place.innerHTML = svg(width, height, out.join(""), "effects of the parameters");
  };

  const sobol = () => {
    const place = byId("sobol"), found = chosen.sobol;
    const article = place.closest("article");
    article.hidden = !data.outputs.some((each) => each.sobol);
    if (!found) { place.innerHTML = ""; byId("sobol-note").textContent = `${chosen.name} does not vary.`; return; }
    byId("sobol-note").textContent = `Shares of the variance of ${chosen.name}: by a parameter alone, and with its interactions; whiskers are ± 2 standard errors. ${found.used} of ${found.samples} base samples are complete.`;
    const width = 560, row = 42, height = found.parameters.length * row + 50, left = 190, right = width - 24;
    const x = (value) => left + Math.min(Math.max(value, -0.1) + 0.1, 1.2) / 1.2 * (right - left);
    const out = [0, 0.25, 0.5, 0.75, 1].map((value) => `<path class="grid" d="M${x(value)} 6V${height - 40}"/><text x="${x(value)}" y="${height - 26}" text-anchor="middle">${value}</text>`);
    const order = found.parameters.map((_, k) => k).sort((a, b) => found.total[b] - found.total[a]);
    order.forEach((k, at) => {
      const y = 10 + at * row;
      out.push(`<text class="name" x="${left - 8}" y="${y + 19}" text-anchor="end">${escaped(short(found.parameters[k], 28))}<title>${escaped(found.parameters[k])}</title></text>`);
      for (const [values, errors, kind, shift] of [[found.first, found.first_error, "", 0], [found.total, found.total_error, "second", 14]]) {
        out.push(`<rect class="bar ${kind}" x="${Math.min(x(0), x(values[k]))}" y="${y + shift}" width="${Math.abs(x(values[k]) - x(0))}" height="12" rx="2"/>`);
        out.push(`<path class="error" d="M${x(values[k] - 2 * errors[k])} ${y + shift + 6}H${x(values[k] + 2 * errors[k])}"/>`);
      }
    });
    out.push(`<rect class="bar" x="4" y="${height - 16}" width="10" height="10"/><text x="18" y="${height - 7}">first order</text><rect class="bar second" x="90" y="${height - 16}" width="10" height="10"/><text x="104" y="${height - 7}">total</text>`);
    place.innerHTML = svg(width, height, out.join(""), "Sobol indices");
  };

  const valueOf = (surface, point) => {
    const scaled = point.map((value, k) => (2 * (value - surface.low[k])) / (surface.high[k] - surface.low[k]) - 1);
    return surface.powers.reduce((sum, powers, k) => sum + surface.coefficients[k] * powers.reduce((product, power, i) => product * scaled[i] ** power, 1), 0);
  };

  const responseSurface = () => {
    const place = byId("surface"), surface = chosen.surface, note = byId("surface-note");
    for (const each of [byId("across"), byId("up")]) each.parentElement.hidden = !surface || surface.parameters.length < 2;
    if (!surface) { place.innerHTML = ""; note.textContent = "There are too few variants, or nothing numeric varies."; return; }
    const quality = surface.predicted === null ? "" : ` It explains ${(100 * surface.determined).toPrecision(4)} % of the variance, and predicts ${(100 * Math.max(surface.predicted, 0)).toPrecision(4)} % of variants that are left out of the fit${surface.predicted < 0.9 ? ": do not rely on it" : ""}.`;
    const order = Math.max(...surface.powers.map((powers) => powers.reduce((a, b) => a + b, 0)));
    note.textContent = `${order > 1 ? "A quadratic" : "A linear"} polynomial, other parameters at their medians.${quality}`;
    const width = 560, height = 360;
    const a = Math.max(0, surface.parameters.indexOf(byId("across").value));
    let b = surface.parameters.indexOf(byId("up").value);
    const axis = (k) => data.parameters.find((each) => each.name === surface.parameters[k]);
    if (surface.parameters.length < 2) {
      const points = Array.from({ length: 61 }, (_, k) => surface.low[0] + (k / 60) * (surface.high[0] - surface.low[0]));
      const values = points.map((value) => valueOf(surface, [value]));
      const [low, high] = extent([...values, ...chosen.values]);
      const x = (value) => 66 + ((value - surface.low[0]) / (surface.high[0] - surface.low[0])) * (width - 82);
      const y = (value) => height - 40 - ((value - low) / (high - low)) * (height - 54);
      const path = points.map((value, k) => `${x(value).toFixed(1)} ${y(values[k]).toFixed(1)}`).join("L");
      const dots = axis(0).values.map((value, k) => (chosen.values[k] === null ? "" : `<circle cx="${x(value).toFixed(1)}" cy="${y(chosen.values[k]).toFixed(1)}" r="2.2" fill="var(--tone-1)"/>`));
      place.innerHTML = svg(width, height, frame(width, height, [surface.low[0], low], [surface.high[0], high], x, y) + dots.join("") + `<path d="M${path}" fill="none" stroke="var(--accent)" stroke-width="1.8"/><text class="name" x="${width / 2}" y="${height - 6}" text-anchor="middle">${escaped(titled(axis(0)))}</text>`, "response surface");
      return;
    }
    if (b < 0 || b === a) b = a === 0 ? 1 : 0;
    byId("up").value = surface.parameters[b];
    const cells = 44, grid = [];
    for (let j = 0; j < cells; j++) for (let i = 0; i < cells; i++) {
      const point = [...surface.middle];
      point[a] = surface.low[a] + ((i + 0.5) / cells) * (surface.high[a] - surface.low[a]);
      point[b] = surface.low[b] + ((j + 0.5) / cells) * (surface.high[b] - surface.low[b]);
      grid.push(valueOf(surface, point));
    }
    const [low, high] = extent(grid);
    const x = (value) => 66 + ((value - surface.low[a]) / (surface.high[a] - surface.low[a])) * (width - 82);
    const y = (value) => height - 74 - ((value - surface.low[b]) / (surface.high[b] - surface.low[b])) * (height - 88);
    const w = (width - 82) / cells, h = (height - 88) / cells, out = [];
    grid.forEach((value, k) => out.push(`<rect x="${(66 + (k % cells) * w).toFixed(2)}" y="${(height - 74 - (Math.floor(k / cells) + 1) * h).toFixed(2)}" width="${(w + 0.6).toFixed(2)}" height="${(h + 0.6).toFixed(2)}" fill="${colour((value - low) / (high - low))}"/>`));
    for (const value of ticks(surface.low[a], surface.high[a], 5)) out.push(`<text x="${x(value)}" y="${height - 60}" text-anchor="middle">${shown(value)}</text>`);
    for (const value of ticks(surface.low[b], surface.high[b], 5)) out.push(`<text x="60" y="${y(value) + 4}" text-anchor="end">${shown(value)}</text>`);
    const dots = Math.min(count, 300);
    for (let k = 0; k < dots; k++) out.push(`<circle cx="${x(axis(a).values[k]).toFixed(1)}" cy="${y(axis(b).values[k]).toFixed(1)}" r="1.5" fill="#fff" fill-opacity=".75"/>`);
    out.push(`<text class="name" x="${66 + (width - 82) / 2}" y="${height - 44}" text-anchor="middle">${escaped(titled(axis(a)))}</text>`);
    out.push(`<text class="name" transform="translate(12 ${(height - 74) / 2}) rotate(-90)" text-anchor="middle">${escaped(short(titled(axis(b)), 40))}</text>`);
    out.push(bar(low, high, width - 236, height - 28, 220), `<text class="name" x="${width - 244}" y="${height - 20}" text-anchor="end">${escaped(short(titled(chosen), 40))}</text>`);
    place.innerHTML = svg(width, height, out.join(""), "response surface");
  };

  const binned = (values, low, high, bins) => {
    const out = new Array(bins).fill(0);
    for (const value of known(values)) out[Math.min(bins - 1, Math.max(0, Math.floor(((value - low) / (high - low)) * bins)))]++;
    return out;
  };

  const histogram = () => {
    const place = byId("histogram"), width = 560, height = 360, values = known(chosen.values);
    const limits = (chosen.limits || []).filter((value) => value !== null);
    byId("histogram-note").textContent = limits.length ? `Limits of ${chosen.name} are dashed.` : `Number of variants over ${chosen.name}.`;
    const [low, high] = extent([...values, ...limits]);
    const bins = Math.max(5, Math.min(40, Math.round(Math.sqrt(values.length)) + 2)), counts = binned(values, low, high, bins), most = Math.max(...counts, 1);
    const x = (value) => 66 + ((value - low) / (high - low)) * (width - 82), y = (value) => height - 40 - (value / most) * (height - 58);
    const bars = counts.map((each, k) => `<rect class="bar" x="${66 + (k * (width - 82)) / bins + 0.5}" y="${y(each)}" width="${(width - 82) / bins - 1}" height="${height - 40 - y(each)}"/>`);
    const marks = limits.map((value) => `<path class="limit" d="M${x(value)} 14V${height - 40}"/>`);
    place.innerHTML = svg(width, height, frame(width, height, [low, 0], [high, most], x, y) + bars.join("") + marks.join("") + `<text class="name" x="${width / 2}" y="${height - 6}" text-anchor="middle">${escaped(titled(chosen))}</text>`, "distribution");
  };

  const correlation = (a, b) => {
    const pairs = a.map((value, k) => [value, b[k]]).filter(([x, y]) => x !== null && y !== null), n = pairs.length;
    if (n < 3) return null;
    const mean = (k) => pairs.reduce((sum, each) => sum + each[k], 0) / n, [mx, my] = [mean(0), mean(1)];
    const sum = (f) => pairs.reduce((total, each) => total + f(each[0] - mx, each[1] - my), 0);
    const scale = Math.sqrt(sum((x) => x * x) * sum((_, y) => y * y));
    return scale > 0 ? sum((x, y) => x * y) / scale : null;
  };

  const matrix = () => {
    const place = byId("matrix"), some = numbers.slice(0, 9), n = some.length, cell = Math.min(170, 980 / n), left = 10, top = 24, size = left + n * cell;
    const scales = some.map((each) => extent(each.values)), out = [];
    const dots = Math.min(count, n > 5 ? 250 : 500), every = Math.max(1, Math.floor(count / dots));
    const [low, high] = extent(chosen.values);
    for (let row = 0; row < n; row++) for (let column = 0; column < n; column++) {
      const x0 = left + column * cell, y0 = top + row * cell, room = cell - 8;
      const at = (axis, value) => (value - scales[axis][0]) / (scales[axis][1] - scales[axis][0]);
      out.push(`<rect x="${x0}" y="${y0}" width="${room}" height="${room}" fill="none" class="axis" stroke-opacity=".45"/>`);
      if (row === column) {
        const bins = 14, counts = binned(some[row].values, ...scales[row], bins), most = Math.max(...counts, 1);
        counts.forEach((each, k) => out.push(`<rect class="bar" fill-opacity=".55" x="${x0 + (k * room) / bins}" y="${y0 + room - (each / most) * (room - 4)}" width="${room / bins - 0.6}" height="${(each / most) * (room - 4)}"/>`));
      } else if (row > column) {
        for (let k = 0; k < count; k += every) {
          const a = some[column].values[k], b = some[row].values[k];
          if (a === null || b === null) continue;
          const tone = data.limited && !data.accepted[k] ? "var(--faint)" : colour((chosen.values[k] - low) / (high - low));
          out.push(`<circle cx="${(x0 + at(column, a) * room).toFixed(1)}" cy="${(y0 + room - at(row, b) * room).toFixed(1)}" r="1.7" fill="${tone}" fill-opacity="${inRanges(k) ? 0.8 : 0.08}"/>`);
        }
      } else {
        const r = correlation(some[column].values, some[row].values);
        if (r !== null) out.push(`<text x="${x0 + room / 2}" y="${y0 + room / 2 + 5}" text-anchor="middle" style="font-size:${11 + 9 * Math.abs(r)}px;fill:${Math.abs(r) > 0.3 ? "var(--ink)" : "var(--faint)"}">${r.toFixed(2)}</text>`);
      }
      if (row === 0) out.push(`<text class="name" x="${x0 + room / 2}" y="14" text-anchor="middle">${escaped(short(some[column].name, Math.max(8, Math.floor(cell / 6.2))))}<title>${escaped(titled(some[column]))}</title></text>`);
    }
    place.innerHTML = svg(size, top + n * cell, out.join(""), "scatter matrix");
  };

  const draw = () => {
    parallel(); tornado(); sobol(); responseSurface(); histogram(); matrix();
    const inside = data.variants.filter((_, k) => inRanges(k)).length;
    byId("shown").textContent = `${ranges.size ? `${inside} chosen of ` : ""}${data.shown} variants drawn${data.count > data.shown ? ` of ${data.count}` : ""}`;
  };

  const select = (element, names) => {
    element.innerHTML = names.map((name) => `<option>${escaped(name)}</option>`).join("");
    element.addEventListener("change", draw);
  };
  if (!numbers.length || !count) {
    for (const place of document.querySelectorAll(".drawing")) place.closest(".card").hidden = true;
    byId("choice").hidden = true;
    return;
  }
  select(byId("output"), (data.outputs.length ? data.outputs : data.parameters).map((each) => each.name));
  byId("output").addEventListener("change", () => {
    chosen = numbers.find((each) => each.name === byId("output").value) || chosen;
    draw();
  });
  const first = data.outputs.map((each) => each.surface).find(Boolean);
  const largest = (data.outputs[0] && data.outputs[0].effects ? data.outputs[0].effects : []).map((each) => each.parameter);
  select(byId("across"), first ? first.parameters : []);
  select(byId("up"), first ? first.parameters : []);
  if (largest.length > 1) { byId("across").value = largest[0]; byId("up").value = largest[1]; }
  draw();
})();
