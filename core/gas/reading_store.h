// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "absl/status/statusor.h"
#include "core/gas/ageing.h"
#include "core/gas/gmrf_graph.h"
#include "core/gas/information.h"
#include "core/gas/reading_site.h"
#include "core/types/gas_reading.h"
#include "core/types/map_snapshot.h"
#include "core/types/options.h"
#include "core/types/pose2.h"

namespace plumescout {

// What the readings say of each variable at one time, and how many said it.
struct PlacedReadings {
  std::vector<Evidence> evidence;  // by variable
  GasCounters counters;
};

// Every reading of a mission, kept by where it was taken, for ever.
//
// Readings of one site are merged: without ageing into their sums, so that memory and time follow
// the area that was visited, not the length of the mission; with ageing they are kept one by one,
// since each weight changes with time.
class ReadingStore {
 public:
  explicit ReadingStore(const GasOptions& options);

  // A reading that is not finite, or whose concentration is absurd, is counted and waits for ever.
  void Add(std::int64_t time_ns, Point2 position, const GasReading& reading);

  // Places all readings on `graph`, their precision as of `time_ns`. The first grid with cells
  // becomes the anchor lattice; later ones may begin elsewhere, by whole cells.
  // Errors: kInvalidArgument for a lattice of other resolution or between the cells.
  // Cost: O(sites log sites), with ageing O(readings) besides.
  absl::StatusOr<PlacedReadings> PlaceAll(const GmrfGraph& graph, std::int64_t time_ns);

 private:
  struct Reading {
    std::int64_t time_ns;
    double deviation_ppm;  // z_k - m_0
    double variance_ppm2;  // 1 / lambda_o of this reading
  };
  struct Arrival {
    Point2 position;
    Reading reading;
  };
  struct Record {
    std::int64_t count = 0;
    Evidence sums;                  // without ageing
    std::vector<Reading> readings;  // with ageing
  };

  void MergeArrivals();
  void Merge(const Reading& reading, Record& record) const;
  Evidence EvidenceOf(const Reading& reading, std::int64_t time_ns) const;
  Evidence EvidenceOf(const Record& record, std::int64_t time_ns) const;

  double background_mean_ppm_;
  Ageing ageing_;
  std::int64_t unusable_ = 0;
  GridGeometry anchor_;            // no cells: none yet
  std::vector<Arrival> arrivals_;  // not yet merged, for want of an anchor or of a refresh
  std::map<ReadingSite, Record> records_;
};

}  // namespace plumescout
