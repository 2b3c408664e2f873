// The page of a run: moves the objects of a scene that k3d draws, and what stands beside it.
// `frot` holds what Python knows (page.py), `k3d` the viewer.
const numbers = (text) => {
  const bytes = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  return new Float32Array(bytes.buffer);
};
const make = (tag, parent, given = {}, text = "") => {
  const found = document.createElement(tag);
  Object.assign(found, given);
  found.textContent = text;
  parent.append(found);
  return found;
};

// ---------------------------------------------------------------- the page
document.title = frot.name;
make("style", document.head, {}, frot.css);
const root = make("div", document.body, { id: "frot" });
const head = make("header", root);
make("h1", head, {}, frot.name);
make("p", head, {}, frot.doc);
if (frot.fault) make("p", head, { className: "fault" }, frot.fault);
const see = make("div", root, { className: "see" });
see.append(document.getElementById("canvasTarget"));
const label = make("div", see, { className: "label" });
const legend = make("div", see, { className: "legend" });
const curves = make("div", root, { className: "curves" });
const foot = make("footer", root);
const play = make("button", foot, { className: "play", title: "space bar" }, "play");
const slider = make("input", foot, { type: "range", min: 0, max: 1, step: "any", value: 0 });
const speed = make("select", foot, { title: "speed" });
const strip = make("div", foot, { className: "events", title: "events" });
const happened = make("div", foot, { className: "happened" });

// ---------------------------------------------------------------- time
const times = Float64Array.from(frot.times);
const first = times[0], last = times[times.length - 1], span = last - first;
let now = first, playing = false, before = 0;
const natural = Math.pow(10, Math.round(Math.log10(span / 6 || 1)));
for (const factor of [0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10]) {
  const value = factor * natural;
  make("option", speed, { value, selected: factor === 1 }, `${+value.toPrecision(2)} x`);
}
if (span > 1.5 && span < 25) {
  const real = [...speed.options].reduce((a, b) =>
    Math.abs(Math.log(b.value)) < Math.abs(Math.log(a.value)) ? b : a);
  real.selected = true;
}

// The pair of moments around t, and where t is between them.
const find = (list, t) => {
  let low = 0, high = list.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (list[middle] <= t) low = middle; else high = middle;
  }
  const width = list[high] - list[low];
  return [low, high, width > 0 ? Math.min(Math.max((t - list[low]) / width, 0), 1) : 0];
};
const between = (values, size, place) => {
  const [a, b, s] = place, found = new Array(size);
  for (let k = 0; k < size; k++)
    found[k] = (1 - s) * values[a * size + k] + s * values[b * size + k];
  return found;
};

// ---------------------------------------------------------------- what moves
const objects = (ids) => ids.map((id) => k3d.getObjectById(id)).filter(Boolean);
const put = (list, matrix) => {
  for (const one of list) {
    one.matrixAutoUpdate = false;
    one.matrix.fromArray(matrix);
    one.matrixWorldNeedsUpdate = true;
  }
};
const show = (list, visible) => { for (const one of list) one.visible = visible; };
// Columns of a matrix for things along z from p, as long as d, as wide as w.
const along = (p, d, w) => {
  const long = Math.hypot(...d) || 1e-30, n = d.map((x) => x / long);
  const k = n.map(Math.abs).indexOf(Math.min(...n.map(Math.abs)));
  const e = [0, 0, 0]; e[k] = 1;
  let f = [e[1] * n[2] - e[2] * n[1], e[2] * n[0] - e[0] * n[2], e[0] * n[1] - e[1] * n[0]];
  const size = Math.hypot(...f); f = f.map((x) => x / size);
  const g = [n[1] * f[2] - n[2] * f[1], n[2] * f[0] - n[0] * f[2], n[0] * f[1] - n[1] * f[0]];
  return [...f.map((x) => x * w), 0, ...g.map((x) => x * w), 0, ...d, 0, ...p, 1];
};
const posed = (pose, layer) => {
  let [x, y, z, w, i, j, k] = pose;
  const size = Math.hypot(w, i, j, k) || 1;
  w /= size; i /= size; j /= size; k /= size;
  return [1 - 2 * (j * j + k * k), 2 * (i * j + w * k), 2 * (i * k - w * j), 0,
    2 * (i * j - w * k), 1 - 2 * (i * i + k * k), 2 * (j * k + w * i), 0,
    2 * (i * k + w * j), 2 * (j * k - w * i), 1 - 2 * (i * i + j * j), 0, x, y, z + layer, 1];
};
const poses = Object.fromEntries(Object.entries(frot.poses).map(([k, v]) => [k, numbers(v)]));
const parts = frot.parts.map((x) => ({ ...x, objects: objects(x.ids) }));
const joinings = frot.joinings.map((x) => ({ ...x, ends: numbers(x.ends), objects: objects(x.ids) }));
const arrows = frot.arrows.map((x) => ({
  ...x, places: numbers(x.places), vectors: numbers(x.vectors),
  shaft: objects(x.shaft), head: objects(x.head),
}));
const cones = frot.cones.map((x) => ({
  ...x, places: numbers(x.places), normals: numbers(x.normals), objects: objects(x.ids),
}));
const modes = Object.fromEntries(Object.entries(frot.modes).map(([k, v]) => [k, numbers(v)]));
const shown = { reactions: true, cones: false, frames: false, symbols: true, follow: frot.follow };
const middles = numbers(frot.middles);
let at = between(middles, 3, find(times, first));

