// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "core/gas/epoch_schedule.h"
#include "core/gas/field/field_engine.h"
#include "core/gas/field_audit.h"
#include "core/gas/field_bytes.h"
#include "core/gas/field_origin.h"
#include "core/gas/gas_epoch.h"
#include "core/gas/gas_inputs.h"
#include "core/gas/gas_lattice.h"
#include "core/gas/gas_what_if.h"
#include "core/gas/noise_scale.h"
#include "core/gas/offset_estimate.h"
#include "core/gas/prior_scale.h"
#include "core/types/cell_state.h"
#include "core/types/gas_reading.h"
#include "core/types/grid.h"
#include "core/types/map_snapshot.h"
#include "core/types/options.h"
#include "core/types/pose2.h"
#include "core/types/stop.h"

namespace plumescout {

// Gas posterior of a mission, kept exact while readings come and the map changes.
//
//   GasMap gas(options);
//   gas.Add(time_ns, position, reading);
//   RETURN_IF_ERROR(gas.Refresh(occupancy.States(), now_ns));
//   gas.mean_ppm()[cell], gas.variance_ppm2()[cell]
//
// Readings are kept by position for ever. Each takes part if its cell is free, or, if not, in a
// free neighbour (see PlacementOf); otherwise it waits.
//
// Now and then the field is made anew in an epoch: to age readings, to have room to grow, to suit
// the dissection to the map, and to measure how far the live field has drifted. Someone else may
// run its long part meanwhile:
//
//   if (gas.epoch_due(now_ns)) RETURN_IF_ERROR(gas.BeginEpoch(now_ns));
//   gas.epoch()->Recompute();  // on any thread
//   if (gas.adoption_due(now_ns)) RETURN_IF_ERROR(gas.Adopt());
//
// The same calls give the same bytes, wherever Recompute ran. Thread-compatible.
class GasMap {
 public:
  // REQUIRES: Validate(options).ok(). `resolution_m`: as of ReadingStore.
  explicit GasMap(const GasOptions& options, double resolution_m = 0.0);

  // From now on the field is computed on a lattice so coarse that it takes no more than so many
  // bytes, by FieldBytes, as far as kMostLatticeFactor goes. One that grows beyond that is made
  // anew on a lattice of twice the factor.
  void LimitField(std::int64_t bytes) { most_field_bytes_ = bytes; }
  int lattice_factor() const { return inputs_.factor(); }
  // What it holds, by which its memory is reckoned.
  std::int64_t field_bytes() const {
    return FieldBytes(active_cells_, static_cast<std::int64_t>(lattice_.size()));
  }
  const ReadingStore& readings() const { return inputs_.readings(); }

  // Once `stop` says so, and from then on it has to, whatever runs or is begun ends soon, within
  // 0.2 s for a million cells, with kCancelled; an epoch that begins later is told as well. The map
  // is then of no use any more. `stop` is asked on the threads that compute.
  void AbandonWhen(StopFn stop) { field_options_.stop = std::move(stop); }

  // A reading that is not finite, or beyond 1e9 ppm, is counted and waits for ever.
  // `is_part`: as of ReadingStore::Add.
  void Add(std::int64_t time_ns, Point2 position, const GasReading& reading, bool is_part = false);
  // The same of a sensor in a mission in which some have unknown offsets. Once it has met others
  // often enough, also since the last refresh, its offset is estimated from what that placed, and
  // what readers see is the field with that as a further unknown. REQUIRES: options without ageing.
  void AddFrom(const ReadingSource& source, std::int64_t time_ns, Point2 position,
               const GasReading& reading);
  // Whether it has a free cell, or may wait for one; see ReadingStore::HasRoomFor.
  bool HasRoomFor(Point2 position) const { return inputs_.HasRoomFor(position); }

  // From now on these are all readings, none of them placed yet (see ReadingStore::Unplaced); there
  // is no field until the next refresh, which makes it anew. An epoch that is under way comes to
  // nothing.
  // `sensors`: those of them that are known to be of certain sensors, see AddFrom.
  void ReplaceReadings(ReadingStore readings, SensorOffsets sensors);
  bool replaced() const { return replaced_; }  // and not refreshed since

  // Brings the posterior to `states` and all readings so far. Their precisions are those of the
  // last epoch; where that is too long before `time_ns` for how precise they are, cells are aged
  // to `time_ns` here and now.
  // Errors: kInvalidArgument, with nothing changed, if the lattice of `states` is not that of the
  // first refresh moved by whole cells. kInternal if the field cannot be computed, which would be a
  // defect: readers then see none until a refresh, which makes all anew, succeeds. kCancelled as
  // AbandonWhen says. Cost at 160x200 cells, rooms: 0.2 ms a reading at worst, 3 ms a scan, anew 23
  // ms; docs/performance.md.
  absl::Status Refresh(const Grid<CellState>& states, std::int64_t time_ns);

