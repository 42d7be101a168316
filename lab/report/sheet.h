// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "formats/image.h"
#include "lab/report/bar_chart.h"
#include "lab/report/chart.h"
#include "lab/report/map_panel.h"

namespace plumescout::lab {

// Rows have as many cells as there are columns.
struct TextTable {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

// What page and sheet show, in this order.
struct ReportFigures {
  std::string title;
  std::vector<std::pair<std::string, std::string>> key_numbers;
  std::vector<MapPanel> panels;
  std::vector<Chart> charts;
  std::vector<std::string> notes = {};    // paragraphs under the title
  std::vector<BarChart> bar_charts = {};  // after the charts
  std::vector<TextTable> tables = {};     // on the page only, under the notes
};

// Sizes that page and sheet share.
inline constexpr int kPanelWidth_px = 448;
inline constexpr int kChartHeight_px = 300;
inline constexpr std::size_t kHeadlineNumbers = 6;  // the first key numbers, printed large

// Height of the panels: what the tallest one needs.
int PanelHeight_px(const ReportFigures& figures);

// One picture of everything: panels in rows of four; at most three charts of both kinds, beside the
// key numbers.
Image DrawSheet(const ReportFigures& figures);

}  // namespace plumescout::lab
