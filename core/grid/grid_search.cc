// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/grid/grid_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/grid/padded.h"

namespace plumescout {
namespace {

// Below every length, so that no relaxation ever enters a blocked cell.
constexpr double kBlocked = -1.0;

// Dijkstra with a queue of buckets as wide as the shortest step (Dial; Denardo and Fox 1979): a
// step from one bucket always ends in a later one, so cells of one bucket need no order. Rounding
// can at worst put a step back into the bucket at hand; its cells are then simply visited again.
class Wavefront {
 public:
  Wavefront(const Grid<std::uint8_t>& passable, Connectivity connectivity)
      : geometry_(passable.geometry()),
        travel_m_(PaddedFrom<double>(
            passable, kBlocked, [](std::uint8_t ok) { return ok != 0 ? kUnreached_m : kBlocked; })),
        offsets_(travel_m_.NeighbourOffsets()),
        connectivity_(connectivity),
        straight_m_(kStraightStep_cells * geometry_.resolution_m),
        diagonal_m_(kDiagonalStep_cells * geometry_.resolution_m) {}

  void Open(Cell cell) { travel_m_[travel_m_.IndexOf(cell)] = kUnreached_m; }

  // Spreads from the sources until `done(bucket)` says so, asked after each bucket, or all is
  // reached.
  template <typename Done>
  void Run(std::vector<SearchSource> sources, Done&& done) {
    std::sort(sources.begin(), sources.end(),
              [](const SearchSource& a, const SearchSource& b) { return a.travel_m < b.travel_m; });
    auto next_source = sources.begin();
    while (next_source != sources.end() || waiting_ > 0) {
      if (waiting_ == 0) level_ = std::max(level_, LevelOf(next_source->travel_m));
      for (; next_source != sources.end() && LevelOf(next_source->travel_m) <= level_;
           ++next_source) {
        if (geometry_.Contains(next_source->cell)) {
          Reach(travel_m_.IndexOf(next_source->cell), next_source->travel_m);
        }
      }
      std::vector<Entry>& bucket = BucketOf(level_);
      VisitAll(bucket);
      if (done(bucket)) return;
      bucket.clear();
      ++level_;
    }
  }

  struct Entry {
    int cell;
    double travel_m;
  };

  Cell CellOf(const Entry& entry) const { return travel_m_.CellAt(entry.cell); }

  Grid<double> Field() const {
    return GridFrom<double>(travel_m_, geometry_,
                            [](double d) { return d == kBlocked ? kUnreached_m : d; });
  }

 private:
  std::int64_t LevelOf(double travel_m) const {
    return static_cast<std::int64_t>(travel_m / straight_m_);
  }

  std::vector<Entry>& BucketOf(std::int64_t level) {
    return buckets_[static_cast<std::size_t>(level) % buckets_.size()];
  }

  void Reach(int cell, double travel_m) {
    if (!(travel_m < travel_m_[cell])) return;
    travel_m_[cell] = travel_m;
    BucketOf(std::max(LevelOf(travel_m), level_)).push_back({cell, travel_m});
    ++waiting_;
  }

  // Settles the cells of the bucket at hand and reaches their neighbours.
  void VisitAll(const std::vector<Entry>& bucket) {
    for (std::size_t i = 0; i < bucket.size(); ++i) {  // which grows under rounding
      const Entry entry = bucket[i];
      --waiting_;
      if (entry.travel_m == travel_m_[entry.cell]) ReachNeighbours(entry);
    }
  }

  void ReachNeighbours(const Entry& from) {
    std::array<bool, 4> open{};
    for (std::size_t k = 0; k < 4; ++k) {
      open[k] = travel_m_[from.cell + offsets_[k]] != kBlocked;
      Reach(from.cell + offsets_[k], from.travel_m + straight_m_);
    }
    if (connectivity_ == Connectivity::kFour) return;
    const bool may_cut = connectivity_ == Connectivity::kEight;
    for (std::size_t k = 0; k < 4; ++k) {  // diagonal 4 + k lies between straights k and k + 1
      if (may_cut || (open[k] && open[(k + 1) % 4])) {
        Reach(from.cell + offsets_[4 + k], from.travel_m + diagonal_m_);
      }
    }
  }

