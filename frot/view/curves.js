// The curves beside the picture: panels of one unit, bars of modes, a cursor, a chooser.
// `frot` is the content of the page; `tools` are functions of page.js.
const makeCurves = (pane, tools) => {
  const { make, numbers, find, between } = tools;
  const LEFT = 58, RIGHT = 10, TOP = 7, BOTTOM = 17, HIGH = 118, BAR = 17, MOST = 7, MARKS = 60;
  const grid = Float64Array.from(frot.grid);
  const begin = grid[0], end = grid[grid.length - 1];
  const known = new Map(frot.curves.map((x) => [x.name, x]));
  const values = (curve) => {
    if (!curve.values) {
      const y = curve.y ? numbers(curve.y) : new Float32Array(grid.length);
      curve.values = Float64Array.from(y, (v) => v + curve.first);
    }
    return curve.values;
  };
  const bar = make("div", pane, { className: "chooser" });
  const inner = make("div", pane, { className: "panels" });
  const cursor = make("div", inner, { className: "cursor" });
  let panels = [], width = 0;

  // ------------------------------------------------------------ which curves
  const kind = (curve) => (curve.mode ? "mode" : curve.steps.length ? curve.steps.join() : curve.unit);
  const add = (name) => {
    const curve = known.get(name);
    const place = panels.find((p) => kind(p.curves[0]) === kind(curve)
      && (curve.mode || p.curves.length < MOST));
    if (place) place.curves.push(curve);
    else panels.push({ curves: [curve] });
    // bars of modes are last
    panels.sort((a, b) => a.curves[0].mode - b.curves[0].mode);
  };
  const remove = (name) => {
    for (const p of panels) p.curves = p.curves.filter((x) => x.name !== name);
    panels = panels.filter((p) => p.curves.length);
  };
  const isShown = (name) => panels.some((p) => p.curves.some((x) => x.name === name));
  panels = frot.panels.map((names) => ({ curves: names.map((x) => known.get(x)) }));

  // ------------------------------------------------------------ the chooser
  const list = make("details", bar);
  make("summary", list, {}, "choose curves");
  const filter = make("input", list, { type: "search", placeholder: "part of a name" });
  const choices = make("div", list, { className: "choices" });
  const boxes = frot.curves.map((curve) => {
    const label = make("label", choices, { title: curve.unit });
    const box = make("input", label, { type: "checkbox", checked: isShown(curve.name) });
    label.append(curve.name);
    if (curve.unit) make("small", label, {}, curve.unit);
    box.addEventListener("change", () => {
      (box.checked ? add : remove)(curve.name);
      draw();
    });
    return { curve, box, label };
  });
  filter.addEventListener("input", () => {
    const words = filter.value.toLowerCase().split(/\s+/);
    for (const one of boxes)
      one.label.hidden = !words.every((w) => one.curve.name.toLowerCase().includes(w));
  });

  // ------------------------------------------------------------ drawing
  // 1, 2 or 5 times a power of ten between `few` values of a range.
  const ticks = (low, high, few) => {
    const rough = (high - low) / few, power = Math.pow(10, Math.floor(Math.log10(rough)));
    const step = [1, 2, 5, 10].find((x) => x * power >= rough * 0.999) * power;
    const found = [];
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) found.push(k * step);
    const places = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    const size = Math.max(Math.abs(low), Math.abs(high));
    const text = (v) => (size >= 1e5 || size < 1e-3 ? v.toPrecision(3) : v.toFixed(places));
    return found.map((v) => [v, Math.abs(v) < 1e-9 * step ? "0" : text(v)]);
  };
  // Rounding, and errors within the tolerance, are not drawn as a motion.
  const range = (curves) => {
    let low = Infinity, high = -Infinity;
    for (const curve of curves) for (const v of values(curve)) {
      if (v < low) low = v;
      if (v > high) high = v;
    }
    const size = Math.max(Math.abs(low), Math.abs(high)) || 1;
    if (high - low < 1e-5 * size) return [(low + high) / 2 - 0.05 * size, (low + high) / 2 + 0.05 * size];
    return [low - 0.05 * (high - low), high + 0.05 * (high - low)];
  };
  const across = (t) => LEFT + ((width - LEFT - RIGHT) * (t - begin)) / (end - begin || 1);
  const paint = (panel, last) => {
    const modes = panel.curves[0].mode, steps = panel.curves[0].steps;
    const high = modes ? BAR * panel.curves.length : HIGH;
    const ratio = window.devicePixelRatio || 1, whole = TOP + high + (last ? 2 * BOTTOM : 6);
    const canvas = make("canvas", panel.box, { width: width * ratio, height: whole * ratio });
    canvas.style.cssText = `width:${width}px;height:${whole}px`;
    panel.box.prepend(canvas);
    const c = canvas.getContext("2d");
    c.scale(ratio, ratio);
    c.font = "11px system-ui, 'DejaVu Sans', sans-serif";
    c.textBaseline = "middle";
    const line = (x, y, u, v, colour) => {
      c.strokeStyle = colour;
      c.beginPath(); c.moveTo(x, y); c.lineTo(u, v); c.stroke();
    };
    const below = TOP + high;
    for (const [t, text] of ticks(begin, end || 1, 6)) {
      line(across(t), TOP, across(t), below, "#e8edf2");
      if (!last) continue;
      c.fillStyle = "#33414f"; c.textAlign = "center";
      c.fillText(text, across(t), below + 10);
    }
    if (last) c.fillText("time (s)", (LEFT + width - RIGHT) / 2, below + 26);
    c.textAlign = "right";
    if (modes) {
      panel.curves.forEach((curve, row) => {
        const y = values(curve), top = TOP + BAR * row + 1;
        for (let k = 0, from = 0; k < y.length; k++) {
          if (k + 1 < y.length && y[k + 1] === y[from]) continue;
          c.fillStyle = frot.modeColours[y[from]];
          const x = across(grid[from]), stop = across(grid[Math.min(k + 1, y.length - 1)]);
          c.fillRect(x, top, Math.max(stop - x, 0.5), BAR - 2);
          from = k + 1;
        }
        c.fillStyle = "#33414f";
        c.fillText(curve.name.replace(/\.mode$/, "").slice(-9), LEFT - 6, top + BAR / 2 - 1);
      });
    } else {
      const named = steps.map((x, k) => [k, x]).filter((x) => x[1]);
      const [low, top] = steps.length ? [named[0][0] - 0.3, steps.length - 0.7] : range(panel.curves);
      const up = (v) => below - (high * (v - low)) / (top - low);
      c.fillStyle = "#33414f";
      for (const [v, text] of steps.length ? named : ticks(low, top, 5)) {
        line(LEFT, up(v), width - RIGHT, up(v), "#e8edf2");
        c.fillStyle = "#33414f";
        c.fillText(text, LEFT - 5, up(v));
      }
      c.save();
      c.beginPath(); c.rect(LEFT, TOP, width - LEFT - RIGHT, high); c.clip();
      c.setLineDash([2, 3]);
      if (frot.events.length <= MARKS)
        for (const e of frot.events) line(across(e.time), TOP, across(e.time), below, "#8a97a5");
      c.setLineDash([]);
      c.lineWidth = 1.6;
      panel.curves.forEach((curve, k) => {
        const y = values(curve);
        c.strokeStyle = frot.palette[k % frot.palette.length];
        c.beginPath();
        for (let i = 0; i < y.length; i++) {
          if (steps.length && i) c.lineTo(across(grid[i]), up(y[i - 1]));
          c.lineTo(across(grid[i]), up(y[i]));
        }
        c.stroke();
      });
      c.restore();
      c.save();
      c.translate(9, TOP + high / 2); c.rotate(-Math.PI / 2);
      c.textAlign = "center";
      c.fillText(steps.length ? "" : panel.curves[0].unit || "number", 0, 0);
      c.restore();
    }
    c.lineWidth = 1;
    c.strokeStyle = "#1c2733";
    c.strokeRect(LEFT, TOP, width - LEFT - RIGHT, high);
  };
  const draw = () => {
    width = Math.max(pane.clientWidth - 12, 200);
    inner.replaceChildren(cursor);
    panels.forEach((panel, number) => {
      panel.box = make("div", inner, { className: "panel" });
      paint(panel, number === panels.length - 1);
      panel.cells = panel.curves.map((curve, k) => {
        const row = make("div", panel.box, { className: "row" });
        make("i", row).style.background = curve.mode ? "none" : frot.palette[k % frot.palette.length];
        make("span", row, {}, curve.name);
        const cell = make("b", row);
        make("small", row, {}, curve.unit);
        const cross = make("button", row, { title: `take ${curve.name} away` }, "×");
        cross.addEventListener("click", () => {
          boxes.find((x) => x.curve === curve).box.checked = false;
          remove(curve.name);
          draw();
        });
        return cell;
      });
    });
    cursor.hidden = !panels.length;
    at(now);
  };

  // ------------------------------------------------------------ the moment
  let now = begin;
  const at = (t) => {
    now = t;
    const place = find(grid, t);
    cursor.style.transform = `translateX(${across(t)}px)`;
    for (const panel of panels) panel.curves.forEach((curve, k) => {
      const y = values(curve);
      panel.cells[k].textContent = curve.steps.length
        ? curve.steps[y[place[2] >= 1 ? place[1] : place[0]]]
        : between(y, 1, place)[0].toPrecision(5);
    });
  };
  const pick = (event) => {
    const x = event.clientX - inner.getBoundingClientRect().left;
    const part = (x - LEFT) / (width - LEFT - RIGHT);
    tools.go(begin + (end - begin) * Math.min(Math.max(part, 0), 1));
  };
  inner.addEventListener("pointerdown", (event) => {
    if (event.target.tagName === "CANVAS") { tools.pause(); pick(event); }
  });
  inner.addEventListener("pointermove", (event) => {
    if (event.buttons && event.target.tagName === "CANVAS") pick(event);
  });
  let last = 0;
  new ResizeObserver(() => {
    if (Math.abs(pane.clientWidth - last) > 1) { last = pane.clientWidth; draw(); }
  }).observe(pane);
  draw();
  return { at };
};
