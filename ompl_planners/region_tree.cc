// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "ompl_planners/region_tree.h"

#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/goals/GoalSampleableRegion.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>

#include <algorithm>
#include <exception>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "ompl_planners/ompl_space.h"

namespace plumescout {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

// The discs as OMPL's goal, which notes what planners show it and never says that it is satisfied:
// when the search ends is settled by its termination condition.
class Discs : public ob::GoalSampleableRegion {
 public:
  Discs(const ob::SpaceInformationPtr& space, double radius_m, Desk& desk)
      : GoalSampleableRegion(space), radius_m_(radius_m), desk_(desk) {
    for (const plumescout::Goal& goal : desk.problem.goals) open_.push_back(goal.position);
    Note(desk.problem.start);
  }

  bool all_reached() const { return open_.empty(); }

  using GoalSampleableRegion::isSatisfied;
  bool isSatisfied(const ob::State* state, double* distance) const override {
    Note(ToPoint(state));
    if (distance != nullptr) *distance = distanceGoal(state);
    return false;
  }
  double distanceGoal(const ob::State* state) const override {
    double least_m = std::numeric_limits<double>::infinity();
    for (const Point2 goal : open_) least_m = std::min(least_m, Distance_m(ToPoint(state), goal));
    return least_m;
  }
  void sampleGoal(ob::State* state) const override {
    desk_.meter.CountDraw();
    FromPoint(open_[desk_.rng.Below(open_.size())], state);
  }
  unsigned int maxSampleCount() const override { return static_cast<unsigned int>(open_.size()); }

 private:
  void Note(Point2 point) const {
    std::erase_if(open_, [&](Point2 goal) { return Distance_m(point, goal) <= radius_m_; });
  }

  double radius_m_;
  Desk& desk_;
  mutable std::vector<Point2> open_;  // goals not reached yet
};

template <typename Rrt>
class RegionTree : private Rrt {
 public:
  RegionTree(const ob::SpaceInformationPtr& space, double step_m) : Rrt(space) {
    this->setRange(step_m);
  }

  void Grow(const ob::ProblemDefinitionPtr& query, const ob::PlannerTerminationCondition& end) {
    this->setProblemDefinition(query);
    this->setup();
    this->solve(end);
  }

  int vertices() const { return this->nn_ ? static_cast<int>(this->nn_->size()) : 0; }

  // The cheapest way to a vertex in the disc, if there is one.
  std::optional<FoundPath> PathInto(Point2 center, double radius_m, const EdgeCost& cost) const {
    std::vector<typename Rrt::Motion*> motions;
    if (this->nn_) this->nn_->list(motions);
    std::optional<FoundPath> best;
    for (const auto* motion : motions) {
      if (!(Distance_m(ToPoint(motion->state), center) <= radius_m)) continue;
      FoundPath path;
      path.vertices = WayTo(motion);
      path.cost = PathCost(cost, path.vertices);
      if (!best || path.cost < best->cost) best = std::move(path);
    }
    return best;
  }

 private:
  // From the root; a root alone stands twice, so that it is a path.
  static std::vector<Point2> WayTo(const typename Rrt::Motion* motion) {
    std::vector<Point2> way;
    for (; motion != nullptr; motion = motion->parent) way.push_back(ToPoint(motion->state));
    if (way.size() == 1) way.push_back(way.front());
    std::reverse(way.begin(), way.end());
    return way;
  }
};

ob::ProblemDefinitionPtr MakeQuery(const ob::SpaceInformationPtr& space,
                                   const std::shared_ptr<Discs>& discs, Desk& desk) {
  auto query = std::make_shared<ob::ProblemDefinition>(space);
  ob::ScopedState<> start(space);
  FromPoint(desk.problem.start, start.get());
  query->addStartState(start);
  query->setGoal(discs);
  query->setOptimizationObjective(MakeOmplObjective(space, desk));
  return query;
}

template <typename Rrt>
void Search(const RegionTreeOptions& options, Desk& desk, PathResult& result) {
  const ob::SpaceInformationPtr space = MakeOmplSpace(desk);
  const auto discs = std::make_shared<Discs>(space, options.goal_radius_m, desk);
  RegionTree<Rrt> tree(space, options.step_m);
  desk.meter.Begin(options.max_samples, 1);
  tree.Grow(MakeQuery(space, discs, desk), ob::PlannerTerminationCondition([&] {
              return discs->all_reached() || desk.meter.Over();
            }));
  result.effort.vertices = tree.vertices();
  for (std::size_t i = 0; i < result.paths.size(); ++i) {
    result.paths[i] =
        tree.PathInto(desk.problem.goals[i].position, options.goal_radius_m, desk.problem.cost);
  }
}

}  // namespace

PathResult GrowRegionTree(const RegionTreeOptions& options, const PathProblem& problem) noexcept {
  PathResult result;
  result.paths.resize(problem.goals.size());
  Desk desk(problem);
  if (CanStart(problem) && !problem.goals.empty()) {
    PrepareOmpl(problem.seed);
    try {
      if (options.kind == PathKind::kRrtStar) {
        Search<og::RRTstar>(options, desk, result);
      } else {
        Search<og::RRT>(options, desk, result);
      }
    } catch (const std::exception&) {
      // OMPL's way to say that it found nothing; what was found before stands.
    }
  }
  result.effort.samples = desk.meter.draws();
  result.effort.edges_evaluated = desk.meter.edges();
  result.end = EndOf(result.paths, desk.meter.cut_short());
  return result;
}

}  // namespace plumescout
