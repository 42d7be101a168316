// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string>

#include "absl/strings/str_cat.h"
#include "plumescout/v1/mission_service.pb.h"
#include "tests/server/bad_input.h"

namespace plumescout::server {

// Of a second gas, for the first has no model of its own.
inline BadInputs BadGasSpecies() {
  const std::string gases = "options.gas_species";
  BadInputs rows;
  const auto values = [&](const std::string& field, std::initializer_list<const char*> values) {
    for (const char* value : values) {
      rows.Row({absl::StrCat(gases, ".", field), value,
                [field, value = std::string(value)](Message& message) {
                  auto& options =
                      *static_cast<v1::CreateMissionRequest&>(message).mutable_options();
                  options.add_gas_species()->set_name("methane");
                  options.add_gas_species()->set_name("ozone");
                  SetField(*options.mutable_gas_species(1), field, value);
                },
                absl::StatusCode::kInvalidArgument, absl::StrCat(gases, "[1].", field)});
    }
  };
  values("name", {R"("")", R"("O3")", R"("a/b")", R"("methane")"});
  values("prior_precision_per_ppm2", {"nan", "inf", "-1", "0", "1e300", "1e-300"});
  values("observation_precision_per_ppm2", {"nan", "inf", "-1", "0", "1e300", "1e-300"});
  values("background_precision_per_ppm2", {"nan", "inf", "-1", "0", "1e300", "1e-300"});
  values("background_mean_ppm", {"nan", "inf", "-1", "1e7"});
  rows.Row({gases + ".background_mean_ppm", "of the first",
            [](Message& message) {
              auto& options = *static_cast<v1::CreateMissionRequest&>(message).mutable_options();
              options.add_gas_species()->set_name("methane");
              options.mutable_gas_species(0)->set_background_mean_ppm(1.0);
            },
            absl::StatusCode::kInvalidArgument, gases + "[0].background_mean_ppm"});
  return rows.Row({gases, "five of them",
                   [](Message& message) {
                     auto& request = static_cast<v1::CreateMissionRequest&>(message);
                     for (const char* name : {"a", "b", "c", "d", "e"}) {
                       request.mutable_options()->add_gas_species()->set_name(name);
                     }
                   },
                   absl::StatusCode::kInvalidArgument, gases});
}

}  // namespace plumescout::server
