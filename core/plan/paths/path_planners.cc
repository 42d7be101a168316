// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/path_planners.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "core/plan/paths/anytime_xit.h"
#include "core/plan/paths/grid_exact.h"
#include "core/plan/paths/guarded_planner.h"
#include "core/plan/paths/xit.h"

namespace plumescout {
namespace {

std::unique_ptr<const PathPlanner> Guarded(std::unique_ptr<const PathPlanner> planner,
                                           const PlanningOptions& options) {
  return std::make_unique<const GuardedPlanner>(std::move(planner), options);
}

}  // namespace

absl::string_view PathKindName(PathKind kind) {
  switch (kind) {
    case PathKind::kXit:
      return "xit";
    case PathKind::kAnytimeXit:
      return "anytime_xit";
    case PathKind::kGridExact:
      return "grid_exact";
    case PathKind::kRrt:
      return "rrt";
    case PathKind::kRrtStar:
      return "rrt_star";
    case PathKind::kInformedRrtStar:
      return "informed_rrt_star";
    case PathKind::kBitStar:
      return "bit_star";
    case PathKind::kPrmStar:
      return "prm_star";
  }
  return "";
}

absl::StatusOr<std::unique_ptr<const PathPlanner>> MakePathPlanner(
    const PlanningOptions& options, const PathPlannerFactory& others) {
  switch (options.paths) {
    case PathKind::kXit:
      return Guarded(std::make_unique<const XitPlanner>(options), options);
    case PathKind::kAnytimeXit:
      return std::make_unique<const AnytimeXitPlanner>(options);
    case PathKind::kGridExact:
      return std::make_unique<const GridExactPlanner>();
    default:
      break;
  }
  auto planner = others ? others(options) : nullptr;
  if (planner == nullptr) {
    return absl::InvalidArgumentError(
        absl::StrCat("planning.paths = ", PathKindName(options.paths),
                     " is not available here: the planners of OMPL are off"));
  }
  return Guarded(std::move(planner), options);
}

}  // namespace plumescout
