// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/grid/neighbours.h"
#include "core/grid/padded.h"
#include "core/types/cell_rect.h"
#include "core/types/grid.h"
#include "core/types/stop.h"

namespace plumescout {

// Where a search starts, and what the way to there has already cost: finite and not negative.
struct SearchSource {
  Cell cell;
  double travel_m = 0.0;
};

// The neighbour over which the shortest way enters `cell`; none if the way starts there.
// `travel(Cell) -> Length` gives what a search found, infinite where it did not come.
template <typename Length, typename Travel>
std::optional<Cell> Predecessor(Cell cell, double resolution_m, Connectivity connectivity,
                                Travel&& travel) {
  constexpr Length kUnreached = std::numeric_limits<Length>::infinity();
  const auto reached = [&travel](Cell c) { return travel(c) < kUnreached; };
  std::optional<Cell> best;
  Length best_m = travel(cell);
  for (const Cell offset : kNeighbours8) {
    if (IsDiagonal(offset) && connectivity == Connectivity::kFour) continue;
    if (connectivity == Connectivity::kEightNoCornerCut && !StepAllowed(cell, offset, reached)) {
      continue;
    }
    const Cell from = Shifted(cell, offset);
    // The same sum as the search formed, so that it is met exactly; infinite where not reached.
    const Length via_m =
        travel(from) + static_cast<Length>(StepLength_cells(offset) * resolution_m);
    if (via_m < best_m || (via_m == best_m && !best)) {
      best = from;
      best_m = via_m;
    }
  }
  return best;
}

// Dijkstra over the cells of a raster with a queue of buckets as wide as the shortest step (Dial;
// Denardo and Fox 1979): a step from one bucket always ends in a later one, so cells of one bucket
// need no order. The engine of core/grid/grid_search.h, for those that read the result in place.
//
// With Length = float a way of n steps is right to n roundings, one part in 10^4 on any map.
template <typename Length>
class TravelSearch {
 public:
  static constexpr Length kUnreached = std::numeric_limits<Length>::infinity();

  struct Entry {
    int cell;  // index of the padded raster
    Length travel_m;
  };

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

  // Spreads from the sources until `done(bucket)`, asked after each bucket, or all is reached.
  // Sources that are outside or not passable are passed over.
  template <typename Done>
  void Run(std::vector<SearchSource> sources, Done&& done) {
    const auto earlier = [](const SearchSource& a, const SearchSource& b) {
      return a.travel_m < b.travel_m;
    };
    if (!std::is_sorted(sources.begin(), sources.end(), earlier)) {
      std::sort(sources.begin(), sources.end(), earlier);
    }
    for (auto next = sources.begin(); next != sources.end() || IsWaiting(); ++level_) {
      if (!IsWaiting()) level_ = LevelOf(static_cast<Length>(next->travel_m));
      for (; next != sources.end(); ++next) {
        const auto travel_m = static_cast<Length>(next->travel_m);
        if (LevelOf(travel_m) > level_) break;
        if (!cells_.Contains(next->cell)) continue;
        Bucket& bucket = BucketOf(level_);
        bucket.count += Reach(travel_m_.IndexOf(next->cell), travel_m, true, bucket.Tail());
      }
      Bucket& bucket = BucketOf(level_);
      for (std::size_t i = 0; i < bucket.count; ++i) {
        const Entry entry = bucket.slots[i];
        if (entry.travel_m == travel_m_[entry.cell]) ReachNeighbours(entry);
      }
      if (done(std::span<const Entry>(bucket.slots.data(), bucket.count))) return;
      bucket.count = 0;
    }
  }
  void Run(std::vector<SearchSource> sources) {
    Run(std::move(sources), [](std::span<const Entry>) { return false; });
  }

  // Metres from the nearest source; kUnreached where blocked, not reached or outside.
  Length Travel(Cell cell) const {
    return cells_.Contains(cell) ? Unblocked(travel_m_[travel_m_.IndexOf(cell)]) : kUnreached;
  }

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
  // Below every length, so that no relaxation ever enters a blocked cell.
  static constexpr Length kBlocked = -1;
  static constexpr std::size_t kBuckets = 4;  // three are in use; a power of two is quicker

  static Length Unblocked(Length travel_m) { return travel_m == kBlocked ? kUnreached : travel_m; }

  std::int64_t LevelOf(Length travel_m) const {
    return static_cast<std::int64_t>(travel_m * levels_per_m_);
  }

  // Cells of one level; the slots behind `count` are room to write into.
  struct Bucket {
    static constexpr std::size_t kRoom = 8;  // as many as one visit may reach

    Entry* Tail() {
      if (slots.size() < count + kRoom) slots.resize(2 * (count + kRoom));
      return slots.data() + count;
    }

    std::vector<Entry> slots;
    std::size_t count = 0;
  };

  Bucket& BucketOf(std::int64_t level) {
    return buckets_[static_cast<std::size_t>(level) % kBuckets];
  }
  bool IsWaiting() const {
    return std::any_of(buckets_.begin(), buckets_.end(),
                       [](const Bucket& bucket) { return bucket.count > 0; });
  }

  // Shortens the way to `cell` if `allowed`, and writes it to `slot`. Returns 1 if it did, else 0,
  // without a branch: which neighbours are nearer is past predicting.
  std::size_t Reach(int cell, Length travel_m, bool allowed, Entry* slot) {
    Length& known_m = travel_m_[cell];
    const bool nearer = (travel_m < known_m) & allowed;
    known_m = nearer ? travel_m : known_m;
    *slot = {cell, travel_m};
    return nearer ? 1 : 0;
  }

  // A straight step leads into the next bucket, a diagonal one into that or the one after it.
  // Where rounding says otherwise a cell waits in a neighbouring bucket, which costs a second
  // visit at worst.
  void ReachNeighbours(const Entry& from) {
    Bucket& next = BucketOf(level_ + 1);
    Entry* tail = next.Tail();
    std::size_t count = 0;
    std::array<bool, 4> open{};
    const Length straight_m = from.travel_m + straight_m_;
    for (std::size_t k = 0; k < 4; ++k) {
      const int neighbour = from.cell + offsets_[k];
      open[k] = (travel_m_[neighbour] != kBlocked) | (connectivity_ == Connectivity::kEight);
      count += Reach(neighbour, straight_m, true, tail + count);
    }
    next.count += count;
    if (connectivity_ == Connectivity::kFour) return;
    const Length diagonal_m = from.travel_m + diagonal_m_;
    Bucket& after = LevelOf(diagonal_m) > level_ + 1 ? BucketOf(level_ + 2) : next;
    tail = after.Tail();
    count = 0;
    for (std::size_t k = 0; k < 4; ++k) {  // diagonal 4 + k lies between straights k and k + 1
      const bool allowed = (int{open[k]} & int{open[(k + 1) % 4]}) != 0;  // no branch
      count += Reach(from.cell + offsets_[4 + k], diagonal_m, allowed, tail + count);
    }
    after.count += count;
  }

  GridGeometry geometry_;
  CellRect cells_;
  Padded<Length> travel_m_;
  std::array<int, 8> offsets_;
  Connectivity connectivity_;
  Length straight_m_;
  Length diagonal_m_;
  Length levels_per_m_;
  std::array<Bucket, kBuckets> buckets_;
  std::int64_t level_ = 0;
};

}  // namespace plumescout
