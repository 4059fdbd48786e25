// One page, one clock: the sound's time (or, where it cannot be played, the wall's) poses everything.
const at = id => document.getElementById(id);
const data = JSON.parse(at("data").textContent);
const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
const dark = matchMedia("(prefers-color-scheme: dark)");
let colour = {};
function readColours() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ["ink", "faint", "hair", "fill", "inspired", "speech", "breath"]) colour[name] = style.getPropertyValue("--" + name).trim();
}
readColours();

function bytes(base64) {
  const text = atob(base64), out = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) out[i] = text.charCodeAt(i);
  return out;
}

// Curves: 16-bit steps between a channel's lowest and highest value, little-endian, straight lines between frames; one that never moves has one.
const channels = {};
for (const [name, {low, step, values}] of Object.entries(data.channels)) {
  const raw = new DataView(bytes(values).buffer), decoded = new Float32Array(raw.byteLength / 2);
  for (let i = 0; i < decoded.length; i++) decoded[i] = low + step * raw.getUint16(2 * i, true);
  channels[name] = decoded;
}
// A Score that knows no phones has lips that follow the loudness.
const lipsMove = ["jaw_open", "lip_close", "lip_round", "lip_spread"].some(name => channels[name].some(v => v > .01));
const figure = figureIn(at("figure"));
function sample(name, t) {
  const values = channels[name], x = Math.min(Math.max(t * data.fps, 0), values.length - 1), i = Math.floor(x);
  const next = values[Math.min(i + 1, values.length - 1)];
  return values[i] + (next - values[i]) * (x - i);
}
function poseAt(t) {
  const pose = {};
  for (const name in channels) pose[name] = sample(name, t);
  return pose;
}

// Sound
const audio = new Audio();
let silent = false;
audio.addEventListener("error", () => { silent = true; });
audio.preload = "auto";
audio.src = URL.createObjectURL(new Blob([bytes(at("sound").textContent.trim())], {type: "audio/flac"}));
at("sound").remove();

const state = {time: 0, playing: false, since: 0, gain: still ? 1 : 2, word: -1, breath: -1, act: -1, last: null};
function now() {
  if (!state.playing) return state.time;
  return silent ? (performance.now() - state.since) / 1000 : audio.currentTime;
}
function seek(t) {
  state.time = Math.min(Math.max(t, 0), data.shown);
  state.since = performance.now() - state.time * 1000;
  if (audio.readyState > 0) audio.currentTime = state.time;
  pose(state.time);
}
audio.addEventListener("loadedmetadata", () => {
  document.documentElement.dataset.sound = audio.duration.toFixed(6);
  if (state.time) audio.currentTime = state.time;
});
function toggle(play = !state.playing) {
  if (play && state.time >= data.shown - .01) seek(0);
  state.playing = play;
  state.since = performance.now() - state.time * 1000;
  if (!silent) play ? audio.play().catch(refused) : audio.pause();
  at("play-shape").setAttribute("d", play ? "M6 4h4v16H6zM14 4h4v16h-4z" : "M7 4l13 8-13 8z");
  at("play").setAttribute("aria-label", play ? "Pause" : "Play");
  if (play) requestAnimationFrame(tick);
}
function refused(error) {
  if (error.name === "NotSupportedError") { silent = true; state.since = performance.now() - state.time * 1000; }
  else if (error.name !== "AbortError") toggle(false);
}
audio.addEventListener("pause", () => { if (state.playing && !audio.ended) toggle(false); });
function tick() {
  if (!state.playing) return;
  state.time = Math.min(now(), data.shown);
  pose(state.time);
  if (state.time >= data.shown - .005 || audio.ended && !silent) toggle(false);
  else requestAnimationFrame(tick);
}

// Text
const words = [], breaths = [], acts = [], inspired = data.inspired.map(([onset, end]) => ({onset, end}));
for (const piece of data.text) {
  if (piece.onset === undefined) { at("transcript").append(piece.text); continue; }
  const span = document.createElement("span");
  span.className = piece.caption !== undefined ? "act" : piece.text === undefined ? "breath" : "word";
  if (piece.caption !== undefined) {
    span.textContent = piece.caption;
    acts.push({...piece, span});
  } else if (piece.text === undefined) {
    span.style.width = `${(.5 + 4 * piece.depth).toFixed(2)}em`;
    span.title = `breath at ${clock(piece.onset)}`;
    breaths.push({...piece, span});
  } else {
    span.textContent = piece.text;
    words.push({...piece, span});
  }
  span.dataset.onset = piece.onset;
  at("transcript").append(span);
}
const said = [...words, ...acts.map(act => ({...act, text: act.caption, act: true}))].sort((a, b) => a.onset - b.onset);
at("transcript").addEventListener("click", event => {
  const onset = event.target.dataset.onset;
  if (onset !== undefined) seek(Number(onset));
});
function clock(t) {
  const minutes = Math.floor(t / 60), seconds = t - 60 * minutes;
  return `${minutes}:${seconds.toFixed(1).padStart(4, "0")}`;
}
function lastBefore(list, t) {
  let low = 0, high = list.length;
  while (low < high) { const middle = (low + high) >> 1; list[middle].onset <= t + 1e-9 ? low = middle + 1 : high = middle; }
  return low - 1;
}
function mark(list, key, t) {
  let index = lastBefore(list, t);
  if (index >= 0 && t >= list[index].end) index = -1;
  if (index === state[key]) return;
  if (state[key] >= 0) list[state[key]].span.classList.remove("now");
  state[key] = index;
  if (index >= 0) list[index].span.classList.add("now");
}
// The transcript shows the last word or breath begun, also where nothing is said; before the first, its beginning.
function follow(t) {
  const begun = [words, breaths, acts].map(list => list[lastBefore(list, t)]).filter(Boolean);
  const last = begun.length ? begun.reduce((a, b) => a.onset > b.onset ? a : b) : null;
  if (last === state.last) return;
  state.last = last;
  const box = at("transcript"), edge = element => element.getBoundingClientRect().top;
  const top = last ? edge(last.span) - edge(box) + box.scrollTop : 0;
  if (top < box.scrollTop + 40 || top > box.scrollTop + box.clientHeight - 80)
    box.scrollTo({top: top - box.clientHeight / 3, behavior: still || !state.playing ? "auto" : "smooth"});
}

