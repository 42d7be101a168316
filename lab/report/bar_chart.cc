// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/bar_chart.h"

#include <algorithm>
#include <cmath>

#include "lab/report/chart_frame.h"
#include "lab/report/palette.h"

namespace plumescout::lab {
namespace {

constexpr double kHeadroom = 1.06;
constexpr double kGroupShare = 0.8;  // of the room of a group that its bars fill
constexpr Stroke kReferenceStroke{kSourceColor, 2.5};

// Plot area, and the value at its upper edge.
struct Plot {
  PixelBox area;
  double top_value;

  double PixelY(double value) const { return area.bottom() - value / top_value * area.height; }
};

double Greatest(const BarChart& chart) {
  double greatest = 0.0;
  for (const BarSeries& series : chart.series) {
    for (const Bar& bar : series.bars) {
      for (const double value : {bar.value, bar.high, bar.reference}) {
        if (std::isfinite(value)) greatest = std::max(greatest, value);
      }
    }
  }
  return greatest > 0.0 ? greatest : 1.0;
}

void DrawLine(Canvas& canvas, PixelPoint a, PixelPoint b, const Stroke& stroke) {
  const PixelPoint line[] = {a, b};
  canvas.Polyline(line, stroke);
}

void DrawAxes(Canvas& canvas, const Plot& plot, const BarChart& chart) {
  DrawValueLines(canvas, plot.area, 0.0, plot.top_value,
                 [&](double value) { return plot.PixelY(value); });
  const double step =
      plot.area.width / static_cast<double>(std::max<std::size_t>(1, chart.groups.size()));
  for (std::size_t i = 0; i < chart.groups.size(); ++i) {
    DrawBelowPlot(canvas, plot.area, plot.area.x + (static_cast<double>(i) + 0.5) * step,
                  chart.groups[i]);
  }
}

// `room` is the column of the plot area that belongs to the bar.
void DrawBar(Canvas& canvas, const Plot& plot, const PixelBox& room, const Bar& bar, Rgb color) {
  const double middle = room.x + 0.5 * room.width;
  if (std::isfinite(bar.value)) {
    const double y = plot.PixelY(bar.value);
    constexpr double kGap_px = 1.0;  // between neighbours
    canvas.FillBox({room.x, y, std::max(1.0, room.width - kGap_px), plot.area.bottom() - y}, color);
  }
  if (std::isfinite(bar.low) && std::isfinite(bar.high)) {
    DrawLine(canvas, {middle, plot.PixelY(bar.low)}, {middle, plot.PixelY(bar.high)}, {kInk, 1.2});
  }
  if (std::isfinite(bar.reference)) {
    const double y = plot.PixelY(bar.reference);
    for (const Stroke& stroke : {Stroke{kPaper, 5.0}, kReferenceStroke}) {
      DrawLine(canvas, {room.x, y}, {room.right(), y}, stroke);
    }
  }
}

void DrawBars(Canvas& canvas, const Plot& plot, const BarChart& chart) {
  const double group_px = plot.area.width / static_cast<double>(chart.groups.size());
  const double bar_px = kGroupShare * group_px / static_cast<double>(chart.series.size());
  for (std::size_t s = 0; s < chart.series.size(); ++s) {
    const std::vector<Bar>& bars = chart.series[s].bars;
    for (std::size_t g = 0; g < std::min(bars.size(), chart.groups.size()); ++g) {
      const double left = plot.area.x + static_cast<double>(g) * group_px +
                          0.5 * (1.0 - kGroupShare) * group_px + static_cast<double>(s) * bar_px;
      DrawBar(canvas, plot, {left, plot.area.y, bar_px, plot.area.height}, bars[g],
              chart.series[s].color);
    }
  }
}

}  // namespace

std::vector<ChartLegendItem> LegendOf(const BarChart& chart) {
  std::vector<ChartLegendItem> items;
  for (const BarSeries& series : chart.series) {
    if (series.name.empty()) continue;
    items.push_back({series.name, {series.color}, LegendSample::kSquare});
  }
  if (!chart.reference_name.empty()) items.push_back({chart.reference_name, kReferenceStroke});
  return items;
}

void DrawBarChart(Canvas& canvas, const PixelBox& box, const BarChart& chart,
                  const std::vector<ChartLegendItem>& legend) {
  const Plot plot{DrawChartFrame(canvas, box, chart.title, chart.x_label, legend),
                  kHeadroom * Greatest(chart)};
  DrawAxes(canvas, plot, chart);
  if (!chart.groups.empty() && !chart.series.empty()) DrawBars(canvas, plot, chart);
  DrawFootLine(canvas, plot.area);
}

}  // namespace plumescout::lab
