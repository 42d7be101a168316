// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "ompl_planners/ompl_search.h"

#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/prm/PRMstar.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <string>
#include <utility>

#include "ompl_planners/ompl_space.h"

namespace plumescout {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

constexpr int kBatch = 100;  // states; BIT*'s own default

FoundPath ToFoundPath(const PathProblem& problem, const ob::PathPtr& path) {
  FoundPath found;
  for (const ob::State* const state : path->as<og::PathGeometric>()->getStates()) {
    found.vertices.push_back(ToPoint(state));
  }
  found.cost = PathCost(problem.cost, found.vertices);
  return found;
}

// A planner that tells how many vertices it has.
class Tree {
 public:
  virtual ~Tree() = default;
  virtual ob::Planner& planner() = 0;
  virtual int vertices() = 0;
};

template <typename Rrt>
class RrtTree : public Tree, private Rrt {
 public:
  explicit RrtTree(const ob::SpaceInformationPtr& space) : Rrt(space) {}
  ob::Planner& planner() override { return *this; }
  int vertices() override { return this->nn_ ? static_cast<int>(this->nn_->size()) : 0; }
  Rrt& rrt() { return *this; }
};

class BitTree : public Tree {
 public:
  BitTree(const ob::SpaceInformationPtr& space, int samples) : bit_star_(space) {
    bit_star_.setSamplesPerBatch(static_cast<unsigned int>(std::clamp(samples, 1, kBatch)));
  }
  ob::Planner& planner() override { return bit_star_; }
  int vertices() override {
    const auto& properties = bit_star_.getPlannerProgressProperties();
    const auto found = properties.find("current graph vertices INTEGER");
    return found == properties.end() ? 0 : std::stoi(found->second());
  }

 private:
  og::BITstar bit_star_;
};

std::unique_ptr<Tree> MakeTree(PathKind kind, int samples, const ob::SpaceInformationPtr& space) {
  if (kind == PathKind::kBitStar) return std::make_unique<BitTree>(space, samples);
  if (kind == PathKind::kRrtStar) return std::make_unique<RrtTree<og::RRTstar>>(space);
  if (kind == PathKind::kRrt) return std::make_unique<RrtTree<og::RRT>>(space);
  auto informed = std::make_unique<RrtTree<og::InformedRRTstar>>(space);
  // OMPL takes the price of the straight line from the start for a lower bound of the cost to come
  // and prunes by it. Ours is none, and infinite behind a wall: prune by the cost in the tree.
  informed->rrt().setAdmissibleCostToCome(false);
  return informed;
}

class OmplSearch {
 public:
  OmplSearch(PathKind kind, int samples, const PathProblem& problem)
      : kind_(kind), samples_(samples), desk_(problem) {
    result_.paths.resize(problem.goals.size());
  }

  void Run() {
    const std::vector<std::size_t> goals = GoalsToSearch();
    if (goals.empty()) return;
    space_ = MakeOmplSpace(desk_);
    objective_ = MakeOmplObjective(space_, desk_);
    if (kind_ == PathKind::kPrmStar) {
      SearchRoadmap(goals);
    } else {
      for (std::size_t k = 0; k < goals.size() && !desk_.meter.stopped(); ++k) {
        SearchTree(goals[k], goals.size() - k);
      }
    }
  }

  PathResult TakeResult() {
    result_.effort.samples = desk_.meter.draws();
    result_.effort.edges_evaluated = desk_.meter.edges();
    const bool all = std::all_of(result_.paths.begin(), result_.paths.end(),
                                 [](const auto& path) { return path.has_value(); });
    result_.end = desk_.meter.cut_short() ? PlanEnd::kStopped
                  : all                   ? PlanEnd::kAllGoalsReached
                                          : PlanEnd::kQueueExhausted;
    return std::move(result_);
  }

