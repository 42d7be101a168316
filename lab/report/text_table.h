// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lab/report/canvas.h"

namespace plumescout::lab {

// Rows have as many cells as there are columns.
struct TextTable {
  std::string title;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};

// Height of the table when it is drawn; nothing if its columns are wider than `width_px` together,
// or if there are none. Names of columns may take several lines, cells take one.
std::optional<double> TextTableHeight_px(const TextTable& table, double width_px);

// Draws the table at the top of the box; nothing if it is too wide.
void DrawTextTable(Canvas& canvas, const PixelBox& box, const TextTable& table);

}  // namespace plumescout::lab
