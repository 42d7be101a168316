// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include "absl/status/status.h"
#include "core/gas/ageing.h"
#include "core/gas/ageing_watch.h"
#include "core/gas/anchor_cell.h"
#include "core/gas/anchored_states.h"
#include "core/gas/information.h"
#include "core/gas/reading_bucket.h"
#include "core/gas/reading_site.h"
#include "core/types/cell_state.h"
#include "core/types/gas_reading.h"
#include "core/types/grid.h"
#include "core/types/map_snapshot.h"
#include "core/types/options.h"
#include "core/types/pose2.h"

namespace plumescout {

struct CellEvidence {
  AnchorCell cell;
  Evidence evidence;
};

// Every reading of a mission, kept by where it was taken, for ever, and placed on the cells of a
// map that changes and grows.
//
//   store.Add(time_ns, position, reading);
//   RETURN_IF_ERROR(store.Place(states, changed));
//   for (AnchorCell cell : store.TakeChanged()) use(store.EvidenceAt(cell));
//
// Readings of one site are merged: without ageing into their sums, with it into buckets of like
// age. Memory and time follow the area that was visited, kSitesPerCell a cell at most, not the
// length of the mission. Those that wait to be placed are merged likewise once they are many.
// The evidence of a cell is always summed anew, site by site in a fixed order, and never corrected
// by differences: readings that came and went leave no trace in it. Thread-compatible.
class ReadingStore {
 public:
  // Readings kept one by one until the next Place; more are merged site by site.
  static constexpr std::size_t kMostArrivals = 4096;
  // Sites without a free cell that HasRoomFor lets come about.
  static constexpr std::size_t kMostWaitingSites = 100'000;

  // `resolution_m`: of the grids to come, whose cell edges then lie on whole multiples of it; so
  // that readings can be merged before the first. 0: unknown.
  explicit ReadingStore(const GasOptions& options, double resolution_m = 0.0);

  // A reading that is not finite, or whose concentration is absurd, is counted and waits for ever;
  // any other waits for the next Place. Cost: O(log sites), amortised.
  // `is_part`: of a reading of which another part was added, and counted.
  void Add(std::int64_t time_ns, Point2 position, const GasReading& reading, bool is_part = false);
  // Whether a reading there would not be one site too many of those that wait. Callers who do not
  // ask have room for any number.
  bool HasRoomFor(Point2 position) const;

  // Places what arrived, and places anew the sites near `changed`: the indices of at least those
  // cells of `states` that became free or ceased to be since the last call; beyond the grid nothing
  // is free. The first grid with cells becomes the anchor; later ones may begin elsewhere, by whole
  // cells. Errors, after which nothing has changed: kInvalidArgument as from CornerOf.
  // Cost: O((arrivals + min(changed, sites)) log sites); O(sites log sites) if the grid lost cells.
  absl::Status Place(const Grid<CellState>& states, std::span<const std::size_t> changed);

  // Cells whose evidence may have changed since the last call, ascending, each once.
  std::vector<AnchorCell> TakeChanged();

  // As of the last AgeTo, or of the AgeStale that aged the cell after that. Cost: O(buckets in the
  // cell).
  Evidence EvidenceAt(AnchorCell cell) const;
  // The same of all cells with evidence, ascending. Cost: O(buckets + sites log sites).
  std::vector<CellEvidence> AllEvidence() const;

  // All cells with evidence, ascending, as of `time_ns`, or later if AgeStale went further. The
  // same bits as AgeTo(time_ns) and EvidenceAt would give, until a cell's readings change or are
  // merged, or it is aged further. Cost: as of AllEvidence.
  std::vector<CellEvidence> EvidenceAsOf(std::int64_t time_ns) const;

  // From now on precisions are as of `time_ns`, or later where AgeStale went further; every cell
  // with evidence counts as changed. Without ageing nothing happens.
  void AgeTo(std::int64_t time_ns);
  // The same, only of cells whose variances would otherwise be wrong by more than
  // AgeingWatch::kMostError. REQUIRES: TakeChanged was called after the last change.
  void AgeStale(std::int64_t time_ns);
  // How wrong they are, as of what was taken from TakeChanged.
  const AgeingWatch& watch() const { return watch_; }

  // Merges readings of like age, within the bounds of MergeAlike for evidence as of `now_ns` or
  // later. A site that lies in a free cell and has brought nothing for a half-life is merged into
  // the centre of its cell: should the cell cease to be free, it moves as if taken there. So a cell
  // holds tens of buckets, not thousands. Evidence changes within these bounds, but does not count
  // as changed. Without ageing nothing happens. Cost: O(buckets log buckets).
  void Compact(std::int64_t now_ns);

