// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/support/team_gauntlet.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "absl/strings/str_cat.h"

namespace plumescout {
namespace fleet_gauntlet_test {

using support::Contestant;
using support::GauntletResult;
using support::Room;
using support::TeamGauntlet;

// The properties are what docs/performance.md tells.
GauntletResult RunAll(const std::string& name, double width_m, double height_m,
                      const std::vector<Room>& rooms, const std::vector<Contestant>& contestants) {
  TeamGauntlet gauntlet(width_m, height_m, rooms, contestants);
  const GauntletResult result = gauntlet.Run(120.0);
  EXPECT_TRUE(gauntlet.ok());
  ::testing::Test::RecordProperty(absl::StrCat(name, "_make_ways"), result.make_ways);
  ::testing::Test::RecordProperty(absl::StrCat(name, "_deadlocks_broken"), result.deadlocks_broken);
  ::testing::Test::RecordProperty(absl::StrCat(name, "_longest_stand_s"),
                                  absl::StrCat(result.longest_stand_s));
  ::testing::Test::RecordProperty(absl::StrCat(name, "_last_arrival_s"),
                                  absl::StrCat(result.last_arrival_s));
  EXPECT_EQ(result.contacts, 0);
  EXPECT_EQ(result.unresolved, 0);
  return result;
}

// Dead-end rooms on both sides of a corridor of 1 m.
std::vector<Room> Comb(int rooms) {
  std::vector<Room> comb = {{{0.3, 3.0}, {0.3 + 3.0 * rooms, 4.0}}};
  for (int i = 0; i < rooms; ++i) {
    const double x_m = 0.3 + 3.0 * i;
    comb.push_back({{x_m, 0.3}, {x_m + 2.7, 2.7}});
    comb.push_back({{x_m + 0.9, 2.6}, {x_m + 1.8, 3.1}});
  }
  return comb;
}

TEST(TeamGauntlet, RobotsInDeadEndRoomsOnAOneLaneCorridorChangePlaces) {
  for (const int rooms : {2, 4}) {
    std::vector<Contestant> all;
    for (int i = 0; i < rooms; ++i) {
      all.push_back({absl::StrCat("r", i),
                     {1.65 + 3.0 * i, 1.55},
                     Point2{1.65 + 3.0 * (rooms - 1 - i), 1.55}});
    }
    EXPECT_EQ(
        RunAll(absl::StrCat("comb_", rooms), 3.0 * rooms + 0.6, 4.3, Comb(rooms), all).arrivals,
        rooms)
        << rooms;
  }
}

TEST(TeamGauntlet, HallsWithOneDoorAreChanged) {
  const std::vector<Room> halls = {
      {{0.3, 0.3}, {6.0, 6.3}}, {{6.3, 0.3}, {12.0, 6.3}}, {{5.9, 2.8}, {6.4, 3.7}}};
  for (const int side : {1, 2, 4}) {
    std::vector<Contestant> all;
    for (int i = 0; i < side; ++i) {
      const double y_m = 3.25 + 1.3 * (i - 0.5 * (side - 1));
      all.push_back({absl::StrCat("w", i), {2.05, y_m}, Point2{10.05, y_m}});
      all.push_back({absl::StrCat("e", i), {10.05, y_m}, Point2{2.05, y_m}});
    }
    EXPECT_EQ(RunAll(absl::StrCat("halls_", side), 12.3, 6.6, halls, all).arrivals, 2 * side)
        << side;
  }
}

TEST(TeamGauntlet, WhoIsParkedInTheMouthOfADeadEndLetsOthersInAndOut) {
  const std::vector<Room> rooms = {{{0.3, 0.3}, {5.0, 5.0}}, {{4.9, 2.0}, {11.0, 3.0}}};
  const std::vector<Contestant> all = {{"in", {2.05, 2.45}, Point2{10.05, 2.45}},
                                       {"parked", {5.45, 2.45}, std::nullopt}};
  EXPECT_EQ(RunAll("parked_in", 11.3, 5.3, rooms, all).arrivals, 1);
  const std::vector<Contestant> out = {{"out", {9.05, 2.45}, Point2{1.05, 2.45}},
                                       {"parked", {5.45, 2.45}, std::nullopt}};
  EXPECT_EQ(RunAll("parked_out", 11.3, 5.3, rooms, out).arrivals, 1);
}

TEST(TeamGauntlet, TwoChangePlacesAcrossADoorAndInADeadEnd) {
  const std::vector<Room> halls = {
      {{0.3, 0.3}, {4.0, 4.3}}, {{4.3, 0.3}, {8.0, 4.3}}, {{3.9, 1.8}, {4.4, 2.7}}};
  const std::vector<Contestant> across = {{"a", {3.55, 2.25}, Point2{4.75, 2.25}},
                                          {"b", {4.75, 2.25}, Point2{3.55, 2.25}}};
  EXPECT_EQ(RunAll("door_swap", 8.3, 4.6, halls, across).arrivals, 2);
  const std::vector<Room> dead_end = {{{0.3, 0.3}, {5.0, 5.0}}, {{4.9, 2.0}, {11.0, 3.0}}};
  const std::vector<Contestant> swap = {{"a", {5.05, 2.45}, Point2{9.05, 2.45}},
                                        {"b", {9.05, 2.45}, Point2{3.05, 2.45}}};
  EXPECT_EQ(RunAll("dead_end_swap", 11.3, 5.3, dead_end, swap).arrivals, 2);
}

// Nobody can pass, and each waits for the other: somebody has to back off.
TEST(TeamGauntlet, RobotsThatMeetInAOneLaneCorridorAreTakenApart) {
  const std::vector<Room> rooms = {
      {{0.3, 0.3}, {3.3, 4.3}}, {{3.2, 1.8}, {10.4, 2.8}}, {{10.3, 0.3}, {13.3, 4.3}}};
  const std::vector<Contestant> all = {{"a1", {6.05, 2.25}, Point2{12.05, 2.25}},
                                       {"b1", {7.25, 2.25}, Point2{1.55, 2.25}},
                                       {"a2", {5.05, 2.25}, Point2{12.05, 1.05}},
                                       {"b2", {8.25, 2.25}, Point2{1.55, 3.45}}};
  for (const std::size_t count : {2, 3, 4}) {
    const std::vector<Contestant> some(all.begin(),
                                       all.begin() + static_cast<std::ptrdiff_t>(count));
    const GauntletResult result = RunAll(absl::StrCat("corridor_", count), 13.6, 4.6, rooms, some);
    EXPECT_EQ(result.arrivals, static_cast<int>(count)) << count;
    EXPECT_GE(result.deadlocks_broken, 1) << count;
  }
}

}  // namespace fleet_gauntlet_test
}  // namespace plumescout
