// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "ompl_planners/ompl_planner.h"

#include <gtest/gtest.h>

#include <atomic>
#include <set>
#include <string>
#include <thread>

#include "tests/support/path_case.h"

namespace plumescout {
namespace {

using testing::PathCase;

constexpr OmplKind kKinds[] = {OmplKind::kRrt, OmplKind::kRrtStar, OmplKind::kInformedRrtStar,
                               OmplKind::kBitStar, OmplKind::kPrmStar};

TEST(OmplPlanner, KindsAndNamesBelongTogether) {
  std::set<std::string> names;
  for (const OmplKind kind : kKinds) {
    EXPECT_EQ(OmplKindOf(OmplName(kind)), kind);
    names.insert(OmplName(kind));
  }
  EXPECT_EQ(names, (std::set<std::string>{"rrt", "rrt_star", "informed_rrt_star", "bit_star",
                                          "prm_star"}));
  EXPECT_EQ(OmplKindOf("lazy_prm_star"), std::nullopt);
  EXPECT_EQ(OmplKindOf(""), std::nullopt);
}

TEST(OmplPlanner, OfEveryKindFindsPaths) {
  const PathCase c(3);
  for (const OmplKind kind : kKinds) {
    const PathResult result = MakeOmplPlanner(kind, {})->FindPaths(c.Problem());
    EXPECT_EQ(result.end, PlanEnd::kAllGoalsReached) << OmplName(kind);
  }
}

TEST(OmplPlanner, TakesANumberOfSamplesBelowZeroForZero) {
  const PathCase c(3);
  for (const OmplKind kind : kKinds) {
    const PathResult result = MakeOmplPlanner(kind, {.samples = -7})->FindPaths(c.Problem());
    EXPECT_EQ(result.paths.size(), c.goals.size()) << OmplName(kind);
  }
}

TEST(OmplPlanner, GivesTheSameBytesWhenManyThreadsSearchAtOnce) {
  const PathCase c(4);
  const auto planner = MakeOmplPlanner(OmplKind::kRrtStar, {.samples = 200});
  const PathResult alone = planner->FindPaths(c.Problem());
  std::vector<PathResult> results(4);
  std::vector<std::thread> threads;
  for (PathResult& result : results) {
    threads.emplace_back([&] { result = planner->FindPaths(c.Problem()); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const PathResult& result : results) EXPECT_EQ(result.paths, alone.paths);
}

TEST(OmplPlanner, ThatWaitsForAnotherSearchHonoursItsStopFunction) {
  const auto planner = MakeOmplPlanner(OmplKind::kRrtStar, {.samples = 1'000'000});
  std::atomic<bool> searching = false;
  std::atomic<bool> enough = false;
  PathCase first(5);
  first.stop = [&] {
    searching = true;
    return enough.load();
  };
  std::thread busy([&] { planner->FindPaths(first.Problem()); });
  while (!searching) std::this_thread::yield();
  PathCase second(6);
  second.stop = [] { return true; };
  const PathResult result = planner->FindPaths(second.Problem());
  EXPECT_EQ(result.end, PlanEnd::kStopped);
  EXPECT_EQ(result.paths, std::vector<std::optional<FoundPath>>(second.goals.size()));
  enough = true;
  busy.join();
}

}  // namespace
}  // namespace plumescout
