// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "core/types/gas_at_place.h"
#include "core/types/grid.h"
#include "core/types/pose2.h"

namespace plumescout {

// The cells in which readings of a gas were taken, and when the newest were, by their place in the
// world: cells of a map that grows move, these do not. Thread-compatible.
class SampledCells {
 public:
  // Of maps with this resolution, whose cell edges lie on whole multiples of it.
  explicit SampledCells(double resolution_m) : resolution_m_(resolution_m) {}

  // Whether the cell is new. Cost: O(log cells); if it is, O(cells of its column).
  bool Add(std::int64_t time_ns, Point2 place);

  // 1: sampled. Cost: O(cells).
  Grid<std::uint8_t> On(const GridGeometry& geometry) const;

  // The newest reading of the cell whose middle is nearest; of cells as near, of that which was
  // read last. None if there is none. REQUIRES: finite place. Cost: O(columns nearer than it *
  // log).
  std::optional<NearestReading> Nearest(Point2 place) const;

  // See core/types/byte_archive.h. Times are not hashed: states of before they were kept have none.
  template <typename Archive, typename Self>
  static void VisitState(Archive& archive, Self& self) {
    std::set<std::pair<std::int64_t, std::int64_t>> cells;
    std::vector<std::int64_t> newest_ns;  // in their order
    if constexpr (!Archive::kReads) {
      for (const auto& [x, column] : self.columns_) {
        for (const Sampled& cell : column) {
          cells.insert(cells.end(), {x, cell.y});
          newest_ns.push_back(cell.newest_ns);
        }
      }
    }
    archive(cells);
    if constexpr (!Archive::kHashes) archive.Since(2, newest_ns);
    if constexpr (Archive::kReads) {
      archive.Require(newest_ns.empty() || newest_ns.size() == cells.size(),
                      "a sampled cell has no time");
      if (!archive.ok()) return;
      newest_ns.resize(cells.size(), kNoTime_ns);
      self.columns_.clear();
      std::size_t i = 0;
      for (const auto& [x, y] : cells) self.columns_[x].push_back({y, newest_ns[i++]});
    }
  }

 private:
  static constexpr std::int64_t kNoTime_ns = std::numeric_limits<std::int64_t>::min();

  struct Sampled {
    std::int64_t y = 0;
    std::int64_t newest_ns = kNoTime_ns;
  };
  using Column = std::vector<Sampled>;  // ascending

  std::int64_t Index(double coordinate_m) const;
  double Middle_m(std::int64_t index) const;
  Point2 MiddleOf(std::int64_t x, std::int64_t y) const { return {Middle_m(x), Middle_m(y)}; }
  static Column::const_iterator FirstFrom(std::int64_t y, const Column& column);

  double resolution_m_;
  std::map<std::int64_t, Column> columns_;  // copied with every snapshot of a mission: few nodes
};

}  // namespace plumescout
