// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/reading_store.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "core/gas/gas_scale.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// Far beyond pure gas (1e6 ppm); sums of such readings stay finite.
constexpr double kMostConcentration_ppm = 1e9;

bool IsUsable(Point2 position, const GasReading& reading) {
  return std::isfinite(position.x_m) && std::isfinite(position.y_m) &&
         std::abs(reading.concentration_ppm) <= kMostConcentration_ppm &&
         std::isfinite(reading.variance_ppm2) && reading.variance_ppm2 >= 0.0;
}

void Insert(const ReadingSite& site, std::vector<ReadingSite>& sites) {
  sites.insert(std::lower_bound(sites.begin(), sites.end(), site), site);
}

}  // namespace

ReadingStore::ReadingStore(const GasOptions& options, double resolution_m)
    : options_(options), resolution_m_(resolution_m), ageing_(options) {}

void ReadingStore::Add(std::int64_t time_ns, Point2 position, const GasReading& reading,
                       bool is_part) {
  if (!is_part) {
    ++counters_.readings;
    ++counters_.waiting;
  }
  if (!IsUsable(position, reading)) return;
  arrivals_.push_back({position,
                       BucketOf(time_ns, ageing_.InitialVariance_ppm2(reading),
                                DeviationOnScale(options_, reading.concentration_ppm)),
                       is_part});
  if (arrivals_.size() >= kMostArrivals) MergeArrivals();
}

bool ReadingStore::HasRoomFor(Point2 position) const {
  if (waiting_sites_ + arrivals() < kMostWaitingSites) return true;
  const GridGeometry lattice = Lattice();
  if (lattice.resolution_m == 0.0) return false;
  const ReadingSite site = SiteOf(position, lattice);
  return sites_.contains(site) || merged_arrivals_.contains(site);
}

// By which sites are counted now: before there is an anchor, from (0, 0) of the frame.
GridGeometry ReadingStore::Lattice() const {
  return anchor_.size() > 0 ? anchor_ : GridGeometry{0.0, 0.0, resolution_m_, 0, 0};
}

void ReadingStore::Anchor(const GridGeometry& first) {
  if (!merged_arrivals_.empty()) {
    const Cell corner = Lattice().CellAt(first.Center({0, 0}));
    Sites moved;
    for (auto& [key, site] : merged_arrivals_) {
      const AnchorCell cell{key.cell.x - corner.x, key.cell.y - corner.y};
      moved.emplace_hint(moved.end(), ReadingSite{cell, key.neighbour_order}, std::move(site));
    }
    merged_arrivals_ = std::move(moved);
  }
  anchor_ = first;
}

ReadingStore ReadingStore::Unplaced() const {
  ReadingStore store = *this;
  store.anchor_ = {};
  store.extent_ = {};
  store.sites_.clear();
  store.merged_arrivals_.clear();
  store.waiting_sites_ = 0;
  store.buckets_ = 0;
  store.cells_.clear();
  store.changed_.clear();
  store.watch_ = {};
  store.aged_to_ns_ = 0;
  store.counters_ = {};
  store.counters_.readings = store.counters_.waiting = counters_.readings;
  Cell corner;
  if (anchor_.size() > 0) corner = store.Lattice().CellAt(anchor_.Center({0, 0}));
  for (const Sites* sites : {&sites_, &merged_arrivals_}) {
    for (const auto& [key, site] : *sites) {
      const AnchorCell cell{key.cell.x + corner.x, key.cell.y + corner.y};
      Site& merged = store.merged_arrivals_[ReadingSite{cell, key.neighbour_order}];
      merged.count += site.count;
      merged.sums += site.sums;
      merged.buckets.insert(merged.buckets.end(), site.buckets.begin(), site.buckets.end());
    }
  }
  store.CountArrivalBuckets();
  return store;
}

void ReadingStore::CountArrivalBuckets() {
  arrival_buckets_ = 0;
  for (const auto& [key, site] : merged_arrivals_) arrival_buckets_ += site.buckets.size();
}

void ReadingStore::MergeArrivals() {
  const GridGeometry lattice = Lattice();
  if (lattice.resolution_m == 0.0) return;
  for (const Arrival& arrival : arrivals_) {
    Site& site = merged_arrivals_[SiteOf(arrival.position, lattice)];
    const Site one = SiteOfOne(arrival);
    site.count += one.count;
    site.sums += one.sums;
    arrival_buckets_ -= site.buckets.size();
    site.buckets.insert(site.buckets.end(), one.buckets.begin(), one.buckets.end());
    MergeBuckets(site);
    arrival_buckets_ += site.buckets.size();
  }
  arrivals_.clear();
}

