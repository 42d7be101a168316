// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "lab/report/canvas.h"
#include "lab/report/chart_legend.h"
#include "lab/report/image.h"

namespace plumescout::lab {

// A value with its interval and what others have found; what is not finite is not shown.
struct Bar {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  double value = kNone;
  double low = kNone;
  double high = kNone;
  double reference = kNone;
};

struct BarSeries {
  std::string name;  // empty: not in the legend
  Rgb color;
  std::vector<Bar> bars;  // one for each group
};

// Groups of bars, side by side, all from zero upwards. Values, intervals and references >= 0.
struct BarChart {
  std::string title;                // with the unit
  std::string x_label;              // what the groups are
  std::vector<std::string> groups;  // their names, short
  std::vector<BarSeries> series;
  std::string reference_name;  // of the marks, if there are any
};

// What the legend, which stands in rows below the title, has to say.
std::vector<ChartLegendItem> LegendOf(const BarChart& chart);

// Draws title, legend, axes and bars into the box.
void DrawBarChart(Canvas& canvas, const PixelBox& box, const BarChart& chart,
                  const std::vector<ChartLegendItem>& legend);
inline void DrawBarChart(Canvas& canvas, const PixelBox& box, const BarChart& chart) {
  DrawBarChart(canvas, box, chart, LegendOf(chart));
}

}  // namespace plumescout::lab
