// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The frames: which one is shown, and what is drawn on it. `run` is what report_data.hpp wrote.

const byId = (id) => document.getElementById(id);
const run = JSON.parse(byId("run").textContent);
const listeners = [];  // called with the frame's index when it changes
let shown = -1;

/// Shows a frame of the run, counted from 0; what lies outside is cut off.
function show(frame) {
  frame = Math.max(0, Math.min(run.frames.length - 1, Math.round(frame)));
  if (frame === shown) return;
  shown = frame;
  for (const listener of listeners) listener(frame);
}

/// Index of the frame nearest to a time, seconds.
function frameAt(seconds) {
  let low = 0, high = run.frames.length - 1;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (run.frames[middle].t < seconds) low = middle + 1; else high = middle;
  }
  return low > 0 && seconds - run.frames[low - 1].t < run.frames[low].t - seconds ? low - 1 : low;
}

/// The picture nearest to a frame.
function pictureOf(frame) {
  let best = null;
  for (const picture of run.pictures)
    if (best === null || Math.abs(picture.frame - frame) < Math.abs(best.frame - frame)) best = picture;
  return best;
}

/// The 12 bytes of each feature; feature_bytes.hpp.
function featuresOf(picture) {
  const text = atob(picture.features.split(",")[1]);
  const view = new DataView(Uint8Array.from(text, (c) => c.charCodeAt(0)).buffer);
  const features = [];
  for (let at = 0; at < view.byteLength; at += 12) {
    const bits = view.getUint8(at + 4), score = view.getInt16(at + 6, true);
    const dx = view.getInt8(at + 8), dy = view.getInt8(at + 9);
    features.push({
      x: view.getUint16(at, true) / 8, y: view.getUint16(at + 2, true) / 8,
      verdict: bits & 3, kept: (bits & 4) !== 0, reason: view.getUint8(at + 5),
      score: score === -32768 ? null : score / 100,
      offset: dx === -128 ? null : [dx / 2, dy / 2], depth: view.getUint16(at + 10, true) / 100});
  }
  return features;
}

const verdicts = ["kept", "dynamic", "unknown"], verdictColours = ["#3cc873", "#f05528", "#cdcdcd"];
let picture = null, features = [], pointed = null;

function drawFeature(paper, feature, scale) {
  const x = feature.x * scale, y = feature.y * scale;
  paper.strokeStyle = verdictColours[feature.verdict];
  paper.beginPath();
  if (feature.verdict === 0) paper.arc(x, y, 3, 0, 7);
  if (feature.verdict === 1) {
    paper.moveTo(x - 3.5, y - 3.5); paper.lineTo(x + 3.5, y + 3.5);
    paper.moveTo(x - 3.5, y + 3.5); paper.lineTo(x + 3.5, y - 3.5);
  }
  if (feature.verdict === 2) {
    paper.rect(x - 3, y - 3, 6, 6);
    if (!feature.kept) { paper.moveTo(x - 5, y); paper.lineTo(x + 5, y); }
  }
  if (byId("show_offsets").checked && feature.offset) {
    const length = Math.hypot(feature.offset[0], feature.offset[1]);
    if (length >= 1 && length <= 40) {
      paper.moveTo(x, y);
      paper.lineTo(x - 3 * scale * feature.offset[0], y - 3 * scale * feature.offset[1]);
    }
  }
  paper.stroke();
}

function drawBox(paper, box, scale) {
  const [x, y, width, height] = box.box.map((value) => value * scale);
  paper.setLineDash(box.carried ? [9, 6] : []);
  paper.lineWidth = box.moves ? 2.5 : 1.2;
  paper.strokeStyle = "#f0e442";
  paper.strokeRect(x, y, width, height);
  paper.setLineDash([]);
  paper.font = "13px system-ui, sans-serif";
  paper.lineWidth = 3;
  paper.strokeStyle = "#141414";
  paper.fillStyle = "#fff";
  const at = [Math.max(x, 0) + 5, Math.max(y, 0) + 16];
  paper.strokeText(box.name, ...at);
  paper.fillText(box.name, ...at);
}

const moverColours = ["#ff7ad9", "#30e0d0", "#ffb03a", "#b9a3ff", "#d4f24a", "#ff9c8f"];  // of report.css's --mover0 …

/// The movers that a frame has: [mover, what is known of it then].
function moversIn(frame) {
  return run.movers.map((mover) => [mover, mover.seen[frame - mover.from]]).filter(([, seen]) => seen);
}

/// As in "id 2 (person) 1.1 m/s".
const moverLabel = (mover, [, , , , speed, state]) =>
  `${mover.name} ${state === "moving" ? `${speed.toFixed(1)} m/s` : state}`;

function drawMoverBox(paper, mover, seen, scale) {
  paper.strokeStyle = moverColours[mover.colour];
  paper.lineWidth = 2.5;
  paper.setLineDash(seen[5] === "lost" ? [4, 5] : []);
  paper.strokeRect(...seen.slice(0, 4).map((value) => value * scale));
  paper.setLineDash([]);
}

const labelHeight = 20;

/// The first place from `top` downwards where a label of this width hides none of those that are `taken`: [left, top,
/// width] each.
function freeTop(left, top, wide, taken) {
  const hides = ([otherLeft, otherTop, otherWide]) =>
    left < otherLeft + otherWide && otherLeft < left + wide && Math.abs(top - otherTop) < labelHeight;
  for (let hidden = taken.find(hides); hidden; hidden = taken.find(hides)) top = hidden[1] + labelHeight;
  return top;
}

