// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "lab/formats/scene.h"

namespace plumescout::lab {

// A hall of 6 m x 5 m with an inlet in the west, an outlet in the east, a screen, a box and one
// source. Takes a moment.
absl::StatusOr<Scene> MakeGasHall();

}  // namespace plumescout::lab
