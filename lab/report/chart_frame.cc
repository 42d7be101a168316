// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/chart_frame.h"

#include "lab/report/font.h"
#include "lab/report/palette.h"
#include "lab/report/ticks.h"

namespace plumescout::lab {
namespace {

constexpr double kTitleSize_px = 16.0;
constexpr double kTop_px = 34.0;  // for the title
constexpr double kLegendTop_px = 26.0;
constexpr double kLeft_px = 52.0;    // for the labels of the values
constexpr double kBottom_px = 40.0;  // for what stands below the plot
constexpr double kRight_px = 10.0;
constexpr int kTicks = 5;

}  // namespace

PixelBox DrawChartFrame(Canvas& canvas, const PixelBox& box, const std::string& title,
                        const std::string& x_label, const std::vector<ChartLegendItem>& legend) {
  const double top_px = kTop_px + ChartLegendHeight_px(legend, box.width);
  const PixelBox plot{box.x + kLeft_px, box.y + top_px, box.width - kLeft_px - kRight_px,
                      box.height - top_px - kBottom_px};
  const double size_px = SizeToFit_px(title, kTitleSize_px, box.width, true);
  canvas.Text({box.x, box.y + kTitleSize_px}, title, {size_px, kInk, Anchor::kStart, true});
  DrawChartLegend(canvas, {box.x, box.y + kLegendTop_px, box.width, box.height}, legend);
  canvas.Text({plot.x + 0.5 * plot.width, plot.bottom() + 36.0}, x_label,
              {kChartLabelSize_px, kFaintInk, Anchor::kMiddle});
  return plot;
}

void DrawValueLines(Canvas& canvas, const PixelBox& plot, double low, double high,
                    const std::function<double(double)>& pixel_y) {
  for (const double value : LinearTicks(low, high, kTicks)) {
    const double y = pixel_y(value);
    const PixelPoint line[] = {{plot.x, y}, {plot.right(), y}};
    canvas.Polyline(line, {kGridLine, 1.0});
    constexpr double kBeforePlot_px = 8.0;
    const std::string label = TickLabel(value);
    const double size_px = SizeToFit_px(label, kChartLabelSize_px, kLeft_px - kBeforePlot_px);
    canvas.Text({plot.x - kBeforePlot_px, y + 4.0}, label, {size_px, kFaintInk, Anchor::kEnd});
  }
}

void DrawBelowPlot(Canvas& canvas, const PixelBox& plot, double x, const std::string& name) {
  canvas.Text({x, plot.bottom() + 18.0}, name, {kChartLabelSize_px, kFaintInk, Anchor::kMiddle});
}

void DrawFootLine(Canvas& canvas, const PixelBox& plot) {
  const PixelPoint line[] = {{plot.x, plot.bottom()}, {plot.right(), plot.bottom()}};
  canvas.Polyline(line, {kFrame, 1.0});
}

}  // namespace plumescout::lab
