// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "absl/types/span.h"

namespace plumescout {

// Checks of single fields of a message. `field` is the path from the request, as clients write it:
// "batch.observations[3].pose.x_m". Every refusal is kInvalidArgument, says "<field> = <value>
// <rule>" and carries a google.rpc.BadRequest that names the field.

absl::Status FieldError(absl::string_view field, absl::string_view value, absl::string_view rule);
absl::Status FieldError(absl::string_view field, double value, absl::string_view rule);
// For fields that are missing or whose value is of no use to the reader.
absl::Status FieldError(absl::string_view field, absl::string_view rule);
// The same as kOutOfRange: what the field names may come to be.
absl::Status NotYetError(absl::string_view field, std::int64_t value, absl::string_view rule);

absl::Status CheckFinite(absl::string_view field, double value);
absl::Status CheckPositive(absl::string_view field, double value);     // finite and > 0
absl::Status CheckNotNegative(absl::string_view field, double value);  // finite and >= 0
absl::Status CheckRange(absl::string_view field, double value, double low, double high);
absl::Status CheckIntRange(absl::string_view field, std::int64_t value, std::int64_t low,
                           std::int64_t high);
absl::Status CheckPresent(absl::string_view field, bool present);

// "batch" and "pose" make "batch.pose"; an empty parent leaves the name alone.
std::string Join(absl::string_view parent, absl::string_view name);
// "batch.observations[3]".
std::string Join(absl::string_view parent, absl::string_view name, int index);

// Where the core calls a field differently from the wire.
struct FieldName {
  absl::string_view core;
  absl::string_view wire;
};

// The core names a refused field at the start of its message: "radius_m = -1 must be > 0". Turns
// such a kInvalidArgument into one that names the field of the wire below `parent`; others pass
// unchanged, and so does one that already carries its field.
absl::Status WithField(const absl::Status& status, absl::string_view parent,
                       absl::Span<const FieldName> renamed = {});

}  // namespace plumescout
