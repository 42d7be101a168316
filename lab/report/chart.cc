// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/chart.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lab/report/chart_frame.h"
#include "lab/report/palette.h"
#include "lab/report/ticks.h"

namespace plumescout::lab {
namespace {

constexpr int kTicks_x = 6;
constexpr double kHeadroom = 0.06;  // of the range, above and below the curves

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Range kNowhere{kInfinity, -kInfinity};

bool IsEmpty(const Range& range) { return range.low > range.high; }

// Adds the finite points of a curve to the range along one axis.
void Include(const Curve& curve, double ChartPoint::*axis, Range& range) {
  for (const ChartPoint& point : curve.points) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) continue;
    range.low = std::min(range.low, point.*axis);
    range.high = std::max(range.high, point.*axis);
  }
}

// [0, 1] if there are no finite points.
Range RangeOfX(const Chart& chart) {
  Range range = kNowhere;
  for (const Curve& curve : chart.curves) Include(curve, &ChartPoint::x, range);
  return IsEmpty(range) ? Range{} : range;
}

// As the default of Chart::y_range says; [0, 1] if there are no finite points. The intervals of few
// trials are so wide that a range with all of them would show nothing else.
Range RangeOfY(const Chart& chart) {
  Range curves = kNowhere;
  Range bounds = kNowhere;
  for (const Curve& curve : chart.curves) {
    Include(curve, &ChartPoint::y, curve.kind == CurveKind::kBound ? bounds : curves);
  }
  if (IsEmpty(curves)) curves = bounds;
  if (IsEmpty(curves)) return Range{};
  if (IsEmpty(bounds)) return curves;
  constexpr double kLeastReach = 0.1;  // of the values: intervals of a level curve show
  const double magnitude = std::max(std::abs(curves.low), std::abs(curves.high));
  const double reach = std::max(curves.high - curves.low, kLeastReach * magnitude);
  const double lowest = curves.low >= 0.0 ? 0.0 : -kInfinity;
  return {std::max({std::min(curves.low, bounds.low), curves.low - reach, lowest}),
          std::min(std::max(curves.high, bounds.high), curves.high + reach)};
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
  PixelBox area;
  Range x;
  Range y;

  double PixelX(double value) const {
    return area.x + (value - x.low) / (x.high - x.low) * area.width;
  }
  double PixelY(double value) const {
    return area.bottom() - (value - y.low) / (y.high - y.low) * area.height;
  }
};

void DrawAxes(Canvas& canvas, const Plot& plot) {
  DrawValueLines(canvas, plot.area, plot.y.low, plot.y.high,
                 [&](double value) { return plot.PixelY(value); });
  for (const double value : LinearTicks(plot.x.low, plot.x.high, kTicks_x)) {
    const double x = plot.PixelX(value);
    const PixelPoint tick[] = {{x, plot.area.bottom()}, {x, plot.area.bottom() + 4.0}};
    canvas.Polyline(tick, {kFrame, 1.0});
    DrawBelowPlot(canvas, plot.area, x, TickLabel(value));
  }
  DrawFootLine(canvas, plot.area);
}

struct Segment {
  PixelPoint from;
  PixelPoint to;
};

// What of the segment lies in the box; nothing if an end is not finite. The edges of the box cut
// the line at shares of its length (Liang and Barsky).
std::optional<Segment> ClipSegment(const Segment& segment, const PixelBox& box) {
  const PixelPoint a = segment.from;
  const PixelPoint b = segment.to;
  double first = 0.0;
  double last = 1.0;
  const auto cut = [&](double start, double end, double low, double high) {
    const double step = end - start;
    if (!std::isfinite(step)) return false;
    if (step == 0.0) return start >= low && start <= high;
    first = std::max(first, std::min((low - start) / step, (high - start) / step));
    last = std::min(last, std::max((low - start) / step, (high - start) / step));
    return first <= last;
  };
  if (!cut(a.x, b.x, box.x, box.right()) || !cut(a.y, b.y, box.y, box.bottom())) {
    return std::nullopt;
  }
  const auto at = [&](double share) {
    return PixelPoint{a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
  };
  return Segment{first > 0.0 ? at(first) : a, last < 1.0 ? at(last) : b};
}

// The parts of the line in the box, parted by a point that is not finite.
std::vector<PixelPoint> ClipLine(const std::vector<PixelPoint>& line, const PixelBox& box) {
  std::vector<PixelPoint> clipped;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const std::optional<Segment> part = ClipSegment({line[i], line[i + 1]}, box);
    if (!part) continue;
    const bool goes_on =
        !clipped.empty() && clipped.back().x == part->from.x && clipped.back().y == part->from.y;
    if (!goes_on) {
      if (!clipped.empty()) clipped.push_back({kInfinity, kInfinity});
      clipped.push_back(part->from);
    }
    clipped.push_back(part->to);
  }
  return clipped;
}

void DrawCurve(Canvas& canvas, const Plot& plot, const Curve& curve) {
  constexpr double kSlack_px = 1.0;  // what lies along an edge is seen, whatever the rounding
  const PixelBox area{plot.area.x - kSlack_px, plot.area.y - kSlack_px,
                      plot.area.width + 2.0 * kSlack_px, plot.area.height + 2.0 * kSlack_px};
  std::vector<PixelPoint> line;
  for (const ChartPoint& point : curve.points) {
    line.push_back({plot.PixelX(point.x), plot.PixelY(point.y)});
  }
  if (curve.kind != CurveKind::kDots) {
    canvas.Polyline(ClipLine(line, area), curve.stroke);
    return;
  }
  for (const PixelPoint& point : line) {
    if (!ClipSegment({point, point}, area)) continue;
    canvas.Disc(point, 0.5 * curve.stroke.width_px, curve.stroke.color);
  }
}

}  // namespace

std::vector<ChartLegendItem> LegendOf(const Chart& chart) {
  std::vector<ChartLegendItem> items;
  if (chart.curves.size() < 2) return items;
  for (const Curve& curve : chart.curves) {
    if (curve.name.empty()) continue;
    const bool dots = curve.kind == CurveKind::kDots;
    items.push_back({curve.name, curve.stroke, dots ? LegendSample::kDot : LegendSample::kLine});
  }
  return items;
}

void DrawChart(Canvas& canvas, const PixelBox& box, const Chart& chart,
               const std::vector<ChartLegendItem>& legend) {
  const Plot plot{DrawChartFrame(canvas, box, chart.title, chart.x_label, legend),
                  Widen(RangeOfX(chart)),
                  chart.y_range.value_or(WithHeadroom(Widen(RangeOfY(chart))))};
  DrawAxes(canvas, plot);
  for (const Curve& curve : chart.curves) DrawCurve(canvas, plot, curve);
}

}  // namespace plumescout::lab
