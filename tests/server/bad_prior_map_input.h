// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "tests/server/bad_input.h"

namespace plumescout::server {

// A field of a prior map that is good but for it.
inline BadInput BadPriorMapField(const std::string& field, const std::string& value,
                                 const std::string& blamed) {
  const auto spoil = [=](Message& message) {
    const std::string prior_map = "options.prior_map";
    if (absl::StrContains(field, ".files")) {
      SetField(message, prior_map,
               R"({files {yaml: "{resolution: 0.1, origin: [0, 0, 0], negate: 0, )"
               R"(occupied_thresh: 0.65, free_thresh: 0.196}" pgm: "P5 1 1 255 \376"}})");
    } else {
      SetField(message, prior_map,
               "{cells {geometry {origin {} resolution_m: 0.1 column_count: 1 row_count: 1}}}");
    }
    SetField(message, field, value);
  };
  return {field, value, spoil, absl::StatusCode::kInvalidArgument, blamed};
}

inline BadInputs BadPriorMap() {
  const std::string p = "options.prior_map";
  const std::string g = p + ".cells.geometry";
  BadInputs rows;
  rows.Values(p, {"{}"})
      .ValuesBlaming(g + ".resolution_m", p + ".cells", {"{}"})
      .ValuesBlaming(p + ".files.yaml", p + ".files", {"{}"})
      .Row({p + ".map", "none", [=](Message& message) { SetField(message, p, "{}"); },
            absl::StatusCode::kInvalidArgument, p});
  for (const char* axis : {"x_m", "y_m"}) {
    for (const char* value : {"nan", "inf"}) {
      rows.Row(BadPriorMapField(absl::StrCat(g, ".origin.", axis), value,
                                absl::StrCat(g, ".origin.", axis)));
    }
  }
  for (const char* value : {"nan", "inf", "0", "-1"}) {
    rows.Row(BadPriorMapField(g + ".resolution_m", value, g + ".resolution_m"));
  }
  for (const char* side : {".column_count", ".row_count"}) {
    for (const char* value : {"-1", "2147483647"})
      rows.Row(BadPriorMapField(g + side, value, g + side));
  }
  const std::string data = p + ".cells.deflated_data";
  rows.Row(BadPriorMapField(g, "{resolution_m: nan}", g + ".resolution_m"))
      .Row(BadPriorMapField(g + ".origin", "{x_m: nan}", g + ".origin.x_m"))
      .Row(BadPriorMapField(data, R"("")", data))
      .Row(BadPriorMapField(data, R"("\001")", data));
  for (const char* value : {R"("")", R"("[")", R"("words")", R"("\000\001")"}) {
    rows.Row(BadPriorMapField(p + ".files.yaml", value, p + ".files.yaml"));
  }
  for (const char* value : {R"("")", R"("P2 1 1 255 0")", R"("P5 1 1 255 ")", R"("P5 0 1 255 ")"}) {
    rows.Row(BadPriorMapField(p + ".files.pgm", value, p + ".files.pgm"));
  }
  return rows;
}

}  // namespace plumescout::server