// `open`, `stick`, `slip` of a liaison: the mode of the moment reached, never one between two.
const modeOf = (name, place) => (modes[name] ? modes[name][place[2] >= 1 ? place[1] : place[0]] : -1);

const move = () => {
  const place = find(times, now);
  for (const part of parts) {
    const list = part.objects;
    let visible = part.kind === "frame" ? shown.frames || part.owner === "" : true;
    if (part.kind === "liaison") {
      visible = shown.symbols && (part.mode < 0 || part.mode === modeOf(part.liaison, place));
    }
    show(list, visible);
    if (!visible) continue;
    const values = poses[part.owner];
    let pose = [0, 0, 0, 1, 0, 0, 0];
    if (values) {
      pose = between(values, 7, place);
      // a quaternion and its opposite are the same turn
      const a = place[0] * 7, b = place[1] * 7;
      let same = 0;
      for (let k = 3; k < 7; k++) same += values[a + k] * values[b + k];
      if (same < 0) for (let k = 3; k < 7; k++)
        pose[k] = (1 - place[2]) * values[a + k] - place[2] * values[b + k];
    }
    put(list, posed(pose, part.layer));
  }
  for (const one of joinings) {
    const ends = between(one.ends, 6, place), p = ends.slice(0, 3);
    put(one.objects, along(p, [0, 1, 2].map((k) => ends[k + 3] - p[k]), 1));
  }
  for (const one of arrows) {
    const v = between(one.vectors, 3, place).map((x) => x * frot.scale), long = Math.hypot(...v);
    const visible = shown.reactions && long > 0.3 * frot.small && isFinite(long);
    show(one.shaft, visible); show(one.head, visible);
    if (!visible) continue;
    const p = between(one.places, 3, place), tip = Math.min(0.45 * long, 1.1 * frot.small);
    p[2] += one.layer;
    const end = p.map((x, k) => x + v[k] * (1 - tip / long));
    put(one.shaft, along(p, v.map((x) => x * (1 - tip / long)), frot.small * 0.16));
    put(one.head, along(end, v.map((x) => (x * tip) / long), tip * 0.42));
  }
  for (const one of cones) {
    const visible = shown.cones && modeOf(one.name, place) !== 0;
    show(one.objects, visible);
    if (!visible) continue;
    const long = 5 * frot.small, n = between(one.normals, 3, place);
    put(one.objects, along(between(one.places, 3, place), n.map((x) => x * long), long * Math.tan(one.angle)));
  }
  const there = between(middles, 3, place);
  if (shown.follow) {
    const camera = k3d.getWorld().controls.getCameraArray();
    for (let k = 0; k < 3; k++) { camera[k] += there[k] - at[k]; camera[k + 3] += there[k] - at[k]; }
    k3d.setCamera(camera);
  }
  at = there;
  if (frot.series) k3d.setTime(now);
  k3d.render();
  slider.value = span > 0 ? (now - first) / span : 0;
  label.textContent = `t = ${now.toPrecision(6)} s`;
  tell();
};

