// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "absl/strings/str_cat.h"
#include "plumescout/v1/mission_service.pb.h"
#include "tests/server/bad_input.h"
#include "tests/server/bad_name_input.h"

namespace plumescout::server {

// Areas that are none, in a list of areas.
inline BadInputs BadAreas(const std::string& list) {
  BadInputs rows;
  const std::string vertices = absl::StrCat(list, ".vertices");
  for (const char* axis : {"x_m", "y_m"}) {
    for (const char* value : {"nan", "-inf", "1e300"}) {
      const auto spoil = [=](Message& message) {
        SetField(message, list, "{vertices {} vertices {} vertices {}}");
        SetField(message, absl::StrCat(vertices, ".", axis), value);
      };
      rows.Row({absl::StrCat(vertices, ".", axis), value, spoil, absl::StatusCode::kInvalidArgument,
                absl::StrCat(list, "[0].vertices[0].", axis)});
    }
  }
  const auto many = [](int count, const std::string& part, const std::string& between) {
    std::string text;
    for (int i = 0; i < count; ++i) absl::StrAppend(&text, i > 0 ? between : "", part);
    return text;
  };
  static const std::string crooked = absl::StrCat("{", many(257, "vertices {}", " "), "}");
  rows.ValuesBlaming(absl::StrCat(list, "[0].vertices"), list,
                     {"{}", "{vertices {} vertices {}}", crooked.c_str()});
  rows.Row({vertices, "one",
            [=](Message& message) {
              SetField(message, list, "{}");
              SetField(message, vertices, "{x_m: 1}");
            },
            absl::StatusCode::kInvalidArgument, absl::StrCat(list, "[0].vertices")});
  const std::string triangle = "vertices {} vertices {} vertices {}";
  const auto named = [=](const std::string& name) {
    return [=](Message& message) {
      SetField(message, list, absl::StrCat("{", triangle, " name: \"", name, "\"}"));
    };
  };
  for (const char* name : {"Spill", "a_b", "-", "area "}) {
    rows.Row({absl::StrCat(list, ".name"), name, named(name), absl::StatusCode::kInvalidArgument,
              absl::StrCat(list, "[0].name")});
  }
  rows.Row({absl::StrCat(list, ".name"), "twice",
            [=](Message& message) {
              named("spill")(message);
              named("spill")(message);
            },
            absl::StatusCode::kInvalidArgument, absl::StrCat(list, "[1].name")});
  rows.Row({list, "65 of them",
            [=](Message& message) {
              for (int i = 0; i < 65; ++i) named(absl::StrCat("a", i))(message);
            },
            absl::StatusCode::kInvalidArgument, list});
  return rows;
}

inline BadInputs BadKeepOut() {
  return BadInputs()
      .Rows(BadMissionName("name"))
      .Rows(BadRequestId())
      .Value("deleted", R"("nowhere")", absl::StatusCode::kNotFound, "KEEP_OUT_AREA_NOT_FOUND")
      .Rows(BadAreas("added"))
      .Row({"added.name", "none",
            [](Message& message) {
              SetField(message, "added", "{vertices {} vertices {} vertices {}}");
            },
            absl::StatusCode::kInvalidArgument, "added[0].name"});
}

}  // namespace plumescout::server
