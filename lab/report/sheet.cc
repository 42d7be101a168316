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
constexpr int kColumnsOfCharts = 3;  // and of numbers
constexpr int kContent_px = static_cast<int>(kColumns) * (kPanelWidth_px + kGap_px) - kGap_px;
constexpr int kWidth_px = kContent_px + 2 * kMargin_px;

static_assert(kColumnsOfCharts * (kChartWidth_px + kGap_px) - kGap_px == kContent_px);

double ColumnX(int column) { return kMargin_px + column * (kChartWidth_px + kGap_px); }

int RowsOf(std::size_t count, std::size_t columns) {
  return static_cast<int>((count + columns - 1) / columns);
}

// Numbers that the headline does not hold.
std::size_t OtherNumbers(const ReportFigures& figures) {
  return figures.key_numbers.size() - std::min(kHeadlineNumbers, figures.key_numbers.size());
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
    const double room_px = step - kGap_px / 2;
    canvas.Text({x, top + 14.0}, name, {SizeToFit_px(name, 13.0, room_px), kFaintInk});
    canvas.Text({x, top + 44.0}, value,
                {SizeToFit_px(value, 24.0, room_px, true), kLineColors[0], Anchor::kStart, true});
  }
}

// In columns, one after the other.
void DrawOtherNumbers(Canvas& canvas, double top, const ReportFigures& figures) {
  constexpr double kBetween_px = 12.0;
  const int rows = RowsOf(OtherNumbers(figures), kColumnsOfCharts);
  for (std::size_t i = kHeadlineNumbers; i < figures.key_numbers.size(); ++i) {
    const auto& [name, value] = figures.key_numbers[i];
    const int at = static_cast<int>(i - kHeadlineNumbers);
    const double x = ColumnX(at / rows);
    const double y = top + kNumberRow_px * (at % rows);
    const double right = x + kChartWidth_px;
    const PixelPoint rule[] = {{x, y}, {right, y}};
    canvas.Polyline(rule, {kGridLine, 1.0});
    const double room_px = kChartWidth_px - kBetween_px - TextWidth_px(name, 13.0);
    canvas.Text({x, y + 17.0}, name, {13.0, kFaintInk});
    canvas.Text({right, y + 17.0}, value, {SizeToFit_px(value, 13.0, room_px), kInk, Anchor::kEnd});
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
  int legend_top = 0;
  int charts_top = 0;
  int numbers_top = 0;
  int height = 0;
};

SheetLayout LayOut(const ReportFigures& figures, const ChartDrawings& charts,
                   std::size_t note_lines) {
  SheetLayout layout;
  layout.headline_top = kMargin_px + kTitle_px + kNoteLine_px * static_cast<int>(note_lines);
  layout.table_top = layout.headline_top + kHeadline_px;
  layout.panels_top = layout.table_top;
  if (!figures.tables.empty()) {
    const std::optional<double> table = TextTableHeight_px(figures.tables.front(), kContent_px);
    if (table) layout.panels_top += static_cast<int>(std::ceil(*table)) + kGap_px;
  }
  layout.panel_height = PanelHeight_px(figures, PanelWidth_px(figures));
  const int panel_rows = RowsOf(figures.panels.size(), PanelsPerRow(figures));
  layout.legend_top = layout.panels_top + panel_rows * (layout.panel_height + kGap_px);
  const double legend_px = ChartLegendHeight_px(charts.legend, kContent_px);
  layout.charts_top = layout.legend_top + static_cast<int>(std::ceil(legend_px));
  const int chart_rows = RowsOf(charts.charts.size(), kColumnsOfCharts);
  layout.numbers_top = layout.charts_top + chart_rows * (charts.height_px + kGap_px);
  layout.height = layout.numbers_top +
                  kNumberRow_px * RowsOf(OtherNumbers(figures), kColumnsOfCharts) + kMargin_px;
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

void DrawCharts(Canvas& canvas, const SheetLayout& layout, const ChartDrawings& charts) {
  DrawChartLegend(canvas, {kMargin_px, static_cast<double>(layout.legend_top), kContent_px, 0.0},
                  charts.legend);
  for (std::size_t i = 0; i < charts.charts.size(); ++i) {
    const int at = static_cast<int>(i);
    const double top = layout.charts_top + at / kColumnsOfCharts * (charts.height_px + kGap_px);
    charts.charts[i].draw(canvas, {ColumnX(at % kColumnsOfCharts), top, kChartWidth_px,
                                   static_cast<double>(charts.height_px)});
  }
}

// The legend of all charts that have one, if it is the same and there are several.
std::vector<ChartLegendItem> SharedLegend(
    const std::vector<std::vector<ChartLegendItem>>& legends) {
  std::vector<ChartLegendItem> shared;
  int with_legend = 0;
  for (const std::vector<ChartLegendItem>& legend : legends) {
    if (legend.empty()) continue;
    if (with_legend > 0 && legend != shared) return {};
    shared = legend;
    ++with_legend;
  }
  return with_legend > 1 ? shared : std::vector<ChartLegendItem>{};
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

ChartDrawings MakeChartDrawings(const ReportFigures& figures) {
  std::vector<std::vector<ChartLegendItem>> legends;
  for (const Chart& chart : figures.charts) legends.push_back(LegendOf(chart));
  for (const BarChart& chart : figures.bar_charts) legends.push_back(LegendOf(chart));
  ChartDrawings drawings{SharedLegend(legends), kChartHeight_px, {}};
  if (!drawings.legend.empty()) {
    for (std::vector<ChartLegendItem>& legend : legends) legend.clear();
  }
  double legend_px = 0.0;
  for (const std::vector<ChartLegendItem>& legend : legends) {
    legend_px = std::max(legend_px, ChartLegendHeight_px(legend, kChartWidth_px));
  }
  drawings.height_px += static_cast<int>(std::ceil(legend_px));
  std::size_t at = 0;
  for (const Chart& chart : figures.charts) {
    drawings.charts.push_back(
        {chart.title, [&chart, legend = legends[at++]](Canvas& canvas, const PixelBox& box) {
           DrawChart(canvas, box, chart, legend);
         }});
  }
  for (const BarChart& chart : figures.bar_charts) {
    drawings.charts.push_back(
        {chart.title, [&chart, legend = legends[at++]](Canvas& canvas, const PixelBox& box) {
           DrawBarChart(canvas, box, chart, legend);
         }});
  }
  return drawings;
}

Image DrawSheet(const ReportFigures& figures) {
  const std::vector<std::string> notes = NoteLines(figures);
  const ChartDrawings charts = MakeChartDrawings(figures);
  const SheetLayout layout = LayOut(figures, charts, notes.size());
  return DrawImage(kWidth_px, layout.height, kPaper, [&](Canvas& canvas) {
    canvas.Text({kMargin_px, kMargin_px + 26.0}, figures.title, {30.0, kInk, Anchor::kStart, true});
    for (std::size_t i = 0; i < notes.size(); ++i) {
      canvas.Text({kMargin_px, kMargin_px + kTitle_px + kNoteLine_px * static_cast<double>(i)},
                  notes[i], {kNoteSize_px, kInk});
    }
    DrawHeadline(canvas, layout.headline_top, figures);
    if (!figures.tables.empty()) {
      DrawTextTable(canvas,
                    {kMargin_px, static_cast<double>(layout.table_top), kContent_px,
                     static_cast<double>(layout.panels_top - layout.table_top)},
                    figures.tables.front());
    }
    DrawPanels(canvas, layout, figures);
    DrawCharts(canvas, layout, charts);
    DrawOtherNumbers(canvas, layout.numbers_top, figures);
  });
}

}  // namespace plumescout::lab
