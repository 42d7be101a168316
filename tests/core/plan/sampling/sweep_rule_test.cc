// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/plan/sampling/sampling_rule.h"
#include "tests/support/site_case.h"

namespace plumescout {
namespace sweep_rule_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::SiteCase;
using ::testing::SizeIs;

SamplingChoice Choose(const SiteCase& c) {
  const Sites sites = c.Find();
  const GoalQuery robot = c.Query();
  const StopFn never = NeverStop();
  const auto choice = MakeSweepRule()->Choose({robot, c.At(c.start), sites, 1, never});
  EXPECT_TRUE(choice.ok()) << choice.status();
  return choice.ok() ? *choice : SamplingChoice{};
}

// Sampled one after the other until nothing is left.
std::vector<Cell> Sweep(SiteCase c) {
  std::vector<Cell> cells;
  while (cells.size() < c.belief.occupancy->size()) {
    const SamplingChoice choice = Choose(c);
    if (choice.errands.empty()) break;
    EXPECT_THAT(choice.errands[0].stops, SizeIs(1));
    cells.push_back(choice.errands[0].stops[0].cell);
    testing::SetSampled(c.belief, {cells.back()});
  }
  return cells;
}

TEST(SweepRule, GoesUpOneLegAndDownTheNext) {
  EXPECT_THAT(Sweep(SiteCase(testing::OpenArt(3, 2))),
              ElementsAre(Cell{0, 0}, Cell{1, 0}, Cell{2, 0}, Cell{2, 1}, Cell{1, 1}, Cell{0, 1}));
}

TEST(SweepRule, BeginsAtTheCornerWhereTheRobotWasFirst) {
  EXPECT_EQ(Sweep(SiteCase(testing::OpenArt(5, 5, {4, 0}))).front(), (Cell{4, 0}));
  EXPECT_EQ(Sweep(SiteCase(testing::OpenArt(5, 5, {1, 4}))).front(), (Cell{0, 4}));
  EXPECT_EQ(Sweep(SiteCase(testing::OpenArt(5, 5, {3, 3}))).front(), (Cell{4, 4}));
  SiteCase c(testing::OpenArt(5, 5));
  c.belief.robots["r"].first_place = c.At({4, 4});
  EXPECT_EQ(Sweep(c).front(), (Cell{4, 4})) << "though it is somewhere else now";
}

TEST(SweepRule, StridesAlongAndAcrossItsLegs) {
  SiteCase c(testing::OpenArt(5, 3));
  c.options.sites.sweep_stride = 2;
  c.options.sites.sweep_leg_stride = 2;
  EXPECT_THAT(Sweep(c),
              ElementsAre(Cell{0, 0}, Cell{2, 0}, Cell{4, 0}, Cell{4, 2}, Cell{2, 2}, Cell{0, 2}));
}

TEST(SweepRule, PassesOverWhatCannotBeReached) {
  const testing::GridArt art = {"...",  //
                                ".#.",  //
                                "S.."};
  EXPECT_THAT(Sweep(SiteCase(art)), SizeIs(8));
}

TEST(SweepRule, SaysWhereInTheSweepItIs) {
  SiteCase c(testing::OpenArt(3, 2));
  testing::SetSampled(c.belief, {{0, 0}, {1, 0}});
  EXPECT_THAT(Choose(c).merit, HasSubstr("site 3 of 6"));
  EXPECT_EQ(Choose(c).phase, MissionPhase::kSampling);
}

TEST(SweepRule, HasNothingLeftAtItsEnd) {
  SiteCase c(testing::OpenArt(1, 1));
  testing::SetSampled(c.belief, {{0, 0}});
  EXPECT_THAT(Choose(c).errands, IsEmpty());
}

}  // namespace sweep_rule_test
}  // namespace plumescout
