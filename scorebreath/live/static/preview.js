// The stage: a card for every body, drawn whenever the screen is.
const at = id => document.getElementById(id);
const still = matchMedia("(prefers-reduced-motion: reduce)").matches;
const STATES = {
  connecting: "Connecting …", waiting: "Connected, waiting for pictures …", live: "Live", lost: "Not connected, trying again …",
};
const MOST = 16, QUIET = 2, GONE = 10; // bodies; s without pictures until that is said, and until a body has left
const wish = Number.parseFloat(new URLSearchParams(location.search).get("delay"));
const delay = Number.isFinite(wish) ? Math.min(2, Math.max(0, wish)) : .05;
const clock = makeClock(delay), cards = new Map();
let gain = still ? 1 : 2, made = 0, state = "", heard = -Infinity, drawn = [];
const seconds = () => performance.now() / 1000;

function become(next) {
  if (next === state) return;
  state = next;
  document.body.dataset.state = next;
  at("state").textContent = STATES[next];
}

// A drawing of its own: ids, and what refers to them, begin with its number.
function makeCard(body) {
  const element = at("card").content.firstElementChild.cloneNode(true), svg = element.querySelector("svg"), prefix = `figure-${++made}-`;
  for (const part of [svg, ...svg.querySelectorAll("*")]) {
    if (part.id) part.id = prefix + part.id;
    for (const name of ["mask", "clip-path", "fill"]) {
      const value = part.getAttribute(name);
      if (value && value.startsWith("url(#")) part.setAttribute(name, value.replace("url(#", `url(#${prefix}`));
    }
  }
  element.dataset.body = body;
  at("stage").append(element);
  const find = name => element.querySelector("." + name);
  return {
    element, svg, row: makeRow(), draw: figureIn(svg, prefix), strip: makeStrip(find("strip")), label: svg.getAttribute("aria-label"), name: "", lips: false,
    heard: 0, shown: null, arrived: [], said: "", title: element.querySelector("h2"), text: find("said"), parts: ["before", "now", "after"].map(find),
    volume: find("read-volume"), air: find("read-air"),
  };
}

function arrive(picture) {
  let card = cards.get(picture.body);
  if (!card) {
    if (cards.size >= MOST) return;
    cards.set(picture.body, card = makeCard(picture.body));
  }
  clock.heard(picture.unix);
  card.row.add(picture);
  card.heard = heard = seconds();
  card.arrived.push(heard);
  while (card.arrived[0] < heard - 1) card.arrived.shift();
  become("live");
}

// The breath group that is said, the word that sounds marked; when it is over it stays until the next.
function say(card, said) {
  const key = said ? JSON.stringify(said) : "";
  if (key === card.said) return;
  card.said = key;
  card.text.classList.toggle("past", !said);
  const letters = Array.from(said ? said.text : card.text.textContent), [from, to] = said?.word ?? [letters.length, letters.length];
  [[0, from], [from, to], [to, letters.length]].forEach(([begin, end], i) => { card.parts[i].textContent = letters.slice(begin, end).join(""); });
  if (said) card.element.classList.add("speaks");
  if (to > from) card.text.scrollTop = card.parts[1].offsetTop - card.text.offsetTop - card.text.clientHeight / 2;
}

function draw(card, unix) {
  const shown = card.row.at(unix);
  if (!shown) return;
  const {pose} = shown;
  card.shown = shown;
  card.lips ||= ["jaw_open", "lip_close", "lip_round", "lip_spread"].some(name => pose[name] > .01);
  if (card.name !== shown.name) {
    card.name = card.title.textContent = shown.name;
    card.svg.setAttribute("aria-label", `${shown.name}. ${card.label}`);
  }
  say(card, shown.said);
  card.draw(pose, gain, still, card.lips);
  card.strip.add(unix, pose);
  card.strip.draw(unix, still);
  card.volume.textContent = `${(100 * pose.lung_volume).toFixed(0)} % VC`;
  card.air.textContent = `${pose.airflow < -.005 ? "−" : ""}${Math.abs(pose.airflow).toFixed(2)} L/s`;
}

function tick() {
  const now = seconds(), unix = clock.now();
  drawn.push(now);
  while (drawn[0] < now - 1) drawn.shift();
  if (state === "live" && now - heard > QUIET) become("waiting");
  for (const [body, card] of cards) {
    const quiet = heard - card.heard; // while others had pictures
    card.element.classList.toggle("gone", quiet > QUIET);
    if (quiet > GONE) { card.element.remove(); cards.delete(body); continue; }
    if (state === "live") draw(card, unix);
  }
  facts(now);
  requestAnimationFrame(tick);
}

function facts(now) {
  const first = cards.values().next().value, time = first?.shown?.time;
  if (time !== undefined) {
    const whole = Math.max(0, time), minutes = Math.floor(whole / 60);
    at("clock").textContent = `${minutes}:${(Math.floor((whole - 60 * minutes) * 10) / 10).toFixed(1).padStart(4, "0")}`;
  }
  const pictures = first ? first.arrived.filter(each => each > now - 1).length : 0;
  at("rate").textContent = first && state === "live" ? `${pictures} pictures/s, ${drawn.length} drawn/s` : "";
}

function move(value) {
  gain = value;
  at("read-gain").textContent = `×${gain}`;
}
at("gain").value = gain;
at("gain").addEventListener("input", event => move(Number(event.target.value)));
move(gain);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", readColours);
connect(arrive, next => {
  if (next === "lost") { clock.forget(); for (const card of cards.values()) card.row.clear(); }
  if (next === "waiting") for (const card of cards.values()) card.heard = heard = seconds(); // they have time to come back
  become(next);
});
window.scorebreath = {
  bodies: () => Array.from(cards, ([body, {name, shown}]) => ({body, name, ...shown})), get state() { return state; }, get gain() { return gain; }, delay,
};
requestAnimationFrame(tick);
