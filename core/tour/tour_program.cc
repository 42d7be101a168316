// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/tour/tour_program.h"

#include <CbcEventHandler.hpp>
#include <CbcModel.hpp>
#include <CoinError.hpp>
#include <CoinPackedMatrix.hpp>
#include <CoinPackedVector.hpp>
#include <OsiClpSolverInterface.hpp>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"

namespace plumescout {
namespace {

using Values = std::vector<double>;

// CbcModel::status().
constexpr int kStoppedByHandler = 5;

// A solution must be better by this part of the longest edge to replace another.
constexpr double kTolerance = 1e-7;

// Asked by CBC at every node of its search.
class StopHandler : public CbcEventHandler {
 public:
  explicit StopHandler(const StopFn& stop) : stop_(stop) {}

  using CbcEventHandler::event;
  CbcAction event(CbcEvent /*which*/) override {
    return stop_() ? CbcEventHandler::stop : noAction;
  }
  CbcEventHandler* clone() const override {  // the caller owns it
    return std::make_unique<StopHandler>(*this).release();
  }

 private:
  const StopFn& stop_;
};

// Columns are edges, rows are nodes: (P1a). Costs are parts of the longest edge, which gives the
// solver's absolute tolerances a meaning.
void LoadDegreeConstraints(const TourGraph& graph, OsiClpSolverInterface& solver) {
  constexpr double kEdgesAtNode = 2.0;
  const auto edges = static_cast<int>(graph.edges.size());
  double longest_m = 0.0;
  for (const TourEdge& edge : graph.edges) longest_m = std::max(longest_m, edge.cost_m);
  const double scale = longest_m > 0.0 ? longest_m : 1.0;
  std::vector<CoinBigIndex> starts = {0};
  std::vector<int> ends;
  Values costs;
  for (const TourEdge& edge : graph.edges) {
    ends.insert(ends.end(), {edge.a, edge.b});
    starts.push_back(static_cast<CoinBigIndex>(ends.size()));
    costs.push_back(edge.cost_m / scale);
  }
  const Values zeros(graph.edges.size(), 0.0);
  const Values ones(ends.size(), 1.0);
  const Values degrees(static_cast<std::size_t>(graph.nodes), kEdgesAtNode);
  solver.loadProblem(edges, graph.nodes, starts.data(), ends.data(), ones.data(), zeros.data(),
                     ones.data(), costs.data(), degrees.data(), degrees.data());
  for (int edge = 0; edge < edges; ++edge) solver.setInteger(edge);
}

absl::Status NoTour() { return absl::NotFoundError("the graph has no closed tour of all nodes"); }

absl::Status GaveUp(int code) {
  return absl::InternalError(absl::StrCat("the solver gave up on a tour, status ", code));
}

}  // namespace

struct TourProgram::State {
  TourGraph graph;
  OsiClpSolverInterface solver;
};

TourProgram::TourProgram(const TourGraph& graph) : state_(std::make_unique<State>()) {
  state_->graph = graph;
  state_->solver.messageHandler()->setLogLevel(0);
  LoadDegreeConstraints(graph, state_->solver);
}

TourProgram::~TourProgram() = default;

void TourProgram::ForbidSubtour(const std::vector<int>& nodes) {
  const TourGraph& graph = state_->graph;
  std::vector<bool> inside(static_cast<std::size_t>(graph.nodes), false);
  for (const int node : nodes) inside[static_cast<std::size_t>(node)] = true;
  std::vector<int> columns;
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const auto [a, b, cost_m] = graph.edges[i];
    if (inside[static_cast<std::size_t>(a)] && inside[static_cast<std::size_t>(b)]) {
      columns.push_back(static_cast<int>(i));
    }
  }
  const Values ones(columns.size(), 1.0);
  OsiClpSolverInterface& solver = state_->solver;
  solver.addRow(static_cast<int>(columns.size()), columns.data(), ones.data(),
                -solver.getInfinity(), static_cast<double>(nodes.size()) - 1.0);
}

absl::StatusOr<Values> TourProgram::SolveRelaxed() {
  OsiClpSolverInterface& solver = state_->solver;
  solver.resolve();
  if (solver.isProvenPrimalInfeasible()) return NoTour();
  if (!solver.isProvenOptimal()) return GaveUp(solver.getModelPtr()->status());
  return Values(solver.getColSolution(), solver.getColSolution() + solver.getNumCols());
}

absl::StatusOr<Values> TourProgram::Solve(const StopFn& stop) {
  CbcModel model(state_->solver);
  model.setLogLevel(0);
  model.setCutoffIncrement(kTolerance);
  const StopHandler handler(stop);
  model.passInEventHandler(&handler);
  model.branchAndBound();
  if (model.isProvenInfeasible()) return NoTour();
  if (model.status() == kStoppedByHandler) {
    return absl::DeadlineExceededError("stopped before the shortest tour was found");
  }
  if (!model.isProvenOptimal()) return GaveUp(model.status());
  Values x(model.bestSolution(), model.bestSolution() + model.getNumCols());
  for (double& value : x) value = std::round(value);
  return x;
}

}  // namespace plumescout
