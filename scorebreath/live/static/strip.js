// The last seconds of a body, up to now: lungs above, breath and speech below; blue where air goes in.
const SECONDS = 8;
const ink = {};
function readColours() {
  const style = getComputedStyle(document.documentElement);
  for (const name of ["ink", "hair", "fill", "inspired", "speech", "breath"]) ink[name] = style.getPropertyValue("--" + name).trim();
}
readColours();

function makeStrip(canvas) {
  let past = [], low = .25, high = .65, first = 0, width = 0, height = 0;
  new ResizeObserver(() => {
    const ratio = devicePixelRatio || 1;
    [width, height] = [canvas.clientWidth, canvas.clientHeight];
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    canvas.getContext("2d").setTransform(ratio, 0, 0, ratio, 0, 0);
  }).observe(canvas);
  return {
    add(unix, pose) {
      if (past.length && unix < past[past.length - 1].unix) past = [];
      const {lung_volume: lungs, airflow, speech_level: speech, breath_level: breath} = pose;
      past.push({unix, lungs, into: airflow > .02, speech, breath});
      while (past[0].unix < unix - SECONDS - 1) past.shift();
      low = Math.min(low, lungs - .02);
      high = Math.max(high, lungs + .02);
    },
    draw(unix, still) {
      const pen = canvas.getContext("2d"), rate = width / SECONDS, middle = height * .67;
      if (!still) first = unix - SECONDS;
      else if (unix < first || unix > first + SECONDS) first = unix - .2 * SECONDS;
      const x = each => (each.unix - first) * rate;
      pen.clearRect(0, 0, width, height);
      if (past.length < 2) return;
      pen.fillStyle = ink.inspired;
      for (let i = 1, begin = null; i < past.length; i++) {
        if (past[i].into && begin === null) begin = past[i];
        if (begin !== null && (!past[i].into || i === past.length - 1)) { pen.fillRect(x(begin), 0, x(past[i]) - x(begin), height); begin = null; }
      }
      const trace = y => { pen.beginPath(); for (const each of past) pen.lineTo(x(each), y(each)); };
      const close = y => { pen.lineTo(x(past[past.length - 1]), y); pen.lineTo(x(past[0]), y); pen.closePath(); pen.fill(); };
      const lungs = each => middle - 4 - (each.lungs - low) / (high - low) * (middle - 10);
      const level = name => each => height - Math.max(0, Math.min(1, (each[name] + 50) / 58)) * (height - middle - 4);
      pen.globalAlpha = .6; pen.fillStyle = ink.fill; trace(lungs); close(middle); pen.globalAlpha = 1;
      for (const name of ["breath", "speech"]) { pen.fillStyle = ink[name]; trace(level(name)); close(height); }
      pen.lineWidth = 2.2; pen.lineJoin = "round"; pen.strokeStyle = ink.ink; trace(lungs); pen.stroke();
    },
  };
}