  // The same readings, to be placed on another map as if none had been placed. REQUIRES: a
  // resolution. Cost: O(sites).
  ReadingStore Unplaced() const;

  const GridGeometry& anchor() const { return anchor_; }     // no cells: none yet
  const GasCounters& counters() const { return counters_; }  // current at any time
  std::size_t sites() const { return sites_.size(); }
  std::size_t buckets() const { return buckets_; }  // held by all sites
  // Sites that are not placed yet, each reading that is kept alone counted as one.
  std::size_t arrivals() const { return arrivals_.size() + merged_arrivals_.size(); }
  // Held by those of them that are merged.
  std::size_t arrival_buckets() const { return arrival_buckets_; }

  // REQUIRES: TakeChanged was called after the last change. What was read is to be placed by
  // PlaceAgain.
  template <typename Archive, typename Self>
  static void VisitState(Archive& archive, Self& self);
  // Places all sites on the states that they were placed on last, as they were then. Returns
  // whether they fit these. Cost: O(sites log sites).
  bool PlaceAgain(const AnchoredStates& states);

 private:
  struct Arrival {
    Point2 position;
    ReadingBucket reading;
    bool is_part = false;

    template <typename Archive, typename Self>
    static void VisitState(Archive& archive, Self& self);
  };
  struct Site {
    std::int64_t count = 0;
    Evidence sums;                       // without ageing
    std::vector<ReadingBucket> buckets;  // with ageing
    Placement placement;

    template <typename Archive, typename Self>
    static void VisitState(Archive& archive, Self& self);
  };
  struct PlacedCell {
    std::vector<ReadingSite> sites;  // ascending
    bool changed = false;
    std::int64_t aged_alone_to_ns = std::numeric_limits<std::int64_t>::min();
    std::size_t watched = 0;  // entry of watch_
  };
  using Sites = std::map<ReadingSite, Site>;
  // What of a PlacedCell and its entry of watch_ does not follow from sites and states.
  struct AgedCell {
    AnchorCell cell;
    std::int64_t aged_alone_to_ns = 0;
    Staleness staleness;

    template <typename Archive, typename Self>
    static void VisitState(Archive& archive, Self& self);
  };

  void PlaceSitesNear(AnchorCell cell, const Grid<CellState>& states);
  void PlaceSite(const ReadingSite& key, Site& site, const Grid<CellState>& states);
  void PlaceReadings(const ReadingSite& key, const Site& news, const Grid<CellState>& states);
  Site SiteOfOne(const Arrival& arrival) const;
  void MergeArrivals();
  void CountArrivalBuckets();
  void MergeBuckets(Site& site);
  GridGeometry Lattice() const;
  void Anchor(const GridGeometry& first);
  bool HasSettled(const Sites::value_type& entry, std::int64_t now_ns) const;
  Sites::iterator MoveToCentre(Sites::iterator from);
  void Count(const Placement& placement, std::int64_t readings);
  PlacedCell& MarkChanged(AnchorCell cell);
  std::int64_t AgedTo_ns(const PlacedCell& cell) const {
    return std::max(aged_to_ns_, cell.aged_alone_to_ns);
  }
  Staleness StalenessOf(const PlacedCell& cell) const;
  Evidence SumOver(const PlacedCell& cell, std::int64_t time_ns) const;
  std::vector<AgedCell> AgedCells() const;
  void Watch(const std::vector<AgedCell>& cells);

  GasOptions options_;
  double resolution_m_;
  Ageing ageing_;
  std::int64_t aged_to_ns_ = 0;
  GasCounters counters_;
  GridGeometry anchor_;
  AnchorRect extent_;              // of the last grid
  std::vector<Arrival> arrivals_;  // not yet placed, for want of an anchor or of a call
  Sites merged_arrivals_;          // those before them, on Lattice()
  Sites sites_;
  std::size_t waiting_sites_ = 0;           // of sites_, those in no cell
  std::size_t buckets_ = 0;                 // of sites_
  std::size_t arrival_buckets_ = 0;         // of merged_arrivals_
  std::map<AnchorCell, PlacedCell> cells_;  // all that ever had a site
  std::vector<AnchorCell> changed_;         // those marked so
  AgeingWatch watch_;                       // over cells_
};

}  // namespace plumescout
