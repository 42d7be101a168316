// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/sheet.h"

#include <algorithm>
#include <cmath>

#include "lab/report/cairo_canvas.h"
#include "lab/report/font.h"
#include "lab/report/palette.h"

namespace plumescout::lab {
namespace {

constexpr std::size_t kColumns = 4;
constexpr int kMargin_px = 40;
constexpr int kGap_px = 32;
constexpr int kTitle_px = 64;
constexpr int kHeadline_px = 84;
constexpr int kNumberRow_px = 24;
constexpr int kNumbersTop_px = 34;
constexpr int kContent_px = static_cast<int>(kColumns) * (kPanelWidth_px + kGap_px) - kGap_px;
constexpr int kWidth_px = kContent_px + 2 * kMargin_px;

double ColumnX(std::size_t column) {
  return kMargin_px + static_cast<double>(column) * (kPanelWidth_px + kGap_px);
}

constexpr double kNoteSize_px = 14.0;
constexpr int kNoteLine_px = 22;

std::vector<std::string> NoteLines(const ReportFigures& figures) {
  std::vector<std::string> lines;
  for (const std::string& note : figures.notes) {
    for (std::string& line : WrapText(note, kNoteSize_px, kContent_px)) {
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

void DrawHeadline(Canvas& canvas, double top, const ReportFigures& figures) {
  const std::size_t count = std::min(kHeadlineNumbers, figures.key_numbers.size());
  const double step = kContent_px / static_cast<double>(kHeadlineNumbers);
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [name, value] = figures.key_numbers[i];
    const double x = kMargin_px + static_cast<double>(i) * step;
    canvas.Text({x, top + 14.0}, name, {13.0, kFaintInk});
    canvas.Text({x, top + 44.0}, value, {24.0, kLineColors[0], Anchor::kStart, true});
  }
}

void DrawKeyNumbers(Canvas& canvas, const Box& box, const ReportFigures& figures) {
  canvas.Text({box.x, box.y + 16.0}, "Key numbers", {16.0, kInk, Anchor::kStart, true});
  double y = box.y + kNumbersTop_px;
  for (const auto& [name, value] : figures.key_numbers) {
    const PixelPoint rule[] = {{box.x, y}, {box.right(), y}};
    canvas.Polyline(rule, {kGridLine, 1.0});
    canvas.Text({box.x, y + 17.0}, name, {13.0, kFaintInk});
    canvas.Text({box.right(), y + 17.0}, value, {13.0, kInk, Anchor::kEnd});
    y += kNumberRow_px;
  }
}

// Width of panels that fill the sheet, or of the widest map if all are tall.
double PanelWidth_px(const ReportFigures& figures) {
  const double most_px =
      (kContent_px + kGap_px) / static_cast<double>(PanelsPerRow(figures)) - kGap_px;
  double needed_px = kPanelWidth_px;  // for titles and legends
  for (const MapPanel& panel : figures.panels) {
    needed_px = std::max(needed_px, MapWidth_px(panel, most_px));
  }
  return std::min(most_px, needed_px);
}

// Where the parts of the sheet begin and how high they are.
struct SheetLayout {
  int headline_top = 0;
  int table_top = 0;
  int panels_top = 0;
  int panel_height = 0;
  int charts_top = 0;
  int chart_height = 0;
  int height = 0;
};

SheetLayout LayOut(const ReportFigures& figures, std::size_t note_lines) {
  SheetLayout layout;
  layout.headline_top = kMargin_px + kTitle_px + kNoteLine_px * static_cast<int>(note_lines);
  layout.table_top = layout.headline_top + kHeadline_px;
  layout.panels_top = layout.table_top;
  if (!figures.tables.empty()) {
    const std::optional<double> table = TextTableHeight_px(figures.tables.front(), kContent_px);
    if (table) layout.panels_top += static_cast<int>(std::ceil(*table)) + kGap_px;
  }
  layout.panel_height = PanelHeight_px(figures, PanelWidth_px(figures));
  const std::size_t columns = PanelsPerRow(figures);
  const int rows = static_cast<int>((figures.panels.size() + columns - 1) / columns);
  layout.charts_top = layout.panels_top + rows * (layout.panel_height + kGap_px);
  layout.chart_height = ChartHeight_px(figures);
  const int numbers_height =
      kNumbersTop_px + kNumberRow_px * static_cast<int>(figures.key_numbers.size());
  layout.height = layout.charts_top + std::max(layout.chart_height, numbers_height) + kMargin_px;
  return layout;
}

void DrawPanels(Canvas& canvas, const SheetLayout& layout, const ReportFigures& figures) {
  const std::size_t columns = PanelsPerRow(figures);
  const double width = PanelWidth_px(figures);
  const double step = width + kGap_px;
  const double left =
      kMargin_px + 0.5 * (kContent_px + kGap_px - static_cast<double>(columns) * step);
  for (std::size_t i = 0; i < figures.panels.size(); ++i) {
    const int row = static_cast<int>(i / columns);
    const double x = left + static_cast<double>(i % columns) * step;
    const int y = layout.panels_top + row * (layout.panel_height + kGap_px);
    DrawMapPanel(canvas,
                 {x, static_cast<double>(y), width, static_cast<double>(layout.panel_height)},
                 figures.panels[i]);
  }
}

void DrawCharts(Canvas& canvas, const SheetLayout& layout, const ReportFigures& figures) {
  std::size_t column = 0;
  const auto next_box = [&] {
    return Box{ColumnX(column++), static_cast<double>(layout.charts_top), kPanelWidth_px,
               static_cast<double>(layout.chart_height)};
  };
  for (const Chart& chart : figures.charts) DrawChart(canvas, next_box(), chart);
  for (const BarChart& chart : figures.bar_charts) DrawBarChart(canvas, next_box(), chart);
}

}  // namespace

std::size_t PanelsPerRow(const ReportFigures& figures) {
  if (figures.panels_per_row) return std::max<std::size_t>(1, *figures.panels_per_row);
  constexpr std::size_t kFewest = 3;  // fewer would be as large as all the rest
  const std::size_t count = figures.panels.size();
  if (count < kFewest) return kColumns;
  const std::size_t rows = (count + kColumns - 1) / kColumns;
  return (count + rows - 1) / rows;
}

int PanelHeight_px(const ReportFigures& figures, double width_px) {
  double height_px = 0.0;
  for (const MapPanel& panel : figures.panels) {
    height_px = std::max(height_px, MapPanelHeight_px(panel, width_px));
  }
  return static_cast<int>(std::ceil(height_px));
}

int ChartHeight_px(const ReportFigures& figures) {
  double legend_px = 0.0;
  for (const Chart& chart : figures.charts) {
    legend_px = std::max(legend_px, LegendHeight_px(chart, kPanelWidth_px));
  }
  for (const BarChart& chart : figures.bar_charts) {
    legend_px = std::max(legend_px, LegendHeight_px(chart, kPanelWidth_px));
  }
  return kChartHeight_px + static_cast<int>(std::ceil(legend_px));
}

Image DrawSheet(const ReportFigures& figures) {
  const std::vector<std::string> notes = NoteLines(figures);
  const SheetLayout layout = LayOut(figures, notes.size());
  return DrawImage(kWidth_px, layout.height, kPaper, [&](Canvas& canvas) {
    canvas.Text({kMargin_px, kMargin_px + 26.0}, figures.title, {30.0, kInk, Anchor::kStart, true});
    for (std::size_t i = 0; i < notes.size(); ++i) {
      canvas.Text({kMargin_px, kMargin_px + kTitle_px + kNoteLine_px * static_cast<double>(i)},
                  notes[i], {kNoteSize_px, kInk});
    }
    DrawHeadline(canvas, layout.headline_top, figures);
    const auto whole_width = [&](int top) {
      return Box{kMargin_px, static_cast<double>(top), kContent_px,
                 static_cast<double>(layout.height - top)};
    };
    if (!figures.tables.empty()) {
      DrawTextTable(canvas, whole_width(layout.table_top), figures.tables.front());
    }
    DrawPanels(canvas, layout, figures);
    DrawCharts(canvas, layout, figures);
    Box numbers = whole_width(layout.charts_top);
    numbers.x = ColumnX(kColumns - 1);
    numbers.width = kPanelWidth_px;
    DrawKeyNumbers(canvas, numbers, figures);
  });
}

}  // namespace plumescout::lab
