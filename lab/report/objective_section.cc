// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/objective_section.h"

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "lab/report/palette.h"

namespace plumescout::lab {
namespace {

constexpr double kPercent = 100.0;

// A verdict as people read it: what is decided lies on one of the threshold's sides.
enum class Outlook { kBelow, kAbove, kRefuted, kUndecided, kNotMeasured, kDoesNotCount };

Outlook OutlookOf(const ObjectiveOutcome& outcome, const MapSnapshot& map, std::size_t cell) {
  switch (outcome.verdicts[cell]) {
    case ObjectiveVerdict::kDecided: {
      const bool has_sides = outcome.asked.kind != ObjectiveKind::kConfirmClean;
      const bool is_above =
          has_sides && static_cast<double>(map.gas_mean_ppm[cell]) > outcome.asked.threshold_ppm;
      return is_above ? Outlook::kAbove : Outlook::kBelow;
    }
    case ObjectiveVerdict::kRefuted:
      return Outlook::kRefuted;
    case ObjectiveVerdict::kUndecided:
      return Outlook::kUndecided;
    case ObjectiveVerdict::kNotMeasured:
      return Outlook::kNotMeasured;
    case ObjectiveVerdict::kDoesNotCount:
      break;
  }
  return Outlook::kDoesNotCount;
}

struct Kind {
  Outlook outlook;
  std::string name;
  Rgb color;
};

// Those that missions for `asked` can have, as the console calls them (objective_words.ts).
std::vector<Kind> KindsOf(const ObjectiveOptions& asked) {
  const std::string threshold = absl::StrFormat("%g ppm", asked.threshold_ppm);
  std::vector<Kind> kinds;
  switch (asked.kind) {
    case ObjectiveKind::kMapAboveThreshold:
      kinds = {{Outlook::kAbove, absl::StrCat("above ", threshold), kJudgedAboveColor},
               {Outlook::kBelow, absl::StrCat("below ", threshold), kJudgedBelowColor}};
      break;
    case ObjectiveKind::kConfirmClean:
      kinds = {{Outlook::kBelow, absl::StrCat("below ", threshold), kJudgedBelowColor},
               {Outlook::kRefuted, absl::StrCat("above ", threshold), kJudgedRefutedColor}};
      break;
    case ObjectiveKind::kFindSources:
      kinds = {{Outlook::kBelow, "weaker than the source", kJudgedBelowColor},
               {Outlook::kAbove, absl::StrCat("weaker, but above ", threshold), kJudgedAboveColor}};
      break;
    case ObjectiveKind::kCompleteMap:
      break;
  }
  kinds.push_back({Outlook::kUndecided, "undecided, measured", kJudgedUndecidedColor});
  kinds.push_back({Outlook::kNotMeasured, "undecided, not measured", kNotMeasuredColor});
  return kinds;
}

std::string Asked(const ObjectiveOptions& asked) {
  const std::string threshold = absl::StrFormat("%g ppm", asked.threshold_ppm);
  std::string what = "a complete map";
  switch (asked.kind) {
    case ObjectiveKind::kMapAboveThreshold:
      what = absl::StrCat("map where there is more than ", threshold);
      break;
    case ObjectiveKind::kConfirmClean:
      what = absl::StrCat("confirm that there is nowhere more than ", threshold);
      break;
    case ObjectiveKind::kFindSources:
      what = absl::StrCat("find the strongest place, if it is above ", threshold);
      break;
    case ObjectiveKind::kCompleteMap:
      break;
  }
  return absl::StrCat(what, absl::StrFormat(", %.4g %% sure", kPercent * asked.confidence));
}

std::string Became(ObjectiveState state) {
  switch (state) {
    case ObjectiveState::kMet:
      return "met";
    case ObjectiveState::kRefuted:
      return "refuted";
    case ObjectiveState::kCannotBeMet:
      return "the mission ended before";
    case ObjectiveState::kPursued:
      break;
  }
  return "still open";
}

// Of what is concluded, or how far the most doubtful place is from it.
std::string Confidence(const ObjectiveStatus& status) {
  const std::string share = absl::StrFormat("%.4g %%", kPercent * status.confidence);
  if (IsConcluded(status)) return share;
  if (!status.place) return "nothing is known";
  return absl::StrCat(share, absl::StrFormat(" at %.1f, %.1f, the most doubtful place",
                                             status.place->x_m, status.place->y_m));
}

std::string When(const ObjectiveOutcome& outcome) {
  if (outcome.status.state == ObjectiveState::kPursued) return "";
  return absl::StrFormat("after %.0f s", outcome.since_s);
}

std::string Area(double area_m2, double all_m2) {
  if (!(all_m2 > 0.0)) return "none";
  return absl::StrFormat("%.1f m\u00B2 (%.1f %%)", area_m2, kPercent * area_m2 / all_m2);
}

}  // namespace

TextTable ObjectiveTable(const ObjectiveOutcome& outcome, const MapSnapshot& map) {
  TextTable table{"What the mission was for",
                  {"objective", "outcome", "confidence", "when"},
                  {{Asked(outcome.asked), Became(outcome.status.state), Confidence(outcome.status),
                    When(outcome)}}};
  const double resolution_m = outcome.verdicts.geometry().resolution_m;
  std::vector<std::size_t> counts(static_cast<std::size_t>(Outlook::kDoesNotCount) + 1);
  for (std::size_t i = 0; i < outcome.verdicts.size(); ++i) {
    ++counts[static_cast<std::size_t>(OutlookOf(outcome, map, i))];
  }
  const std::size_t all = outcome.verdicts.size() - counts.back();
  const auto area_m2 = [resolution_m](std::size_t cells) {
    return static_cast<double>(cells) * resolution_m * resolution_m;
  };
  for (const Kind& kind : KindsOf(outcome.asked)) {
    table.columns.push_back(kind.name);
    table.rows.front().push_back(
        Area(area_m2(counts[static_cast<std::size_t>(kind.outlook)]), area_m2(all)));
  }
  return table;
}

MapPanel ObjectivePanel(const ObjectiveOutcome& outcome, const MapSnapshot& map,
                        const Rectangle& region) {
  MapPanel panel;
  panel.title = "Objective";
  panel.region = region;
  const std::vector<Kind> kinds = KindsOf(outcome.asked);
  const GridGeometry& geometry = map.occupancy.geometry();
  panel.cells = PaintCells(geometry, region, [&](Cell cell) {
    if (map.occupancy[cell] == CellState::kOccupied) return kWallColor;
    const Outlook outlook = OutlookOf(outcome, map, geometry.Index(cell));
    for (const Kind& kind : kinds) {
      if (kind.outlook == outlook) return kind.color;
    }
    return map.occupancy[cell] == CellState::kFree ? kFreeColor : kUnknownColor;
  });
  for (const Kind& kind : kinds) {
    panel.legend.push_back({kind.name, MarkShape::kSwatch, kind.color});
  }
  panel.legend.push_back({"does not count", MarkShape::kSwatch, kFreeColor});
  const auto mark = [&panel](const char* name, const std::optional<Point2>& place, Rgb color) {
    if (!place) return;
    panel.marks.push_back({MarkShape::kDisc, color, *place});
    panel.legend.push_back({name, MarkShape::kDisc, color});
  };
  if (!IsConcluded(outcome.status) || outcome.status.state == ObjectiveState::kRefuted) {
    mark(
        outcome.status.state == ObjectiveState::kRefuted ? "clearest place" : "most doubtful place",
        outcome.status.place, kInk);
  }
  mark("strongest place", outcome.status.strongest, kStartColor);
  return panel;
}

}  // namespace plumescout::lab
