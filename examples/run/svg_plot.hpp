// SPDX-FileCopyrightText: 2026 The stillpoint authors
// SPDX-License-Identifier: MIT
#pragma once

// Line plots as SVG. Colours and dashes are the page's (CSS classes), so that they follow its light and dark scheme.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

#include "html.hpp"
#include "stillpoint/core/geometry.hpp"
#include "stillpoint/io/number_format.hpp"

namespace stillpoint_run {

/// A line through points; a point that is not finite breaks it.
struct Line {
  std::string name;       ///< in the legend
  std::string css_class;  ///< of report.css: colour and dash
  std::vector<stillpoint::Vector2d> points;
  std::string key = {};    ///< of a path in the page's data: a map marks where it is at the moment; empty: no mark
  std::string label = {};  ///< beside the last point
};

/// Something of note over a stretch of x, drawn in a strip of its own.
struct Mark {
  std::string css_class;  ///< also chooses the shape: mark0 to mark3
  double x_begin = 0.0, x_end = 0.0;
};

/// A mark in the legend.
struct MarkName {
  std::string css_class, name, meaning;
};

/// One plot. Lines in front are drawn last.
struct Plot {
  std::string title;             ///< above it, and the name a screen reader says
  std::string description;       ///< what a screen reader says further
  std::string x_label, y_label;  ///< with units
  std::vector<Line> lines;
  std::vector<Mark> marks;
  std::vector<MarkName> mark_names;
  bool is_stacked = false;               ///< lines are heights of areas, one upon the other
  bool is_map = false;                   ///< a metre is as long in both directions; else x is time, and y begins at 0
  std::array<int, 2> map_axes = {0, 1};  ///< of a map: which of right (0), ahead (1), up (2) are x and y
  double y_at_least = 0.0;               ///< the y axis reaches at least here
};

namespace detail {

struct Axis {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();

  void include(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  void settle() {
    if (!(low <= high)) low = 0.0, high = 1.0;
    if (!(high - low > 1e-9)) high = low + (std::abs(low) > 1e-9 ? std::abs(low) : 1.0);
  }
};

/// A step of 1, 2 or 5 times a power of ten that gives about `count` of them.
inline double tick_step(double range, int count) {
  const double rough = range / count, power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= rough) return factor * power;
  return 10 * power;
}

inline std::string number(double value) { return stillpoint::format_fixed(value, 1); }

/// A shape for each kind of mark: not told by colour alone.
inline std::string mark_shape(const std::string& css_class, double x, double y) {
  const std::string at = " transform=\"translate(" + number(x) + ',' + number(y) + ")\"/>";
  const char* path = css_class == "mark0"   ? "M0-5 5 5-5 5Z"                       // triangle
                     : css_class == "mark1" ? "M0-5 5 0 0 5-5 0Z"                   // diamond
                     : css_class == "mark2" ? "M-4-4h8v8h-8Z"                       // square
                                            : "M-5-2h3v-3h4v3h3v4h-3v3h-4v-3h-3Z";  // cross
  return "<path class=\"" + css_class + "\" d=\"" + path + '"' + at;
}

/// Draws one plot into a picture of fixed inner size, which the page scales.
class PlotDrawing {
 public:
  explicit PlotDrawing(const Plot& plot) : plot_(plot), heights_(stack(plot)) {
    for (const Line& line : heights_)
      for (const stillpoint::Vector2d& point : line.points) {
        x_.include(point.x());  // a gap, too: plots over the same time look alike
        y_.include(point.y());
      }
    for (const Mark& mark : plot.marks) {
      x_.include(mark.x_begin);
      x_.include(mark.x_end);
    }
    if (!plot.is_map) y_.include(0.0);
    if (plot.y_at_least > 0) y_.include(plot.y_at_least);
    x_.settle();
    y_.settle();
    if (plot.is_map)
      equalise();
    else
      y_.high += y_.high > plot.y_at_least ? 0.05 * (y_.high - y_.low) : 0.0;
    if (!plot.marks.empty()) bottom_ -= kStrip;
  }