ReadingStore::Site ReadingStore::SiteOfOne(const Arrival& arrival) const {
  Site site;
  site.count = arrival.is_part ? 0 : 1;
  if (ageing_.enabled()) {
    site.buckets.push_back(arrival.reading);
  } else {
    site.sums += EvidenceOf(arrival.reading, ageing_, arrival.reading.newest_ns);
  }
  return site;
}

// Bounds the buckets of a site that no epoch merges: one that waits, and one whose readings come
// faster than sample time passes.
void ReadingStore::MergeBuckets(Site& site) {
  constexpr std::size_t kMostWaiting = 256;
  constexpr std::size_t kMostPlaced = 4096;
  if (site.buckets.size() < (site.placement.cell ? kMostPlaced : kMostWaiting)) return;
  std::int64_t newest_ns = site.buckets.front().newest_ns;
  for (const ReadingBucket& bucket : site.buckets) {
    newest_ns = std::max(newest_ns, bucket.newest_ns);
  }
  MergeAlike(newest_ns, ageing_, site.buckets);
}

absl::Status ReadingStore::Place(const Grid<CellState>& states,
                                 std::span<const std::size_t> changed) {
  const bool is_first = anchor_.size() == 0;
  if (is_first && states.size() == 0) return absl::OkStatus();
  PLUMESCOUT_ASSIGN_OR_RETURN(const AnchorCell corner,
                              CornerOf(states.geometry(), is_first ? states.geometry() : anchor_));
  if (is_first) Anchor(states.geometry());
  const AnchorRect before =
      std::exchange(extent_, AnchorRect::Sized(corner, states.width(), states.height()));
  if (!extent_.Covers(before) || changed.size() >= sites_.size()) {
    for (auto& [key, site] : sites_) PlaceSite(key, site, states);
  } else {
    for (const std::size_t index : changed) {
      const Cell cell = states.geometry().CellAtIndex(index);
      PlaceSitesNear({corner.x + cell.x, corner.y + cell.y}, states);
    }
  }
  for (const auto& [key, site] : merged_arrivals_) PlaceReadings(key, site, states);
  merged_arrivals_.clear();
  arrival_buckets_ = 0;
  for (const Arrival& arrival : arrivals_) {
    PlaceReadings(SiteOf(arrival.position, anchor_), SiteOfOne(arrival), states);
  }
  arrivals_.clear();
  return absl::OkStatus();
}

// Only sites within one cell can be placed on a cell, or anew because of it.
void ReadingStore::PlaceSitesNear(AnchorCell cell, const Grid<CellState>& states) {
  constexpr std::uint32_t kLastOrder = std::numeric_limits<std::uint32_t>::max();
  for (int y = cell.y - 1; y <= cell.y + 1; ++y) {
    const auto end = sites_.upper_bound({{cell.x + 1, y}, kLastOrder});
    for (auto it = sites_.lower_bound({{cell.x - 1, y}, 0}); it != end; ++it) {
      PlaceSite(it->first, it->second, states);
    }
  }
}

void ReadingStore::PlaceSite(const ReadingSite& key, Site& site, const Grid<CellState>& states) {
  const Placement placement = PlacementOf(key, states, extent_.min);
  if (placement == site.placement) return;
  Count(site.placement, -site.count);
  if (site.placement.cell) std::erase(MarkChanged(*site.placement.cell).sites, key);
  if (site.placement.cell && !placement.cell) ++waiting_sites_;
  if (!site.placement.cell && placement.cell) --waiting_sites_;
  site.placement = placement;
  Count(site.placement, site.count);
  if (site.placement.cell) Insert(key, MarkChanged(*site.placement.cell).sites);
}

void ReadingStore::PlaceReadings(const ReadingSite& key, const Site& news,
                                 const Grid<CellState>& states) {
  const auto [it, is_new] = sites_.try_emplace(key);
  Site& site = it->second;
  if (is_new) {
    ++waiting_sites_;
    PlaceSite(key, site, states);
  }
  buckets_ -= site.buckets.size();
  site.count += news.count;
  site.sums += news.sums;
  site.buckets.insert(site.buckets.end(), news.buckets.begin(), news.buckets.end());
  MergeBuckets(site);
  buckets_ += site.buckets.size();
  counters_.waiting -= news.count;  // as arrivals
  Count(site.placement, news.count);
  if (site.placement.cell) MarkChanged(*site.placement.cell);
}

void ReadingStore::Count(const Placement& placement, std::int64_t readings) {
  (placement.cell ? counters_.in_posterior : counters_.waiting) += readings;
  if (placement.moved) counters_.moved_to_neighbour += readings;
}

ReadingStore::PlacedCell& ReadingStore::MarkChanged(AnchorCell cell) {
  const auto [it, is_new] = cells_.try_emplace(cell);
  PlacedCell& placed = it->second;
  if (is_new) placed.watched = watch_.Add(cell);
  if (!std::exchange(placed.changed, true)) changed_.push_back(cell);
  return placed;
}

