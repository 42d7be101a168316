// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "lab/report/canvas.h"
#include "lab/report/chart_legend.h"

namespace plumescout::lab {

// What charts of all kinds have around their plot.

inline constexpr double kChartLabelSize_px = 13.0;

// Draws title, legend below it and the name of the x axis at the foot; returns the plot area.
PixelBox DrawChartFrame(Canvas& canvas, const PixelBox& box, const std::string& title,
                        const std::string& x_label, const std::vector<ChartLegendItem>& legend);

// Lines across the plot at round values between `low` and `high`, which lie at `pixel_y`.
void DrawValueLines(Canvas& canvas, const PixelBox& plot, double low, double high,
                    const std::function<double(double)>& pixel_y);

// A name below the plot, centred at `x`.
void DrawBelowPlot(Canvas& canvas, const PixelBox& plot, double x, const std::string& name);

// The line at the foot of the plot.
void DrawFootLine(Canvas& canvas, const PixelBox& plot);

}  // namespace plumescout::lab
