// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/reading_state.h"

namespace plumescout {

// In the order of cells, not that in which they came to be watched: that tells nothing.
std::vector<ReadingStore::AgedCell> ReadingStore::AgedCells() const {
  std::vector<AgedCell> aged;
  aged.reserve(cells_.size());
  for (const auto& [cell, placed] : cells_) {
    aged.push_back({cell, placed.aged_alone_to_ns, watch_.staleness(placed.watched)});
  }
  return aged;
}

void ReadingStore::Watch(const std::vector<AgedCell>& cells) {
  cells_.clear();
  changed_.clear();
  watch_ = {};
  for (const AgedCell& aged : cells) {
    PlacedCell& placed = cells_[aged.cell];
    placed.aged_alone_to_ns = aged.aged_alone_to_ns;
    placed.watched = watch_.Add(aged.cell);
    watch_.Set(placed.watched, aged.staleness);
  }
}

bool ReadingStore::PlaceAgain(const AnchoredStates& states) {
  anchor_ = states.anchor();
  extent_ = {};
  if (!states.empty()) {
    extent_ = AnchorRect::Sized(states.At(0), states.states().width(), states.states().height());
  }
  waiting_sites_ = 0;
  buckets_ = 0;
  for (auto& [key, site] : sites_) {
    site.placement = PlacementOf(key, states.states(), extent_.min);
    buckets_ += site.buckets.size();
    if (!site.placement.cell) {
      ++waiting_sites_;
      continue;
    }
    const auto placed = cells_.find(*site.placement.cell);
    if (placed == cells_.end()) return false;
    placed->second.sites.push_back(key);  // sites ascend
  }
  return true;
}

}  // namespace plumescout
