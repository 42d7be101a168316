// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "ompl_planners/ompl_planner.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "absl/base/attributes.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "ompl_planners/ompl_search.h"

namespace plumescout {
namespace {

// OMPL's seed and console belong to the process.
ABSL_CONST_INIT absl::Mutex ompl_mutex(absl::kConstInit);
constexpr absl::Duration kBetweenTries = absl::Milliseconds(1);

using Search = std::function<PathResult(const PathProblem&)>;

class OmplPlanner : public PathPlanner {
 public:
  explicit OmplPlanner(Search search) : search_(std::move(search)) {}

  PathResult FindPaths(const PathProblem& problem) const override {
    while (!ompl_mutex.TryLock()) {
      if (problem.stop()) {
        return {std::vector<std::optional<FoundPath>>(problem.goals.size()), PlanEnd::kStopped, {}};
      }
      absl::SleepFor(kBetweenTries);
    }
    PathResult result = search_(problem);
    ompl_mutex.Unlock();
    return result;
  }

 private:
  Search search_;
};

}  // namespace

std::unique_ptr<const PathPlanner> MakeOmplPlanner(const PlanningOptions& options) {
  switch (options.paths) {
    case PathKind::kRrt:
    case PathKind::kRrtStar:
    case PathKind::kInformedRrtStar:
    case PathKind::kBitStar:
    case PathKind::kPrmStar:
      return std::make_unique<const OmplPlanner>(
          [kind = options.paths, samples = std::max(options.sample_count, 0)](
              const PathProblem& problem) { return SearchWithOmpl(kind, samples, problem); });
    default:
      return nullptr;
  }
}

std::unique_ptr<const PathPlanner> MakeRegionTreePlanner(const RegionTreeOptions& options) {
  return std::make_unique<const OmplPlanner>(
      [options](const PathProblem& problem) { return GrowRegionTree(options, problem); });
}

}  // namespace plumescout
