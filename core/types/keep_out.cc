// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/keep_out.h"

#include <algorithm>
#include <set>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/string_view.h"
#include "core/types/checker.h"
#include "core/types/error_reason.h"
#include "core/types/ids.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

absl::Status ValidateArea(const Polygon& area, const std::string& field) {
  constexpr int kMaxVertices = 256;
  constexpr double kMaxCoordinate_m = 1e6;
  Checker checker;
  checker.InRange(absl::StrCat(field, ".vertices"), area.vertices.size(), 3, kMaxVertices);
  for (std::size_t i = 0; i < area.vertices.size(); ++i) {
    const std::string vertex = absl::StrCat(field, ".vertices[", i, "]");
    checker
        .InRange(absl::StrCat(vertex, ".x_m"), area.vertices[i].x_m, -kMaxCoordinate_m,
                 kMaxCoordinate_m)
        .InRange(absl::StrCat(vertex, ".y_m"), area.vertices[i].y_m, -kMaxCoordinate_m,
                 kMaxCoordinate_m);
  }
  return checker.status();
}

// Each as it has to be, and of those with a name no two with the same.
absl::Status ValidateAreas(const std::vector<Polygon>& areas, absl::string_view field,
                           bool may_lack_name) {
  PLUMESCOUT_RETURN_IF_ERROR(Checker().InRange(field, areas.size(), 0, kMostKeepOutAreas).status());
  std::set<std::string> names;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const std::string area = absl::StrCat(field, "[", i, "]");
    PLUMESCOUT_RETURN_IF_ERROR(ValidateArea(areas[i], area));
    const std::string& name = areas[i].name;
    if (name.empty() && may_lack_name) continue;
    PLUMESCOUT_RETURN_IF_ERROR(ValidateId(absl::StrCat(area, ".name"), name));
    if (names.insert(name).second) continue;
    return absl::InvalidArgumentError(
        absl::StrCat(area, ".name = \"", name, "\" is that of another area"));
  }
  return absl::OkStatus();
}

auto Find(std::vector<Polygon>& areas, const std::string& name) {
  return std::find_if(areas.begin(), areas.end(),
                      [&](const Polygon& area) { return area.name == name; });
}

}  // namespace

absl::Status ValidateKeepOut(const std::vector<Polygon>& areas) {
  return ValidateAreas(areas, "keep_out", true);
}

std::vector<Polygon> WithNames(std::vector<Polygon> areas) {
  int number = 0;
  for (Polygon& area : areas) {
    while (area.name.empty()) {
      std::string name = absl::StrCat("area-", ++number);
      if (Find(areas, name) == areas.end()) area.name = std::move(name);
    }
  }
  return areas;
}

absl::StatusOr<std::vector<Polygon>> AfterChange(std::vector<Polygon> areas,
                                                 const KeepOutChanged& change) {
  PLUMESCOUT_RETURN_IF_ERROR(ValidateAreas(change.added, "added", false));
  for (const std::string& name : change.deleted) {
    const auto found = Find(areas, name);
    if (found == areas.end()) {
      return TypedError(absl::StatusCode::kNotFound, reason::kKeepOutAreaNotFound,
                        absl::StrCat("keep-out area \"", name.substr(0, 80), "\""));
    }
    areas.erase(found);
  }
  for (const Polygon& area : change.added) {
    if (Find(areas, area.name) != areas.end()) {
      return TypedError(absl::StatusCode::kAlreadyExists, reason::kKeepOutAreaExists,
                        absl::StrCat("keep-out area \"", area.name, "\""));
    }
    areas.push_back(area);
  }
  if (areas.size() > kMostKeepOutAreas) {
    return TypedError(absl::StatusCode::kResourceExhausted, reason::kLimitReached,
                      absl::StrCat("the mission would have ", areas.size(),
                                   " keep-out areas, more than ", kMostKeepOutAreas));
  }
  return areas;
}

}  // namespace plumescout
