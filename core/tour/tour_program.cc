// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0

// The only user of GLPK, which is under the GPL, version 3 or later.
#include "core/tour/tour_program.h"

#include <glpk.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"

namespace plumescout {
namespace {

using Values = std::vector<double>;

// GLPK keeps an environment for each thread, and does not free it by itself.
class Environment {
 public:
  Environment() { glp_term_out(GLP_OFF); }
  ~Environment() { glp_free_env(); }
};

void OpenEnvironment() { static thread_local const Environment environment; }

struct ProblemDeleter {
  void operator()(glp_prob* problem) const { glp_delete_prob(problem); }
};
using Problem = std::unique_ptr<glp_prob, ProblemDeleter>;

// Indices of GLPK begin at 1, and so do its lists.
int RowOf(int node) { return node + 1; }
int ColumnOf(std::size_t edge) { return static_cast<int>(edge) + 1; }

// Rows are nodes, columns are edges: (P1a). Costs are parts of the longest edge, which gives the
// solver's absolute tolerances a meaning.
Problem MakeProblem(const TourGraph& graph) {
  constexpr double kEdgesAtNode = 2.0;
  double longest_m = 0.0;
  for (const TourEdge& edge : graph.edges) longest_m = std::max(longest_m, edge.cost_m);
  const double scale = longest_m > 0.0 ? longest_m : 1.0;
  Problem problem(glp_create_prob());
  glp_add_rows(problem.get(), graph.nodes);
  for (int node = 0; node < graph.nodes; ++node) {
    glp_set_row_bnds(problem.get(), RowOf(node), GLP_FX, kEdgesAtNode, kEdgesAtNode);
  }
  if (!graph.edges.empty()) glp_add_cols(problem.get(), static_cast<int>(graph.edges.size()));
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const auto [a, b, cost_m] = graph.edges[i];
    const int rows[] = {0, RowOf(a), RowOf(b)};
    const double ones[] = {0.0, 1.0, 1.0};
    glp_set_mat_col(problem.get(), ColumnOf(i), 2, rows, ones);
    glp_set_col_kind(problem.get(), ColumnOf(i), GLP_BV);
    glp_set_obj_coef(problem.get(), ColumnOf(i), cost_m / scale);
  }
  return problem;
}

void AskStop(glp_tree* tree, void* stop) {
  if ((*static_cast<const StopFn*>(stop))()) glp_ios_terminate(tree);
}

absl::Status NoTour() { return absl::NotFoundError("the graph has no closed tour of all nodes"); }

absl::Status GaveUp(int code, int status) {
  return absl::InternalError(
      absl::StrCat("the solver gave up on a tour: returned ", code, ", status ", status));
}

// Of both kinds of solution alike.
absl::Status Judge(int code, int status) {
  if (code == GLP_ESTOP) {
    return absl::DeadlineExceededError("stopped before the shortest tour was found");
  }
  if (code == 0 && status == GLP_NOFEAS) return NoTour();
  return code == 0 && status == GLP_OPT ? absl::OkStatus() : GaveUp(code, status);
}

}  // namespace

struct TourProgram::State {
  TourGraph graph;
  Problem problem;
};

TourProgram::TourProgram(const TourGraph& graph) {
  OpenEnvironment();
  state_ = std::make_unique<State>(State{graph, MakeProblem(graph)});
}

TourProgram::~TourProgram() = default;

void TourProgram::ForbidSubtour(const std::vector<int>& nodes) {
  const TourGraph& graph = state_->graph;
  std::vector<bool> inside(static_cast<std::size_t>(graph.nodes), false);
  for (const int node : nodes) inside[static_cast<std::size_t>(node)] = true;
  std::vector<int> columns = {0};
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    const auto [a, b, cost_m] = graph.edges[i];
    if (inside[static_cast<std::size_t>(a)] && inside[static_cast<std::size_t>(b)]) {
      columns.push_back(ColumnOf(i));
    }
  }
  const Values ones(columns.size(), 1.0);
  glp_prob* const problem = state_->problem.get();
  const int row = glp_add_rows(problem, 1);
  glp_set_mat_row(problem, row, static_cast<int>(columns.size()) - 1, columns.data(), ones.data());
  glp_set_row_bnds(problem, row, GLP_UP, 0.0, static_cast<double>(nodes.size()) - 1.0);
}

absl::StatusOr<Values> TourProgram::SolveRelaxed() {
  glp_smcp options;
  glp_init_smcp(&options);
  options.msg_lev = GLP_MSG_OFF;
  options.meth = GLP_DUALP;  // added constraints leave the last basis feasible for the dual
  glp_prob* const problem = state_->problem.get();
  const int code = glp_simplex(problem, &options);
  if (const absl::Status status = Judge(code, glp_get_status(problem)); !status.ok()) return status;
  Values x;
  for (std::size_t i = 0; i < state_->graph.edges.size(); ++i) {
    x.push_back(glp_get_col_prim(problem, ColumnOf(i)));
  }
  return x;
}

absl::StatusOr<Values> TourProgram::Solve(const StopFn& stop) {
  // The search begins at the basis of the relaxed problem.
  if (const absl::Status status = SolveRelaxed().status(); !status.ok()) return status;
  StopFn asked = stop;
  glp_iocp options;
  glp_init_iocp(&options);
  options.msg_lev = GLP_MSG_OFF;
  options.cb_func = AskStop;
  options.cb_info = &asked;
  glp_prob* const problem = state_->problem.get();
  const int code = glp_intopt(problem, &options);
  if (const absl::Status status = Judge(code, glp_mip_status(problem)); !status.ok()) return status;
  Values x;
  for (std::size_t i = 0; i < state_->graph.edges.size(); ++i) {
    x.push_back(std::round(glp_mip_col_val(problem, ColumnOf(i))));
  }
  return x;
}

}  // namespace plumescout