  std::string svg() const {
    std::string out = "<svg class=\"chart\" viewBox=\"0 0 " + number(kWidth) + ' ' + number(kHeight) + "\"" + scales() +
                      " role=\"img\" aria-label=\"" + escaped(plot_.title + ". " + plot_.description) + "\">";
    draw_grid(out);
    for (std::size_t i = 0; i < heights_.size(); ++i)
      plot_.is_stacked ? draw_area(out, i) : draw_line(out, heights_[i]);
    draw_marks(out);
    draw_now(out);
    for (const Line& line : heights_) draw_label(out, line);  // last: above lines and moments
    return out + "</svg>";
  }

 private:
  static constexpr double kWidth = 520, kHeight = 320, kLeft = 54, kRight = 506, kTop = 36, kStrip = 18;

  double x_at(double x) const { return kLeft + (x - x_.low) / (x_.high - x_.low) * (kRight - kLeft); }
  double y_at(double y) const { return bottom_ - (y - y_.low) / (y_.high - y_.low) * (bottom_ - kTop); }

  /// For the page's script: from pixels to values and back.
  std::string scales() const {
    const auto list = [](std::initializer_list<double> values) {
      std::string text;
      for (const double value : values) text += (text.empty() ? "" : " ") + stillpoint::format_fixed(value, 5);
      return text;
    };
    return std::string(" data-kind=\"") + (plot_.is_map ? "map" : "time") + "\" data-x=\"" +
           list({x_.low, x_.high, kLeft, kRight}) + "\" data-y=\"" + list({y_.low, y_.high, bottom_, kTop}) +
           "\" data-axes=\"" + std::to_string(plot_.map_axes[0]) + ' ' + std::to_string(plot_.map_axes[1]) + "\"";
  }

  /// The moment that the page shows: the script moves it.
  void draw_now(std::string& out) const {
    if (!plot_.is_map) {
      out += "<path class=\"now\" visibility=\"hidden\" d=\"M0 " + number(kTop) + 'V' + number(bottom_) + "\"/>";
      return;
    }
    for (const Line& line : plot_.lines)
      if (!line.key.empty())
        out += "<circle class=\"now now_" + line.css_class + "\" data-path=\"" + escaped(line.key) +
               "\" visibility=\"hidden\" r=\"5.5\"/>";
  }

  /// Heights as they are drawn: of a stack, the sums.
  static std::vector<Line> stack(const Plot& plot) {
    std::vector<Line> lines = plot.lines;
    if (plot.is_stacked)
      for (std::size_t i = 1; i < lines.size(); ++i)
        for (std::size_t k = 0; k < lines[i].points.size(); ++k) lines[i].points[k].y() += lines[i - 1].points[k].y();
    return lines;
  }

  /// Widens the axis that has room to spare, and gives both a rim.
  void equalise() {
    const double per_pixel =
        1.08 * std::max((x_.high - x_.low) / (kRight - kLeft), (y_.high - y_.low) / (bottom_ - kTop));
    const auto widen = [per_pixel](Axis& axis, double pixels) {
      const double centre = 0.5 * (axis.low + axis.high), half = 0.5 * per_pixel * pixels;
      axis.low = centre - half;
      axis.high = centre + half;
    };
    widen(x_, kRight - kLeft);
    widen(y_, bottom_ - kTop);
  }

  void draw_grid(std::string& out) const {
    const auto ticks = [](const Axis& axis, int count, auto&& draw) {
      const double step = tick_step(axis.high - axis.low, count);
      const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
      for (double k = std::ceil(axis.low / step - 1e-9); k * step <= axis.high + 1e-9 * step; ++k)
        draw(k * step, stillpoint::format_fixed(k == 0 ? 0.0 : k * step, decimals));
    };
    const double floor = plot_.marks.empty() ? bottom_ : bottom_ + kStrip;
    ticks(y_, 5, [&](double value, const std::string& text) {
      const std::string y = number(y_at(value));
      out += "<path class=\"grid\" d=\"M" + number(kLeft) + ' ' + y + 'H' + number(kRight) + "\"/><text x=\"" +
             number(kLeft - 6) + "\" y=\"" + number(y_at(value) + 5) + "\" text-anchor=\"end\">" + text + "</text>";
    });
    ticks(x_, 6, [&](double value, const std::string& text) {
      const std::string x = number(x_at(value));
      out += "<path class=\"grid\" d=\"M" + x + ' ' + number(kTop) + 'V' + number(bottom_) + "\"/><text x=\"" + x +
             "\" y=\"" + number(floor + 18) + "\" text-anchor=\"middle\">" + text + "</text>";
    });
    out += "<text x=\"" + number(2) + "\" y=\"" + number(kTop - 20) + "\">" + escaped(plot_.y_label) + "</text>" +
           "<text x=\"" + number(kRight) + "\" y=\"" + number(floor + 37) + "\" text-anchor=\"end\">" +
           escaped(plot_.x_label) + "</text>";
  }

