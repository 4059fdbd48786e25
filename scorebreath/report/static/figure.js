// The figure: shapes as functions of the channels. 1 unit of chest or belly is about 30 mm, at 0.7 pixels a millimetre.
// A page that shows several gives each drawing ids that begin with a prefix of its own.
function figureIn(svg, prefix = "") {
  const FULL = 21, JAW = 27, NOSTRIL = 5, SHOULDER = 14, HINGE = [176, 122];
  const parts = Object.fromEntries(Array.from(svg.querySelectorAll("[id]"), part => [part.id.slice(prefix.length), part]));
  const at = id => parts[id];
  const heads = svg.querySelectorAll(".head"), airs = at("air").querySelectorAll("path"), voices = at("voice").querySelectorAll("path");
  const face = faceIn(at);
  const path = (id, d) => at(id).setAttribute("d", d);
  const n = x => x.toFixed(2);
  const mix = parts => parts.map(p => typeof p === "number" ? n(p) : p).join(" ");

  // From the hips up to the collar; chest and belly in pixels.
  function front(c, b, s) {
    return ["C", 250 + .5 * b, 546, 254 + .9 * b, 508, 254 + b, 472, "C", 254 + b, 442, 247 + .5 * b + .2 * c, 414, 246 + .35 * b + .45 * c, 392,
      "C", 248 + .8 * c, 368, 253 + c, 346 - .2 * c, 250 + c, 322 - .3 * c,
      "C", 247 + .8 * c, 288 - .4 * c, 237 + .4 * c, 256 - .4 * c, 222, 236 - .5 * s];
  }

  function torso(chest, belly, lift, volume) {
    const c = chest * FULL, b = belly * FULL, s = lift * SHOULDER;
    path("torso", mix(["M", 134, 226 - s, "C", 110 - .1 * c, 234 - s, 98 - .2 * c, 258 - .5 * s, 96 - .2 * c, 302,
      "C", 94, 352, 112, 392, 110, 440, "L", 104, 580, "L", 250, 580, ...front(c, b, s),
      "C", 196, 250 - .6 * s, 158, 246 - s, 134, 226 - s, "Z"]));
    path("arm", mix(["M", 106, 308 - .5 * s, "C", 104, 264 - s, 134, 246 - s, 154, 260 - s, "C", 170, 272 - s, 170, 306 - .6 * s, 166, 344,
      "C", 162, 392, 160, 424, 163, 462, "C", 166, 512, 170, 552, 174, 580, "L", 112, 580, "C", 108, 532, 108, 482, 110, 432,
      "C", 112, 384, 108, 346, 106, 308 - .5 * s, "Z"]));
    const edge = 214 + 14 * volume + .7 * c, base = 352 + 40 * volume + .15 * b;
    path("lungs", mix(["M", 194, 262 - .5 * s, "C", edge - 10, 262 - .5 * s, edge + .2 * c, 300, edge, base - 22, "C", edge - 2, base - 8, edge - 12, base - 2, edge - 18, base - 8,
      "C", 188, base - 26, 176, base - 20, 166, base - 4, "C", 156, base + 6, 148, base - 4, 148, base - 30, "C", 148, 306, 164, 262 - .5 * s, 194, 262 - .5 * s, "Z"]));
    path("windpipe", mix(["M", 188, 236 - .5 * s, "L", 190, 268 - .5 * s]));
  }

  function nose(flare) {
    const f = flare * NOSTRIL;
    path("wing", mix(["M", 257 - .4 * f, 123, "C", 258 - .4 * f, 114 - f, 270 + .2 * f, 113 - f, 274 + .2 * f, 121,
      "C", 273, 128, 263, 130, 257 - .4 * f, 123, "Z"]));
    at("nostril").setAttribute("rx", n(3.6 + .7 * f));
    at("nostril").setAttribute("ry", n(1.7 + .6 * f));
  }

  function mouth(open) {
    const angle = open * JAW, turn = angle * Math.PI / 180, [hx, hy] = HINGE;
    const turned = (x, y) => [hx + (x - hx) * Math.cos(turn) - (y - hy) * Math.sin(turn), hy + (x - hx) * Math.sin(turn) + (y - hy) * Math.cos(turn)];
    at("jaw").setAttribute("transform", `rotate(${n(angle)} ${hx} ${hy})`);
    path("mouth-inside", open < .005 ? "" : mix(["M", 243, 148, "L", 264, 146, "L", ...turned(263, 153), "L", ...turned(244, 152), "Z"]));
  }

  // It is the right side that is seen.
  function eye(lid, brow) {
    const shut = Math.min(1, Math.max(0, lid)), low = 90 + 9 * shut;
    path("lid", mix(["M", 232, 96, "C", 239, low, 247, low, 253, 95 + shut]));
    at("eye").setAttribute("ry", n(3.6 * (1 - shut)));
    at("brow").setAttribute("transform", `translate(0 ${n(-7 * brow)})`);
  }

  // What air does: in through what is open, out while speaking, or where it is heard. The dashes travel with the volume: no clock of their own.
  function air(pose, still) {
    const flow = Math.min(1, Math.abs(pose.airflow) / 1.2);
    const open = pose.mouth_open + pose.nostril_flare, seen = pose.airflow > 0 || pose.breath_level > -79;
    for (const line of airs) {
      const nose = line.classList.contains("nose");
      const share = open > 0 ? (nose ? pose.nostril_flare : pose.mouth_open) / open : (nose ? 1 : 0);
      line.setAttribute("opacity", seen ? n(flow * Math.min(1, .25 + share)) : 0);
      line.setAttribute("stroke-dashoffset", still ? 0 : n(-pose.lung_volume * 1400));
    }
    const loud = Math.max(0, 1 + pose.speech_level / 40);
    voices.forEach((arc, i) => arc.setAttribute("opacity", n(Math.max(0, Math.min(1, 3 * loud - i)) * .8)));
    return loud;
  }

  path("rest", mix(["M", 250, 580, ...front(0, 0, 0)]));
  // `lips` is false where no channel moves the lips: then they follow the loudness.
  return function draw(pose, gain, still, lips = true) {
    const chest = pose.thorax * gain, belly = pose.abdomen * gain, lift = pose.shoulder * gain;
    torso(chest, belly, lift, pose.lung_volume);
    nose(pose.nostril_flare * gain);
    const loud = air(pose, still);
    if (!lips) pose = {...pose, jaw_open: .28 * Math.max(0, loud - .35)};
    pose = {...pose, mouth_open: Math.min(1, pose.mouth_open * gain)};
    mouth(face.aperture(pose));
    eye(pose.lid_right, pose.brow_right);
    face.draw(pose, gain);
    for (const part of heads)
      part.setAttribute("transform", `translate(0 ${n(-.25 * lift * SHOULDER)}) rotate(${n(-pose.head_pitch * gain)} 172 216)`);
  };
}