// Strip and overview
function canvas(id) {
  const element = at(id), ratio = devicePixelRatio || 1, width = element.clientWidth, height = element.clientHeight;
  if (element.width !== Math.round(width * ratio) || element.height !== Math.round(height * ratio)) {
    element.width = Math.round(width * ratio);
    element.height = Math.round(height * ratio);
  }
  const pen = element.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  return [pen, width, height];
}
const lungs = channels.lung_volume.reduce(([low, high], v) => [Math.min(low, v), Math.max(high, v)], [1e9, -1e9]);
lungs[0] -= .02;
lungs[1] = Math.max(lungs[1], lungs[0] + .1);
// Every word and act has its label: in the first of three rows where there is room, a little later where there is none. Fewer
// seconds are shown where those on one screen would crowd the rows: in a narrow window, or where speech is fast.
const SECONDS = 10, DENSE = 90, ROWS = 3, ROW = 15, LATE = .25, FONT = "12px system-ui, sans-serif";
let first = 0, labels = {width: 0, rate: 1, seconds: SECONDS, count: 1, rows: [], begins: [], longest: 0};
function arrange(pen, width) {
  const widths = said.map(word => pen.measureText(word.text).width + 6);
  for (let rate = Math.max(width / SECONDS, DENSE); ; rate *= 1.2) {
    const free = Array(ROWS).fill(-1e9), rows = [], begins = [];
    let late = 0, longest = 0;
    said.forEach((word, i) => {
      let row = free.findIndex(end => end <= word.onset);
      if (row < 0) row = free.indexOf(Math.min(...free));
      begins.push(Math.max(word.onset, free[row]));
      rows.push(row);
      free[row] = begins[i] + widths[i] / rate;
      late = Math.max(late, begins[i] - word.onset);
      longest = Math.max(longest, free[row] - word.onset);
    });
    labels = {width, rate, seconds: width / rate, count: 1 + rows.reduce((a, b) => Math.max(a, b), 0), rows, begins, longest};
    if (late <= LATE || labels.seconds < 2) return;
  }
}
function strip(t) {
  const [pen, width, height] = canvas("strip");
  pen.font = FONT;
  if (labels.width !== width) arrange(pen, width);
  const {rate, seconds, count} = labels;
  if (!still) first = t - .3 * seconds;
  else if (t < first || t > first + .9 * seconds) first = Math.max(0, t - .1 * seconds);
  const x = time => (time - first) * rate, foot = height - count * ROW - 9, middle = foot * .67;
  const lung = v => middle - 6 - (v - lungs[0]) / (lungs[1] - lungs[0]) * (middle - 18);
  pen.textBaseline = "alphabetic";
  pen.fillStyle = colour.inspired;
  for (let i = Math.max(0, lastBefore(inspired, first) - 1); i < inspired.length && inspired[i].onset < first + seconds; i++)
    pen.fillRect(x(inspired[i].onset), 0, (inspired[i].end - inspired[i].onset) * rate, foot);
  const from = Math.max(0, first), to = Math.min(data.shown, first + seconds);
  const trace = (name, y) => {
    pen.beginPath();
    for (let time = from; time <= to; time += 1.5 / rate) pen.lineTo(x(time), y(sample(name, time)));
  };
  const close = y => { pen.lineTo(x(to), y); pen.lineTo(x(from), y); pen.closePath(); pen.fill(); };
  pen.globalAlpha = .6; pen.fillStyle = colour.fill;
  trace("lung_volume", lung); close(middle);
  pen.globalAlpha = 1;
  const level = db => foot - Math.max(0, Math.min(1, (db + 50) / 58)) * (foot - middle - 8);
  for (const [name, ink] of [["breath_level", "breath"], ["speech_level", "speech"]]) {
    pen.fillStyle = colour[ink]; trace(name, level); close(foot);
  }
  pen.lineWidth = 2.2; pen.lineJoin = "round"; pen.strokeStyle = colour.ink;
  trace("lung_volume", lung); pen.stroke();
  for (const label of shown(t)) {
    pen.fillStyle = label.now ? (label.act ? colour.breath : colour.ink) : colour.faint;
    pen.fillText(label.text, label.left, foot + 4 + (label.row + .75) * ROW);
  }
  pen.fillStyle = colour.ink;
  pen.fillRect(x(t) - 1, 0, 2, height);
}
function shown(t) {
  const {rate, seconds, rows, begins, longest} = labels, found = [];
  for (let i = Math.max(0, lastBefore(said, first - longest)); i < said.length && said[i].onset < first + seconds; i++)
    found.push({text: said[i].text, act: said[i].act, left: (begins[i] - first) * rate, row: rows[i], now: said[i].onset <= t && t < said[i].end});
  return found;
}
let peaks = [];
function highest(width) {
  const all = channels.lung_volume;
  return Array.from({length: width}, (_, column) => {
    const begin = Math.floor(column / width * all.length), end = Math.max(begin + 1, Math.floor((column + 1) / width * all.length));
    return all.subarray(begin, end).reduce((a, b) => Math.max(a, b));
  });
}
function overview(t) {
  const [pen, width, height] = canvas("overview");
  if (peaks.length !== width) peaks = highest(width);
  const played = t / data.shown * width;
  peaks.forEach((v, column) => {
    const y = height - 3 - (v - lungs[0]) / (lungs[1] - lungs[0]) * (height - 8);
    pen.fillStyle = column <= played ? colour.speech : colour.hair;
    pen.fillRect(column, y, 1, height - y);
  });
  pen.fillStyle = colour.ink;
  pen.fillRect(Math.round(played) - 1, 0, 2, height);
}

