// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>

#include "core/plan/paths/path_planner.h"
#include "core/types/pose2.h"
#include "core/types/rng.h"
#include "ompl_planners/cell_sampler.h"
#include "ompl_planners/search_meter.h"

namespace ompl::base {
class OptimizationObjective;
class SpaceInformation;
class State;
}  // namespace ompl::base

namespace plumescout {

// What a search works on: the problem, its meter and its chance.
struct Desk {
  explicit Desk(const PathProblem& the_problem)
      : problem(the_problem),
        meter(the_problem),
        cells(the_problem.reachable),
        rng(the_problem.seed) {}

  const PathProblem& problem;
  SearchMeter meter;
  CellSampler cells;
  Rng rng;
};

// Whether a search has anywhere to begin: a start that is a point of a reachable cell.
bool CanStart(const PathProblem& problem);

Point2 ToPoint(const ompl::base::State* state);
void FromPoint(Point2 point, ompl::base::State* state);

// The plane of the problem: states are drawn from its reachable cells and counted by the meter,
// motions are priced by it. Keeps a reference to `desk`.
std::shared_ptr<ompl::base::SpaceInformation> MakeOmplSpace(Desk& desk);

// The problem's edge cost as OMPL's objective: never content, so that a search uses what it is
// granted. Keeps a reference to `desk`.
std::shared_ptr<ompl::base::OptimizationObjective> MakeOmplObjective(
    const std::shared_ptr<ompl::base::SpaceInformation>& space, Desk& desk);

// Every generator that OMPL makes from now on follows from `seed`, also if others were made before.
// Switches OMPL's console output off. Both belong to the process: one search at a time.
void PrepareOmpl(std::uint64_t seed);

}  // namespace plumescout
