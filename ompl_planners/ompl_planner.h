// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "core/plan/paths/path_planner.h"

namespace plumescout {

// The public planners that ours are compared with, of the Open Motion Planning Library 1.5.
enum class OmplKind { kRrt, kRrtStar, kInformedRrtStar, kBitStar, kPrmStar };

struct OmplOptions {
  // States drawn at random before a search ends: for each goal, since a tree knows one goal; by
  // kPrmStar once, for the one roadmap that serves all. kRrt ends at its first path, kBitStar draws
  // in batches of 100 and ends when the next would exceed the number. Below 0 counts as 0.
  int samples = 1000;
};

// "rrt", "rrt_star", "informed_rrt_star", "bit_star", "prm_star".
const char* OmplName(OmplKind kind);
std::optional<OmplKind> OmplKindOf(const std::string& name);

// OMPL under our EdgeCost and its exact walk. Of PathProblem:
//   start, goals  a start or goal outside the reachable cells has no path.
//   seed          settles everything: same problem, same bytes. OMPL draws its seeds from one
//                 generator a process, so searches wait for one another: one at a time.
//   budget        of edge evaluations: walks over the raster. Trees, which take the goals in
//                 order, share it evenly among the goals that are left.
//   stop          polled at every iteration, and while waiting for another search. What is not
//                 interrupted is a single iteration and, in kPrmStar, one query of the roadmap.
// PathResult::effort.vertices counts the vertices of all trees, or of the roadmap. Switches OMPL's
// console output off for the whole process.
std::unique_ptr<const PathPlanner> MakeOmplPlanner(OmplKind kind, const OmplOptions& options);

}  // namespace plumescout
