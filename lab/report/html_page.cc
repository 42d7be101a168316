// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/html_page.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "absl/strings/string_view.h"
#include "lab/report/cairo_canvas.h"

namespace plumescout::lab {
namespace {

constexpr std::size_t kPrintedColumns = 7;  // of panels, where a mission is on one sheet

constexpr char kStyle[] = R"(
body { margin: 0 auto; padding: 2rem; max-width: 120rem; color: #1f2430; background: #fff;
       font: 16px/1.5 system-ui, sans-serif; }
h1 { margin: 0 0 1rem; font-size: 1.9rem; }
p { max-width: 60rem; }
h2 { margin: 0 0 .5rem; font-size: 1rem; }
.headline { display: flex; flex-wrap: wrap; gap: 1rem 3rem; margin: 0 0 2rem; }
.headline div { font-size: .85rem; color: #6b7280; }
.headline strong { display: block; font-size: 1.6rem; color: #2463c9; }
.figures { display: grid; grid-template-columns: repeat(auto-fit, minmax(22rem, 1fr));
           gap: 1.5rem 2rem; margin: 0 0 1.5rem; }
@media (min-width: 90rem) {
  .panels { grid-template-columns: repeat(var(--columns), minmax(0, 1fr)); }
}
.charts { grid-template-columns: repeat(auto-fit, minmax(min(32rem, 100%), 1fr)); }
img { width: 100%; height: auto; max-width: 52rem; }
.legend img { width: auto; max-width: 100%; }
table { border-collapse: collapse; font-size: .9rem; font-variant-numeric: tabular-nums; }
td { border-top: 1px solid #e2e5ea; padding: .2rem .6rem .2rem 0; }
th { padding: .2rem .6rem .2rem 0; text-align: left; }
.wide { width: 100%; margin: 0 0 2rem; }
.numbers { width: 100%; max-width: 40rem; }
.numbers td:first-child { color: #6b7280; }
.numbers td:last-child { text-align: right; }
.explorer { width: 100%; height: min(46rem, 85vh); border: 1px solid #e2e5ea; border-radius: 8px;
            margin: 0 0 2rem; }
@page { size: A4 landscape; margin: 8mm; }
@media print {
  .explorer { display: none; }
  body { padding: 0; font-size: 9px; }
  h1 { margin: 0 0 .4rem; font-size: 1.2rem; }
  .headline { gap: .2rem 2rem; margin: 0 0 .5rem; }
  .headline strong { font-size: 1.1rem; }
  .figures { gap: .5rem 1rem; margin: 0 0 .5rem; }
  .panels { grid-template-columns: repeat(var(--printed-columns), minmax(0, 1fr)); }
  p { margin: 0 0 .3rem; }
  table { font-size: inherit; }
  .wide { margin: 0 0 .4rem; }
  .charts { grid-template-columns: repeat(4, minmax(0, 1fr)); }
  .panels img { max-height: 90mm; width: auto; max-width: 100%; }
  .numbers, .numbers tbody { display: block; width: auto; max-width: none; }
  .numbers { font-size: inherit; }
  .numbers tbody { columns: 4; }
  .numbers tr { display: flex; justify-content: space-between; break-inside: avoid; }
  .numbers td { padding: .05rem .6rem .05rem 0; }
}
)";

std::string EscapeMarkup(absl::string_view text) {
  return absl::StrReplaceAll(
      text, {{"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}, {"'", "&#39;"}});
}

std::string MakeHeadline(const ReportFigures& figures) {
  std::string html = "<div class=\"headline\">\n";
  const std::size_t count = std::min(kHeadlineNumbers, figures.key_numbers.size());
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [name, value] = figures.key_numbers[i];
    absl::StrAppend(&html, "<div>", EscapeMarkup(name), "<strong>", EscapeMarkup(value),
                    "</strong></div>\n");
  }
  return html + "</div>\n";
}

// A page in the page: neither has a say in how the other looks.
std::string MakeExplorer(const ReportFigures& figures) {
  if (figures.explorer.empty()) return "";
  return absl::StrCat(
      "<iframe class=\"explorer\" title=\"The mission to look around in\" srcdoc=\"",
      EscapeMarkup(figures.explorer), "\"></iframe>\n");
}

std::string MakeNotes(const ReportFigures& figures) {
  std::string html;
  for (const std::string& note : figures.notes) {
    absl::StrAppend(&html, "<p>", EscapeMarkup(note), "</p>\n");
  }
  return html;
}

// What the headline does not hold.
std::string MakeOtherNumbers(const ReportFigures& figures) {
  if (figures.key_numbers.size() <= kHeadlineNumbers) return "";
  std::string html = "<h2>More numbers</h2>\n<table class=\"numbers\">\n";
  for (std::size_t i = kHeadlineNumbers; i < figures.key_numbers.size(); ++i) {
    const auto& [name, value] = figures.key_numbers[i];
    absl::StrAppend(&html, "<tr><td>", EscapeMarkup(name), "</td><td>", EscapeMarkup(value),
                    "</td></tr>\n");
  }
  return html + "</table>\n";
}

std::string MakeRow(const std::vector<std::string>& cells, const char* tag) {
  std::string html = "<tr>";
  for (const std::string& cell : cells) {
    absl::StrAppend(&html, "<", tag, ">", EscapeMarkup(cell), "</", tag, ">");
  }
  return html + "</tr>\n";
}

std::string MakeTextTable(const TextTable& table) {
  std::string html = absl::StrCat("<h2>", EscapeMarkup(table.title),
                                  "</h2>\n<table class=\"wide\">\n", MakeRow(table.columns, "th"));
  for (const std::vector<std::string>& row : table.rows) html += MakeRow(row, "td");
  return html + "</table>\n";
}

// A figure of its own, so that names within one do not meet those of another.
std::string MakeFigure(const std::string& title, int width_px, int height_px, const Drawing& draw) {
  return absl::StrCat("<img alt=\"", EscapeMarkup(title), "\" src=\"data:image/svg+xml;base64,",
                      absl::Base64Escape(DrawSvg(width_px, height_px, draw)), "\">\n");
}

std::string MakePanels(const ReportFigures& figures) {
  const int height_px = PanelHeight_px(figures, kPanelWidth_px);
  const PixelBox box{0.0, 0.0, kPanelWidth_px, static_cast<double>(height_px)};
  std::string html;
  for (const MapPanel& panel : figures.panels) {
    html += MakeFigure(panel.title, kPanelWidth_px, height_px,
                       [&](Canvas& canvas) { DrawMapPanel(canvas, box, panel); });
  }
  return html;
}

std::string MakeLegend(const std::vector<ChartLegendItem>& items) {
  if (items.empty()) return "";
  constexpr int kWidth_px = 2 * kChartWidth_px;
  const int height_px = static_cast<int>(std::ceil(ChartLegendHeight_px(items, kWidth_px)));
  const PixelBox box{0.0, 0.0, kWidth_px, static_cast<double>(height_px)};
  return absl::StrCat("<div class=\"legend\">\n",
                      MakeFigure("Legend of the charts", kWidth_px, height_px,
                                 [&](Canvas& canvas) { DrawChartLegend(canvas, box, items); }),
                      "</div>\n");
}

std::string MakeCharts(const ReportFigures& figures) {
  const ChartDrawings charts = MakeChartDrawings(figures);
  const PixelBox box{0.0, 0.0, kChartWidth_px, static_cast<double>(charts.height_px)};
  std::string html = absl::StrCat(MakeLegend(charts.legend), "<div class=\"figures charts\">\n");
  for (const ChartDrawing& chart : charts.charts) {
    html += MakeFigure(chart.title, kChartWidth_px, charts.height_px,
                       [&](Canvas& canvas) { chart.draw(canvas, box); });
  }
  return html + "</div>\n";
}

}  // namespace

std::string MakeHtmlPage(const ReportFigures& figures) {
  const std::string title = EscapeMarkup(figures.title);
  std::string html = absl::StrCat(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width\">\n<title>",
      title, "</title>\n<style>", kStyle, "</style>\n</head>\n<body>\n<h1>", title, "</h1>\n",
      MakeNotes(figures), MakeHeadline(figures), MakeExplorer(figures));
  for (const TextTable& table : figures.tables) html += MakeTextTable(table);
  absl::StrAppend(&html, "<div class=\"figures panels\" style=\"--columns: ", PanelsPerRow(figures),
                  "; --printed-columns: ", std::min(kPrintedColumns, figures.panels.size()),
                  "\">\n");
  absl::StrAppend(&html, MakePanels(figures), "</div>\n", MakeCharts(figures),
                  MakeOtherNumbers(figures), "</body>\n</html>\n");
  return html;
}

}  // namespace plumescout::lab