// Everything at one moment
function pose(t) {
  const values = poseAt(t);
  mark(words, "word", t);
  mark(breaths, "breath", t);
  mark(acts, "act", t);
  follow(t);
  strip(t);
  overview(t);
  figure(values, state.gain, still, lipsMove); // writes come after all reads of the layout
  for (const name in values) at("figure").dataset[name.replace(/_(.)/g, (_, c) => c.toUpperCase())] = values[name].toFixed(6);
  at("figure").dataset.time = t.toFixed(6);
  at("read-volume").textContent = `${(100 * values.lung_volume).toFixed(0)} % VC`;
  at("read-air").textContent = `${values.airflow < -.005 ? "−" : ""}${Math.abs(values.airflow).toFixed(2)} L/s`;
  at("read-gain").textContent = `×${state.gain}`;
  at("clock").textContent = `${clock(t)} / ${clock(data.shown)}`;
  at("seek").value = t;
  at("seek").setAttribute("aria-valuetext", clock(t));
  return values;
}
function fromHash() {
  const found = /^#t=([0-9.]+)$/.exec(location.hash);
  if (found) { if (state.playing) toggle(false); seek(Number(found[1])); }
}

// Hands
at("seek").max = data.shown;
at("seek").addEventListener("input", event => seek(Number(event.target.value)));
at("play").addEventListener("click", () => toggle());
at("gain").value = state.gain;
at("gain").addEventListener("input", event => { state.gain = Number(event.target.value); pose(now()); });
let drag = null;
at("strip").addEventListener("pointerdown", event => { drag = {x: event.clientX, time: now()}; at("strip").setPointerCapture(event.pointerId); });
at("strip").addEventListener("pointermove", event => { if (drag) seek(drag.time - (event.clientX - drag.x) / labels.rate); });
for (const name of ["pointerup", "pointercancel"]) at("strip").addEventListener(name, () => { drag = null; });
addEventListener("keydown", event => {
  const own = {gain: "Arrow Home End", play: "Space", transcript: "ArrowUp ArrowDown Home End"}[event.target.id] || "";
  if (event.ctrlKey || event.metaKey || event.altKey || own.includes(event.key.trim() || "Space")) return;
  const t = now(), current = lastBefore(breaths, t);
  const previous = current >= 0 && t - breaths[current].onset < .5 ? current - 1 : current;
  const keys = {
    " ": () => toggle(), ArrowLeft: () => seek(t - 2), ArrowRight: () => seek(t + 2), Home: () => seek(0), End: () => seek(data.shown),
    ArrowUp: () => seek(previous >= 0 ? breaths[previous].onset : 0),
    ArrowDown: () => seek(current + 1 < breaths.length ? breaths[current + 1].onset : data.shown),
  };
  if (event.key in keys) { event.preventDefault(); keys[event.key](); }
});
addEventListener("resize", () => pose(now()));
addEventListener("hashchange", fromHash);
dark.addEventListener("change", () => { readColours(); pose(now()); });
window.scorebreath = {pose: t => { if (state.playing) toggle(false); state.time = t; return pose(t); }, data, labels: () => ({...labels, first, shown: shown(now())})};
pose(0);
fromHash();
