// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/plan/paths/xit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/plan/cost/sampler.h"
#include "core/plan/paths/connection_radius.h"
#include "core/plan/paths/goal_neighbours.h"
#include "core/plan/paths/neighbour_index.h"

namespace plumescout {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kNoParent = -1;
constexpr int kNotOpen = -1;

// The implicit random geometric graph: samples, goal cells and the root, with their neighbours.
struct Graph {
  std::vector<Point2> points;          // samples, then goal cells that are no sample, then the root
  std::vector<Cell> cells;             // that hold them
  std::vector<int> goal_vertices;      // by goal; none if goal cells are no vertices
  std::vector<std::vector<int>> ends;  // by goal: where a path to it may end
  int sample_count = 0;

  int root() const { return static_cast<int>(points.size()) - 1; }
};

Graph MakeGraph(const PathProblem& problem, const PlanningOptions& options) {
  Rng rng(problem.seed);
  const Grid<float> mass = SamplingMass(problem.cost.information(), problem.reachable,
                                        problem.start_cell(), options.uniform_share, problem.stop);
  std::vector<Cell> cells =
      DrawSamples(mass, options.sample_count, options.sampling, rng, problem.stop);  // line 1
  Graph graph;
  graph.sample_count = static_cast<int>(cells.size());
  if (options.goal_vertices) {
    for (const Goal& goal : problem.goals) {  // line 2
      const auto known = std::find(cells.begin(), cells.end(), goal.cell);
      graph.goal_vertices.push_back(static_cast<int>(known - cells.begin()));
      graph.ends.push_back({graph.goal_vertices.back()});
      if (known == cells.end()) cells.push_back(goal.cell);
    }
  }
  graph.points.reserve(cells.size() + 1);
  for (const Cell cell : cells) graph.points.push_back(problem.cost.geometry().Center(cell));
  if (!options.goal_vertices) {
    for (const Goal& goal : problem.goals) {  // lines 3-5
      graph.ends.push_back(
          NearestSamples(graph.points, goal.position, options.nearest_sample_count));
    }
  }
  graph.points.push_back(problem.start);
  cells.push_back(problem.start_cell());
  graph.cells = std::move(cells);
  return graph;
}

double Radius_m(const PathProblem& problem, const PlanningOptions& options, int samples) {
  const double resolution_m = problem.cost.geometry().resolution_m;
  const auto cells = static_cast<double>(problem.reachable.size()) -
                     static_cast<double>(std::count(problem.reachable.values().begin(),
                                                    problem.reachable.values().end(), 0));
  return ConnectionRadius_m(cells * resolution_m * resolution_m, samples, resolution_m, options);
}

class XitSearch {
 public:
  XitSearch(const PathProblem& problem, const PlanningOptions& options)
      : problem_(problem),
        informed_(options.informed_heuristic),
        graph_(MakeGraph(problem, options)),
        near_(graph_.points, Radius_m(problem, options, graph_.sample_count)),  // line 7
        goal_neighbours_(graph_.points, graph_.sample_count, graph_.goal_vertices,
                         options.nearest_sample_count),  // lines 3-5
        g_(graph_.points.size(), kInfinity),
        parent_(graph_.points.size(), kNoParent),
        taken_(graph_.points.size(), 0),
        place_in_open_(graph_.points.size(), kNotOpen),
        heuristics_(graph_.points.size() * graph_.ends.size(), 0.0) {
    Reach(graph_.root(), kNoParent, 0.0);  // line 6
  }

  PathResult Run() {
    PathResult result;
    result.end = Grow();
    for (const auto& ends : graph_.ends) result.paths.push_back(PathToOneOf(ends));
    result.effort = effort_;
    result.effort.samples = graph_.sample_count;
    result.effort.vertices = static_cast<int>(
        std::count_if(g_.begin(), g_.end(), [](double g) { return g < kInfinity; }));
    if (problem_.tree != nullptr) *problem_.tree = Edges();
    return result;
  }

 private:
  double& g(int vertex) { return g_[static_cast<std::size_t>(vertex)]; }
  Point2 At(int vertex) const { return graph_.points[static_cast<std::size_t>(vertex)]; }
  PointInCell InCell(int vertex) const {
    return {At(vertex), graph_.cells[static_cast<std::size_t>(vertex)]};
  }
  bool Taken(int vertex) const { return taken_[static_cast<std::size_t>(vertex)] != 0; }
  bool Solved(std::size_t goal) const {
    const std::vector<int>& ends = graph_.ends[goal];
    return std::any_of(ends.begin(), ends.end(), [this](int vertex) { return Taken(vertex); });
  }

  // Lines 8-28.
  PlanEnd Grow() {
    std::vector<std::size_t> open(problem_.goals.size());  // goals not solved yet
    for (std::size_t j = 0; j < open.size(); ++j) open[j] = j;
    while (!open.empty()) {
      for (const std::size_t goal : open) {  // line 9
        if (Solved(goal)) continue;          // lines 10-11
        if (problem_.stop()) return PlanEnd::kStopped;
        const int v = TakeNext(goal);  // lines 13-14
        if (v == kNoParent) return PlanEnd::kQueueExhausted;
        if (!Expand(v)) return PlanEnd::kStopped;
      }
      std::erase_if(open, [this](std::size_t goal) { return Solved(goal); });
    }
    return PlanEnd::kAllGoalsReached;
  }

