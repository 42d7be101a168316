// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "lab/report/canvas.h"

namespace plumescout::lab {

struct ChartLegendItem {
  std::string name;
  Stroke stroke;
  bool filled = false;  // the sample is a square of the stroke's colour, else a piece of line
};

// Height of the rows that the items need in this width, with the gap below them; 0 without items.
double ChartLegendHeight_px(const std::vector<ChartLegendItem>& items, double width_px);

// Draws samples and names from the top left corner of the box, in rows that its width holds; a
// name that is wider than the box is cut.
void DrawChartLegend(Canvas& canvas, const Box& box, const std::vector<ChartLegendItem>& items);

}  // namespace plumescout::lab
