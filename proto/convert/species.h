// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "core/types/options.h"

namespace plumescout {

// The place among the mission's gases of the one that a request names; of the first, if it names
// none. INVALID_ARGUMENT, saying which there are, for a gas that the mission does not map.
absl::StatusOr<std::size_t> SpeciesFromProto(const std::string& name, const MissionOptions& options,
                                             absl::string_view field);
// The same of a list, which names each gas once.
absl::Status CheckSpecies(const std::vector<std::string>& names, const MissionOptions& options,
                          absl::string_view field);

}  // namespace plumescout
