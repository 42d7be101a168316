// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "core/plan/paths/path_planner.h"
#include "core/types/options.h"
#include "ompl_planners/region_tree.h"

namespace plumescout {

// The public planners that ours are compared with, of the Open Motion Planning Library 1.5, under
// our EdgeCost and its exact walk: that of options.paths, null if it is none of them.
//
// options.sample_count states are drawn at random before a search ends: for each goal, since a tree
// knows one goal; by kPrmStar once, for the one roadmap that serves all. kRrt ends at its first
// path, kBitStar draws in batches of 100 and ends when the next would exceed the number. Of
// PathProblem:
//   start, goals  a start or goal outside the reachable cells has no path.
//   seed          settles everything: same problem, same bytes. OMPL draws its seeds from one
//                 generator a process, so searches wait for one another: one at a time.
//   budget        of edge evaluations: walks over the raster. Trees, which take the goals in
//                 order, share it evenly among the goals that are left.
//   stop          polled at every iteration, and while waiting for another search. What is not
//                 interrupted is a single iteration and, in kPrmStar, one query of the roadmap.
// PathResult::effort.vertices counts the vertices of all trees, or of the roadmap. Switches OMPL's
// console output off for the whole process.
std::unique_ptr<const PathPlanner> MakeOmplPlanner(const PlanningOptions& options);

// As above, but one tree for all goals, which ends beside them: see GrowRegionTree.
std::unique_ptr<const PathPlanner> MakeRegionTreePlanner(const RegionTreeOptions& options);

}  // namespace plumescout
