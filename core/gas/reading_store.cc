// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/reading_store.h"

#include <cmath>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
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

struct Shift {
  std::int64_t x = 0;
  std::int64_t y = 0;
};

// The cell of `geometry` in which the anchor's cell (0, 0) lies.
absl::StatusOr<Shift> ShiftOf(const GridGeometry& anchor, const GridGeometry& geometry) {
  constexpr double kTolerance_cells = 1e-3;  // origins are sums of rounded tile sizes
  const double x = (anchor.origin_x_m - geometry.origin_x_m) / anchor.resolution_m;
  const double y = (anchor.origin_y_m - geometry.origin_y_m) / anchor.resolution_m;
  if (geometry.resolution_m != anchor.resolution_m ||
      !(std::abs(x - std::round(x)) <= kTolerance_cells) ||
      !(std::abs(y - std::round(y)) <= kTolerance_cells)) {
    return absl::InvalidArgumentError(absl::StrCat(
        "gas map: lattice of ", geometry.resolution_m, " m from (", geometry.origin_x_m, ", ",
        geometry.origin_y_m, ") does not match ", anchor.resolution_m, " m from (",
        anchor.origin_x_m, ", ", anchor.origin_y_m, ")"));
  }
  return Shift{std::llround(x), std::llround(y)};
}

}  // namespace

ReadingStore::ReadingStore(const GasOptions& options)
    : background_mean_ppm_(options.background_mean_ppm), ageing_(options) {}

void ReadingStore::Add(std::int64_t time_ns, Point2 position, const GasReading& reading) {
  if (!IsUsable(position, reading)) {
    ++unusable_;
    return;
  }
  arrivals_.push_back({position,
                       {time_ns, reading.concentration_ppm - background_mean_ppm_,
                        ageing_.InitialVariance_ppm2(reading.variance_ppm2)}});
}

absl::StatusOr<PlacedReadings> ReadingStore::PlaceAll(const GmrfGraph& graph,
                                                      std::int64_t time_ns) {
  PlacedReadings placed;
  placed.evidence.resize(static_cast<std::size_t>(graph.variables()));
  placed.counters.waiting = unusable_ + static_cast<std::int64_t>(arrivals_.size());
  placed.counters.readings = placed.counters.waiting;
  if (graph.geometry().size() == 0 && anchor_.size() == 0) return placed;
  if (anchor_.size() == 0) anchor_ = graph.geometry();
  MergeArrivals();
  PLUMESCOUT_ASSIGN_OR_RETURN(const Shift shift, ShiftOf(anchor_, graph.geometry()));
  GasCounters& counters = placed.counters;
  counters = {.readings = unusable_, .waiting = unusable_};
  for (const auto& [site, record] : records_) {
    const Placement placement = Place(site, shift.x, shift.y, graph);
    const bool waits = placement.variable == VariableIndex::kNone;
    counters.readings += record.count;
    (waits ? counters.waiting : counters.in_posterior) += record.count;
    if (placement.moved) counters.moved_to_neighbour += record.count;
    if (!waits) placed.evidence[ToSize(placement.variable)] += EvidenceOf(record, time_ns);
  }
  return placed;
}

void ReadingStore::MergeArrivals() {
  for (const Arrival& arrival : arrivals_) {
    Merge(arrival.reading, records_[SiteOf(arrival.position, anchor_)]);
  }
  arrivals_.clear();
}

void ReadingStore::Merge(const Reading& reading, Record& record) const {
  ++record.count;
  if (ageing_.enabled()) {
    record.readings.push_back(reading);
  } else {
    record.sums += EvidenceOf(reading, reading.time_ns);
  }
}

Evidence ReadingStore::EvidenceOf(const Reading& reading, std::int64_t time_ns) const {
  const double precision = ageing_.Precision(reading.variance_ppm2, reading.time_ns, time_ns);
  return {precision, precision * reading.deviation_ppm};
}

Evidence ReadingStore::EvidenceOf(const Record& record, std::int64_t time_ns) const {
  Evidence evidence = record.sums;
  for (const Reading& reading : record.readings) evidence += EvidenceOf(reading, time_ns);
  return evidence;
}

}  // namespace plumescout