  // A diagonal step leads at most two buckets on, three with rounding.
  static constexpr std::int64_t kBuckets = 4;

  GridGeometry geometry_;
  Padded<double> travel_m_;
  std::array<int, 8> offsets_;
  Connectivity connectivity_;
  double straight_m_;
  double diagonal_m_;
  std::array<std::vector<Entry>, kBuckets> buckets_;
  std::int64_t level_ = 0;
  std::int64_t waiting_ = 0;  // entries not visited yet
};

// The neighbour over which the shortest way enters `cell`; none if the way starts there.
std::optional<Cell> Predecessor(const Grid<double>& travel_m, Cell cell,
                                Connectivity connectivity) {
  const auto reached = [&travel_m](Cell c) { return travel_m.At(c, kUnreached_m) < kUnreached_m; };
  std::optional<Cell> best;
  double best_m = travel_m[cell];
  for (const Cell offset : kNeighbours8) {
    const Cell from = Shifted(cell, offset);
    if (!reached(from)) continue;
    if (IsDiagonal(offset) && connectivity == Connectivity::kFour) continue;
    if (connectivity == Connectivity::kEightNoCornerCut && !StepAllowed(cell, offset, reached)) {
      continue;
    }
    // The same sum as the search formed, so that it is met exactly.
    const double via_m =
        travel_m[from] + StepLength_cells(offset) * travel_m.geometry().resolution_m;
    if (via_m < best_m || (via_m == best_m && !best)) {
      best = from;
      best_m = via_m;
    }
  }
  return best;
}

}  // namespace

Grid<double> TravelDistances_m(const Grid<std::uint8_t>& passable,
                               const std::vector<SearchSource>& sources,
                               Connectivity connectivity) {
  Wavefront wavefront(passable, connectivity);
  wavefront.Run(sources, [](const auto&) { return false; });
  return wavefront.Field();
}

Grid<double> TravelDistances_m(const Grid<std::uint8_t>& passable, const std::vector<Cell>& starts,
                               Connectivity connectivity) {
  std::vector<SearchSource> sources;
  sources.reserve(starts.size());
  for (const Cell start : starts) sources.push_back({start, 0.0});
  return TravelDistances_m(passable, sources, connectivity);
}

std::vector<Cell> ShortestPath(const Grid<double>& travel_m, Cell goal, Connectivity connectivity) {
  if (!(travel_m.At(goal, kUnreached_m) < kUnreached_m)) return {};
  std::vector<Cell> path = {goal};
  while (const std::optional<Cell> from = Predecessor(travel_m, path.back(), connectivity)) {
    path.push_back(*from);
  }
  std::reverse(path.begin(), path.end());
  return path;
}

std::vector<Cell> PathToNearest(const Grid<std::uint8_t>& passable,
                                const Grid<std::uint8_t>& targets, Cell start) {
  if (!passable.Contains(start)) return {};
  Wavefront wavefront(passable, Connectivity::kEightNoCornerCut);
  wavefront.Open(start);
  std::optional<Cell> nearest;
  double nearest_m = kUnreached_m;
  wavefront.Run({{start, 0.0}}, [&](const std::vector<Wavefront::Entry>& bucket) {
    for (const Wavefront::Entry& entry : bucket) {
      const Cell cell = wavefront.CellOf(entry);
      if (targets[cell] == 0 || entry.travel_m > nearest_m) continue;
      if (entry.travel_m == nearest_m &&
          targets.geometry().Index(*nearest) < targets.geometry().Index(cell)) {
        continue;
      }
      nearest = cell;
      nearest_m = entry.travel_m;
    }
    return nearest.has_value();
  });
  if (!nearest) return {};
  return ShortestPath(wavefront.Field(), *nearest);
}

double PathLength_m(const std::vector<Cell>& path, double resolution_m) {
  double length_cells = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    length_cells += StepLength_cells({path[i].x - path[i - 1].x, path[i].y - path[i - 1].y});
  }
  return length_cells * resolution_m;
}

}  // namespace plumescout
