// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "lab/sim/layout.h"

namespace plumescout::lab {

// Reads a layout from YAML; lab/scenes/industrial_16x20.yaml shows every key but `release`,
// which a source may have: a map of any of start_s, end_s, on_s, off_s. Positions are [x, y].
// The result is valid. Errors are kInvalidArgument: YAML that does not parse (with line and
// column), an unknown, repeated, missing or mistyped key (by its path, "walls[2].thickness_m"), a
// value out of range.
absl::StatusOr<Layout> ParseLayout(const std::string& yaml);

// The same from a file. Besides, the errors of ReadFile; all name the file.
absl::StatusOr<Layout> ReadLayout(const std::string& path);

}  // namespace plumescout::lab
