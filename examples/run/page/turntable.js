// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The trajectories in 3D, seen from a camera without perspective that goes around them.

const turntable = byId("turntable");

function makeTurntable(canvas) {
  const points = Object.values(run.paths).flat().filter((point) => point);
  // Not Math.min(...all): a call takes some 120 000 arguments, half an hour of poses has more.
  const extreme = (choose, axis) => points.reduce((best, point) => choose(best, point[axis]), choose());
  const low = [0, 1, 2].map((axis) => extreme(Math.min, axis)), high = [0, 1, 2].map((axis) => extreme(Math.max, axis));
  const centre = low.map((value, axis) => (value + high[axis]) / 2);
  const size = Math.max(Math.hypot(...low.map((value, axis) => high[axis] - value)), 0.1);
  let yaw = 0.6, pitch = 0.5, zoom = 1, pressed = null;

  /// To pixels; `depth` grows away from the viewer.
  function project(point) {
    const [right, ahead, up] = point.map((value, axis) => value - centre[axis]);
    const x = right * Math.cos(yaw) - ahead * Math.sin(yaw), away = right * Math.sin(yaw) + ahead * Math.cos(yaw);
    const y = up * Math.cos(pitch) + away * Math.sin(pitch);
    const scale = 0.85 * zoom * Math.min(canvas.clientWidth, canvas.clientHeight) / size;
    return [canvas.clientWidth / 2 + scale * x, canvas.clientHeight / 2 - scale * y];
  }

  function line(paper, from, to) {
    paper.moveTo(...project(from));
    paper.lineTo(...project(to));
  }

  /// Squares of one metre, or of a tenth or ten where that would be too few or too many.
  function drawGrid(paper, colour) {
    const step = size < 1 ? 0.1 : size < 30 ? 1 : 10;
    const begin = [0, 1].map((axis) => Math.floor(low[axis] / step) * step);
    const end = [0, 1].map((axis) => Math.ceil(high[axis] / step + 1e-9) * step);
    paper.strokeStyle = colour("--rule");
    paper.lineWidth = 1;
    paper.beginPath();
    for (let x = begin[0]; x <= end[0] + 1e-9; x += step) line(paper, [x, begin[1], 0], [x, end[1], 0]);
    for (let y = begin[1]; y <= end[1] + 1e-9; y += step) line(paper, [begin[0], y, 0], [end[0], y, 0]);
    paper.stroke();
    paper.fillStyle = colour("--soft");
    paper.font = "13px system-ui, sans-serif";
    paper.fillText(`grid: ${step} m`, 8, canvas.clientHeight - 8);
  }

  function drawTurntable() {
    const width = canvas.clientWidth, height = canvas.clientHeight;
    if (!width) return;
    const density = window.devicePixelRatio || 1, paper = canvas.getContext("2d");
    canvas.width = width * density;
    canvas.height = height * density;
    paper.scale(density, density);
    const style = getComputedStyle(document.documentElement), colour = (name) => style.getPropertyValue(name);
    drawGrid(paper, colour);
    const looks = {unfiltered: ["--orange", [7, 4], 2.2], filtered: ["--blue", [], 2.2], truth: ["--ink", [1, 4], 1.8]};
    for (const [name, path] of Object.entries(run.paths)) {
      const [shade, dashes, thickness] = looks[name];
      paper.strokeStyle = paper.fillStyle = colour(shade);
      paper.lineWidth = thickness;
      paper.setLineDash(dashes);
      paper.beginPath();
      let isDown = false;
      for (const point of path) {
        if (point) isDown ? paper.lineTo(...project(point)) : paper.moveTo(...project(point));
        isDown = point !== null;
      }
      paper.stroke();
      paper.setLineDash([]);
      if (!path[shown]) continue;
      paper.beginPath();
      paper.arc(...project(path[shown]), 5.5, 0, 7);
      paper.fill();
    }
  }

  function turn(right, up) {
    yaw += right;
    pitch = Math.max(-1.5708, Math.min(1.5708, pitch + up));
    canvas.dataset.yaw = yaw.toFixed(3);
    drawTurntable();
  }
  function zoomBy(factor) {
    zoom = Math.max(0.2, Math.min(20, zoom * factor));
    drawTurntable();
  }

  canvas.addEventListener("pointerdown", (event) => {
    pressed = {x: event.clientX, y: event.clientY, moved: 0};
    if (event.isTrusted) canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!pressed) return;
    const dx = event.clientX - pressed.x, dy = event.clientY - pressed.y;
    pressed = {x: event.clientX, y: event.clientY, moved: pressed.moved + Math.hypot(dx, dy)};
    turn(-0.01 * dx, 0.01 * dy);
  });
  canvas.addEventListener("pointerup", (event) => {
    const box = canvas.getBoundingClientRect();
    if (pressed && pressed.moved < 4) show(nearestFrame([event.clientX - box.left, event.clientY - box.top], project,
                                                            Object.values(run.paths)));
    pressed = null;
  });
  canvas.addEventListener("pointercancel", () => { pressed = null; });
  canvas.addEventListener("wheel", (event) => {
    if (!event.ctrlKey) return;  // else one could not scroll past it
    event.preventDefault();
    zoomBy(Math.exp(-0.002 * event.deltaY));
  }, {passive: false});
  canvas.addEventListener("keydown", (event) => {
    const turns = {ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1]};
    if (turns[event.key]) turn(...turns[event.key]);
    else if (event.key === "+") zoomBy(1.2);
    else if (event.key === "-") zoomBy(1 / 1.2);
    else return;
    event.preventDefault();
    event.stopPropagation();
  });
  listeners.push(drawTurntable);
  window.addEventListener("resize", drawTurntable);
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", drawTurntable);
}

if (turntable) makeTurntable(turntable);