  void draw_line(std::string& out, const Line& line) const {
    std::string path;
    bool pen_is_down = false;
    for (const stillpoint::Vector2d& point : line.points) {
      if (point.allFinite()) {
        path += (pen_is_down ? 'L' : 'M') + number(x_at(point.x())) + ' ' + number(y_at(point.y()));
        if (!pen_is_down) path += "h0";  // a lone point shows as a dot
      }
      pen_is_down = point.allFinite();
    }
    if (!path.empty()) out += "<path class=\"line " + line.css_class + "\" d=\"" + path + "\"/>";
  }

  void draw_label(std::string& out, const Line& line) const {
    const auto last =
        std::find_if(line.points.rbegin(), line.points.rend(), [](const auto& p) { return p.allFinite(); });
    if (!line.label.empty() && last != line.points.rend())
      out += "<text class=\"at_end\" x=\"" + number(std::min(x_at(last->x()) + 6, kRight - 14)) + "\" y=\"" +
             number(std::max(y_at(last->y()) - 6, kTop + 14)) + "\">" + escaped(line.label) + "</text>";
  }

  void draw_area(std::string& out, std::size_t i) const {
    const std::vector<stillpoint::Vector2d>& upper = heights_[i].points;
    if (upper.empty()) return;
    std::string path;
    for (const stillpoint::Vector2d& point : upper)
      path += (path.empty() ? 'M' : 'L') + number(x_at(point.x())) + ' ' + number(y_at(point.y()));
    for (std::size_t k = upper.size(); k-- > 0;)
      path += 'L' + number(x_at(upper[k].x())) + ' ' + number(y_at(i > 0 ? heights_[i - 1].points[k].y() : 0.0));
    out += "<path class=\"area " + heights_[i].css_class + "\" d=\"" + path + "Z\"/>";
  }

  void draw_marks(std::string& out) const {
    const double y = bottom_ + 0.5 * kStrip;
    for (const Mark& mark : plot_.marks) {
      if (mark.x_end > mark.x_begin)
        out += "<path class=\"line " + mark.css_class + "\" d=\"M" + number(x_at(mark.x_begin)) + ' ' + number(y) +
               'H' + number(x_at(mark.x_end)) + "\"/>";
      out += mark_shape(mark.css_class, x_at(mark.x_begin), y);
    }
  }

  const Plot& plot_;
  std::vector<Line> heights_;
  Axis x_, y_;
  double bottom_ = 276;
};

}  // namespace detail

/// The plot with its title, legend and caption as an HTML figure.
inline std::string figure_of(const Plot& plot) {
  std::string legend;
  const auto entry = [&legend](const std::string& picture, const std::string& name, const std::string& meaning) {
    legend += "<li><svg viewBox=\"0 0 30 14\" aria-hidden=\"true\">" + picture + "</svg><span>" + escaped(name) +
              (meaning.empty() ? "" : "<small>" + escaped(meaning) + "</small>") + "</span></li>";
  };
  for (const Line& line : plot.lines)
    entry(plot.is_stacked ? "<path class=\"area " + line.css_class + "\" d=\"M4 0h22v14h-22Z\"/>"
                          : "<path class=\"line " + line.css_class + "\" d=\"M1 7h28\"/>",
          line.name, "");
  for (const MarkName& mark : plot.mark_names)
    entry(detail::mark_shape(mark.css_class, 15, 7), mark.name, mark.meaning);
  return "<figure class=\"plot\"><h3>" + escaped(plot.title) + "</h3>" + detail::PlotDrawing(plot).svg() +
         "<ul class=\"legend\">" + legend + "</ul><figcaption>" + escaped(plot.description) +
         "</figcaption></figure>\n";
}

}  // namespace stillpoint_run