// ---------------------------------------------------------------- curves
const beside = frot.curves.length ? makeCurves(curves, {
  make, numbers, find, between, go: (t) => go(t), pause: () => { playing = false; state(); },
}) : null;
const tell = () => {
  if (beside) beside.at(now);
  const reached = frot.events.filter((e) => e.time <= now + 1e-12 * span).length - 1;
  if (reached !== tell.reached) {
    tell.reached = reached;
    [...happened.children].forEach((x, k) => x.classList.toggle("now", k === reached));
    if (reached >= 0) happened.scrollTop = happened.children[reached].offsetTop - happened.offsetTop - 20;
  }
};

// Of a model without bodies the curves have the room.
if (!frot.parts.some((x) => x.kind === "body")) {
  legend.style.display = "none";
  curves.style.width = "75vw";
}

// ---------------------------------------------------------------- what one can do
const go = (t) => { now = Math.min(Math.max(t, first), last); move(); };
const state = () => {
  play.textContent = playing ? "pause" : "play";
  if (!playing && drawer.getPixelRatio() !== dots) { drawer.setPixelRatio(dots); k3d.render(); }
};
const toggle = () => {
  playing = !playing && span > 0;
  if (playing && now >= last) now = first;
  before = performance.now();
  state();
  if (playing) requestAnimationFrame(tick);
};
// Where a computer draws fewer than 28 pictures a second, they have fewer dots until it pauses.
const drawer = k3d.getWorld().renderer, dots = drawer.getPixelRatio();
let pace = 20;
const hurry = (taken) => {
  pace += 0.15 * (Math.min(taken, 200) - pace);
  const now = drawer.getPixelRatio();
  if (pace > 36 && now > 0.45 * dots) { drawer.setPixelRatio(0.75 * now); pace = 20; }
};
const tick = (stamp) => {
  if (!playing) return;
  hurry(stamp - before);
  const passed = Math.max(stamp - before, 0) / 1000;
  before = stamp;
  const next = now + passed * speed.value;
  if (next >= last) { playing = false; state(); }
  go(next);
  frames += 1;
  if (playing) requestAnimationFrame(tick);
};
let frames = 0;
play.addEventListener("click", toggle);
slider.addEventListener("input", () => { playing = false; state(); go(first + span * slider.value); });
document.addEventListener("keydown", (event) => {
  if (event.target.tagName === "SELECT" || ["checkbox", "search"].includes(event.target.type)) return;
  const step = span / 200;
  if (event.key === " ") { event.preventDefault(); if (event.target !== play) toggle(); }
  else if (event.key === "ArrowRight") { event.preventDefault(); go(now + step); }
  else if (event.key === "ArrowLeft") { event.preventDefault(); go(now - step); }
  else if (event.key === "Home") go(first);
  else if (event.key === "End") go(last);
});
for (const event of frot.events) {
  const mark = make("i", strip, { title: event.text });
  mark.style.left = `${span > 0 ? (100 * (event.time - first)) / span : 0}%`;
  const line = make("a", happened, { href: "#" }, event.text);
  const there = (e) => { e.preventDefault(); playing = false; state(); go(event.time); };
  mark.addEventListener("click", there);
  line.addEventListener("click", there);
}
if (frot.unlisted) make("div", happened, {}, `${frot.unlisted} later events are not listed`);
if (!frot.events.length) { strip.remove(); happened.remove(); }
const choose = (name, words) => {
  const one = make("label", legend);
  const box = make("input", one, { type: "checkbox", checked: shown[name] });
  one.append(words);
  box.addEventListener("change", () => { shown[name] = box.checked; move(); });
};
if (arrows.length) choose("reactions", "reactions");
if (cones.length) choose("cones", "friction cones");
choose("frames", "frames");
choose("symbols", "liaisons");
choose("follow", "follow");
const camera = make("button", legend, {}, "camera");
const home = () => {
  const { target, way, up, half, field } = frot.camera;
  const high = Math.tan((field * Math.PI) / 360), wide = (high * see.clientWidth) / see.clientHeight;
  const far = 1.12 * Math.max(half[0] / wide, half[1] / high);
  const start = between(middles, 3, find(times, first));
  const goal = target.map((x, k) => (shown.follow ? x + at[k] - start[k] : x));
  k3d.setCamera([...goal.map((x, k) => x + far * way[k]), ...goal, ...up]);
};
camera.addEventListener("click", () => { home(); move(); });
for (const [words, colour] of frot.colours) {
  const one = make("span", legend);
  make("i", one).style.background = colour;
  one.append(words);
}
window.frotView = { go, toggle, now: () => now, frames: () => frames, first, last, k3d, shown };
k3d.resizeHelper();
home();
move();
