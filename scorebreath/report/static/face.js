// The face from the front, few lines, each a function of the channels. The character's own left is on the right of the page.
// `at` finds a part of the drawing by its id.
function faceIn(at) {
  const n = x => x.toFixed(2);
  const path = (id, ...parts) => at(id).setAttribute("d", parts.map(p => typeof p === "number" ? n(p) : p).join(" "));
  const move = (id, x, y, more = "") => at(id).setAttribute("transform", `translate(${n(x)} ${n(y)})${more}`);
  const fade = (id, opacity) => at(id).setAttribute("opacity", n(Math.max(0, Math.min(1, opacity))));
  const clamp = (x, low, high) => Math.min(high, Math.max(low, x));
  const TURN = 1.35, HALF = 26, MOUTH = 92;

  // What an emotion adds to the shapes at its full strength.
  const EMOTIONS = {
    happy: {smile: 1, squint: .5, raise: .12, open: .05},
    kidding: {smile: .7, smirk: .5, squint: .25, raise: .35},
    sad: {droop: 1, inner: .9, frown: .2, wide: -.16},
    angry: {frown: .95, press: .6, droop: .4, squint: .4, wide: -.1},
    surprised: {raise: .9, wide: .8, open: .34, round: .2},
    disgusted: {sneer: 1, frown: .45, squint: .55, droop: .45},
    afraid: {raise: .55, inner: .8, frown: .3, wide: .8, stretch: .7, open: .12},
  };
  const SHAPES = ["smile", "smirk", "droop", "stretch", "press", "sneer", "squint", "wide", "raise", "inner", "frown", "open", "round"];

  // Everything that moves, the emotions in it.
  function shapes(pose) {
    const sum = Object.fromEntries(SHAPES.map(name => [name, 0]));
    for (const [emotion, adds] of Object.entries(EMOTIONS))
      for (const name in adds) sum[name] += adds[name] * (pose["emotion_" + emotion] || 0);
    return sum;
  }
  // How far the mouth is open, 0..1: the lips shut it whatever jaw, breath and emotion do.
  function aperture(pose) {
    return clamp(Math.max(pose.jaw_open, pose.mouth_open) + shapes(pose).open, 0, 1) * (1 - pose.lip_close);
  }

  function outline(jaw, up) {
    const chin = 148 + 14 * jaw - 1.5 * up, cheek = 108 + 9 * jaw;
    const d = ["M", -93, -30, "C", -96, 22, -92, 72, -68, cheek, "C", -50, chin - 14, -24, chin, 0, chin, "C", 24, chin, 50, chin - 14, 68, cheek,
      "C", 92, 72, 96, 22, 93, -30, "C", 90, -112, 52, -146, 0, -146, "C", -52, -146, -90, -112, -93, -30, "Z"];
    path("face-skin", ...d);
    path("face-clip-path", ...d);
    path("face-chin", "M", -17, chin - 24, "C", -8, chin - 20, 8, chin - 20, 17, chin - 24);
  }

  function eye(name, side, lid, s, look) {
    // Upper and lower edge of the opening; a shut lid lies on the lower one.
    const raised = clamp(-lid, 0, 1) * 6 + s.wide * 7, shut = clamp(lid, 0, 1);
    const low = 9.5 - 5 * s.squint, top = (-13 - raised) * (1 - shut) + (low + 1.5) * shut;
    const inner = -side * HALF, outer = side * HALF, tilt = -2.5;
    const upper = ["C", inner * .52, top * 1.12, outer * .5, top * 1.2 + tilt * (1 - shut), outer, tilt];
    const lower = ["C", outer * .55, low * 1.25, inner * .5, low * 1.25, inner, 2];
    path(`${name}-white`, "M", inner, 2, ...upper, ...lower, "Z");
    path(`${name}-clip-path`, "M", inner, 2, ...upper, ...lower, "Z");
    path(`${name}-lash`, "M", inner, 2, ...upper, "L", outer + side * 2.5, tilt - 1.2 + 2 * shut);
    path(`${name}-low`, "M", outer, tilt, ...lower);
    const fold = Math.min(top, -5) - 7 + 4 * shut;
    path(`${name}-fold`, "M", inner * .86, -4, "C", inner * .45, fold * 1.13, outer * .5, fold * 1.2 - 2, outer * 1.08, -7);
    path(`${name}-bag`, "M", inner * .6, 15 - 2 * s.squint, "C", inner * .2, 20 - 3 * s.squint, outer * .4, 20 - 3 * s.squint, outer * .8, 12 - 2 * s.squint);
    fade(`${name}-bag`, .25 + .6 * s.squint);
    move(`${name}-iris`, look.x, look.y);
  }

  function brow(id, side, raise, s) {
    const up = 15 * raise - 4 * s.frown, inner = side * (20 - 6 * s.frown), outer = side * 71;
    const y = -38 - up, begin = y + 4 - 15 * s.inner + 9 * s.frown, end = y + 6 + 5 * s.inner - 2 * s.frown + 4 * raise;
    // From its root thick, towards the temple thin.
    const over = y - 8 - 3 * raise + 2 * s.inner, x1 = inner + side * 16, x2 = outer - side * 18;
    path(id, "M", inner, begin, "C", x1, over + 4 - 5 * s.inner + 5 * s.frown, x2, over + 1, outer, end,
      "C", x2, over + 7, x1, over + 12 - 5 * s.inner + 5 * s.frown, inner + side * 1.5, begin + 6, "C", inner - side * 1.5, begin + 5, inner - side * 1.5, begin + 2, inner, begin, "Z");
  }

  function nose(flare, s) {
    const w = 4 * flare + 2.5 * s.sneer, up = 3.5 * s.sneer;
    path("face-nose", "M", -18 - w, 42 - up, "C", -24 - w, 47 - up, -23 - w, 56 - up, -14 - .5 * w, 55 - .5 * up, "C", -8, 54, -7, 60, 0, 60, "C", 7, 60, 8, 54, 14 + .5 * w, 55 - .5 * up,
      "C", 23 + w, 56 - up, 24 + w, 47 - up, 18 + w, 42 - up);
    path("face-bridge", "M", 11, -12, "C", 8, 8, 10, 24, 14, 34);
    for (const [id, side] of [["face-left", 1], ["face-right", -1]]) {
      const hole = at(id);
      hole.setAttribute("cx", n(side * (9.5 + .5 * w)));
      hole.setAttribute("cy", n(54 - .5 * up));
      hole.setAttribute("rx", n(3.6 + .35 * w));
      hole.setAttribute("ry", n(1.5 + .35 * w));
    }
    fade("face-sneer", s.sneer);
  }

  function mouth(pose, s) {
    const closed = pose.lip_close, tuck = pose.lip_tuck * (1 - closed), round = clamp(pose.lip_round + s.round, 0, 1), spread = pose.lip_spread;
    const open = aperture(pose), gap = Math.max(54 * open * (1 - .3 * round), 5 * tuck), press = clamp(closed * .8 + s.press, 0, 1);
    const wide = 37 + 7 * spread - 15 * round + 10 * s.smile * (1 - .5 * round) + 8 * s.stretch - .08 * gap - 2 * s.droop;
    const lift = 11 * s.smile - 8 * s.droop - 3 * s.stretch, left = -lift, right = -lift - 8 * s.smirk, ax = -wide - 2 * s.smirk, bx = wide;
    // One arc through both corners; the opening is what lies between it bent up and bent down.
    const bend = .3 * lift, top = bend - .22 * gap - 3 * s.sneer, low = bend + 1.05 * gap - 4 * tuck, mid = y => .75 * y + .125 * (left + right);
    const over = (8.5 - 3.5 * press - 1.5 * s.smile + 2 * round) * (1 - .15 * open), under = (12 - 5 * press - 2 * s.smile + 2 * round) * (1 - .5 * tuck);
    const bow = 2.4 * (1 - .6 * round), y = mid(top);
    const lipTop = ["C", ax * .6, .4 * right + .6 * top - over, -10, y - over - bow, 0, y - over + .5 * bow, "C", 10, y - over - bow, bx * .6, .4 * left + .6 * top - over, bx, left];
    const upper = ["C", bx * .55, top, ax * .55, top, ax, right], lower = ["C", ax * .58, low, bx * .58, low, bx, left];
    const lipLow = ["C", bx * .62, low + 1.3 * under, ax * .62, low + 1.3 * under, ax, right];
    path("face-lip-upper", "M", ax, right, ...lipTop, ...upper, "Z");
    path("face-lip-lower", "M", ax, right, ...lower, ...lipLow, "Z");
    path("face-mouth", "M", bx, left, ...upper, ...lower, "Z");
    path("face-mouth-clip-path", "M", bx, left, ...upper, ...lower, "Z");
    path("face-seam", "M", ax, right, ...lower);
    fade("face-seam", 1 - clamp(gap / 6, 0, 1));
    // Teeth hang from above; the lower lip under them shows them in f and v. The tongue lies below.
    const teeth = y + 3 + 6 * Math.min(1, 2 * open) * (1 - .4 * round) + 5 * tuck;
    path("face-teeth", "M", -wide, y - 22, "L", wide, y - 22, "L", wide, teeth - 4 - 4 * s.smile, "C", wide * .5, teeth, -wide * .5, teeth, -wide, teeth - 4 - 4 * s.smile, "Z");
    move("face-tongue", 0, mid(low) + 7 - 12 * pose.tongue_tip * open);
    // The corners, the shade under the lip, and what a smile folds.
    const turn = 2.5 * s.smile - 2 * s.droop, foot = mid(low + 1.3 * under) + 10;
    path("face-corners", "M", ax - 3.5, right - .8 - turn, "C", ax - 2, right + 1, ax, right + .6, ax + 2.5, right + .2, "M", bx + 3.5, left - .8 - turn, "C", bx + 2, left + 1, bx, left + .6, bx - 2.5, left + .2);
    path("face-under", "M", -14, foot, "C", -6, foot + 3, 6, foot + 3, 14, foot);
    const fold = 6 * s.smile;
    path("face-folds", "M", -30, -36, "C", -41 - fold, -28, -51 - fold, -16, -52 - fold, -3 - .3 * lift, "M", 30, -36, "C", 41 + fold, -28, 51 + fold, -16, 52 + fold, -3 - .3 * lift);
    fade("face-folds", .05 + .6 * s.smile + .4 * s.sneer + .25 * spread * open);
  }

  function body(pose, gain) {
    const up = 9 * pose.shoulder * gain, out = 6 * clamp(pose.thorax * gain, -1, 2);
    path("face-shirt", "M", -44, 214, "C", -64, 231 - up, -104 - out, 235 - up, -120 - out, 258 - up, "C", -134 - out, 280 - up, -139 - out, 330, -141 - out, 400,
      "L", 141 + out, 400, "C", 139 + out, 330, 134 + out, 280 - up, 120 + out, 258 - up, "C", 104 + out, 235 - up, 64, 231 - up, 44, 214, "C", 30, 240, -30, 240, -44, 214, "Z");
    path("face-collar", "M", -47, 212, "C", -34, 246, 34, 246, 47, 212);
  }

  return {
    aperture,
    draw(pose, gain) {
      const s = shapes(pose), yaw = pose.head_yaw, pitch = pose.head_pitch;
      const x = clamp(yaw * TURN, -40, 40), y = clamp(-pitch * TURN, -34, 34);
      at("face-head").setAttribute("transform", `rotate(${n(-pose.head_roll)} 0 170) translate(${n(.22 * x)} ${n(.2 * y)})`);
      body(pose, gain);
      const jaw = clamp(Math.max(pose.jaw_open, pose.mouth_open) + s.open, 0, 1);
      outline(jaw, clamp(pitch, -15, 15) * .5);
      // What lies nearer moves further: the nose most, ears and hair behind the other way.
      const narrow = ` scale(${n(1 - .004 * Math.abs(yaw))} 1)`;
      move("face-ears", -.45 * x, -.4 * y);
      move("face-hair-back", -.12 * x, -.1 * y);
      move("face-hair", .12 * x, .15 * y);
      move("face-eyes", x, y, narrow);
      move("face-brows", x, y, narrow);
      move("face-nose-group", 1.45 * x, 1.35 * y);
      move("face-lips", 1.12 * x, MOUTH + 1.1 * y, narrow);
      move("face-cheeks", .9 * x, .9 * y - 5 * s.smile);
      move("face-wrinkles", .9 * x, .95 * y - 6 * Math.max(pose.brow_left, pose.brow_right));
      const look = {x: clamp(pose.eye_yaw * .52, -13, 13), y: clamp(-pose.eye_pitch * .5, -9, 9)};
      eye("face-eye-left", 1, pose.lid_left, s, look);
      eye("face-eye-right", -1, pose.lid_right, s, look);
      const all = {...s, frown: clamp(s.frown + pose.brow_frown, 0, 1)};
      brow("face-brow-left", 1, clamp(s.raise + pose.brow_left, 0, 1.2), all);
      brow("face-brow-right", -1, clamp(s.raise + pose.brow_right, 0, 1.2), all);
      nose(pose.nostril_flare * gain, s);
      mouth(pose, s);
      fade("face-wrinkle-forehead", .85 * pose.wrinkle_forehead);
      fade("face-wrinkle-glabella", pose.wrinkle_glabella);
      fade("face-cheeks", .35 + .45 * s.smile);
    },
  };
}
