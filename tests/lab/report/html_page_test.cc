// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/html_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "lab/report/figures.h"
#include "tests/support/small_report.h"

namespace plumescout::lab {
namespace html_page_test {

using testing::HasSubstr;
using testing::Not;

std::string MakePage() {
  const ReportData data = MakeSmallReport();
  return MakeHtmlPage({data.title, data.key_numbers, MakeMapPanels(data), MakeCharts(data)});
}

int Count(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

TEST(HtmlPage, HoldsAllTitlesAndNumbers) {
  const std::string page = MakePage();
  for (const char* text :
       {"<!DOCTYPE html>", "<h1>Small room &lt;1&gt;</h1>", "alt=\"True gas\"",
        "alt=\"Estimated mean\"", "alt=\"Uncertainty (variance)\"",
        "alt=\"Occupancy, frontiers and paths\"", "alt=\"Completeness\"",
        "alt=\"RMSE, critical cells, ppm\"", "alt=\"Entropy, critical cells, nats\"",
        "<div>completeness<strong>50 %</strong></div>", "<div>RMSE<strong>10 ppm</strong></div>"}) {
    EXPECT_THAT(page, HasSubstr(text));
  }
}

TEST(HtmlPage, ANumberStandsOnce) {
  ReportFigures figures;
  for (int i = 0; i < 8; ++i) {
    figures.key_numbers.emplace_back("number " + std::to_string(i), "value");
  }
  const std::string page = MakeHtmlPage(figures);
  for (const auto& [name, value] : figures.key_numbers) EXPECT_EQ(Count(page, name), 1) << name;
  EXPECT_THAT(page, HasSubstr("<td>number 6</td><td>value</td>"));
}

TEST(HtmlPage, TheExplorerIsAPageOfItsOwn) {
  ReportFigures figures;
  EXPECT_THAT(MakeHtmlPage(figures), Not(HasSubstr("<iframe")));
  figures.explorer = "<p class=\"a\">map & all</p>";
  EXPECT_THAT(MakeHtmlPage(figures),
              HasSubstr("srcdoc=\"&lt;p class=&quot;a&quot;&gt;map &amp; all&lt;/p&gt;\""));
}

TEST(HtmlPage, ALegendThatAllChartsShareStandsOnce) {
  ReportFigures figures;
  const Chart chart{"a", "", {}, {{"ours", {}, {{0, 1}}}, {"theirs", {}, {{0, 2}}}}};
  figures.charts = {chart, chart};
  EXPECT_EQ(Count(MakeHtmlPage(figures), "<div class=\"legend\">"), 1);
  figures.charts[1].curves[0].name = "others";
  EXPECT_EQ(Count(MakeHtmlPage(figures), "<div class=\"legend\">"), 0);
}

TEST(HtmlPage, HoldsBarCharts) {
  ReportFigures figures;
  figures.bar_charts = {{"Shares of <runs>", "", {"a"}, {{"ours", {}, {{1.0}}}}, ""}};
  EXPECT_THAT(MakeHtmlPage(figures), HasSubstr("alt=\"Shares of &lt;runs&gt;\""));
}

TEST(HtmlPage, HoldsTablesWithTheirTextEscaped) {
  ReportFigures figures;
  figures.tables = {{"Table III", {"row", "RMSE"}, {{"a < b", "14.9"}}}};
  const std::string page = MakeHtmlPage(figures);
  EXPECT_THAT(page, HasSubstr("<h2>Table III</h2>"));
  EXPECT_THAT(page, HasSubstr("<tr><th>row</th><th>RMSE</th></tr>"));
  EXPECT_THAT(page, HasSubstr("<tr><td>a &lt; b</td><td>14.9</td></tr>"));
}

TEST(HtmlPage, LoadsNothing) {
  const std::string page = MakePage();
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, Not(HasSubstr("<link")));
  EXPECT_THAT(page, Not(HasSubstr("href=")));
  EXPECT_EQ(Count(page, "src="), Count(page, "src=\"data:image/svg+xml;base64,"));
}

TEST(HtmlPage, EveryElementThatOpensCloses) {
  const std::string page = MakePage();
  for (const char* tag : {"div", "table", "tr", "td", "title", "html"}) {
    const std::string name = tag;
    EXPECT_EQ(Count(page, "<" + name + " ") + Count(page, "<" + name + ">"),
              Count(page, "</" + name + ">"))
        << name;
  }
}

TEST(HtmlPage, OneFigureEachForMapsAndCharts) { EXPECT_EQ(Count(MakePage(), "<img "), 4 + 3); }

TEST(HtmlPage, PanelsStandInAsManyColumnsAsOnTheSheet) {
  ReportFigures figures;
  figures.panels.resize(6, MakeMapPanels(MakeSmallReport()).front());
  EXPECT_THAT(
      MakeHtmlPage(figures),
      HasSubstr("<div class=\"figures panels\" style=\"--columns: 3; --printed-columns: 6\">"));
  figures.panels_per_row = 2;
  EXPECT_THAT(MakeHtmlPage(figures), HasSubstr("style=\"--columns: 2; "));
}

TEST(HtmlPage, TablesStandBeforeTheMaps) {
  const ReportData data = MakeSmallReport();
  ReportFigures figures{data.title, data.key_numbers, MakeMapPanels(data), {}};
  figures.tables = {{"Table III", {"row"}, {{"a"}}}, {"By part", {"row"}, {{"b"}}}};
  const std::string page = MakeHtmlPage(figures);
  EXPECT_LT(page.find(">Table III<"), page.find(">By part<"));
  EXPECT_LT(page.find(">By part<"), page.find("<img "));
}

}  // namespace html_page_test
}  // namespace plumescout::lab
