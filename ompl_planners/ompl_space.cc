// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "ompl_planners/ompl_space.h"

#include <ompl/base/OptimizationObjective.h>
#include <ompl/base/ProblemDefinition.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/base/samplers/InformedStateSampler.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <cmath>
#include <limits>
#include <utility>

namespace plumescout {
namespace {

namespace ob = ompl::base;

// BIT* reads freed memory once a heuristic exceeds the price it bounds, be it by rounding.
constexpr double kHeuristicShare = 0.9999;

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

// Eq. (12) of [XIT].
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

}  // namespace

bool CanStart(const PathProblem& problem) {
  const bool is_point = std::isfinite(problem.start.x_m) && std::isfinite(problem.start.y_m);
  return is_point && problem.reachable.At(problem.start_cell(), 0) != 0;
}

Point2 ToPoint(const ob::State* state) {
  const auto* const values = state->as<ob::RealVectorStateSpace::StateType>()->values;
  return {values[0], values[1]};
}

void FromPoint(Point2 point, ob::State* state) {
  auto* const values = state->as<ob::RealVectorStateSpace::StateType>()->values;
  values[0] = point.x_m;
  values[1] = point.y_m;
}

ob::SpaceInformationPtr MakeOmplSpace(Desk& desk) {
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

ob::OptimizationObjectivePtr MakeOmplObjective(const ob::SpaceInformationPtr& space, Desk& desk) {
  return std::make_shared<Objective>(space, desk);
}

void PrepareOmpl(std::uint64_t seed) {
  ompl::msg::noOutputHandler();
  constexpr std::uint64_t kSeeds = 1ULL << 31;
  // 0 is refused. If there were generators before, OMPL logs an error, but obeys.
  ompl::RNG::setSeed(1 + Rng(seed).Below(kSeeds - 1));
}

}  // namespace plumescout
