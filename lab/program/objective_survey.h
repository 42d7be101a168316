// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "absl/status/statusor.h"
#include "core/types/gas_at_place.h"
#include "core/types/map_snapshot.h"
#include "core/types/options.h"
#include "lab/report/objective_section.h"

namespace plumescout::lab {

// As many places as services answer for at once.
inline constexpr std::size_t kMaxPlaces = 4096;

// What a service that plans the mission says of the gas, with verdicts, at up to kMaxPlaces places.
using AskGas =
    std::function<absl::StatusOr<std::vector<GasAtPlace>>(const std::vector<Point2>& places)>;

// How the objective of a mission whose map this is stands, cell by cell; none: a complete map.
// `began_ns`: sample time at which the mission began. Errors: those of `ask`, and kInternal for
// another number of answers.
absl::StatusOr<std::optional<ObjectiveOutcome>> SurveyObjective(const ObjectiveOptions& asked,
                                                                const MapSnapshot& map,
                                                                std::int64_t began_ns,
                                                                const AskGas& ask);

}  // namespace plumescout::lab
