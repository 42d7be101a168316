// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/xit_table3_rows.h"

#include "absl/strings/str_cat.h"
#include "core/types/status_macros.h"
#include "lab/studies/xit_calibration.h"

namespace plumescout::lab {
namespace {

constexpr CostKind kUcb = CostKind::kUcb;
constexpr CostKind kLength = CostKind::kEuclidean;
constexpr RowKind kPublished = RowKind::kPublished;
constexpr Table3Row kRows[] = {
    {"rrt_star_frontier",
     "RRT* frontier exploration",
     "Euclidean",
     "rrt_star_frontier",
     kPublished,
     kLength,
     kLength,
     {20.0, 4.4},
     {1254, 244}},
    {"xit_f_ucb", "XIT-F", "UCB", "xit_f", kPublished, kUcb, kUcb, {17.2, 3.1}, {1088, 280}},
    {"xit_fgf_euclidean",
     "XIT-FGF",
     "Euclidean",
     "xit_fgf",
     kPublished,
     kLength,
     kLength,
     {19.1, 3.5},
     {1169, 245}},
    {"xit_fgf_ucb", "XIT-FGF", "UCB", "xit_fgf", kPublished, kUcb, kUcb, {17.9, 4.7}, {1022, 217}},
    {"xit_gff_euclidean",
     "XIT-GFF",
     "Euclidean",
     "xit_gff",
     kPublished,
     kLength,
     kLength,
     {18.3, 4.4},
     {1096, 263}},
    {"xit_gff_ucb", "XIT-GFF", "UCB", "xit_gff", kPublished, kUcb, kUcb, {14.9, 1.9}, {957, 169}},
    {"xit_fgf_euclidean_tree", "XIT-FGF", "Euclidean tree, UCB choice", "xit_fgf",
     RowKind::kReading, kLength, kUcb},
    {"xit_gff_euclidean_tree", "XIT-GFF", "Euclidean tree, UCB choice", "xit_gff",
     RowKind::kReading, kLength, kUcb},
    {"rrt_star_frontier_ours", "RRT*, then random places", "Euclidean", "rrt_star_frontier",
     RowKind::kOurs, kLength, kLength},
    {"xit_gff_ucb_ours", "XIT-GFF, our search", "UCB", "xit_gff", RowKind::kOurs, kUcb, kUcb},
    {"plumescout", "plumescout", "UCB", "plumescout", RowKind::kOurs, kUcb, kUcb},
};

absl::StatusOr<StudyRow> MakeOurs(const Table3Row& row) {
  const bool own = &row == &kRows[kOwnStrategy];
  PLUMESCOUT_ASSIGN_OR_RETURN(StudyRow made,
                              MakeStudyRow(row.name, row.strategy, /*with_the_papers_goals=*/!own));
  const TrialRobot calibrated = CalibratedRobot();
  made.robot.lidar_range_m = calibrated.lidar_range_m;
  made.robot.plan_latency_s = calibrated.plan_latency_s;
  return made;
}

absl::StatusOr<StudyRow> MakePublished(const Table3Row& row) {
  PLUMESCOUT_ASSIGN_OR_RETURN(StudyRow made, MakePublishedRow(row.name, row.strategy));
  made.robot = CalibratedRobot();
  made.robot.stops_without_frontier = &row == &kRows[kPaperBaseline];
  made.mission.planning.cost = row.expansion;
  made.mission.planning.selection_cost = row.selection;
  return made;
}

}  // namespace

std::span<const Table3Row> Table3Rows() { return kRows; }

std::string LabelOf(const Table3Row& row) { return absl::StrCat(row.method, ", ", row.cost); }

absl::StatusOr<StudyRow> MakeTable3Row(const Table3Row& row) {
  return row.kind == RowKind::kOurs ? MakeOurs(row) : MakePublished(row);
}

}  // namespace plumescout::lab
