// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/maps/part_token.h"

#include <vector>

#include "absl/strings/escaping.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_split.h"
#include "proto/convert/field.h"

namespace plumescout::server {
namespace {

// Equal for equal views only: reals are written in full.
std::string Describe(const MissionId& mission, const MapView& view) {
  std::string text = absl::StrCat(mission, "/", view.occupancy, view.gas_mean, view.gas_variance,
                                  view.full_precision, view.level_of_detail);
  if (view.region) {
    absl::StrAppendFormat(&text, "/%a/%a/%a/%a", view.region->min.x_m, view.region->min.y_m,
                          view.region->max.x_m, view.region->max.y_m);
  }
  for (const std::string& species : view.species) absl::StrAppend(&text, "/", species);
  return text;
}

}  // namespace

std::string PartToken(const PartPlace& place, const MissionId& mission, const MapView& view) {
  return absl::WebSafeBase64Escape(
      absl::StrCat(place.revision, " ", place.tile, " ", Describe(mission, view)));
}

absl::StatusOr<PartPlace> ReadPartToken(const std::string& token, const MissionId& mission,
                                        const MapView& view) {
  std::string text;
  PartPlace place;
  if (absl::WebSafeBase64Unescape(token, &text)) {
    const std::vector<std::string> words = absl::StrSplit(text, ' ');
    if (words.size() == 3 && absl::SimpleAtoi(words[0], &place.revision) &&
        absl::SimpleAtoi(words[1], &place.tile) && words[2] == Describe(mission, view)) {
      return place;
    }
  }
  return FieldError("part_token", token, "is not a token of this map");
}

}  // namespace plumescout::server
