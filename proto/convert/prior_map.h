// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"
#include "plumescout/v1/options.pb.h"

namespace plumescout {

// As cells, deflated: maps are mostly runs, so that one of millions of cells fits a request.
v1::PriorMap ToProto(const Grid<CellState>& map);

// Whether a mission can start with it is for Validate to say. Inflating stops at the size that the
// geometry tells.
absl::StatusOr<Grid<CellState>> FromProto(const v1::KnownCells& proto, absl::string_view field);

}  // namespace plumescout
