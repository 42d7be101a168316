// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/gas/gas_maps.h"

#include <algorithm>

#include "core/types/species.h"
#include "core/types/status_macros.h"

namespace plumescout {

GasMaps::GasMaps(const MissionOptions& options) {
  fields_.reserve(SpeciesCount(options));
  for (const GasOptions& gas : GasOptionsOfAll(options)) {
    fields_.emplace_back(gas, options.occupancy.resolution_m);
  }
}

void GasMaps::LimitFields(std::int64_t bytes) {
  for (GasMap& field : fields_) field.LimitField(bytes / static_cast<std::int64_t>(count()));
}

std::int64_t GasMaps::field_bytes() const {
  std::int64_t bytes = 0;
  for (const GasMap& field : fields_) bytes += field.field_bytes();
  return bytes;
}

std::int64_t GasMaps::reading_sites() const {
  std::size_t sites = 0;
  for (const GasMap& field : fields_) {
    sites += field.readings().sites() + field.readings().arrivals() + field.sensors().sites();
  }
  return static_cast<std::int64_t>(sites);
}

std::int64_t GasMaps::reading_buckets() const {
  std::size_t buckets = 0;
  for (const GasMap& field : fields_) {
    buckets +=
        field.readings().buckets() + field.readings().arrival_buckets() + field.sensors().buckets();
  }
  return static_cast<std::int64_t>(buckets);
}

void GasMaps::AbandonWhen(const StopFn& stop) {
  for (GasMap& field : fields_) field.AbandonWhen(stop);
}

bool GasMaps::stale() const {
  return std::any_of(fields_.begin(), fields_.end(), [](const GasMap& f) { return f.stale(); });
}

bool GasMaps::replaced() const {
  return std::any_of(fields_.begin(), fields_.end(), [](const GasMap& f) { return f.replaced(); });
}

// Maps that one of them does not take, none does.
absl::Status GasMaps::Refresh(const Grid<CellState>& states, std::int64_t time_ns) {
  absl::Status first;
  for (GasMap& field : fields_) {
    const absl::Status status = field.Refresh(states, time_ns);
    if (absl::IsInvalidArgument(status) || absl::IsCancelled(status)) return status;
    if (&field == &fields_.front()) first = status;
  }
  return first;
}

bool GasMaps::IsWithinEpoch() const {
  return std::any_of(fields_.begin(), fields_.end(),
                     [](const GasMap& f) { return f.epoch() != nullptr; });
}

bool GasMaps::epoch_due(std::int64_t time_ns) const {
  return !IsWithinEpoch() &&
         std::any_of(fields_.begin(), fields_.end(),
                     [time_ns](const GasMap& field) { return field.epoch_due(time_ns); });
}

bool GasMaps::epoch_possible() const {
  return !IsWithinEpoch() && std::any_of(fields_.begin(), fields_.end(),
                                         [](const GasMap& f) { return f.epoch_possible(); });
}

absl::Status GasMaps::BeginEpoch(std::int64_t time_ns) {
  if (IsWithinEpoch()) {
    return absl::FailedPreconditionError("an epoch of the gas map is under way already");
  }
  if (!epoch_possible()) return fields_.front().BeginEpoch(time_ns);  // says why not
  for (GasMap& field : fields_) {
    if (field.epoch_possible()) PLUMESCOUT_RETURN_IF_ERROR(field.BeginEpoch(time_ns));
  }
  return absl::OkStatus();
}

std::shared_ptr<GasEpochs> GasMaps::epoch() const {
  std::vector<std::shared_ptr<GasEpoch>> epochs;
  for (const GasMap& field : fields_) {
    if (field.epoch() != nullptr) epochs.push_back(field.epoch());
  }
  return epochs.empty() ? nullptr : std::make_shared<GasEpochs>(std::move(epochs));
}

bool GasMaps::adoption_due(std::int64_t time_ns) const {
  return std::any_of(fields_.begin(), fields_.end(),
                     [time_ns](const GasMap& field) { return field.adoption_due(time_ns); });
}

absl::Status GasMaps::Adopt() {
  if (!IsWithinEpoch()) return fields_.front().Adopt();
  absl::Status first;
  for (GasMap& field : fields_) {
    if (field.epoch() == nullptr) continue;
    const absl::Status status = field.Adopt();
    if (absl::IsCancelled(status)) return status;
    if (&field == &fields_.front()) first = status;
  }
  return first;
}

bool GasMaps::audit_due() const {
  return std::any_of(fields_.begin(), fields_.end(), [](const GasMap& f) { return f.audit_due(); });
}

bool GasMaps::can_be_written() const {
  return std::all_of(fields_.begin(), fields_.end(),
                     [](const GasMap& f) { return f.can_be_written(); });
}

absl::Status GasMaps::MakeFieldsAgain() {
  for (GasMap& field : fields_) PLUMESCOUT_RETURN_IF_ERROR(field.MakeFieldAgain());
  return absl::OkStatus();
}

}  // namespace plumescout
