// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/plan_panels.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/small_plan_picture.h"

namespace plumescout::lab {
namespace plan_panels_test {

std::vector<std::string> Labels(const MapPanel& panel) {
  std::vector<std::string> labels;
  for (const MapMark& mark : panel.marks) {
    if (!mark.label.empty()) labels.push_back(mark.label);
  }
  return labels;
}

bool HasLine(const MapPanel& panel, const std::vector<Point2>& points, double least_width_px) {
  return std::any_of(panel.lines.begin(), panel.lines.end(), [&](const MapLine& line) {
    return line.points == points && line.stroke.width_px >= least_width_px;
  });
}

TEST(PlanPanels, TheFieldShowsEveryEdgeOfTheTree) {
  const PlanPicture picture = MakeSmallPlanPicture();
  const MapPanel panel = MakePlanPanels(picture)[0];
  for (const auto& [parent, child] : picture.tree) EXPECT_TRUE(HasLine(panel, {parent, child}, 1));
  EXPECT_TRUE(panel.color_bar.has_value());
}

TEST(PlanPanels, ThePathsAreAllThereAndTheChosenOneIsThick) {
  const PlanPicture picture = MakeSmallPlanPicture();
  const MapPanel panel = MakePlanPanels(picture)[1];
  const Plan& plan = picture.plan;
  EXPECT_TRUE(HasLine(panel, plan.candidates[0].path, 1.0));
  EXPECT_FALSE(HasLine(panel, plan.candidates[0].path, 4.5));
  const auto chosen = std::find_if(panel.lines.begin(), panel.lines.end(), [](const MapLine& line) {
    return line.stroke.color == kChosenPathColor;
  });
  ASSERT_NE(chosen, panel.lines.end());
  EXPECT_EQ(chosen->points, plan.candidates[1].path);
}

TEST(PlanPanels, GoalsAreLabelledInTheOrderOfTheTables) {
  EXPECT_EQ(Labels(MakePlanPanels(MakeSmallPlanPicture())[1]),
            (std::vector<std::string>{"1", "2", "a"}));
}

TEST(PlanPanels, OnlyTheChosenGoalIsStressed) {
  for (const MapMark& mark : MakePlanPanels(MakeSmallPlanPicture())[1].marks) {
    EXPECT_EQ(mark.stressed, mark.label == "2") << mark.label;
  }
}

TEST(PlanPanels, OfManyRejectedGoalsTheLastHaveNoLetters) {
  PlanPicture picture = MakeSmallPlanPicture();
  picture.plan.rejected.resize(kListedRejections + 3, picture.plan.rejected[0]);
  const MapPanel panel = MakePlanPanels(picture)[1];
  EXPECT_EQ(Labels(panel).size(), 2 + kListedRejections);
  EXPECT_EQ(panel.marks.size(), 1 + 2 + kListedRejections + 3);  // the robot has none either
}

TEST(PlanPanels, APlanToStayHasNoThickPath) {
  PlanPicture picture = MakeSmallPlanPicture();
  picture.plan.candidates.clear();
  picture.plan.chosen = -1;
  for (const MapLine& line : MakePlanPanels(picture)[1].lines) {
    EXPECT_FALSE(line.stroke.color == kChosenPathColor);
  }
}

}  // namespace plan_panels_test
}  // namespace plumescout::lab
