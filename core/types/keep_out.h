// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/types/event.h"
#include "core/types/polygon.h"

namespace plumescout {

// The keep-out areas of a mission, where nobody may drive, though it is sensed and mapped: at most
// kMostKeepOutAreas, of 3 to 256 vertices each, with names of the alphabet of ids.
inline constexpr int kMostKeepOutAreas = 64;

// Whether they may stand in options, where some may lack a name. kInvalidArgument naming field,
// value and rule: "keep_out[1].vertices = 2 must be in [3, 256]".
absl::Status ValidateKeepOut(const std::vector<Polygon>& areas);

// The same areas; those without a name have one, "area-1", "area-2", ... as it is free.
std::vector<Polygon> WithNames(std::vector<Polygon> areas);

// The areas after a change: those that stay, in their order, then what was added. Errors:
//   kInvalidArgument    an added area is none, or has no name (named: "added[0].vertices[2].x_m")
//   kNotFound           KEEP_OUT_AREA_NOT_FOUND: there is none of a name that was deleted
//   kAlreadyExists      KEEP_OUT_AREA_EXISTS: there is one of a name that was added
//   kResourceExhausted  LIMIT_REACHED: they would be too many
absl::StatusOr<std::vector<Polygon>> AfterChange(std::vector<Polygon> areas,
                                                 const KeepOutChanged& change);

}  // namespace plumescout
