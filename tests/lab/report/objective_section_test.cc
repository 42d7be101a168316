// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/objective_section.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "absl/strings/str_format.h"
#include "lab/report/figures.h"
#include "lab/report/palette.h"
#include "tests/support/small_report.h"

namespace plumescout::lab {
namespace objective_section_test {

using ::testing::Contains;
using ::testing::Field;
using ::testing::Not;

// The table's only row, by the names of its columns.
std::map<std::string, std::string> RowOf(const ObjectiveOutcome& outcome) {
  const TextTable table = ObjectiveTable(outcome, MakeSmallReport().map);
  EXPECT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0].size(), table.columns.size());
  std::map<std::string, std::string> row;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    row[table.columns[i]] = table.rows[0][i];
  }
  return row;
}

ObjectiveOutcome OutcomeOf(ObjectiveKind kind, ObjectiveState state) {
  ObjectiveOutcome outcome = MakeSmallOutcome(MakeSmallReport());
  outcome.asked.kind = kind;
  outcome.status.state = state;
  return outcome;
}

TEST(ObjectiveTable, SaysWhatWasAskedAndWhatCameOfItAndHowSureThatIs) {
  auto row = RowOf(OutcomeOf(ObjectiveKind::kConfirmClean, ObjectiveState::kRefuted));
  EXPECT_EQ(row["objective"], "confirm that there is nowhere more than 12.5 ppm, 95 % sure");
  EXPECT_EQ(row["outcome"], "refuted");
  EXPECT_EQ(row["confidence"], "98 %");
  EXPECT_EQ(row["when"], "after 84 s");
}

TEST(ObjectiveTable, AreasAreOfAllThatCounts) {
  auto row = RowOf(OutcomeOf(ObjectiveKind::kConfirmClean, ObjectiveState::kRefuted));
  // 9 x 8 cells of 0.25 m2 inside the walls.
  EXPECT_EQ(row["below 12.5 ppm"], "15.2 m\u00B2 (84.7 %)");
  EXPECT_EQ(row["above 12.5 ppm"], "2.2 m\u00B2 (12.5 %)");
  EXPECT_EQ(row["undecided, measured"], "0.2 m\u00B2 (1.4 %)");
  EXPECT_EQ(row["undecided, not measured"], "0.2 m\u00B2 (1.4 %)");
}

TEST(ObjectiveTable, WhatIsDecidedOfAMapLiesOnOneOfTwoSides) {
  const ReportData data = MakeSmallReport();
  ObjectiveOutcome outcome = OutcomeOf(ObjectiveKind::kMapAboveThreshold, ObjectiveState::kMet);
  for (ObjectiveVerdict& verdict : outcome.verdicts.values()) {
    if (verdict == ObjectiveVerdict::kRefuted) verdict = ObjectiveVerdict::kDecided;
  }
  std::size_t above = 0;
  for (std::size_t i = 0; i < outcome.verdicts.size(); ++i) {
    const bool is_decided = outcome.verdicts[i] == ObjectiveVerdict::kDecided;
    if (is_decided && data.map.gas_mean_ppm[i] > 12.5F) ++above;
  }
  auto row = RowOf(outcome);
  EXPECT_EQ(row["objective"], "map where there is more than 12.5 ppm, 95 % sure");
  EXPECT_EQ(row["above 12.5 ppm"].substr(0, 4),
            absl::StrFormat("%.1f", 0.25 * static_cast<double>(above)).substr(0, 4));
}

TEST(ObjectiveTable, EveryKindAndStateHasItsWords) {
  auto row = RowOf(OutcomeOf(ObjectiveKind::kFindSources, ObjectiveState::kCannotBeMet));
  EXPECT_EQ(row["objective"], "find the strongest place, if it is above 12.5 ppm, 95 % sure");
  EXPECT_EQ(row["outcome"], "the mission ended before");
  EXPECT_EQ(row["confidence"], "98 % at 1.8, 4.8, the most doubtful place");
  EXPECT_EQ(RowOf(OutcomeOf(ObjectiveKind::kFindSources, ObjectiveState::kMet))["outcome"], "met");
}

TEST(ObjectiveTable, WhatIsOpenHasNoTime) {
  ObjectiveOutcome outcome = OutcomeOf(ObjectiveKind::kFindSources, ObjectiveState::kPursued);
  outcome.status.place.reset();
  auto row = RowOf(outcome);
  EXPECT_EQ(row["outcome"], "still open");
  EXPECT_EQ(row["confidence"], "nothing is known");
  EXPECT_EQ(row["when"], "");
}

TEST(ObjectiveTable, NothingThatCountsHasNoArea) {
  ObjectiveOutcome outcome = OutcomeOf(ObjectiveKind::kConfirmClean, ObjectiveState::kPursued);
  std::fill(outcome.verdicts.values().begin(), outcome.verdicts.values().end(),
            ObjectiveVerdict::kDoesNotCount);
  EXPECT_EQ(RowOf(outcome)["undecided, measured"], "none");
}

// Colour that the panel shows of a cell.
Rgb ColorOf(const MapPanel& panel, Cell cell) {
  const Image& image = panel.cells.image;
  return image.At(cell.x, image.height() - 1 - cell.y);
}

TEST(ObjectivePanel, EveryVerdictHasItsColor) {
  const ReportData data = MakeSmallReport();
  const MapPanel panel =
      ObjectivePanel(MakeSmallOutcome(data), data.map, RegionOf(data.map.occupancy.geometry()));
  EXPECT_EQ(ColorOf(panel, {5, 5}), kJudgedRefutedColor);
  EXPECT_EQ(ColorOf(panel, {8, 8}), kJudgedBelowColor);
  EXPECT_EQ(ColorOf(panel, {1, 1}), kNotMeasuredColor);
  EXPECT_EQ(ColorOf(panel, {2, 1}), kJudgedUndecidedColor);
  EXPECT_EQ(ColorOf(panel, {0, 5}), kWallColor);
  EXPECT_EQ(ColorOf(panel, {15, 5}), kUnknownColor);
}

TEST(ObjectivePanel, MarksThePlacesThatAreSpokenOf) {
  const ReportData data = MakeSmallReport();
  const Rectangle region = RegionOf(data.map.occupancy.geometry());
  ObjectiveOutcome outcome = MakeSmallOutcome(data);
  EXPECT_THAT(ObjectivePanel(outcome, data.map, region).legend,
              Contains(Field(&LegendEntry::name, "clearest place")));
  outcome.status.state = ObjectiveState::kPursued;
  EXPECT_THAT(ObjectivePanel(outcome, data.map, region).legend,
              Contains(Field(&LegendEntry::name, "most doubtful place")));
  outcome.status.state = ObjectiveState::kMet;
  outcome.status.strongest = Point2{2.0, 5.0};
  const MapPanel met = ObjectivePanel(outcome, data.map, region);
  EXPECT_THAT(met.legend, Contains(Field(&LegendEntry::name, "strongest place")));
  EXPECT_THAT(met.legend, Not(Contains(Field(&LegendEntry::name, "most doubtful place"))));
  ASSERT_EQ(met.marks.size(), 1u);
  EXPECT_EQ(met.marks[0].position, (Point2{2.0, 5.0}));
}

TEST(ObjectivePanel, StandsAmongTheMapsOfAReport) {
  ReportData data = MakeSmallReport();
  data.objective = MakeSmallOutcome(data);
  const auto panels = MakeMapPanels(data);
  ASSERT_EQ(panels.size(), 5u);
  EXPECT_EQ(panels[4].title, "Objective");
}

}  // namespace objective_section_test
}  // namespace plumescout::lab
