// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The plots: each marks the moment that is shown, and a click on a moment shows it. svg_plot.hpp drew them.

const numbersOf = (text) => text.split(" ").map(Number);

/// A value of an axis (low, high, pixels of low, pixels of high) in pixels, and back.
const toPixels = ([low, high, from, to], value) => from + (value - low) / (high - low) * (to - from);
const toValue = ([low, high, from, to], pixels) => low + (pixels - from) / (to - from) * (high - low);

/// Where an event is, in the units of the drawing.
function pointIn(svg, event) {
  const box = svg.getBoundingClientRect(), view = svg.viewBox.baseVal;
  return [(event.clientX - box.left) / box.width * view.width, (event.clientY - box.top) / box.height * view.height];
}

function placeMark(mark, position) {
  mark.setAttribute("visibility", position ? "visible" : "hidden");
  if (position) mark.setAttribute("transform", `translate(${position[0].toFixed(1)} ${position[1].toFixed(1)})`);
}

/// Where something was in each frame: a trajectory, or a mover.
const pathsByKey = {...run.paths};
for (const mover of run.movers) {
  const path = pathsByKey[mover.key] = Array(run.frames.length).fill(null);
  mover.path.forEach((point, i) => { path[mover.from + i] = point; });
}

/// The frame whose position on any of the paths is nearest to a place.
function nearestFrame(place, project, paths) {
  let best = Infinity, found = shown;
  for (const points of paths)
    points.forEach((point, frame) => {
      if (!point) return;
      const [x, y] = project(point), distance = Math.hypot(x - place[0], y - place[1]);
      if (distance < best) { best = distance; found = frame; }
    });
  return found;
}

for (const svg of document.querySelectorAll("svg.chart")) {
  const xAxis = numbersOf(svg.dataset.x), yAxis = numbersOf(svg.dataset.y), axes = numbersOf(svg.dataset.axes);
  const isMap = svg.dataset.kind === "map", marks = svg.querySelectorAll(".now");
  const paths = isMap ? [...marks].map((mark) => pathsByKey[mark.dataset.path]) : [];
  const project = (point) => [toPixels(xAxis, point[axes[0]]), toPixels(yAxis, point[axes[1]])];

  listeners.push((frame) => {
    for (const mark of marks) {
      if (!isMap) { placeMark(mark, [toPixels(xAxis, run.frames[frame].t), 0]); continue; }
      const point = pathsByKey[mark.dataset.path][frame];
      placeMark(mark, point ? project(point) : null);
    }
  });

  const choose = (event) => {
    const place = pointIn(svg, event);
    show(isMap ? nearestFrame(place, project, paths) : frameAt(toValue(xAxis, place[0])));
  };
  svg.addEventListener("pointerdown", choose);
  svg.addEventListener("pointermove", (event) => { if (event.buttons & 1) choose(event); });
}