function drawMoverLabel(paper, mover, seen, scale, taken) {
  const [x, y] = seen.slice(0, 2).map((value) => value * scale);
  paper.font = "600 13px system-ui, sans-serif";
  const text = moverLabel(mover, seen), wide = paper.measureText(text).width + 10;
  const left = Math.max(0, Math.min(x - 1, paper.canvas.clientWidth - wide));
  const top = freeTop(left, Math.max(0, y - labelHeight), wide, taken);
  taken.push([left, top, wide]);
  paper.fillStyle = moverColours[mover.colour];
  paper.fillRect(left, top, wide, labelHeight);
  paper.fillStyle = "#141414";
  paper.fillText(text, left + 5, top + 14.5);
}

function draw() {
  const canvas = byId("drawing"), width = canvas.clientWidth, height = canvas.clientHeight;
  if (!picture || !width) return;
  const density = window.devicePixelRatio || 1, paper = canvas.getContext("2d");
  canvas.width = width * density;
  canvas.height = height * density;
  paper.scale(density, density);
  const scale = width / run.width;
  if (byId("show_boxes").checked) for (const box of picture.boxes) drawBox(paper, box, scale);
  paper.lineWidth = 1.3;
  if (byId("show_features").checked) for (const feature of features) drawFeature(paper, feature, scale);
  if (byId("show_movers").checked) {
    const movers = moversIn(picture.frame), labels = [];
    for (const [mover, seen] of movers) drawMoverBox(paper, mover, seen, scale);
    for (const [mover, seen] of movers) drawMoverLabel(paper, mover, seen, scale, labels);
  }
  if (!pointed) return;
  paper.strokeStyle = "#fff";
  paper.lineWidth = 2;
  paper.beginPath();
  paper.arc(pointed.x * scale, pointed.y * scale, 8, 0, 7);
  paper.stroke();
}

/// Says of the feature under the pointer what was decided, and why.
function pointAt(event) {
  const canvas = byId("drawing"), box = canvas.getBoundingClientRect(), scale = box.width / run.width;
  const x = (event.clientX - box.left) / scale, y = (event.clientY - box.top) / scale;
  let nearest = null, best = 14 / scale;
  for (const feature of features) {
    const distance = Math.hypot(feature.x - x, feature.y - y);
    if (distance < best) { best = distance; nearest = feature; }
  }
  pointed = nearest;
  if (nearest) {
    const [name, meaning] = run.terms.reasons[nearest.reason];
    byId("feature").textContent =
      `Feature at (${nearest.x.toFixed(0)}, ${nearest.y.toFixed(0)}): ${verdicts[nearest.verdict]}, ` +
      `${nearest.kept ? "kept" : "dropped"}; ${name}: ${meaning}.` +
      (nearest.score === null ? " Not scored." : ` Score ${nearest.score.toFixed(2)} (disagreement with being static).`) +
      (nearest.depth > 0 ? ` Depth ${nearest.depth.toFixed(2)} m.` : " No depth.");
  }
  draw();
}

function cell(row, text, name) {
  const element = row.appendChild(document.createElement(name));
  element.textContent = text;
  return element;
}

/// How many features have which reason, the commonest first.
function listReasons() {
  const counts = new Map();
  for (const feature of features) {
    const count = counts.get(feature.reason) || [0, 0];
    ++count[feature.kept ? 0 : 1];
    counts.set(feature.reason, count);
  }
  const body = byId("reasons").tBodies[0];
  body.replaceChildren();
  byId("reasons").caption.textContent = `Why, in frame ${run.frames[picture.frame].number}`;
  for (const [reason, [kept, dropped]] of [...counts].sort((a, b) => b[1][0] + b[1][1] - a[1][0] - a[1][1])) {
    const row = body.insertRow(), head = cell(row, run.terms.reasons[reason][0], "th");
    head.scope = "row";
    cell(head, run.terms.reasons[reason][1], "small");
    for (const count of [kept, dropped]) cell(row, count, "td").className = "n";
  }
}

/// Status and warnings with what they mean, and of which frame the shown image is.
function describe(frame, index, shown) {
  const status = byId("status");
  status.replaceChildren();
  const line = (name, meaning) => {
    cell(status, name, "b");
    status.append(` ${meaning} `);
  };
  status.append(`Frame ${frame.number} (timestamp ${frame.stamp}): ${frame.kept} of ${frame.features} features kept` +
                `${frame.ms > 0 ? `, ${frame.ms.toFixed(1)} ms` : ""}. `);
  line(frame.status, run.terms.statuses[frame.status]);
  for (const warning of frame.warnings) line(warning, run.terms.warnings[warning]);
  const movers = moversIn(index).map(([mover, seen]) => moverLabel(mover, seen));
  if (movers.length) line("Movers:", `${movers.join(", ")}.`);
  if (shown && shown.frame !== index) status.append(`The image is of frame ${run.frames[shown.frame].number}.`);
}

listeners.push((index) => {
  const next = pictureOf(index);
  describe(run.frames[index], index, next);
  if (next === picture || !next) return;
  picture = next;
  features = featuresOf(picture);
  pointed = null;
  byId("picture").src = byId("thumbnail").src = picture.jpeg;
  listReasons();
  draw();
});

byId("picture").addEventListener("load", draw);
byId("drawing").addEventListener("pointermove", pointAt);
byId("drawing").addEventListener("pointerdown", pointAt);
for (const name of ["features", "boxes", "offsets", "movers"]) byId(`show_${name}`).addEventListener("change", draw);
window.addEventListener("resize", draw);
