// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lab/report/canvas.h"
#include "lab/report/chart_legend.h"

namespace plumescout::lab {

struct ChartPoint {
  double x = 0.0;
  double y = 0.0;
};

enum class CurveKind {
  kLine,
  kBound,  // of an interval around another curve: see Chart::y_range
  kDots,   // points that are not joined, as wide as the stroke
};

struct Curve {
  std::string name;  // shown if the chart has several; empty: not shown
  Stroke stroke;
  std::vector<ChartPoint> points;  // a value that is not finite parts the curve
  CurveKind kind = CurveKind::kLine;
};

struct Range {
  double low = 0.0;
  double high = 1.0;
};

struct Chart {
  std::string title;    // with the unit of y
  std::string x_label;  // with the unit of x
  // Curves are cut off at its ends. Default: what the curves need; bounds of intervals widen that
  // by at most its own width to each side, and not below zero if no curve goes there.
  std::optional<Range> y_range;
  std::vector<Curve> curves;
};

// What the legend, which stands in rows below the title, has to say; nothing for one curve.
std::vector<ChartLegendItem> LegendOf(const Chart& chart);

// Draws title, legend, axes with round ticks, and the curves into the box.
void DrawChart(Canvas& canvas, const PixelBox& box, const Chart& chart,
               const std::vector<ChartLegendItem>& legend);
inline void DrawChart(Canvas& canvas, const PixelBox& box, const Chart& chart) {
  DrawChart(canvas, box, chart, LegendOf(chart));
}

}  // namespace plumescout::lab
