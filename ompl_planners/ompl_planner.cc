// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "ompl_planners/ompl_planner.h"

#include <algorithm>
#include <utility>

#include "absl/base/attributes.h"
#include "absl/synchronization/mutex.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "ompl_planners/ompl_search.h"

namespace plumescout {
namespace {

struct Named {
  OmplKind kind;
  const char* name;
};
constexpr Named kNames[] = {
    {OmplKind::kRrt, "rrt"},
    {OmplKind::kRrtStar, "rrt_star"},
    {OmplKind::kInformedRrtStar, "informed_rrt_star"},
    {OmplKind::kBitStar, "bit_star"},
    {OmplKind::kPrmStar, "prm_star"},
};

// OMPL's seed and console belong to the process.
ABSL_CONST_INIT absl::Mutex ompl_mutex(absl::kConstInit);
constexpr absl::Duration kBetweenTries = absl::Milliseconds(1);

class OmplPlanner : public PathPlanner {
 public:
  OmplPlanner(OmplKind kind, const OmplOptions& options)
      : kind_(kind), samples_(std::max(options.samples, 0)) {}

  PathResult FindPaths(const PathProblem& problem) const override {
    while (!ompl_mutex.TryLock()) {
      if (problem.stop()) {
        return {std::vector<std::optional<FoundPath>>(problem.goals.size()), PlanEnd::kStopped, {}};
      }
      absl::SleepFor(kBetweenTries);
    }
    PathResult result = SearchWithOmpl(kind_, samples_, problem);
    ompl_mutex.Unlock();
    return result;
  }

 private:
  OmplKind kind_;
  int samples_;
};

}  // namespace

const char* OmplName(OmplKind kind) {
  for (const Named& entry : kNames) {
    if (entry.kind == kind) return entry.name;
  }
  return "unknown";
}

std::optional<OmplKind> OmplKindOf(const std::string& name) {
  for (const Named& entry : kNames) {
    if (name == entry.name) return entry.kind;
  }
  return std::nullopt;
}

std::unique_ptr<const PathPlanner> MakeOmplPlanner(OmplKind kind, const OmplOptions& options) {
  return std::make_unique<OmplPlanner>(kind, options);
}

}  // namespace plumescout
