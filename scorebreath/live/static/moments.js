// What is to be seen now: pictures come in a little before their time, or a little after, and what is drawn lies between two of them.
const AHEAD = 5.5; // s that a sender may be ahead of what is heard
const KEPT = 1500; // pictures of a body that wait, at most
const GAP = .25;   // s between pictures, above which nothing is guessed

// The moment that is drawn, in Unix time: behind the wall clock by the delay, and by what pictures are late or clocks differ.
function makeClock(delay, wall = () => Date.now() / 1000) {
  const WINDOW = 2, EASE = .1;
  let least = Infinity, before = Infinity, turned = 0, lag = null, last = 0;
  // A picture that is early waits until it is heard, unless it is earlier than any sender would be: then that clock is another.
  const target = () => { const late = Math.min(least, before); return late > 0 || late < -AHEAD ? late : 0; };
  return {
    heard(unix) {
      const now = wall();
      if (Math.abs(now - turned) > WINDOW) { before = Math.abs(now - turned) > 2 * WINDOW ? Infinity : least; least = Infinity; turned = now; }
      least = Math.min(least, now - unix);
      if (lag === null) { lag = target(); last = now; }
    },
    now() {
      const now = wall(), off = lag === null ? 0 : target() - lag, most = EASE * Math.abs(now - last);
      if (lag !== null) lag += Math.abs(off) > 1 ? off : Math.max(-most, Math.min(most, off));
      last = now;
      return now - (lag ?? 0) - delay;
    },
    forget() { least = before = Infinity; turned = 0; lag = null; },
  };
}

// The pictures of a body, by the time at which they are heard.
function makeRow() {
  let row = [];
  return {
    add(picture) {
      while (row.length && row[row.length - 1].unix >= picture.unix) row.pop(); // it went back to another place
      row.push(picture);
      if (row.length > KEPT) row.splice(0, row.length - KEPT);
    },
    // At a moment: the picture before it, moved towards the one behind it, and the times of both; null where there is none yet.
    at(unix) {
      let next = row.findIndex(picture => picture.unix > unix);
      if (next < 0) next = row.length;
      if (next > 1) { row.splice(0, next - 1); next = 1; }
      if (!row.length || next === 0) return null;
      const from = row[0], to = row[1];
      if (!to) return {...from, unix, between: [from.time, from.time]};
      const span = to.unix - from.unix, jumped = Math.abs(to.time - from.time - span) > GAP;
      const share = span > GAP || jumped ? 0 : Math.min(1, Math.max(0, (unix - from.unix) / span));
      const mixed = (a, b) => a + (b - a) * share, pose = {};
      for (const name of CHANNELS) pose[name] = mixed(from.pose[name], to.pose[name]);
      return {...from, unix, pose, time: mixed(from.time, to.time), between: [from.time, to.time]};
    },
    clear() { row = []; },
  };
}
