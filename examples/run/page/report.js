// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// Slider, buttons and keys: what chooses the moment.

const slider = byId("slider");
slider.max = run.frames.length - 1;
slider.addEventListener("input", () => show(Number(slider.value)));
listeners.push((frame) => {
  slider.value = frame;
  byId("now").textContent = `${run.frames[frame].t.toFixed(2)} s, frame ${run.frames[frame].number}`;
  for (const button of document.querySelectorAll(".moments button"))
    button.setAttribute("aria-pressed", String(Number(button.dataset.frame) === frame));
});

let timer = 0;
function play(wanted) {
  clearTimeout(timer);
  timer = 0;
  byId("play").textContent = wanted ? "pause" : "play";
  if (!wanted) return;
  if (shown === run.frames.length - 1) show(0);
  const step = () => {
    if (shown === run.frames.length - 1) return play(false);
    const seconds = run.frames[shown + 1].t - run.frames[shown].t;
    timer = setTimeout(() => { show(shown + 1); step(); }, Math.max(20, Math.min(1000, 1000 * seconds)));
  };
  step();
}

byId("play").addEventListener("click", () => play(timer === 0));
byId("back").addEventListener("click", () => show(shown - 1));
byId("forth").addEventListener("click", () => show(shown + 1));
for (const button of document.querySelectorAll(".moments button"))
  button.addEventListener("click", () => show(Number(button.dataset.frame)));

document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const step = event.shiftKey ? 10 : 1, onButton = event.target.tagName === "BUTTON" || event.target.type === "checkbox";
  const moves = {ArrowLeft: shown - step, ArrowRight: shown + step, Home: 0, End: run.frames.length - 1};
  if (event.key in moves) show(moves[event.key]);
  else if (event.key === " " && !onButton) play(timer === 0);
  else return;
  event.preventDefault();
});

// First the frame of which most was dropped: it says most.
const dropped = (frame) => frame.features - frame.kept;
show(run.frames.reduce((best, frame, index) => dropped(frame) > dropped(run.frames[best]) ? index : best, 0));
