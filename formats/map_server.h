// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/cell_state.h"
#include "core/types/grid.h"

namespace plumescout {

// Reads a map in the format of ROS map_server: a YAML file that names a PGM image (P5), relative
// to itself. A pixel v means occupancy p = (255 - v) / 255, or v / 255 if `negate`; a cell is
// occupied if p > occupied_thresh, free if p < free_thresh, else unknown. Row 0 of the image is
// the northern one. Only mode "trinary" (also the default) and maps that are not turned.
//
// Errors, each naming the file: kNotFound; kDataLoss if a file does not parse or the image is
// truncated; kInvalidArgument for a mode, yaw, threshold, resolution or size out of range.
absl::StatusOr<Grid<CellState>> ReadMapServer(const std::string& yaml_path);

// The same map from what stands in its two files; the image that `yaml` names is not looked for.
// Errors begin with the word "yaml" or "pgm": kDataLoss, kInvalidArgument as above.
absl::StatusOr<Grid<CellState>> ParseMapServer(absl::string_view yaml, absl::string_view pgm);

// Writes `yaml_path` and, beside it with the extension .pgm, the image: free 254, occupied 0,
// unknown 205. kInvalidArgument if the grid is empty or its geometry not finite; else as WriteFile.
absl::Status WriteMapServer(const Grid<CellState>& map, const std::string& yaml_path);

}  // namespace plumescout
