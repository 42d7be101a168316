// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/text_table.h"

#include <algorithm>
#include <cstddef>

#include "lab/report/font.h"
#include "lab/report/palette.h"

namespace plumescout::lab {
namespace {

constexpr double kTitleSize_px = 16.0;
constexpr double kTitle_px = 26.0;
constexpr double kTextSize_px = 13.0;
constexpr double kLine_px = 18.0;       // of a name of a column
constexpr double kRow_px = 24.0;        // of cells
constexpr double kBaseline_px = 17.0;   // below the top of a row
constexpr double kGap_px = 20.0;        // between columns, at least
constexpr double kMostSpare_px = 40.0;  // by which a column may be wider than it must

double Width_px(const std::string& text) { return TextWidth_px(text, kTextSize_px); }

// Of the widest line.
double Width_px(const std::vector<std::string>& lines) {
  double width_px = 0.0;
  for (const std::string& line : lines) width_px = std::max(width_px, Width_px(line));
  return width_px;
}

// What column `index` needs: its cells, and the longest word of its name.
double LeastWidth_px(const TextTable& table, std::size_t index) {
  double width_px = Width_px(WrapText(table.columns[index], kTextSize_px, 0.0));
  for (const std::vector<std::string>& row : table.rows) {
    if (index < row.size()) width_px = std::max(width_px, Width_px(row[index]));
  }
  return width_px;
}

struct Layout {
  std::vector<double> widths_px;
  std::vector<std::vector<std::string>> names;  // lines of each column's
  std::size_t name_lines = 0;                   // of the longest

  double width_px() const {
    double sum_px = -kGap_px;
    for (const double width_px : widths_px) sum_px += width_px + kGap_px;
    return sum_px;
  }
  double height_px(std::size_t rows) const {
    return kTitle_px + kLine_px * static_cast<double>(name_lines) +
           kRow_px * static_cast<double>(rows);
  }
};

std::optional<Layout> LayOut(const TextTable& table, double width_px) {
  Layout layout;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    layout.widths_px.push_back(LeastWidth_px(table, i));
  }
  const double spare_px = width_px - layout.width_px();
  if (table.columns.empty() || spare_px < 0.0) return std::nullopt;
  const double more_px =
      std::min(kMostSpare_px, spare_px / static_cast<double>(table.columns.size()));
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    layout.widths_px[i] += more_px;
    layout.names.push_back(WrapText(table.columns[i], kTextSize_px, layout.widths_px[i]));
    layout.name_lines = std::max(layout.name_lines, layout.names.back().size());
  }
  return layout;
}

// Names stand at the foot of their lines, next to the cells.
void DrawNames(Canvas& canvas, PixelPoint corner, const Layout& layout) {
  for (std::size_t i = 0; i < layout.names.size(); ++i) {
    const std::vector<std::string>& lines = layout.names[i];
    double y = corner.y + kLine_px * static_cast<double>(layout.name_lines - lines.size());
    for (const std::string& line : lines) {
      canvas.Text({corner.x, y + kTextSize_px}, line, {kTextSize_px, kFaintInk});
      y += kLine_px;
    }
    corner.x += layout.widths_px[i] + kGap_px;
  }
}

void DrawRow(Canvas& canvas, PixelPoint corner, const Layout& layout,
             const std::vector<std::string>& row) {
  const PixelPoint rule[] = {corner, {corner.x + layout.width_px(), corner.y}};
  canvas.Polyline(rule, {kGridLine, 1.0});
  for (std::size_t i = 0; i < std::min(row.size(), layout.widths_px.size()); ++i) {
    canvas.Text({corner.x, corner.y + kBaseline_px}, row[i], {kTextSize_px, kInk});
    corner.x += layout.widths_px[i] + kGap_px;
  }
}

}  // namespace

std::optional<double> TextTableHeight_px(const TextTable& table, double width_px) {
  const std::optional<Layout> layout = LayOut(table, width_px);
  if (!layout) return std::nullopt;
  return layout->height_px(table.rows.size());
}

void DrawTextTable(Canvas& canvas, const PixelBox& box, const TextTable& table) {
  const std::optional<Layout> layout = LayOut(table, box.width);
  if (!layout) return;
  canvas.Text({box.x, box.y + kTitleSize_px}, table.title,
              {kTitleSize_px, kInk, Anchor::kStart, true});
  DrawNames(canvas, {box.x, box.y + kTitle_px}, *layout);
  double y = box.y + layout->height_px(0);
  for (const std::vector<std::string>& row : table.rows) {
    DrawRow(canvas, {box.x, y}, *layout, row);
    y += kRow_px;
  }
}

}  // namespace plumescout::lab
