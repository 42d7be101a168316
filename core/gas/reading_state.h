// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <vector>

#include "core/gas/anchored_states.h"
#include "core/gas/reading_store.h"
#include "core/types/visit_types.h"

namespace plumescout {

void Visit(auto& archive, ConstOr<AnchorCell> auto& cell) {
  auto& [x, y] = cell;
  archive(x, y);
}
void Visit(auto& archive, ConstOr<ReadingSite> auto& site) {
  auto& [cell, neighbour_order] = site;
  archive(cell, neighbour_order);
}
void Visit(auto& archive, ConstOr<Evidence> auto& evidence) {
  auto& [precision, weighted_deviation, weighted_square, count] = evidence;
  archive(precision, weighted_deviation);
  // What is published of it is hashed with the field.
  if constexpr (!std::remove_reference_t<decltype(archive)>::kHashes) {
    archive.Since(2, weighted_square);
    archive.Since(5, count);
  }
}
void Visit(auto& archive, ConstOr<Staleness> auto& staleness) {
  auto& [since_ns, share_per_s] = staleness;
  archive(since_ns, share_per_s);
}
void Visit(auto& archive, ConstOr<ReadingBucket> auto& bucket) {
  auto& [newest_ns, least_variance_ppm2, most_variance_ppm2, count_moments, deviation_moments,
         square_moments] = bucket;
  archive(newest_ns, least_variance_ppm2, most_variance_ppm2, count_moments, deviation_moments);
  if constexpr (!std::remove_reference_t<decltype(archive)>::kHashes) {
    archive.Since(2, square_moments);
  }
}

template <typename Archive, typename Self>
void AnchoredStates::VisitState(Archive& archive, Self& self) {
  archive(self.anchor_, self.states_);
  if constexpr (Archive::kReads) {
    archive.Require(self.empty() == (self.anchor_.width <= 0 || self.anchor_.height <= 0),
                    "states have no anchor");
    self.corner_ = {};
    if (!archive.ok() || self.empty()) return;
    const auto corner = CornerOf(self.states_.geometry(), self.anchor_);
    archive.Require(corner.ok(), "states lie beside their anchor");
    self.corner_ = corner.value_or(AnchorCell{});
  }
}

template <typename Archive, typename Self>
void ReadingStore::Arrival::VisitState(Archive& archive, Self& self) {
  auto& [position, reading, is_part] = self;
  archive(position, reading);
  archive.Since(2, is_part);
}

template <typename Archive, typename Self>
void ReadingStore::Site::VisitState(Archive& archive, Self& self) {
  auto& [count, sums, buckets, placement] = self;  // placed again after reading
  archive(count, sums, buckets);
}

template <typename Archive, typename Self>
void ReadingStore::AgedCell::VisitState(Archive& archive, Self& self) {
  auto& [cell, aged_alone_to_ns, staleness] = self;
  archive(cell, aged_alone_to_ns, staleness);
}

// See PlacementOf: differences of such cells do not overflow.
inline bool IsCellOfSites(AnchorCell cell) {
  constexpr int kFarthest_cells = (1 << 30) + 1;
  return cell.x >= -kFarthest_cells && cell.x <= kFarthest_cells && cell.y >= -kFarthest_cells &&
         cell.y <= kFarthest_cells;
}

// Whether readings can give it.
inline bool IsEvidence(const Evidence& evidence) {
  constexpr double kMost = 1e100;  // far beyond any sensor, and from where products overflow
  return evidence.precision >= 0.0 && evidence.precision <= kMost &&
         std::abs(evidence.weighted_deviation) <= kMost && evidence.weighted_square >= 0.0 &&
         evidence.weighted_square <= kMost && evidence.count >= 0.0 && evidence.count <= kMost;
}

inline bool IsBucket(const ReadingBucket& bucket, const Ageing& ageing) {
  return bucket.least_variance_ppm2 > 0.0 &&
         bucket.most_variance_ppm2 >= bucket.least_variance_ppm2 &&
         IsEvidence(EvidenceOf(bucket, ageing, bucket.newest_ns));
}

template <typename Archive, typename Self>
void ReadingStore::VisitState(Archive& archive, Self& self) {
  archive(self.aged_to_ns_, self.counters_, self.arrivals_, self.merged_arrivals_, self.sites_);
  std::vector<AgedCell> aged;
  if constexpr (!Archive::kReads) aged = self.AgedCells();
  archive(aged);
  if constexpr (Archive::kReads) {
    const auto is_bucket = [&](const ReadingBucket& b) { return IsBucket(b, self.ageing_); };
    for (const Sites* sites : {&self.merged_arrivals_, &self.sites_}) {
      for (const auto& [key, site] : *sites) {
        archive.Require(IsCellOfSites(key.cell), "a site lies too far away");
        archive.Require(std::all_of(site.buckets.begin(), site.buckets.end(), is_bucket),
                        "readings have no variance");
        archive.Require(IsEvidence(site.sums), "readings say what none can");
      }
    }
    for (const Arrival& arrival : self.arrivals_) {
      const Point2 place = arrival.position;
      archive.Require(std::isfinite(place.x_m) && std::isfinite(place.y_m),
                      "a reading was taken nowhere");
      archive.Require(is_bucket(arrival.reading), "a reading has no variance");
    }
    for (const AgedCell& cell : aged) {
      archive.Require(IsCellOfSites(cell.cell), "a cell lies too far away");
    }
    if (archive.ok()) self.Watch(aged);
    self.CountArrivalBuckets();
  }
}

}  // namespace plumescout
