// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/sim/company.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <thread>
#include <utility>
#include <vector>

namespace plumescout::lab {
namespace company_test {

// Every robot acts `acts` times, `period` ns apart, and notes who it was and when. Only the company
// keeps them from doing so at once.
std::vector<std::pair<std::int64_t, int>> KeepDiary(const std::vector<std::int64_t>& periods_ns,
                                                    int acts) {
  Company company(static_cast<int>(periods_ns.size()), true);
  std::vector<std::pair<std::int64_t, int>> diary;
  std::vector<std::thread> threads;
  for (int robot = 0; robot < static_cast<int>(periods_ns.size()); ++robot) {
    threads.emplace_back([&, robot] {
      for (int i = 0; i < acts; ++i) {
        const std::int64_t time_ns = i * periods_ns[static_cast<std::size_t>(robot)];
        company.AwaitTurn(robot, time_ns);
        diary.emplace_back(time_ns, robot);
      }
      company.Leave(robot);
    });
  }
  for (std::thread& thread : threads) thread.join();
  return diary;
}

TEST(CompanyTest, RobotsActInTheOrderOfTimeAndOfTheirNumbers) {
  const auto diary = KeepDiary({10, 10, 7}, 200);
  ASSERT_EQ(diary.size(), 600u);
  EXPECT_TRUE(std::is_sorted(diary.begin(), diary.end()));
}

TEST(CompanyTest, NobodyWaitsForARobotThatHasLeft) {
  Company company(2, true);
  company.Leave(0);
  company.AwaitTurn(1, 1'000'000);  // returns
  SUCCEED();
}

TEST(CompanyTest, OutOfLockstepNobodyWaits) {
  Company company(2, false);
  company.AwaitTurn(1, 1'000'000);  // robot 0 is at 0
  SUCCEED();
}

TEST(CompanyTest, KnowsWhereTheOthersStand) {
  Company company(3, true);
  EXPECT_TRUE(company.Others(0).empty());
  company.Stand(2, {{2.0, 0.0}, 0.3});
  company.Stand(0, {{0.0, 0.0}, 0.1});
  EXPECT_EQ(company.Others(1), (std::vector<Body>{{{0.0, 0.0}, 0.1}, {{2.0, 0.0}, 0.3}}));
  EXPECT_EQ(company.Others(0), (std::vector<Body>{{{2.0, 0.0}, 0.3}}));
  EXPECT_EQ(company.Nearest_m(0), 2.0);
  EXPECT_EQ(company.Nearest_m(1), std::numeric_limits<double>::infinity()) << "it has no body yet";
}

TEST(CompanyTest, RemembersHowCloseTheyCame) {
  Company company(2, true);
  EXPECT_EQ(company.closest_m(), std::numeric_limits<double>::infinity());
  company.Stand(0, {{0.0, 0.0}, 0.1});
  company.Stand(1, {{3.0, 4.0}, 0.1});
  company.Stand(1, {{0.0, 1.5}, 0.1});
  company.Stand(1, {{0.0, 9.0}, 0.1});
  EXPECT_EQ(company.closest_m(), 1.5);
}

constexpr std::int64_t kSecond_ns = 1'000'000'000;

TEST(CompanyTest, BodiesBlockEachOther) {
  Company company(3, true);
  EXPECT_TRUE(company.MayMoveTo(0, {0.0, 0.0}, 0)) << "it has no body yet";
  company.Stand(0, {{0.0, 0.0}, 0.2});
  company.Stand(1, {{1.0, 0.0}, 0.3});
  EXPECT_TRUE(company.MayMoveTo(0, {0.5, 0.0}, 0)) << "they touch and no more";
  EXPECT_EQ(company.contacts(), 0);
  EXPECT_FALSE(company.MayMoveTo(0, {0.51, 0.0}, kSecond_ns));
  EXPECT_EQ(company.contacts(), 1);
  for (const int robot : {0, 1}) {
    EXPECT_FALSE(company.MayMoveTo(robot, {-3.0, 3.0}, 2 * kSecond_ns - 1)) << robot;
    EXPECT_TRUE(company.MayMoveTo(robot, {-3.0, 3.0}, 2 * kSecond_ns)) << robot;
  }
  EXPECT_EQ(company.contacts(), 1) << "who is held runs into nobody";
}

TEST(CompanyTest, BodiesThatOverlapMayPart) {
  Company company(2, true);
  company.Stand(0, {{0.0, 0.0}, 0.3});
  company.Stand(1, {{0.4, 0.0}, 0.3});
  EXPECT_TRUE(company.MayMoveTo(0, {-0.1, 0.0}, 0));
  EXPECT_FALSE(company.MayMoveTo(0, {0.1, 0.0}, 0));
}

}  // namespace company_test
}  // namespace plumescout::lab
