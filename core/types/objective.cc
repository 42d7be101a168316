// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "core/types/objective.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"

namespace plumescout {
namespace {

constexpr double kPercent = 100.0;

std::string At(const std::optional<Point2>& place) {
  if (!place) return "";
  return absl::StrFormat(" at (%.1f, %.1f)", place->x_m, place->y_m);
}

std::string WhatIsMet(const ObjectiveStatus& status, const ObjectiveOptions& options) {
  switch (options.kind) {
    case ObjectiveKind::kMapAboveThreshold:
      return absl::StrFormat("where there is more than %g ppm is known to within %g m",
                             options.threshold_ppm, options.radius_m);
    case ObjectiveKind::kConfirmClean:
      return absl::StrFormat("clean: nowhere more than %g ppm", options.threshold_ppm);
    case ObjectiveKind::kFindSources:
      return absl::StrCat("the strongest place is", At(status.strongest));
    case ObjectiveKind::kCompleteMap:
      break;
  }
  return "the map is complete";
}

std::string WhatIsRefuted(const ObjectiveStatus& status, const ObjectiveOptions& options) {
  if (options.kind == ObjectiveKind::kFindSources) {
    return absl::StrFormat("there is no source: nowhere more than %g ppm", options.threshold_ppm);
  }
  return absl::StrFormat("not clean: %.1f ppm%s", status.mean_ppm, At(status.place));
}

std::string WhatIsLeft(const ObjectiveStatus& status) {
  if (!status.place) return "nothing is known yet";
  return absl::StrFormat("%.1f m\u00B2 are undecided, most of all%s, and %d frontier%s open",
                         status.undecided_area_m2, At(status.place), status.open_frontiers,
                         status.open_frontiers == 1 ? " of the map is" : "s of the map are");
}

}  // namespace

std::string Describe(const ObjectiveStatus& status, const ObjectiveOptions& options) {
  const std::string sure =
      absl::StrFormat(", with a confidence of %.4g %%.", kPercent * status.confidence);
  switch (status.state) {
    case ObjectiveState::kMet:
      return absl::StrCat("The objective is met: ", WhatIsMet(status, options), sure);
    case ObjectiveState::kRefuted:
      return absl::StrCat("The objective is refuted: ", WhatIsRefuted(status, options), sure);
    case ObjectiveState::kCannotBeMet:
      return absl::StrCat("The mission ended before its objective was met: ", WhatIsLeft(status),
                          ".");
    case ObjectiveState::kPursued:
      break;
  }
  return absl::StrCat("The objective is pursued: ", WhatIsLeft(status), ".");
}

}  // namespace plumescout