  // As of the last refresh, on a lattice that covers its states; NaN off free cells, and everywhere
  // if that failed. Empty before the first. Cost: O(cells + sites log sites) at the first call
  // after a change. In a field of roots it is the median, see GasEstimate; else what UnreadDiscount
  // leaves of the field's mean. The certificate is of that mean; see there what it says of the
  // rest.
  const Grid<float>& mean_ppm() const;
  // Of the model as its precisions are given, which plans go by: on the scale of the field, and in
  // the unit in which the prior has the precisions of the options, also where they are learned.
  const Grid<float>& variance_ppm2() const;
  // Of the concentration: in ppm, and if options.estimate_noise by NoiseEstimate. It is
  // another raster than the above only if it has_own_errors().
  const Grid<float>& error_variance_ppm2() const;
  bool has_own_errors() const {
    return options_.estimate_noise || options_.scale != GasScale::kLinear;
  }
  // See NoiseScale; 1 unless options.estimate_noise.
  double noise_scale() const { return quality().noise_scale; }
  // The same moment, to ask what further readings would tell. Null if there is no field.
  // Cost: one number per cell, one pointer per node of the factor, at the first call after a
  // change; nothing where nobody calls it.
  std::shared_ptr<const GasWhatIf> what_if() const;

  // Of the sensors whose offset was not known. Cost: that of mean_ppm().
  const std::vector<SensorOffset>& sensor_offsets() const;
  const SensorOffsets& sensors() const { return inputs_.sensors(); }

  const GasCounters& counters() const { return inputs_.counters(); }
  GasQuality quality() const;
  // Readings came since the last refresh, or no field came of it.
  bool stale() const { return stale_ || has_failed_; }

  bool epoch_due(std::int64_t time_ns) const;
  // Whether BeginEpoch would begin one.
  bool epoch_possible() const { return engine_ != nullptr && epoch_ == nullptr && !has_failed_; }
  // kFailedPrecondition if one is under way or there is no field yet. Cost: O(cells).
  absl::Status BeginEpoch(std::int64_t time_ns);
  std::shared_ptr<GasEpoch> epoch() const { return epoch_; }  // under way, or null
  // Whether the long part has had its time. A fixed one, so that events do not depend on machines.
  bool adoption_due(std::int64_t time_ns) const;
  // Takes the epoch's field over, after the changes since it began; recomputes it here and now if
  // nobody has. Errors: kFailedPrecondition, with nothing changed, if none is under way; kInternal
  // and kCancelled as from Refresh.
  absl::Status Adopt();

  // Whether the epoch adopted last is one after which the field is to be audited.
  bool audit_due() const;
  // Copies what an audit compares; RunAudit may then run on any thread. Null if there is no field,
  // or an epoch under way: that merges readings which the field has heard one by one. `species`:
  // for the finding, see AuditFinding. Cost: O(cells).
  std::shared_ptr<const AuditInputs> MakeAudit(std::size_t species = 0) const;

  // Whether its state can be written: it is neither abandoned nor within an epoch, and there is no
  // field, or one that has heard nothing since it was made anew. Always so right after Adopt.
  bool can_be_written() const {
    return !abandoned_ && epoch_ == nullptr && (!has_field() || origin_.has_value());
  }
  template <typename Archive, typename Self>
  static void VisitState(Archive& archive, Self& self);
  // Makes the field of the state that was read; before that there is none. Errors: kDataLoss if
  // that cannot be; kCancelled as AbandonWhen says. Cost: a fresh computation or two.
  absl::Status MakeFieldAgain();

 private:
  friend struct GasMapPeer;  // of the tests

  struct Changes {
    std::vector<CellChange> cells;
    std::int64_t activated = 0;
    std::int64_t deactivated = 0;
  };
  absl::Status Rebuild(std::int64_t time_ns);
  Changes ChangesIn(std::span<const GasCell> changed) const;
  absl::Status Apply(const Changes& changes);
  GasLattice RoomyLattice() const;
  void TakeOver(std::unique_ptr<FieldEngine> engine, const GasLattice& lattice, FieldOrigin origin);
  bool has_field() const { return engine_ != nullptr && !has_failed_; }
  absl::Status Conclude(const absl::Status& computed, std::int64_t time_ns);
  void Publish() const;
  // Offsets of sensors that are estimated beside would pass for noise.
  bool learns() const {
    return options_.precisions == GasPrecisions::kLearned && !inputs_.sensors().HasColumns();
  }
  OffsetEstimate EstimateSensors() const;

  GasOptions options_;
  FieldOptions field_options_;
  GasInputs inputs_;
  EpochSchedule schedule_;
  GasLattice lattice_;
  std::unique_ptr<FieldEngine> engine_;  // null before there is a free cell
  std::optional<FieldOrigin> origin_;    // of the engine while it has heard nothing since
  std::int64_t active_cells_ = 0;        // of the engine
  std::int64_t most_field_bytes_ = std::numeric_limits<std::int64_t>::max();
  std::shared_ptr<GasEpoch> epoch_;
  std::int64_t time_ns_ = 0;  // of the last refresh
  bool has_failed_ = false;   // the engine holds no field that may be seen
  bool abandoned_ = false;    // and the rest is not what events tell
  bool stale_ = false;
  bool replaced_ = false;
  GasQuality quality_;
  PriorScale prior_scale_;  // that of field_options_

  // What readers see; made when they look.
  mutable Grid<float> mean_ppm_;
  mutable Grid<float> variance_ppm2_;
  mutable Grid<float> error_variance_ppm2_;  // if it has_own_errors()
  mutable NoiseEstimate noise_;
  mutable double most_told_ppm_ = 0.0;  // of all deviations
  mutable std::shared_ptr<const GasWhatIf> what_if_;
  mutable std::vector<double> beside_ppm2_;  // see GasWhatIf, until there is one
  mutable std::vector<SensorOffset> sensor_offsets_;
  mutable bool published_ = true;
};

}  // namespace plumescout
