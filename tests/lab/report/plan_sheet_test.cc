// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/plan_sheet.h"

#include <gtest/gtest.h>

#include "tests/support/small_plan_picture.h"

namespace plumescout::lab {
namespace plan_sheet_test {

TEST(PlanSheet, GrowsByARowForEachCandidateAndRejection) {
  PlanPicture picture = MakeSmallPlanPicture();
  const int height_px = DrawPlanSheet(picture).height();
  picture.plan.candidates.push_back(picture.plan.candidates[0]);
  const int with_candidate_px = DrawPlanSheet(picture).height();
  picture.plan.rejected.push_back(picture.plan.rejected[0]);
  const int with_both_px = DrawPlanSheet(picture).height();
  EXPECT_GT(with_candidate_px, height_px);
  EXPECT_EQ(with_both_px - with_candidate_px, with_candidate_px - height_px);
}

TEST(PlanSheet, ManyRejectionsDoNotMakeItEndless) {
  PlanPicture picture = MakeSmallPlanPicture();
  picture.plan.rejected.resize(kListedRejections + 1, picture.plan.rejected[0]);
  const int height_px = DrawPlanSheet(picture).height();
  picture.plan.rejected.resize(1000, picture.plan.rejected[0]);
  EXPECT_EQ(DrawPlanSheet(picture).height(), height_px);
}

TEST(PlanSheet, ShowsWhichCandidateIsChosen) {
  PlanPicture picture = MakeSmallPlanPicture();
  const Image second = DrawPlanSheet(picture);
  picture.plan.chosen = 0;
  EXPECT_NE(DrawPlanSheet(picture), second);
}

TEST(PlanSheet, DrawsAPlanWithoutAnything) {
  PlanPicture picture = MakeSmallPlanPicture();
  picture.plan = {};
  picture.tree.clear();
  EXPECT_GT(DrawPlanSheet(picture).height(), 0);
}

}  // namespace plan_sheet_test
}  // namespace plumescout::lab
