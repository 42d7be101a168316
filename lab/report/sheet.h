// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lab/report/bar_chart.h"
#include "lab/report/chart.h"
#include "lab/report/chart_legend.h"
#include "lab/report/image.h"
#include "lab/report/map_panel.h"
#include "lab/report/text_table.h"

namespace plumescout::lab {

// What page and sheet show, in this order.
struct ReportFigures {
  std::string title;
  std::vector<std::pair<std::string, std::string>> key_numbers;
  std::vector<MapPanel> panels;
  std::vector<Chart> charts;
  std::vector<std::string> notes = {};    // paragraphs under the title
  std::vector<BarChart> bar_charts = {};  // after the charts
  // Under the first key numbers; the sheet has the first table if it is not too wide.
  std::vector<TextTable> tables = {};
  std::optional<std::size_t> panels_per_row = {};  // default: see PanelsPerRow
  std::string explorer = {};                       // HTML under the headline of the page
};

// Sizes that page and sheet share.
inline constexpr int kPanelWidth_px = 448;          // of a panel in a row of four
inline constexpr int kChartWidth_px = 608;          // of a chart in a row of three
inline constexpr int kChartHeight_px = 400;         // without legend
inline constexpr std::size_t kHeadlineNumbers = 6;  // the first key numbers, printed large

// As the figures say, else as many as fill the fewest rows of up to four best: 3 for 5, 6 and 9.
// One or two panels stand as if they were four.
std::size_t PanelsPerRow(const ReportFigures& figures);

// Height of panels of this width: what the tallest one needs.
int PanelHeight_px(const ReportFigures& figures, double width_px);

// The charts of both kinds, ready to be drawn.
struct ChartDrawing {
  std::string title;
  std::function<void(Canvas&, const PixelBox&)> draw;
};
struct ChartDrawings {
  std::vector<ChartLegendItem> legend;  // of all charts: if several have one and all the same
  int height_px = 0;                    // of each, with its own legend if it has one
  std::vector<ChartDrawing> charts;     // refer to the figures
};
ChartDrawings MakeChartDrawings(const ReportFigures& figures);

// One picture of everything: the first table, rows of panels as wide as the sheet (in its
// middle, if tall maps need less), charts in rows of three, and the other key numbers.
Image DrawSheet(const ReportFigures& figures);

}  // namespace plumescout::lab
