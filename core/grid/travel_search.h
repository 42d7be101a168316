// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/grid/neighbours.h"
#include "core/grid/padded.h"
#include "core/grid/travel_levels.h"
#include "core/types/cell_rect.h"
#include "core/types/grid.h"
#include "core/types/stop.h"

namespace plumescout {

// Where a search starts, and what the way to there has already cost: finite and not negative.
struct SearchSource {
  Cell cell;
  double travel_m = 0.0;
};

// Dijkstra over the cells of a raster with a queue of buckets as wide as the shortest step (Dial;
// Denardo and Fox 1979): a step from one bucket always ends in a later one, so cells of one bucket
// need no order. The engine of core/grid/grid_search.h, for those that read the result in place.
// A cell spreads on in those directions alone in which no shorter way leads by the cell before it.
//
// With Length = float a way of n steps is right to n roundings, one part in 10^4 on any map.
template <typename Length>
class TravelSearch {
 public:
  static constexpr Length kUnreached = std::numeric_limits<Length>::infinity();

  // `passable`: callable (std::size_t index of the raster) -> bool. No cell is passable that lies
  // off `cells`. None is, and none may be asked about by index, if `stop`, which is asked all
  // along, says so.
  template <typename Passable>
  TravelSearch(const GridGeometry& geometry, const CellRect& cells, Connectivity connectivity,
               Passable&& passable, const StopFn& stop = {})
      : geometry_(geometry),
        cells_(cells),
        travel_m_(cells, kBlocked, kBlocked, stop),
        offsets_(travel_m_.NeighbourOffsets()),
        connectivity_(connectivity),
        straight_m_(static_cast<Length>(kStraightStep_cells * geometry.resolution_m)),
        diagonal_m_(static_cast<Length>(kDiagonalStep_cells * geometry.resolution_m)),
        levels_per_m_(Length{1} / straight_m_) {
    const auto open = [&](int y) {
      Length* const row = travel_m_.Row(y);
      const std::size_t first = geometry.Index({cells.min.x, y});
      for (int x = 0; x < cells.width(); ++x) {
        row[x] = passable(first + static_cast<std::size_t>(x)) ? kUnreached : kBlocked;
      }
    };
    if (!ByRows(cells.min.y, cells.end.y, cells.width(), stop, open)) cells_ = CellRect();
  }
  template <typename Passable>
  TravelSearch(const GridGeometry& geometry, Connectivity connectivity, Passable&& passable)
      : TravelSearch(geometry, WholeRaster(geometry), connectivity, passable) {}

  const CellRect& cells() const { return cells_; }

  // Cells of the search by index, which neighbours differ in by offsets(). REQUIRES: in cells(), or
  // beside them.
  int IndexOf(Cell cell) const { return travel_m_.IndexOf(cell); }
  Cell CellAt(int index) const { return travel_m_.CellAt(index); }
  const std::array<int, 8>& offsets() const { return offsets_; }

  // Make a cell passable or not, before the search.
  void Open(int cell) { travel_m_[cell] = kUnreached; }
  void Close(int cell) { travel_m_[cell] = kBlocked; }
  bool IsOpen(int cell) const { return travel_m_[cell] != kBlocked; }

  bool IsReached(int cell) const {
    return travel_m_[cell] != kBlocked && travel_m_[cell] != kUnreached;
  }
  // Reached, and no shorter way will be found. Meaningful within `done`.
  bool IsSettled(int cell) const { return IsReached(cell) && LevelOf(travel_m_[cell]) <= level_; }

  // Spreads from the sources until `done()`, asked after each level, or all is reached.
  // Sources that are outside or not passable are passed over.
  template <typename Done>
  void Run(std::vector<SearchSource> sources, Done&& done) {
    const auto earlier = [](const SearchSource& a, const SearchSource& b) {
      return a.travel_m < b.travel_m;
    };
    if (!std::is_sorted(sources.begin(), sources.end(), earlier)) {
      std::sort(sources.begin(), sources.end(), earlier);
    }
    for (auto next = sources.begin(); next != sources.end() || levels_.IsWaiting(); ++level_) {
      if (!levels_.IsWaiting()) level_ = LevelOf(static_cast<Length>(next->travel_m));
      Level& level = levels_.At(level_);
      for (; next != sources.end(); ++next) {
        const auto travel_m = static_cast<Length>(next->travel_m);
        if (LevelOf(travel_m) > level_) break;
        if (!cells_.Contains(next->cell)) continue;
        const Entry source = {travel_m_.IndexOf(next->cell), 0, travel_m};
        level.sources.count += Reach(source, 1, level.sources.Tail());
      }
      ForEachNearest(level.sources, [this](const Entry& entry) { SpreadFromSource(entry); });
      ForEachNearest(level.straight, [this](const Entry& entry) { SpreadFromStraight(entry); });
      ForEachNearest(level.diagonal, [this](const Entry& entry) { SpreadFromDiagonal(entry); });
      if (done()) return;
      level.Clear();
    }
  }
  void Run(std::vector<SearchSource> sources) {
    Run(std::move(sources), [] { return false; });
  }

  // Calls visit(cell, travel_m) for what was reached on the level that `done` is asked after.
  template <typename Visit>
  void ForEachOfLevel(const Visit& visit) {
    const Level& level = levels_.At(level_);
    for (const Bucket* const bucket : {&level.sources, &level.straight, &level.diagonal}) {
      ForEachNearest(*bucket, [&](const Entry& entry) { visit(entry.cell, entry.travel_m); });
    }
  }

