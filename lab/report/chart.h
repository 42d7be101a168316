// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lab/report/canvas.h"

namespace plumescout::lab {

struct ChartPoint {
  double x = 0.0;
  double y = 0.0;
};

struct Curve {
  std::string name;  // shown if the chart has several; empty: not shown
  Stroke stroke;
  std::vector<ChartPoint> points;  // a value that is not finite parts the curve
};

struct Range {
  double low = 0.0;
  double high = 1.0;
};

struct Chart {
  std::string title;             // with the unit of y
  std::string x_label;           // with the unit of x
  std::optional<Range> y_range;  // default: what the curves need
  std::vector<Curve> curves;
};

// Draws title, axes with round ticks, and the curves into the box.
void DrawChart(Canvas& canvas, const Box& box, const Chart& chart);

}  // namespace plumescout::lab
