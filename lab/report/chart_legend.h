// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "lab/report/canvas.h"

namespace plumescout::lab {

// What stands before a name, in the colour of its stroke: a piece of the line, a square, or a dot
// as wide as the stroke.
enum class LegendSample { kLine, kSquare, kDot };

struct ChartLegendItem {
  std::string name;
  Stroke stroke;
  LegendSample sample = LegendSample::kLine;

  friend bool operator==(const ChartLegendItem&, const ChartLegendItem&) = default;
};

// Height of the rows that the items need in this width, with the gap below them; 0 without items.
double ChartLegendHeight_px(const std::vector<ChartLegendItem>& items, double width_px);

// Draws samples and names from the top left corner of the box, in rows that its width holds; a
// name that is wider than the box is cut.
void DrawChartLegend(Canvas& canvas, const PixelBox& box,
                     const std::vector<ChartLegendItem>& items);

}  // namespace plumescout::lab
