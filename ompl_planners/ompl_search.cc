// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "ompl_planners/ompl_search.h"

#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/base/samplers/InformedStateSampler.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/prm/PRMstar.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "ompl_planners/cell_sampler.h"
#include "ompl_planners/search_meter.h"

namespace plumescout {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

// BIT* reads freed memory once a heuristic exceeds the price it bounds, be it by rounding.
constexpr double kHeuristicShare = 0.9999;
constexpr int kBatch = 100;  // states; BIT*'s own default

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

Point2 ToPoint(const ob::State* state) {
  const auto* const values = state->as<ob::RealVectorStateSpace::StateType>()->values;
  return {values[0], values[1]};
}

void FromPoint(Point2 point, ob::State* state) {
  auto* const values = state->as<ob::RealVectorStateSpace::StateType>()->values;
  values[0] = point.x_m;
  values[1] = point.y_m;
}

// The raster, with a cell to spare on each side: CellAt is generous at its edges.
class PlaneSpace : public ob::RealVectorStateSpace {
 public:
  explicit PlaneSpace(const GridGeometry& g) : RealVectorStateSpace(2) {
    ob::RealVectorBounds bounds(2);
    bounds.setLow(0, g.origin_x_m - g.resolution_m);
    bounds.setLow(1, g.origin_y_m - g.resolution_m);
    bounds.setHigh(0, g.origin_x_m + (g.width + 1) * g.resolution_m);
    bounds.setHigh(1, g.origin_y_m + (g.height + 1) * g.resolution_m);
    setBounds(bounds);
  }
};

class FreeSampler : public ob::RealVectorStateSampler {
 public:
  FreeSampler(const ob::StateSpace* space, Desk& desk)
      : RealVectorStateSampler(space), desk_(desk) {}

  void sampleUniform(ob::State* state) override {
    desk_.meter.CountDraw();
    FromPoint(desk_.cells.Draw(desk_.rng), state);
  }

 private:
  Desk& desk_;
};

// Draws from the cells that a path cheaper than the best so far can touch. BIT* and Informed RRT*
// take this sampler from the objective and never ask the space for one.
class InformedCellSampler : public ob::InformedSampler {
 public:
  InformedCellSampler(const ob::ProblemDefinitionPtr& query, unsigned int max_calls, Desk& desk)
      : InformedSampler(query, max_calls),
        desk_(desk),
        cells_(desk.cells),
        start_(ToPoint(query->getStartState(0))),
        goal_(ToPoint(query->getGoal()->as<ob::GoalState>()->getState())) {}

  bool sampleUniform(ob::State* state, const ob::Cost& below) override {
    desk_.meter.CountDraw();
    Confine(below.value());
    if (cells_.empty()) return false;
    FromPoint(cells_.Draw(desk_.rng), state);
    return true;
  }
  bool sampleUniform(ob::State* state, const ob::Cost& /*from*/, const ob::Cost& below) override {
    return sampleUniform(state, below);
  }
  bool hasInformedMeasure() const override { return false; }
  double getInformedMeasure(const ob::Cost& /*below*/) const override {
    return space_->getMeasure();
  }

 private:
  void Confine(double cost) {
    const double per_m = kHeuristicShare * desk_.problem.cost.LowerBound(1.0);
    if (!(cost < confined_to_) || !(per_m > 0.0)) return;
    confined_to_ = cost;
    cells_.Confine(start_, goal_, cost / per_m);
  }

  Desk& desk_;
  CellSampler cells_;
  Point2 start_;
  Point2 goal_;
  double confined_to_ = std::numeric_limits<double>::infinity();
};

// Eq. (12) of [XIT] as OMPL's objective: never content, so that a search uses what it is granted.
class Objective : public ob::OptimizationObjective {
 public:
  Objective(const ob::SpaceInformationPtr& space, Desk& desk)
      : OptimizationObjective(space), desk_(desk) {
    setCostToGoHeuristic([this](const ob::State* state, const ob::Goal* goal) {
      return motionCostHeuristic(state, goal->as<ob::GoalState>()->getState());
    });
  }

  ob::Cost stateCost(const ob::State* /*state*/) const override { return identityCost(); }
  ob::Cost motionCost(const ob::State* a, const ob::State* b) const override {
    return ob::Cost(desk_.meter.Price(ToPoint(a), ToPoint(b)));
  }
  ob::Cost motionCostHeuristic(const ob::State* a, const ob::State* b) const override {
    const double length_m = Distance_m(ToPoint(a), ToPoint(b));
    return ob::Cost(kHeuristicShare * desk_.problem.cost.LowerBound(length_m));
  }
  ob::InformedSamplerPtr allocInformedStateSampler(const ob::ProblemDefinitionPtr& query,
                                                   unsigned int max_calls) const override {
    return std::make_shared<InformedCellSampler>(query, max_calls, desk_);
  }

 private:
  Desk& desk_;
};

class ExactMotion : public ob::MotionValidator {
 public:
  ExactMotion(const ob::SpaceInformationPtr& space, Desk& desk)
      : MotionValidator(space), desk_(desk) {}

  bool checkMotion(const ob::State* a, const ob::State* b) const override {
    return std::isfinite(desk_.meter.Price(ToPoint(a), ToPoint(b)));
  }
  // Asked by planners that go as far as they can; none of ours does.
  bool checkMotion(const ob::State* a, const ob::State* b,
                   std::pair<ob::State*, double>& last_valid) const override {
    if (checkMotion(a, b)) return true;
    last_valid.second = 0.0;
    if (last_valid.first != nullptr) si_->copyState(last_valid.first, a);
    return false;
  }

 private:
  Desk& desk_;
};

ob::SpaceInformationPtr MakeSpace(Desk& desk) {
  auto plane = std::make_shared<PlaneSpace>(desk.problem.reachable.geometry());
  plane->setStateSamplerAllocator(
      [&desk](const ob::StateSpace* space) { return std::make_shared<FreeSampler>(space, desk); });
  auto space = std::make_shared<ob::SpaceInformation>(plane);
  const Grid<std::uint8_t>& reachable = desk.problem.reachable;
  space->setStateValidityChecker([&reachable](const ob::State* state) {
    return reachable.At(reachable.geometry().CellAt(ToPoint(state)), 0) != 0;
  });
  space->setMotionValidator(std::make_shared<ExactMotion>(space, desk));
  space->setup();
  return space;
}

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
    space_ = MakeSpace(desk_);
    objective_ = std::make_shared<Objective>(space_, desk_);
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
    const bool start_is_point = std::isfinite(start.x_m) && std::isfinite(start.y_m);
    if (!start_is_point || problem.reachable.At(problem.start_cell(), 0) == 0) return {};
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

// Every generator that OMPL makes from now on follows from `seed`, also if others were made before:
// OMPL logs an error then, but obeys.
void SeedOmpl(std::uint64_t seed) {
  constexpr std::uint64_t kSeeds = 1ULL << 31;
  ompl::RNG::setSeed(1 + Rng(seed).Below(kSeeds - 1));  // 0 is refused
}

}  // namespace

PathResult SearchWithOmpl(PathKind kind, int samples, const PathProblem& problem) noexcept {
  ompl::msg::noOutputHandler();
  SeedOmpl(problem.seed);
  OmplSearch search(kind, samples, problem);
  try {
    search.Run();
  } catch (const std::exception&) {
    // OMPL's way to say that it found nothing; what was found before stands.
  }
  return search.TakeResult();
}

}  // namespace plumescout