std::vector<AnchorCell> ReadingStore::TakeChanged() {
  std::sort(changed_.begin(), changed_.end());
  for (const AnchorCell cell : changed_) {
    PlacedCell& placed = cells_.find(cell)->second;
    placed.changed = false;
    watch_.Set(placed.watched, StalenessOf(placed));
  }
  return std::exchange(changed_, {});
}

Evidence ReadingStore::EvidenceAt(AnchorCell cell) const {
  const auto it = cells_.find(cell);
  return it == cells_.end() ? Evidence{} : SumOver(it->second, AgedTo_ns(it->second));
}

std::vector<CellEvidence> ReadingStore::AllEvidence() const { return EvidenceAsOf(aged_to_ns_); }

std::vector<CellEvidence> ReadingStore::EvidenceAsOf(std::int64_t time_ns) const {
  std::vector<CellEvidence> evidence;
  for (const auto& [cell, placed] : cells_) {
    if (placed.sites.empty()) continue;
    evidence.push_back({cell, SumOver(placed, std::max(time_ns, placed.aged_alone_to_ns))});
  }
  return evidence;
}

// The fastest growth of any reading, and the earliest instant from which any grows.
Staleness ReadingStore::StalenessOf(const PlacedCell& cell) const {
  if (!ageing_.enabled()) return {};
  const std::int64_t aged_to_ns = AgedTo_ns(cell);
  Staleness staleness;
  for (const ReadingSite& key : cell.sites) {
    for (const ReadingBucket& bucket : sites_.find(key)->second.buckets) {
      const std::int64_t since_ns = std::max(aged_to_ns, bucket.newest_ns);
      const bool is_first = staleness.share_per_s == 0.0;
      staleness.since_ns = is_first ? since_ns : std::min(staleness.since_ns, since_ns);
      staleness.share_per_s = std::max(
          staleness.share_per_s, ageing_.GrowthShare_per_s(ageing_.Variance_ppm2(
                                     bucket.least_variance_ppm2, bucket.newest_ns, aged_to_ns)));
    }
  }
  return staleness;
}

Evidence ReadingStore::SumOver(const PlacedCell& cell, std::int64_t time_ns) const {
  Evidence evidence;
  for (const ReadingSite& key : cell.sites) {
    const Site& site = sites_.find(key)->second;
    evidence += site.sums;
    for (const ReadingBucket& bucket : site.buckets) {
      evidence += EvidenceOf(bucket, ageing_, time_ns);
    }
  }
  return evidence;
}

void ReadingStore::AgeTo(std::int64_t time_ns) {
  if (!ageing_.enabled()) return;
  aged_to_ns_ = time_ns;
  for (const auto& [cell, placed] : cells_) {
    if (!placed.sites.empty()) MarkChanged(cell);
  }
}

void ReadingStore::AgeStale(std::int64_t time_ns) {
  for (const AnchorCell cell : watch_.TooOld(time_ns)) {
    MarkChanged(cell).aged_alone_to_ns = time_ns;
  }
}

void ReadingStore::Compact(std::int64_t now_ns) {
  if (!ageing_.enabled()) return;
  for (auto it = sites_.begin(); it != sites_.end();) {
    it = HasSettled(*it, now_ns) ? MoveToCentre(it) : std::next(it);
  }
  buckets_ = 0;
  for (auto& [key, site] : sites_) {
    MergeAlike(now_ns, ageing_, site.buckets);
    buckets_ += site.buckets.size();
  }
}

bool ReadingStore::HasSettled(const Sites::value_type& entry, std::int64_t now_ns) const {
  const auto& [key, site] = entry;
  return site.placement.cell == key.cell && key != CentreOf(key.cell) &&
         std::all_of(site.buckets.begin(), site.buckets.end(), [&](const ReadingBucket& bucket) {
           return ageing_.IsHalved(bucket.newest_ns, now_ns);
         });
}

// Both sites lie in the same free cell, so nothing but the order of summation changes.
ReadingStore::Sites::iterator ReadingStore::MoveToCentre(Sites::iterator from) {
  const auto& [key, site] = *from;
  const ReadingSite centre_key = CentreOf(key.cell);
  std::vector<ReadingSite>& in_cell = cells_[key.cell].sites;
  const auto [it, is_new] = sites_.try_emplace(centre_key);
  Site& centre = it->second;
  if (is_new) {
    centre.placement = site.placement;
    Insert(centre_key, in_cell);
  }
  centre.count += site.count;
  centre.buckets.insert(centre.buckets.end(), site.buckets.begin(), site.buckets.end());
  std::erase(in_cell, key);
  return sites_.erase(from);
}

}  // namespace plumescout
