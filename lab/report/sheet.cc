// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/sheet.h"

#include <algorithm>
#include <cmath>

#include "lab/report/palette.h"
#include "lab/report/raster_canvas.h"
#include "lab/report/stroke_font.h"

namespace plumescout::lab {
namespace {

constexpr std::size_t kColumns = 4;
constexpr int kMargin_px = 40;
constexpr int kGap_px = 32;
constexpr int kTitle_px = 64;
constexpr int kHeadline_px = 84;
constexpr int kTableRow_px = 24;
constexpr int kTableTop_px = 34;
constexpr int kWidth_px =
    2 * kMargin_px + static_cast<int>(kColumns) * (kPanelWidth_px + kGap_px) - kGap_px;

double ColumnX(std::size_t column) {
  return kMargin_px + static_cast<double>(column) * (kPanelWidth_px + kGap_px);
}

constexpr double kNoteSize_px = 14.0;
constexpr int kNoteLine_px = 22;

std::vector<std::string> NoteLines(const ReportFigures& figures) {
  std::vector<std::string> lines;
  for (const std::string& note : figures.notes) {
    for (std::string& line : WrapText(note, kNoteSize_px, kWidth_px - 2.0 * kMargin_px)) {
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

void DrawHeadline(Canvas& canvas, double top, const ReportFigures& figures) {
  const std::size_t count = std::min(kHeadlineNumbers, figures.key_numbers.size());
  const double step = (kWidth_px - 2.0 * kMargin_px) / static_cast<double>(kHeadlineNumbers);
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [name, value] = figures.key_numbers[i];
    const double x = kMargin_px + static_cast<double>(i) * step;
    canvas.Text({x, top + 14.0}, name, {13.0, kFaintInk});
    canvas.Text({x, top + 44.0}, value, {24.0, kLineColors[0], Anchor::kStart, true});
  }
}

void DrawTable(Canvas& canvas, const Box& box, const ReportFigures& figures) {
  canvas.Text({box.x, box.y + 16.0}, "Key numbers", {16.0, kInk, Anchor::kStart, true});
  double y = box.y + kTableTop_px;
  for (const auto& [name, value] : figures.key_numbers) {
    const PixelPoint rule[] = {{box.x, y}, {box.right(), y}};
    canvas.Polyline(rule, {kGridLine, 1.0});
    canvas.Text({box.x, y + 17.0}, name, {13.0, kFaintInk});
    canvas.Text({box.right(), y + 17.0}, value, {13.0, kInk, Anchor::kEnd});
    y += kTableRow_px;
  }
}

// Draws the panels in rows of four from `top` on.
void DrawPanels(Canvas& canvas, int top, int height_px, const ReportFigures& figures) {
  for (std::size_t i = 0; i < figures.panels.size(); ++i) {
    const int row = static_cast<int>(i / kColumns);
    DrawMapPanel(canvas,
                 {ColumnX(i % kColumns), static_cast<double>(top + row * (height_px + kGap_px)),
                  kPanelWidth_px, static_cast<double>(height_px)},
                 figures.panels[i]);
  }
}

void DrawCharts(Canvas& canvas, int top, const ReportFigures& figures) {
  std::size_t column = 0;
  const auto next_box = [&] {
    return Box{ColumnX(column++), static_cast<double>(top), kPanelWidth_px, kChartHeight_px};
  };
  for (const Chart& chart : figures.charts) DrawChart(canvas, next_box(), chart);
  for (const BarChart& chart : figures.bar_charts) DrawBarChart(canvas, next_box(), chart);
}

}  // namespace

int PanelHeight_px(const ReportFigures& figures) {
  double height_px = 0.0;
  for (const MapPanel& panel : figures.panels) {
    height_px = std::max(height_px, MapPanelHeight_px(panel, kPanelWidth_px));
  }
  return static_cast<int>(std::ceil(height_px));
}

Image DrawSheet(const ReportFigures& figures) {
  const int table_px = kTableTop_px + kTableRow_px * static_cast<int>(figures.key_numbers.size());
  const std::vector<std::string> notes = NoteLines(figures);
  const int notes_px = kNoteLine_px * static_cast<int>(notes.size());
  const int headline_top = kMargin_px + kTitle_px + notes_px;
  const int panels_top = headline_top + kHeadline_px;
  const int panels_height = PanelHeight_px(figures);
  const int rows = static_cast<int>((figures.panels.size() + kColumns - 1) / kColumns);
  const int charts_top = panels_top + rows * (panels_height + kGap_px);
  const int height_px = charts_top + std::max(kChartHeight_px, table_px) + kMargin_px;
  RasterCanvas canvas(kWidth_px, height_px, kPaper);
  canvas.Text({kMargin_px, kMargin_px + 26.0}, figures.title, {30.0, kInk, Anchor::kStart, true});
  for (std::size_t i = 0; i < notes.size(); ++i) {
    canvas.Text({kMargin_px, kMargin_px + kTitle_px + kNoteLine_px * static_cast<double>(i)},
                notes[i], {kNoteSize_px, kInk});
  }
  DrawHeadline(canvas, headline_top, figures);
  DrawPanels(canvas, panels_top, panels_height, figures);
  DrawCharts(canvas, charts_top, figures);
  DrawTable(canvas,
            {ColumnX(kColumns - 1), static_cast<double>(charts_top), kPanelWidth_px,
             static_cast<double>(table_px)},
            figures);
  return canvas.image();
}

}  // namespace plumescout::lab
