// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/chart.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lab/report/palette.h"
#include "lab/report/ticks.h"

namespace plumescout::lab {
namespace {

constexpr double kTitleSize_px = 16.0;
constexpr double kLabelSize_px = 12.0;
constexpr double kTop_px = 34.0;     // for the title
constexpr double kLeft_px = 52.0;    // for the labels of y
constexpr double kBottom_px = 40.0;  // for the labels of x
constexpr double kRight_px = 10.0;
constexpr int kTicks_x = 4;
constexpr int kTicks_y = 4;
constexpr double kHeadroom = 0.06;  // of the range, above and below the curves

double ChartPoint::*const kAxisX = &ChartPoint::x;
double ChartPoint::*const kAxisY = &ChartPoint::y;

// Range of all finite values along one axis; [0, 1] if there are none.
Range RangeOf(const Chart& chart, double ChartPoint::*axis) {
  Range range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const Curve& curve : chart.curves) {
    for (const ChartPoint& point : curve.points) {
      if (!std::isfinite(point.x) || !std::isfinite(point.y)) continue;
      range.low = std::min(range.low, point.*axis);
      range.high = std::max(range.high, point.*axis);
    }
  }
  return range.low <= range.high ? range : Range{};
}

// A range that can be divided: not empty, and wide enough for its numbers to differ in print.
Range Widen(Range range) {
  const double magnitude = std::max(std::abs(range.low), std::abs(range.high));
  const double least = magnitude > 0.0 ? 1e-6 * magnitude : 1.0;
  if (range.high - range.low < least) range.high = range.low + least;
  return range;
}

Range WithHeadroom(Range range) {
  const double room = kHeadroom * (range.high - range.low);
  // A quantity that is never negative keeps its zero line.
  const bool from_zero = range.low >= 0.0 && range.low <= 0.5 * range.high;
  return {from_zero ? 0.0 : range.low - room, range.high + room};
}

// Plot area and what its edges stand for.
struct Plot {
  Box area;
  Range x;
  Range y;

  double PixelX(double value) const {
    return area.x + (value - x.low) / (x.high - x.low) * area.width;
  }
  double PixelY(double value) const {
    return area.bottom() - (value - y.low) / (y.high - y.low) * area.height;
  }
};

void DrawAxes(Canvas& canvas, const Plot& plot, const std::string& x_label) {
  const Stroke grid{kGridLine, 1.0};
  for (const double value : LinearTicks(plot.y.low, plot.y.high, kTicks_y)) {
    const double y = plot.PixelY(value);
    const PixelPoint line[] = {{plot.area.x, y}, {plot.area.right(), y}};
    canvas.Polyline(line, grid);
    canvas.Text({plot.area.x - 8.0, y + 4.0}, TickLabel(value),
                {kLabelSize_px, kFaintInk, Anchor::kEnd});
  }
  for (const double value : LinearTicks(plot.x.low, plot.x.high, kTicks_x)) {
    const double x = plot.PixelX(value);
    const PixelPoint tick[] = {{x, plot.area.bottom()}, {x, plot.area.bottom() + 4.0}};
    canvas.Polyline(tick, {kFrame, 1.0});
    canvas.Text({x, plot.area.bottom() + 18.0}, TickLabel(value),
                {kLabelSize_px, kFaintInk, Anchor::kMiddle});
  }
  const PixelPoint axis[] = {{plot.area.x, plot.area.bottom()},
                             {plot.area.right(), plot.area.bottom()}};
  canvas.Polyline(axis, {kFrame, 1.0});
  canvas.Text({plot.area.x + 0.5 * plot.area.width, plot.area.bottom() + 36.0}, x_label,
              {kLabelSize_px, kFaintInk, Anchor::kMiddle});
}

void DrawCurve(Canvas& canvas, const Plot& plot, const Curve& curve) {
  std::vector<PixelPoint> line;
  for (const ChartPoint& point : curve.points) {
    line.push_back({plot.PixelX(point.x), plot.PixelY(point.y)});
  }
  canvas.Polyline(line, curve.stroke);
}

// Names of the curves side by side, right of the title: no curve runs through them there.
void DrawLegend(Canvas& canvas, const Box& box, const std::vector<Curve>& curves) {
  constexpr double kSlot_px = 104.0;  // a sample and a name of a dozen letters
  constexpr double kSample_px = 26.0;
  const double y = box.y + kTitleSize_px;
  const auto named = std::count_if(curves.begin(), curves.end(),
                                   [](const Curve& curve) { return !curve.name.empty(); });
  double x = box.right() - kRight_px - kSlot_px * static_cast<double>(named);
  for (const Curve& curve : curves) {
    if (curve.name.empty()) continue;
    const PixelPoint sample[] = {{x, y - 4.0}, {x + kSample_px, y - 4.0}};
    canvas.Polyline(sample, curve.stroke);
    canvas.Text({x + kSample_px + 8.0, y}, curve.name, {kLabelSize_px, kInk, Anchor::kStart});
    x += kSlot_px;
  }
}

}  // namespace

void DrawChart(Canvas& canvas, const Box& box, const Chart& chart) {
  const Plot plot{{box.x + kLeft_px, box.y + kTop_px, box.width - kLeft_px - kRight_px,
                   box.height - kTop_px - kBottom_px},
                  Widen(RangeOf(chart, kAxisX)),
                  chart.y_range.value_or(WithHeadroom(Widen(RangeOf(chart, kAxisY))))};
  canvas.Text({box.x, box.y + kTitleSize_px}, chart.title,
              {kTitleSize_px, kInk, Anchor::kStart, true});
  DrawAxes(canvas, plot, chart.x_label);
  for (const Curve& curve : chart.curves) DrawCurve(canvas, plot, curve);
  if (chart.curves.size() > 1) DrawLegend(canvas, box, chart.curves);
}

}  // namespace plumescout::lab
