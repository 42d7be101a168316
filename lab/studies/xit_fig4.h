// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "absl/status/statusor.h"
#include "lab/trials/study.h"

namespace plumescout::lab {

// [XIT] Fig. 4: how the price of a path falls with the number of samples N, in three scenes, ten
// runs each, over that of a fine Dijkstra search.
absl::StatusOr<Study> RunXitFig4(const ExperimentOptions& options);

}  // namespace plumescout::lab
