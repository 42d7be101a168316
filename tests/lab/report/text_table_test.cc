// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/text_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/recording_canvas.h"

namespace plumescout::lab {
namespace text_table_test {

using ::testing::IsEmpty;

constexpr double kWide_px = 1000.0;
constexpr double kLeft_px = 40.0;
constexpr double kTop_px = 50.0;

TextTable MakeTable() {
  return {"Rows \u00B1 sd", {"row", "RMSE, ppm"}, {{"XIT", "14.9 \u00B1 1.9"}, {"RRT*", "\u2013"}}};
}

std::vector<WrittenText> Write(const TextTable& table, double width_px) {
  RecordingCanvas canvas;
  DrawTextTable(canvas, {kLeft_px, kTop_px, width_px, 500.0}, table);
  return canvas.texts;
}

const WrittenText& Find(const std::vector<WrittenText>& texts, const std::string& utf8) {
  const auto found = std::find_if(texts.begin(), texts.end(),
                                  [&](const WrittenText& text) { return text.utf8 == utf8; });
  static const WrittenText kNothing;
  EXPECT_NE(found, texts.end()) << utf8;
  return found == texts.end() ? kNothing : *found;
}

TEST(TextTable, CellsStandBelowTheirColumnsName) {
  const std::vector<WrittenText> texts = Write(MakeTable(), kWide_px);
  EXPECT_EQ(texts.size(), 1u + 2u + 4u);
  const WrittenText& name = Find(texts, "RMSE, ppm");
  const WrittenText& first = Find(texts, "14.9 \u00B1 1.9");
  const WrittenText& second = Find(texts, "\u2013");
  EXPECT_EQ(first.baseline.x, name.baseline.x);
  EXPECT_EQ(second.baseline.x, name.baseline.x);
  EXPECT_LT(name.baseline.y, first.baseline.y);
  EXPECT_LT(first.baseline.y, second.baseline.y);
  EXPECT_EQ(Find(texts, "XIT").baseline.y, first.baseline.y);
  EXPECT_LT(Find(texts, "Rows \u00B1 sd").baseline.y, name.baseline.y);
}

TEST(TextTable, ATableThatFitsStaysInItsBox) {
  const std::optional<double> height_px = TextTableHeight_px(MakeTable(), kWide_px);
  ASSERT_TRUE(height_px.has_value());
  for (const WrittenText& text : Write(MakeTable(), kWide_px)) {
    EXPECT_LE(text.right(), kLeft_px + kWide_px) << text.utf8;
    EXPECT_LE(text.baseline.y, kTop_px + *height_px) << text.utf8;
  }
}

TEST(TextTable, EveryRowTakesTheSameRoom) {
  TextTable table = MakeTable();
  const double two_px = TextTableHeight_px(table, kWide_px).value_or(0.0);
  table.rows.push_back({"a", "b"});
  const double three_px = TextTableHeight_px(table, kWide_px).value_or(0.0);
  table.rows.push_back({"a", "b"});
  EXPECT_GT(three_px, two_px);
  EXPECT_DOUBLE_EQ(TextTableHeight_px(table, kWide_px).value_or(0.0), three_px + three_px - two_px);
}

TEST(TextTable, ATableThatIsTooWideIsNotDrawn) {
  constexpr double kNarrow_px = 80.0;
  EXPECT_FALSE(TextTableHeight_px(MakeTable(), kNarrow_px).has_value());
  EXPECT_THAT(Write(MakeTable(), kNarrow_px), IsEmpty());
}

TEST(TextTable, ATableWithoutColumnsIsNotDrawn) {
  EXPECT_FALSE(TextTableHeight_px({}, kWide_px).has_value());
  EXPECT_THAT(Write({"title", {}, {}}, kWide_px), IsEmpty());
}

TEST(TextTable, ATableWithoutRowsHasItsHeader) {
  const TextTable table{"title", {"row", "RMSE"}, {}};
  EXPECT_TRUE(TextTableHeight_px(table, kWide_px).has_value());
  EXPECT_EQ(Write(table, kWide_px).size(), 3u);
}

TEST(TextTable, ALongNameTakesSeveralLinesOverShortCells) {
  const TextTable plain{"", {"row", "share"}, {{"a", "1"}}};
  const TextTable table{"", {"row", "share of the gain that the oracle has over it"}, {{"a", "1"}}};
  constexpr double kTight_px = 160.0;
  EXPECT_GT(TextTableHeight_px(table, kTight_px).value_or(0.0),
            TextTableHeight_px(plain, kTight_px).value_or(0.0));
  const std::vector<WrittenText> texts = Write(table, kTight_px);
  EXPECT_GT(texts.size(), Write(plain, kTight_px).size());
  double lowest = 0.0;
  for (const WrittenText& text : texts) {
    EXPECT_LE(text.right(), kLeft_px + kTight_px) << text.utf8;
    if (text.utf8 != "a" && text.utf8 != "1") lowest = std::max(lowest, text.baseline.y);
  }
  EXPECT_EQ(Find(texts, "row").baseline.y, lowest);  // next to the cells
  EXPECT_LT(lowest, Find(texts, "1").baseline.y);
}

TEST(TextTable, RowsOfOtherLengthAreDrawnAsFarAsThereAreColumns) {
  const TextTable table{"", {"row", "RMSE"}, {{"short"}, {"long", "1", "beyond"}}};
  const std::vector<WrittenText> texts = Write(table, kWide_px);
  EXPECT_EQ(texts.size(), 1u + 2u + 1u + 2u);
}

}  // namespace text_table_test
}  // namespace plumescout::lab
