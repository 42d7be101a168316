// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/species.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/strip.h"
#include "core/types/ids.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// The numbers of its own that a species may have, and their names.
std::vector<std::pair<std::string, std::optional<double>>> OwnModel(const GasSpecies& species) {
  return {{"prior_precision_per_ppm2", species.prior_precision_per_ppm2},
          {"observation_precision_per_ppm2", species.observation_precision_per_ppm2},
          {"background_precision_per_ppm2", species.background_precision_per_ppm2},
          {"background_mean_ppm", species.background_mean_ppm}};
}

// The rules of GasOptions are those of its species.
absl::Status ValidateModel(const MissionOptions& options, std::size_t species,
                           const std::string& field) {
  for (const auto& [name, value] : OwnModel(options.gas_species[species])) {
    if (species > 0 || !value) continue;
    return absl::InvalidArgumentError(absl::StrCat(
        field, ".", name, " = ", *value, " must be unset: the first has the model of gas"));
  }
  const absl::Status status = Validate(GasOptionsOf(options, species));
  if (status.ok() || species == 0) return absl::OkStatus();  // gas itself is validated as such
  absl::string_view message = status.message();
  if (absl::ConsumePrefix(&message, "gas.")) {
    return absl::InvalidArgumentError(absl::StrCat(field, ".", message));
  }
  return status;
}

}  // namespace

std::size_t SpeciesCount(const MissionOptions& options) {
  return std::max<std::size_t>(options.gas_species.size(), 1);
}

std::string SpeciesName(const MissionOptions& options, std::size_t species) {
  return options.gas_species.empty() ? std::string() : options.gas_species[species].name;
}

std::optional<std::size_t> FindSpecies(const MissionOptions& options, absl::string_view name) {
  if (name.empty()) return 0;
  for (std::size_t i = 0; i < options.gas_species.size(); ++i) {
    if (options.gas_species[i].name == name) return i;
  }
  return std::nullopt;
}

std::string SpeciesNames(const MissionOptions& options) {
  return absl::StrJoin(options.gas_species, ", ", [](std::string* out, const GasSpecies& species) {
    absl::StrAppend(out, "\"", species.name, "\"");
  });
}

GasOptions GasOptionsOf(const MissionOptions& options, std::size_t species) {
  GasOptions gas = options.gas;
  if (options.gas_species.empty()) return gas;
  const GasSpecies& own = options.gas_species[species];
  gas.prior_precision_per_ppm2 =
      own.prior_precision_per_ppm2.value_or(gas.prior_precision_per_ppm2);
  gas.observation_precision_per_ppm2 =
      own.observation_precision_per_ppm2.value_or(gas.observation_precision_per_ppm2);
  gas.background_precision_per_ppm2 =
      own.background_precision_per_ppm2.value_or(gas.background_precision_per_ppm2);
  gas.background_mean_ppm = own.background_mean_ppm.value_or(gas.background_mean_ppm);
  return gas;
}

std::vector<GasOptions> GasOptionsOfAll(const MissionOptions& options) {
  std::vector<GasOptions> gases;
  for (std::size_t i = 0; i < SpeciesCount(options); ++i) gases.push_back(GasOptionsOf(options, i));
  return gases;
}

absl::Status ValidateSpecies(const MissionOptions& options) {
  const std::vector<GasSpecies>& species = options.gas_species;
  if (species.size() > kMostSpecies) {
    return absl::InvalidArgumentError(
        absl::StrCat("gas_species = ", species.size(), " gases must be at most ", kMostSpecies));
  }
  for (std::size_t i = 0; i < species.size(); ++i) {
    const std::string field = absl::StrCat("gas_species[", i, "]");
    PLUMESCOUT_RETURN_IF_ERROR(ValidateId(absl::StrCat(field, ".name"), species[i].name));
    if (*FindSpecies(options, species[i].name) != i) {
      return absl::InvalidArgumentError(
          absl::StrCat(field, ".name = \"", species[i].name, "\" is that of another gas"));
    }
    PLUMESCOUT_RETURN_IF_ERROR(ValidateModel(options, i, field));
  }
  return absl::OkStatus();
}

}  // namespace plumescout
