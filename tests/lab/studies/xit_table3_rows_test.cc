// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/xit_table3_rows.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace plumescout::lab {
namespace xit_table3_rows_test {

TEST(Table3Rows, StandWhereTheirNumbersSay) {
  const auto rows = Table3Rows();
  ASSERT_EQ(rows.size(), 11u);
  EXPECT_STREQ(rows[kPaperBaseline].name, "rrt_star_frontier");
  EXPECT_STREQ(rows[kPaperBest].name, "xit_gff_ucb");
  EXPECT_STREQ(rows[kStrongBaseline].name, "rrt_star_frontier_ours");
  EXPECT_STREQ(rows[kOwnStrategy].name, "plumescout");
  std::set<std::string> names;
  for (const Table3Row& row : rows) EXPECT_TRUE(names.insert(row.name).second) << row.name;
}

TEST(Table3Rows, ArePublishedToTheLetterOrOurs) {
  for (const Table3Row& row : Table3Rows()) {
    const auto made = MakeTable3Row(row);
    ASSERT_TRUE(made.ok()) << row.name;
    const bool ours = row.kind == RowKind::kOurs;
    const PlanningOptions& planning = made->mission.planning;
    EXPECT_EQ(planning.grid_guard, ours) << row.name;
    EXPECT_EQ(planning.goal_vertices, ours) << row.name;
    EXPECT_EQ(planning.raw_variance, !ours) << row.name;
    EXPECT_EQ(made->robot.corrects_gas_lag, ours) << row.name;
    EXPECT_EQ(planning.cost, row.expansion) << row.name;
    EXPECT_EQ(planning.selection_cost, row.selection) << row.name;
    EXPECT_EQ(made->robot.stops_without_frontier, &row == &Table3Rows()[kPaperBaseline])
        << row.name;
    EXPECT_DOUBLE_EQ(made->robot.plan_latency_s, 0.74) << row.name;  // [XIT] section VI-B
  }
}

TEST(Table3Rows, AreLabelledByMethodAndCost) {
  EXPECT_EQ(LabelOf(Table3Rows()[kPaperBest]), "XIT-GFF, UCB");
}

}  // namespace xit_table3_rows_test
}  // namespace plumescout::lab