  // Metres from the nearest source; kUnreached where blocked, not reached or outside.
  Length Travel(Cell cell) const {
    return cells_.Contains(cell) ? TravelAt(travel_m_.IndexOf(cell)) : kUnreached;
  }
  Length TravelAt(int cell) const { return Unblocked(travel_m_[cell]); }

  // The cells from a source to `goal`, both included; empty if not reached.
  std::vector<Cell> WayTo(Cell goal) const {
    if (Travel(goal) == kUnreached) return {};
    std::vector<Cell> way = {goal};
    const auto travel = [this](Cell cell) { return Travel(cell); };
    while (const std::optional<Cell> from =
               Predecessor<Length>(way.back(), geometry_.resolution_m, connectivity_, travel)) {
      way.push_back(*from);
    }
    std::reverse(way.begin(), way.end());
    return way;
  }

  // REQUIRES: cells() are the whole raster.
  Grid<Length> Field() const { return GridFrom<Length>(travel_m_, geometry_, Unblocked); }

 private:
  using Entry = TravelEntry<Length>;
  using Bucket = TravelBucket<Length>;
  using Level = TravelLevel<Length>;

  // Below every length, so that no relaxation ever enters a blocked cell.
  static constexpr Length kBlocked = -1;

  static Length Unblocked(Length travel_m) { return travel_m == kBlocked ? kUnreached : travel_m; }

  std::int64_t LevelOf(Length travel_m) const {
    return static_cast<std::int64_t>(travel_m * levels_per_m_);
  }

  // Those that nothing nearer has been found for since.
  template <typename Visit>
  void ForEachNearest(const Bucket& bucket, const Visit& visit) const {
    for (std::size_t i = 0; i < bucket.count; ++i) {
      const Entry entry = bucket.slots[i];
      if (entry.travel_m == travel_m_[entry.cell]) visit(entry);
    }
  }

  // Shortens the way to a cell if `allowed` is 1, and writes it to `slot`. Returns 1 if it did,
  // else 0, without a branch: which neighbours are nearer is past predicting.
  std::size_t Reach(const Entry& entry, int allowed, Entry* slot) {
    Length& known_m = travel_m_[entry.cell];
    const int nearer = int{entry.travel_m < known_m} & allowed;
    known_m = nearer != 0 ? entry.travel_m : known_m;
    *slot = entry;
    return static_cast<std::size_t>(nearer);
  }

  // A diagonal step, and where in a list of straight steps those are that it lies between.
  struct Diagonal {
    int way;
    std::size_t left;
    std::size_t right;
  };

  // Takes these steps, ways of 0 to 3 as kNeighbours8 has them. A straight step leads to the next
  // level, a diagonal one to that or the one after it. Where rounding says otherwise a cell waits
  // on a neighbouring level, which costs a second visit at worst.
  template <std::size_t kStraight, std::size_t kDiagonal>
  void Spread(const Entry& from, const std::array<int, kStraight>& straight,
              const std::array<Diagonal, kDiagonal>& diagonal) {
    Level& next = levels_.At(level_ + 1);
    Entry* tail = next.straight.Tail();
    std::size_t count = 0;
    std::array<int, kStraight> open{};
    const Length straight_m = from.travel_m + straight_m_;
    for (std::size_t k = 0; k < kStraight; ++k) {
      const int cell = from.cell + offsets_[static_cast<std::size_t>(straight[k])];
      open[k] = int{travel_m_[cell] != kBlocked} | int{connectivity_ == Connectivity::kEight};
      count += Reach({cell, straight[k], straight_m}, 1, tail + count);
    }
    next.straight.count += count;
    if (connectivity_ == Connectivity::kFour) return;
    const Length diagonal_m = from.travel_m + diagonal_m_;
    Bucket& after = (LevelOf(diagonal_m) > level_ + 1 ? levels_.At(level_ + 2) : next).diagonal;
    tail = after.Tail();
    count = 0;
    for (const Diagonal& step : diagonal) {
      const int cell = from.cell + offsets_[static_cast<std::size_t>(4 + step.way)];
      count +=
          Reach({cell, step.way, diagonal_m}, open[step.left] & open[step.right], tail + count);
    }
    after.count += count;
  }

  void SpreadFromSource(const Entry& from) {
    Spread<4, 4>(from, {0, 1, 2, 3}, {{{0, 0, 1}, {1, 1, 2}, {2, 2, 3}, {3, 3, 0}}});
  }
  // What lies behind, or beside the cell before, is nearer to that one by 2 - sqrt(2) steps or
  // more.
  void SpreadFromStraight(const Entry& from) {
    const int left = (from.way + 1) % 4;
    const int right = (from.way + 3) % 4;
    Spread<3, 2>(from, {from.way, left, right}, {{{from.way, 0, 1}, {right, 0, 2}}});
  }
  // The cells beside a diagonal step are open if no corner is cut. Else they may stand in the way
  // of the ways that are shorter.
  void SpreadFromDiagonal(const Entry& from) {
    const int left = (from.way + 1) % 4;
    const int right = (from.way + 3) % 4;
    if (connectivity_ == Connectivity::kEight) {
      Spread<2, 3>(from, {from.way, left}, {{{from.way, 0, 1}, {left, 0, 1}, {right, 0, 1}}});
    } else {
      Spread<2, 1>(from, {from.way, left}, {{{from.way, 0, 1}}});
    }
  }

  GridGeometry geometry_;
  CellRect cells_;
  Padded<Length> travel_m_;
  std::array<int, 8> offsets_;
  Connectivity connectivity_;
  Length straight_m_;
  Length diagonal_m_;
  Length levels_per_m_;
  TravelLevels<Length> levels_;
  std::int64_t level_ = 0;
};

}  // namespace plumescout
