// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <type_traits>
#include <vector>

#include "core/gas/cell_runs.h"
#include "core/gas/field_region.h"
#include "core/gas/gas_map.h"
#include "core/gas/gas_maps.h"
#include "core/gas/reading_state.h"

namespace plumescout {

void Visit(auto& archive, ConstOr<CellInput> auto& input) {
  auto& [active, precision, weighted_deviation, linked_east, linked_north] = input;
  archive(active, precision, weighted_deviation, linked_east, linked_north);
}
inline bool ContinuesRun(const CellInput& a, const CellInput& b) {
  return a == b && ContinuesRun(a.precision, b.precision) &&
         ContinuesRun(a.weighted_deviation, b.weighted_deviation);
}
void Visit(auto& archive, ConstOr<CellChange> auto& change) {
  auto& [cell, input] = change;
  archive(cell, input);
}
void Visit(auto& archive, ConstOr<FieldOrigin> auto& origin) {
  std::vector<CellInput> cells = origin.cells.Cells();
  archive.Runs(cells);
  if constexpr (!std::is_const_v<std::remove_reference_t<decltype(origin)>>) {
    origin.cells = CellRuns(cells);
  }
  archive(origin.changes);
}
void Visit(auto& archive, ConstOr<GasLattice> auto& lattice) {
  auto& [x0, y0, width, height] = lattice;
  archive(x0, y0, width, height);
}
void Visit(auto& archive, ConstOr<GasCellRect> auto& rect) {
  auto& [min, end] = rect;
  archive(min.x, min.y, end.x, end.y);
}

// All that it has been told, and what it made of that.
template <typename Archive>
void HashField(Archive& archive, const FieldEngine& field) {
  const FieldCells& heard = field.heard();
  archive.Runs(heard.active);
  archive.Runs(heard.links);
  archive.Runs(heard.precision);
  archive.Runs(heard.weighted_deviation);
  archive(field.means_ppm(), field.variances_ppm2());
  const FieldDeviation bound = field.error_bound();
  archive(bound.mean_ppm, bound.variance_ratio);
}

template <typename Archive, typename Self>
void FieldRegion::Tile::VisitState(Archive& archive, Self& self) {
  auto& [x, y] = self;
  archive(x, y);
}

template <typename Archive, typename Self>
void FieldRegion::VisitState(Archive& archive, Self& self) {
  archive(self.visited_);
  if constexpr (Archive::kReads) {
    const auto is_near = [](const Tile& tile) {
      return IsNearOrigin(tile.x) && IsNearOrigin(tile.y);
    };
    archive.Require(std::all_of(self.visited_.begin(), self.visited_.end(), is_near),
                    "a visited tile lies too far away");
    self.geometry_ = {};
    self.corner_ = {};
    self.width_ = self.height_ = 0;
    self.inside_.clear();
    self.inside_count_ = 0;
  }
}

template <typename Archive, typename Self>
void EpochSchedule::VisitState(Archive& archive, Self& self) {
  archive(self.activity_changes_, self.active_cells_, self.refreshes_);
}

inline void Visit(auto& archive, ConstOr<ReadingSource> auto& source) {
  auto& [robot, sensor, offset_stddev_ppm] = source;
  archive(robot, sensor, offset_stddev_ppm);
}

template <typename Archive, typename Self>
void SensorCrossings::Recent::VisitState(Archive& archive, Self& self) {
  auto& [time_ns, position, concentration_ppm] = self;
  archive(time_ns, position, concentration_ppm);
}

template <typename Archive, typename Self>
void SensorCrossings::Pair::VisitState(Archive& archive, Self& self) {
  auto& [crossings, latest_ppm, mean_ppm, squares_ppm2] = self;
  archive(crossings, latest_ppm, mean_ppm, squares_ppm2);
}

template <typename Archive, typename Self>
void SensorCrossings::VisitState(Archive& archive, Self& self) {
  archive(self.recent_, self.pairs_);
}

template <typename Archive, typename Self>
void SensorOffsets::VisitState(Archive& archive, Self& self) {
  auto count = static_cast<std::uint32_t>(self.sensors_.size());
  archive(count);
  if constexpr (Archive::kReads) self.sensors_.clear();
  for (std::uint32_t i = 0; i < count; ++i) {
    if constexpr (Archive::kReads) {
      if (!archive.ok()) return;
      self.sensors_.push_back({{}, ReadingStore(self.options_, self.resolution_m_)});
    }
    auto& [source, readings] = self.sensors_[i];
    archive(source, readings);
  }
  archive(self.crossings_);
}

template <typename Archive, typename Self>
void GasInputs::VisitState(Archive& archive, Self& self) {
  archive(self.factor_, self.states_, self.rect_, self.readings_);
  if constexpr (Archive::kReads) {
    archive.Require(self.factor_ >= 1 && self.factor_ <= kMostLatticeFactor,
                    "the lattice factor is out of range");
    if (!archive.ok()) return;
    const auto& [min, end] = self.rect_;
    archive.Require(IsNearOrigin(min.x) && IsNearOrigin(min.y) && IsNearOrigin(end.x) &&
                        IsNearOrigin(end.y) && self.RectHoldsFreeCells(),
                    "free cells lie beyond those of the gas field");
    archive.Require(self.readings_.PlaceAgain(self.states_), "readings lie where none were");
  }
  archive.Since(2, self.sensors_);
  if constexpr (Archive::kReads) {
    archive.Require(archive.ok() && self.sensors_.PlaceAgain(self.states_),
                    "readings of a sensor lie where none were");
  }
}

// The field itself is hashed, but not written: with its origin it can be made again.
template <typename Archive, typename Self>
void GasMap::VisitState(Archive& archive, Self& self) {
  archive(self.inputs_, self.schedule_, self.lattice_, self.active_cells_, self.time_ns_,
          self.has_failed_, self.stale_, self.quality_);
  archive.Since(2, self.replaced_);
  if (self.options_.precisions == GasPrecisions::kLearned) {
    auto& [theta, log_stddev, readings] = self.prior_scale_;
    archive.Since(2, theta, log_stddev, readings);
    if constexpr (Archive::kReads) {
      archive.Require(theta >= kLeastPriorScale && theta <= kMostPriorScale,
                      "a precision of the gas field is out of range");
    }
  }
  if constexpr (Archive::kHashes) {
    archive(self.epoch_ != nullptr);
    if (self.epoch_ != nullptr) archive(self.epoch_->time_ns(), self.epoch_->lattice());
    archive(self.has_field());
    if (self.has_field()) HashField(archive, *self.engine_);
    if (self.options_.estimate_noise) archive(self.noise_scale());
    if (HasNoiseByLevel(self.options_)) archive(self.quality().clean_air_scale);
  } else if constexpr (Archive::kReads) {
    const GasLattice& lattice = self.lattice_;
    const bool is_lattice = IsNearOrigin(lattice.x0) && IsNearOrigin(lattice.y0) &&
                            lattice.width >= 0 && IsNearOrigin(lattice.width) &&
                            lattice.height >= 0 && IsNearOrigin(lattice.height) &&
                            lattice.size() <= archive.room_bytes() / sizeof(CellInput);
    archive.Require(!is_lattice || (self.active_cells_ >= 0 &&
                                    static_cast<std::size_t>(self.active_cells_) <= lattice.size()),
                    "more cells of the gas lattice are active than it has");
    const GasCellRect& rect = self.inputs_.rect();
    archive.Require(is_lattice && (rect.empty() || HasRoom(lattice, rect, 0)),
                    "the gas lattice is out of range");
    archive(self.origin_);
    const bool is_whole = self.origin_ ? !self.has_failed_ && lattice.size() > 0
                                       : self.has_failed_ || lattice.size() == 0;
    archive.Require(is_whole, "there is a gas field where none can be, or none where one is");
  } else {
    archive(self.origin_);
  }
}

// How many there are follows from the mission's options.
template <typename Archive, typename Self>
void GasMaps::VisitState(Archive& archive, Self& self) {
  for (auto& field : self.fields_) archive(field);
}

}  // namespace plumescout
