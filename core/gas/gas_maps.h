// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "core/gas/gas_epoch.h"
#include "core/gas/gas_map.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "core/types/options.h"
#include "core/types/stop.h"

namespace plumescout {

// Epochs of several fields that began together.
class GasEpochs {
 public:
  explicit GasEpochs(std::vector<std::shared_ptr<GasEpoch>> epochs) : epochs_(std::move(epochs)) {}

  // One after the other; as of GasEpoch.
  void Recompute() {
    for (const auto& epoch : epochs_) epoch->Recompute();
  }
  bool done() const {
    for (const auto& epoch : epochs_) {
      if (!epoch->done()) return false;
    }
    return true;
  }

 private:
  std::vector<std::shared_ptr<GasEpoch>> epochs_;
};

// The gas fields of a mission, one a species, on one map. Each has readings, sensors, certificate
// and audits of its own, and is what it would be alone. They are refreshed together, and made anew
// in epochs that begin and end together, so that there are moments at which all can be written.
// With one species it is a GasMap, and costs nothing beside that. Thread-compatible.
class GasMaps {
 public:
  // REQUIRES: Validate(options).ok().
  explicit GasMaps(const MissionOptions& options);

  std::size_t count() const { return fields_.size(); }
  // By place among the mission's species. REQUIRES: species < count().
  GasMap& operator[](std::size_t species) { return fields_[species]; }
  const GasMap& operator[](std::size_t species) const { return fields_[species]; }
  // The one that plans go by.
  const GasMap& first() const { return fields_.front(); }

  // All together, each an equal share, as GasMap::LimitField.
  void LimitFields(std::int64_t bytes);
  std::int64_t field_bytes() const;
  // The same of all, as their maps and limits are.
  int lattice_factor() const { return first().lattice_factor(); }
  // Sites, with readings that wait, and buckets of readings, of all and of their sensors.
  std::int64_t reading_sites() const;
  std::int64_t reading_buckets() const;

  void AbandonWhen(const StopFn& stop);

  bool stale() const;
  bool replaced() const;
  // Errors of GasMap::Refresh: kInvalidArgument and kCancelled of any field, with which nothing has
  // changed; else those of the first, which plans go by. All are refreshed, whichever of them fail,
  // and the failures of each are in its quality.
  absl::Status Refresh(const Grid<CellState>& states, std::int64_t time_ns);

  // Those of some fields begin and end with those of all. One that is without a field takes no
  // part.
  bool epoch_due(std::int64_t time_ns) const;
  bool epoch_possible() const;
  absl::Status BeginEpoch(std::int64_t time_ns);
  std::shared_ptr<GasEpochs> epoch() const;  // under way, or null
  bool adoption_due(std::int64_t time_ns) const;
  absl::Status Adopt();  // errors as those of Refresh
  bool audit_due() const;

  bool can_be_written() const;
  template <typename Archive, typename Self>
  static void VisitState(Archive& archive, Self& self);
  absl::Status MakeFieldsAgain();

 private:
  bool IsWithinEpoch() const;

  std::vector<GasMap> fields_;  // at least one
};

}  // namespace plumescout
