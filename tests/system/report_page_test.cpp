// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT

// The page of the report in a browser: slider, keys and plots do what they say.

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "run_program.hpp"

namespace system_test::report_page_test {
namespace {

constexpr int kFrames = 6;

/// Does as a user does, and writes what came of it into the page: "name: value" lines.
constexpr char kDriver[] = R"js(
<pre id="found"></pre>
<script>
"use strict";
window.onerror = (message) => { document.getElementById("found").textContent += `error: ${message}\n`; };
window.addEventListener("load", () => setTimeout(() => {
  const found = [], tell = (name, value) => found.push(`${name}: ${value}`);
  const slider = document.getElementById("slider"), now = document.getElementById("now");
  const frame = () => Number(now.textContent.split("frame ")[1]);
  const press = (key, target) =>
    (target || document.body).dispatchEvent(new KeyboardEvent("keydown", {key, bubbles: true, cancelable: true}));
  const click = (element, x, y) => {
    const box = element.getBoundingClientRect();
    const at = {clientX: box.left + x * box.width, clientY: box.top + y * box.height, bubbles: true, pointerId: 1};
    for (const type of ["pointerdown", "pointermove", "pointerup"]) element.dispatchEvent(new PointerEvent(type, at));
    return at;
  };
  const slide = (value) => { slider.value = value; slider.dispatchEvent(new Event("input")); };

  tell("frames", Number(slider.max) + 1);
  tell("picture", document.getElementById("picture").naturalWidth);
  slide(3);
  tell("after slider", frame());
  tell("status", document.getElementById("status").textContent.includes("The frame was judged."));
  tell("reasons", document.querySelectorAll("#reasons tbody tr").length > 0);
  const ink = document.getElementById("drawing").getContext("2d").getImageData(0, 0, 600, 400).data;
  tell("drawn", ink.some((value) => value > 0));

  // A mover of the last frame is drawn, named, and marked on its map.
  slide(Number(slider.max));
  const pixels = () => {
    const canvas = document.getElementById("drawing");
    return canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.join();
  };
  const withMovers = pixels();
  document.getElementById("show_movers").click();
  tell("mover drawn", pixels() !== withMovers);
  document.getElementById("show_movers").click();
  tell("mover named", /id 1 [0-9.]+ m\/s/.test(document.getElementById("status").textContent));
  const trail = document.querySelector('.now[data-path="mover 1"]'), placed = trail.getAttribute("transform");
  slide(Number(slider.max) - 1);
  tell("labels apart", freeTop(10, 5, 90, [[50, 0, 90], [60, 20, 90], [101, 40, 90]]) === 40);
  tell("mover's mark moves", trail.getAttribute("transform") !== placed);

  // Each plot marks the moment: where the last and the first frame are.
  const places = () => [...document.querySelectorAll("svg.chart .now")].map((mark) => mark.getAttribute("transform"));
  slide(0);
  const first = places();
  slide(5);
  tell("plots", document.querySelectorAll("svg.chart").length);
  tell("marks that stay", places().filter((place, i) => place === first[i] && place !== null).length);
  tell("marks hidden", document.querySelectorAll('svg.chart .now[visibility="hidden"]').length);

  press("Home"); tell("Home", frame());
  press("ArrowRight"); press("ArrowRight"); tell("ArrowRight", frame());
  press("ArrowLeft"); tell("ArrowLeft", frame());
  press("End"); tell("End", frame());

  // A click into a plot over time: the left end of the axis is the first frame, the right end the last.
  for (const plot of document.querySelectorAll('svg.chart[data-kind="time"]')) {
    const [, , left, right] = plot.dataset.x.split(" ").map(Number), width = plot.viewBox.baseVal.width;
    slide(2);
    click(plot, right / width, 0.5);
    const last = frame();
    click(plot, left / width, 0.5);
    tell("plot over time", `${last} to ${frame()}`);
  }
  // A click on the mark that a map has for a frame chooses that frame.
  for (const map of document.querySelectorAll('svg.chart[data-kind="map"]')) {
    slide(4);
    const [x, y] = map.querySelector(".now_filtered").getAttribute("transform").match(/[-0-9.]+/g).map(Number);
    slide(0);
    click(map, x / map.viewBox.baseVal.width, y / map.viewBox.baseVal.height);
    tell("map", frame());
  }
  // The turntable turns by dragging and by keys, which then do not move the slider.
  const turntable = document.getElementById("turntable");
  slide(2);
  const box = turntable.getBoundingClientRect();
  const at = (dx) => ({clientX: box.left + 100 + dx, clientY: box.top + 100, bubbles: true, pointerId: 1});
  turntable.dispatchEvent(new PointerEvent("pointerdown", at(0)));
  turntable.dispatchEvent(new PointerEvent("pointermove", at(50)));
  turntable.dispatchEvent(new PointerEvent("pointerup", at(50)));
  tell("turned", turntable.dataset.yaw);
  press("ArrowLeft", turntable);
  tell("turned by key", turntable.dataset.yaw);
  tell("frame meanwhile", frame());

  const moment = document.querySelector(".moments button");
  moment.click();
  tell("moment", frame() === Number(moment.dataset.frame) && moment.getAttribute("aria-pressed") === "true");
  document.getElementById("forth").click();
  document.getElementById("back").click();
  tell("buttons", frame() === Number(moment.dataset.frame));

  // A feature under the pointer says why.
  const drawing = document.getElementById("drawing");
  for (let y = 0.02; y < 1; y += 0.02)
    for (let x = 0.02; x < 1; x += 0.02) {
      if (document.getElementById("feature").textContent.startsWith("Feature at")) break;
      click(drawing, x, y);
    }
  tell("feature", document.getElementById("feature").textContent.startsWith("Feature at"));
  // In a long recording not each frame has an image: whose features these are is said.
  const caption = () => document.getElementById("reasons").caption.textContent;
  const says = () => document.getElementById("status").textContent.includes("The image is of frame");
  slide(4);
  tell("reasons of its own", `${caption() === `Why, in frame ${run.frames[4].number}`} ${says()}`);
  run.pictures.splice(2, 4);
  slide(5);
  tell("reasons of another", `${caption() === `Why, in frame ${run.frames[1].number}`} ${says()}`);
  tell("overflow", document.documentElement.scrollWidth > window.innerWidth);
  document.getElementById("found").textContent += found.join("\n");
}, 200));
</script>
)js";

bool has_browser() { return std::system("command -v chromium > /dev/null 2>&1") == 0; }

/// The page with the driver, after it has run.
std::string driven(const fs::path& page, const TemporaryFolder& folder, const std::string& size) {
  std::string html = read_text(page);
  const std::size_t end = html.rfind("</body>");
  if (end == std::string::npos) return "no </body>";
  html.insert(end, kDriver);
  write_text(folder / "driven.html", html);
  const std::string command =
      "timeout 120 chromium --headless --no-sandbox --disable-gpu --user-data-dir=" + quoted(folder / "profile") +
      " --window-size=" + size + " --virtual-time-budget=5000 --dump-dom file://" + quoted(folder / "driven.html") +
      " > " + quoted(folder / "dom") + " 2> /dev/null";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  const std::string dom = read_text(folder / "dom");
  const std::string head = "<pre id=\"found\">";
  const std::size_t begin = dom.find(head);
  if (begin == std::string::npos) return "nothing found";
  return dom.substr(begin + head.size(), dom.find("</pre>", begin) - begin - head.size());
}

const std::string kAsExpected =
    "frames: 6\n"
    "picture: 640\n"
    "after slider: 3\n"
    "status: true\n"
    "reasons: true\n"
    "drawn: true\n"
    "mover drawn: true\n"
    "mover named: true\n"
    "labels apart: true\n"
    "mover's mark moves: true\n"
    "plots: 9\n"
    "marks that stay: 0\n"
    "marks hidden: 0\n"
    "Home: 0\n"
    "ArrowRight: 2\n"
    "ArrowLeft: 1\n"
    "End: 5\n"
    "plot over time: 5 to 0\n"
    "plot over time: 5 to 0\n"
    "plot over time: 5 to 0\n"
    "plot over time: 5 to 0\n"
    "plot over time: 5 to 0\n"
    "plot over time: 5 to 0\n"
    "map: 4\n"
    "map: 4\n"
    "map: 4\n"
    "turned: 0.100\n"
    "turned by key: 0.200\n"
    "frame meanwhile: 2\n"
    "moment: true\n"
    "buttons: true\n"
    "feature: true\n"
    "reasons of its own: true false\n"
    "reasons of another: true true\n"
    "overflow: false";

TEST(ReportPage, SliderKeysAndPlotsShowTheMoment) {
  if (!has_browser()) GTEST_SKIP() << "no browser (Debian: chromium)";
  const TemporaryFolder folder;
  ASSERT_EQ(
      run_program("--demo --quiet --frames " + std::to_string(kFrames) + " --out " + quoted(folder / "out")).status, 0);
  for (const char* size : {"1280,900", "390,844"})
    EXPECT_EQ(driven(folder / "out" / "report.html", folder, size), kAsExpected) << size;
}

}  // namespace
}  // namespace system_test::report_page_test