 private:
  // Those that can be reached; none from a start that cannot. Answers goals at the start itself:
  // OMPL's planners do not agree on what such a path is.
  std::vector<std::size_t> GoalsToSearch() {
    const PathProblem& problem = desk_.problem;
    const Point2 start = problem.start;
    if (!CanStart(problem)) return {};
    std::vector<std::size_t> goals;
    for (std::size_t i = 0; i < problem.goals.size(); ++i) {
      const Cell cell = problem.goals[i].cell;
      if (problem.reachable.At(cell, 0) == 0) continue;
      if (GoalPoint(i) == start) {
        result_.paths[i] = FoundPath{{start, start}, 0.0, PathSource::kTree};
      } else {
        goals.push_back(i);
      }
    }
    return goals;
  }

  Point2 GoalPoint(std::size_t i) const {
    return desk_.problem.cost.geometry().Center(desk_.problem.goals[i].cell);
  }

  ob::ProblemDefinitionPtr MakeQuery(std::size_t goal) const {
    auto query = std::make_shared<ob::ProblemDefinition>(space_);
    ob::ScopedState<> from(space_);
    ob::ScopedState<> to(space_);
    FromPoint(desk_.problem.start, from.get());
    FromPoint(GoalPoint(goal), to.get());
    query->setStartAndGoalStates(from, to);
    query->setOptimizationObjective(objective_);
    return query;
  }

  void SearchTree(std::size_t goal, std::size_t searches_left) {
    // A batch begun is no longer searched: one draw beyond the number tells of it.
    const std::int64_t batch_begun = kind_ == PathKind::kBitStar ? 1 : 0;
    desk_.meter.Begin(samples_ + batch_begun, searches_left);
    const ob::ProblemDefinitionPtr query = MakeQuery(goal);
    const std::unique_ptr<Tree> tree = MakeTree(kind_, samples_, space_);
    tree->planner().setProblemDefinition(query);
    tree->planner().setup();
    tree->planner().solve(ob::PlannerTerminationCondition([this] { return desk_.meter.Over(); }));
    if (query->hasExactSolution()) {
      result_.paths[goal] = ToFoundPath(desk_.problem, query->getSolutionPath());
    }
    result_.effort.vertices += tree->vertices();
  }

  void SearchRoadmap(const std::vector<std::size_t>& goals);

  PathKind kind_;
  int samples_;
  Desk desk_;
  PathResult result_;
  ob::SpaceInformationPtr space_;
  ob::OptimizationObjectivePtr objective_;
};

// PRM* without PRM::solve, which grows by the clock and looks for the path from a second thread:
// here the same pieces run one after the other. Stock PRM* would also throw in some random walks
// after 0.4 s of growth; ours samples only.
class Roadmap : public og::PRMstar {
 public:
  using PRMstar::PRMstar;

  Vertex Add(Point2 point) {
    ob::State* const state = si_->allocState();
    FromPoint(point, state);
    return addMilestone(state);
  }
  // Null if there is none.
  ob::PathPtr Between(Vertex a, Vertex b) {
    return sameComponent(a, b) ? constructSolution(a, b) : nullptr;
  }
};

void OmplSearch::SearchRoadmap(const std::vector<std::size_t>& goals) {
  desk_.meter.Begin(samples_, 1);
  Roadmap roadmap(space_);
  roadmap.setProblemDefinition(MakeQuery(goals.front()));  // for the objective
  roadmap.setup();
  // First of all, so that a roadmap cut short knows them too.
  const Roadmap::Vertex start = roadmap.Add(desk_.problem.start);
  std::vector<Roadmap::Vertex> ends;
  for (const std::size_t goal : goals) ends.push_back(roadmap.Add(GoalPoint(goal)));
  roadmap.growRoadmap(ob::PlannerTerminationCondition([this] { return desk_.meter.Over(); }));
  for (std::size_t k = 0; k < goals.size(); ++k) {
    if (const ob::PathPtr path = roadmap.Between(start, ends[k])) {
      result_.paths[goals[k]] = ToFoundPath(desk_.problem, path);
    }
  }
  result_.effort.vertices = static_cast<int>(roadmap.milestoneCount());
}

}  // namespace

PathResult SearchWithOmpl(PathKind kind, int samples, const PathProblem& problem) noexcept {
  PrepareOmpl(problem.seed);
  OmplSearch search(kind, samples, problem);
  try {
    search.Run();
  } catch (const std::exception&) {
    // OMPL's way to say that it found nothing; what was found before stands.
  }
  return search.TakeResult();
}

}  // namespace plumescout
