// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "lab/report/chart.h"
#include "lab/report/map_panel.h"
#include "lab/report/report_data.h"

namespace plumescout::lab {

// The part of the map that is known, with a margin; the whole of it if none is.
Rectangle KnownRegion(const Grid<CellState>& map);

// Colours of what is known of cells.
Rgb StateColor(CellState state);

// Colours of goals.
Rgb GoalColor(GoalKind kind);

// True gas (if known), estimated mean, its variance, and occupancy with frontiers, goals and
// paths: all of the same region, the gas maps with the same colours. With an objective also how it
// stands; of a team its tubes at the busiest moment, and where each robot drove.
// REQUIRES: valid data (see report.h).
std::vector<MapPanel> MakeMapPanels(const ReportData& data);

// Completeness, RMSE with that of an all-zero map, and entropy over time.
std::vector<Chart> MakeCharts(const ReportData& data);

}  // namespace plumescout::lab