  // The vertex of Q_v with the least g + h for this goal, of equals the first; kNoParent if Q_v is
  // empty. Q_v has no order: it is the rim of the tree, which is looked through in less time than
  // an order for each goal would take to keep up.
  int TakeNext(std::size_t goal) {
    const double* const h = &heuristics_[goal * graph_.points.size()];
    int next = kNoParent;
    double least = kInfinity;
    for (const int vertex : open_) {
      const double f = g(vertex) + h[vertex];
      if (next != kNoParent && (f > least || (f == least && vertex > next))) continue;
      least = f;
      next = vertex;
    }
    if (next != kNoParent) Close(next);
    return next;
  }

  void Close(int vertex) {
    taken_[static_cast<std::size_t>(vertex)] = 1;
    int& place = place_in_open_[static_cast<std::size_t>(vertex)];
    const int last = open_.back();
    open_[static_cast<std::size_t>(place)] = last;
    place_in_open_[static_cast<std::size_t>(last)] = place;
    open_.pop_back();
    place = kNotOpen;
  }

  // Lines 15-28. False if the budget ran out.
  bool Expand(int v) {
    bool within_budget = true;
    near_.ForEachNear(At(v), [&](int w, double length_m) {  // lines 15-19
      within_budget = within_budget && Try(v, w, length_m);
    });
    for (const auto& [from, w] : goal_neighbours_.EdgesFrom(v)) {
      within_budget = within_budget && Try(v, w, Distance_m(At(v), At(w)));
    }
    return within_budget;
  }

  // Lines 20-28 for one edge. False if its price is over the budget.
  bool Try(int v, int w, double length_m) {
    if (Taken(w) && !informed_) return true;                               // its g is final
    if (!(g(v) + problem_.cost.LowerBound(length_m) < g(w))) return true;  // line 20
    const std::int64_t budget = problem_.max_edge_evaluations;
    if (budget > 0 && effort_.edges_evaluated >= budget) return false;
    ++effort_.edges_evaluated;
    const double via_v = g(v) + problem_.cost.UpTo(InCell(v), InCell(w), g(w) - g(v));
    if (via_v < g(w)) Reach(w, v, via_v);  // line 21
    return true;
  }

  // Lines 22-28: enters the tree, or changes parent.
  void Reach(int vertex, int parent, double cost) {
    if (g(vertex) == kInfinity) WriteHeuristics(vertex);
    g(vertex) = cost;
    parent_[static_cast<std::size_t>(vertex)] = parent;
    taken_[static_cast<std::size_t>(vertex)] = 0;
    int& place = place_in_open_[static_cast<std::size_t>(vertex)];
    if (place != kNotOpen) return;
    place = static_cast<int>(open_.size());
    open_.push_back(vertex);
  }

  void WriteHeuristics(int vertex) {
    if (!problem_.cost.HasHeuristic() && !informed_) return;
    for (std::size_t goal = 0; goal < graph_.ends.size(); ++goal) {
      heuristics_[goal * graph_.points.size() + static_cast<std::size_t>(vertex)] =
          LeastHeuristic(vertex, goal);
    }
  }

  // To the nearest, or cheapest, end of a path to the goal.
  double LeastHeuristic(int vertex, std::size_t goal) const {
    double least = kInfinity;
    for (const int end : graph_.ends[goal]) {
      least = std::min(least, informed_ ? problem_.cost.InformedHeuristic(At(vertex), At(end))
                                        : problem_.cost.Heuristic(Distance_m(At(vertex), At(end))));
    }
    return least;
  }

  std::vector<TreeEdge> Edges() const {
    std::vector<TreeEdge> edges;
    for (std::size_t child = 0; child < parent_.size(); ++child) {
      if (parent_[child] == kNoParent) continue;
      edges.push_back({At(parent_[child]), graph_.points[child]});
    }
    return edges;
  }

  std::optional<FoundPath> PathToOneOf(const std::vector<int>& ends) const {
    const auto cheaper = [this](int a, int b) {
      return g_[static_cast<std::size_t>(a)] < g_[static_cast<std::size_t>(b)];
    };
    const auto end = std::min_element(ends.begin(), ends.end(), cheaper);
    if (end == ends.end() || g_[static_cast<std::size_t>(*end)] == kInfinity) {
      return std::nullopt;
    }
    FoundPath path;
    for (int v = *end; v != kNoParent; v = parent_[static_cast<std::size_t>(v)]) {
      path.vertices.push_back(At(v));
    }
    std::reverse(path.vertices.begin(), path.vertices.end());
    // Of a vertex that was rewired and not taken again, those behind it have not heard.
    path.cost =
        informed_ ? PathCost(problem_.cost, path.vertices) : g_[static_cast<std::size_t>(*end)];
    return path;
  }

  const PathProblem& problem_;
  bool informed_;  // h may exceed the price of the way
  Graph graph_;
  NeighbourIndex near_;
  GoalNeighbours goal_neighbours_;
  std::vector<double> g_;            // cost to come in the tree, g_tau
  std::vector<int> parent_;          // E
  std::vector<std::uint8_t> taken_;  // no longer in Q_v
  std::vector<int> open_;            // Q_v
  std::vector<int> place_in_open_;   // by vertex
  std::vector<double> heuristics_;   // h by goal, then by vertex; of vertices in the tree
  PlanEffort effort_;
};

}  // namespace

PathResult XitPlanner::FindPaths(const PathProblem& problem) const {
  return XitSearch(problem, options_).Run();
}

}  // namespace plumescout
