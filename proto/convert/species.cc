// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "proto/convert/species.h"

#include <optional>
#include <set>

#include "absl/strings/str_cat.h"
#include "core/types/species.h"
#include "core/types/status_macros.h"
#include "proto/convert/field.h"

namespace plumescout {

absl::StatusOr<std::size_t> SpeciesFromProto(const std::string& name, const MissionOptions& options,
                                             absl::string_view field) {
  if (const std::optional<std::size_t> found = FindSpecies(options, name)) return *found;
  const std::string names = SpeciesNames(options);
  return FieldError(field, name,
                    names.empty() ? "must be empty: the mission names no gas"
                                  : absl::StrCat("must be empty or one of ", names));
}

absl::Status CheckSpecies(const std::vector<std::string>& names, const MissionOptions& options,
                          absl::string_view field) {
  std::set<std::size_t> asked;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string item = Join("", field, static_cast<int>(i));
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::size_t species,
                                SpeciesFromProto(names[i], options, item));
    if (!asked.insert(species).second) return FieldError(item, names[i], "is named twice");
  }
  return absl::OkStatus();
}

}  // namespace plumescout
