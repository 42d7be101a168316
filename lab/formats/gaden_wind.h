// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "core/types/grid.h"
#include "lab/formats/gaden_environment.h"
#include "lab/formats/scene.h"

namespace plumescout::lab {

// Frame map of one layer of an environment.
GridGeometry SliceGeometry(const GadenEnvironment& environment);

// The horizontal wind of layer z, read from a file wind_iteration_N of the environment's cells
// (little-endian, x fastest, m/s), whose length tells which of two forms it has:
//
//   version 3    i32 major, i32 minor, then f32 u, v, w by cell
//   version 2    f64 u of all cells, f64 v of all, f64 w of all
//
// Errors, naming the file: those of ReadFile; kDataLoss if the length fits neither;
// kInvalidArgument if a speed is not finite. REQUIRES: z in the environment.
absl::StatusOr<WindField> ReadGadenWind(const std::string& path,
                                        const GadenEnvironment& environment, int z);

}  // namespace plumescout::lab
