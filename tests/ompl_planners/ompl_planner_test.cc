// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "ompl_planners/ompl_planner.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "core/plan/paths/path_planners.h"
#include "tests/support/path_case.h"

namespace plumescout {
namespace ompl_planner_test {

using testing::PathCase;

constexpr PathKind kKinds[] = {PathKind::kRrt, PathKind::kRrtStar, PathKind::kInformedRrtStar,
                               PathKind::kBitStar, PathKind::kPrmStar};

PlanningOptions Options(PathKind kind, int samples = 1000) {
  PlanningOptions options;
  options.paths = kind;
  options.sample_count = samples;
  return options;
}

TEST(OmplPlanner, IsNoneForOurOwnKinds) {
  for (const PathKind kind : {PathKind::kXit, PathKind::kAnytimeXit, PathKind::kGridExact}) {
    EXPECT_EQ(MakeOmplPlanner(Options(kind)), nullptr);
  }
}

TEST(OmplPlanner, OfEveryKindFindsPaths) {
  const PathCase c(3);
  for (const PathKind kind : kKinds) {
    const PathResult result = MakeOmplPlanner(Options(kind))->FindPaths(c.Problem());
    EXPECT_EQ(result.end, PlanEnd::kAllGoalsReached) << PathKindName(kind);
  }
}

TEST(OmplPlanner, TakesANumberOfSamplesBelowZeroForZero) {
  const PathCase c(3);
  for (const PathKind kind : kKinds) {
    const PathResult result = MakeOmplPlanner(Options(kind, -7))->FindPaths(c.Problem());
    EXPECT_EQ(result.paths.size(), c.goals.size()) << PathKindName(kind);
  }
}

TEST(OmplPlanner, GivesTheSameBytesWhenManyThreadsSearchAtOnce) {
  const PathCase c(4);
  const auto planner = MakeOmplPlanner(Options(PathKind::kRrtStar, 200));
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
  const auto planner = MakeOmplPlanner(Options(PathKind::kRrtStar, 1'000'000));
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

}  // namespace ompl_planner_test
}  // namespace plumescout
