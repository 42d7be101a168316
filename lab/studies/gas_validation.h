// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// Whether the simulated gas can be believed: the mean of the filaments against the
// advection-diffusion equation on the same wind, in the hall and in generated buildings (quick: in
// one small building); in the open against the Gaussian plume; all that was released is inside or
// has left. With `options.scenes`, also what our gas does on the wind of these folders against
// their own mean concentration, of which nothing is demanded.
// Errors: as ReadScene, naming the folder; kInvalidArgument if a scene has no wind.
absl::StatusOr<Study> RunGasValidation(const ExperimentOptions& options);

}  // namespace plumescout::lab
