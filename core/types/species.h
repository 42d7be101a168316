// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "core/types/options.h"

namespace plumescout {

// The gases of a mission by their place among MissionOptions::gas_species. One that names none has
// one gas all the same. Plans go by the first.

inline constexpr std::size_t kMostSpecies = 4;

std::size_t SpeciesCount(const MissionOptions& options);
// Empty if the mission names no gas. REQUIRES: species < SpeciesCount(options).
std::string SpeciesName(const MissionOptions& options, std::size_t species);
// An empty name is that of the first; none if the mission has no such gas.
std::optional<std::size_t> FindSpecies(const MissionOptions& options, absl::string_view name);
// The names that FindSpecies knows, for messages: "methane", "hydrogen-sulfide".
std::string SpeciesNames(const MissionOptions& options);

// The model of its field: that of options.gas with what the species says otherwise. REQUIRES:
// species < SpeciesCount(options).
GasOptions GasOptionsOf(const MissionOptions& options, std::size_t species);
// Of all, in their order.
std::vector<GasOptions> GasOptionsOfAll(const MissionOptions& options);

// kInvalidArgument naming field and value: too many, a name that is none or comes twice, a value
// out of range, a first one with a model of its own.
absl::Status ValidateSpecies(const MissionOptions& options);

}  // namespace plumescout
