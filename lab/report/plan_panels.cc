// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/plan_panels.h"

#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "lab/report/figures.h"
#include "lab/report/palette.h"

namespace plumescout::lab {
namespace {

constexpr Rgb kRejectedColor{168, 174, 186};
constexpr Rgb kTreeColor{255, 255, 255};
constexpr Rgb kMarginColor{150, 156, 168};
constexpr Rgb kCandidatePathColor{36, 99, 201};
constexpr double kHalo_px = 2.5;

// A line with a white rim, which sets it off any ground.
void AddLine(std::vector<MapLine>& lines, const std::vector<Point2>& points, const Stroke& stroke) {
  lines.push_back({points, {kPaper, stroke.width_px + kHalo_px}});
  lines.push_back({points, stroke});
}

// The robot's place, and a line to where it looks.
void AddRobot(const Pose2& robot, MapPanel& panel) {
  constexpr double kLook_m = 0.6;
  const Point2 ahead{robot.x_m + kLook_m * std::cos(robot.yaw_rad),
                     robot.y_m + kLook_m * std::sin(robot.yaw_rad)};
  AddLine(panel.lines, {robot.position(), ahead}, {kStartColor, 3.0});
  panel.marks.push_back({MarkShape::kDisc, kStartColor, robot.position()});
}

MapPanel TreePanel(const PlanPicture& picture, const Region& region) {
  const ColorScale scale{ColorMap::kGas, 0.0, 1.0, false};
  MapPanel panel;
  panel.title = "Information map and search tree";
  panel.region = region;
  panel.cells = PaintCells(picture.occupancy.geometry(), region, [&](Cell cell) {
    const CellState state = picture.occupancy[cell];
    if (state != CellState::kFree) return StateColor(state);
    const float information = picture.information[cell];
    return std::isfinite(information) ? scale(information) : kMarginColor;
  });
  for (const auto& [parent, child] : picture.tree) {
    panel.lines.push_back({{parent, child}, {kTreeColor, 1.0}});
  }
  AddRobot(picture.robot, panel);
  panel.color_bar = ColorBar{scale, "UCB"};
  panel.legend = {{"robot", MarkShape::kDisc, kStartColor},
                  {"white: tree", MarkShape::kSwatch, kTreeColor},
                  {"too near to drive", MarkShape::kSwatch, kMarginColor}};
  return panel;
}

std::vector<MapLine> PathLines(const Plan& plan) {
  std::vector<MapLine> lines;
  for (const Candidate& candidate : plan.candidates) {
    AddLine(lines, candidate.path, {kCandidatePathColor, 1.8});
  }
  if (plan.chosen >= 0) {
    AddLine(lines, plan.candidates[static_cast<std::size_t>(plan.chosen)].path,
            {kChosenPathColor, 4.5});
  }
  return lines;
}

std::vector<MapMark> GoalMarks(const Plan& plan) {
  std::vector<MapMark> marks;
  for (std::size_t i = 0; i < plan.candidates.size(); ++i) {
    const Goal& goal = plan.candidates[i].goal;
    marks.push_back({MarkShape::kDisc, GoalColor(goal.kind), goal.position, CandidateLabel(i),
                     static_cast<int>(i) == plan.chosen});
  }
  for (std::size_t i = 0; i < plan.rejected.size(); ++i) {
    marks.push_back(
        {MarkShape::kCross, kRejectedColor, plan.rejected[i].goal.position, RejectionLabel(i)});
  }
  return marks;
}

MapPanel CandidatesPanel(const PlanPicture& picture, const Region& region) {
  MapPanel panel;
  panel.title = "Candidates and choice";
  panel.region = region;
  panel.cells = PaintCells(picture.occupancy.geometry(), region,
                           [&](Cell cell) { return StateColor(picture.occupancy[cell]); });
  AddRobot(picture.robot, panel);
  for (MapLine& line : PathLines(picture.plan)) panel.lines.push_back(std::move(line));
  for (MapMark& mark : GoalMarks(picture.plan)) panel.marks.push_back(std::move(mark));
  panel.legend = {{"chosen path", MarkShape::kLine, kChosenPathColor},
                  {"gas frontier", MarkShape::kDisc, GoalColor(GoalKind::kGasFrontier)},
                  {"robot", MarkShape::kDisc, kStartColor},
                  {"other candidate", MarkShape::kLine, kCandidatePathColor},
                  {"occupancy frontier", MarkShape::kDisc, GoalColor(GoalKind::kOccupancyFrontier)},
                  {"occupied", MarkShape::kSwatch, kOccupiedColor},
                  {"rejected goal", MarkShape::kDisc, kRejectedColor},
                  {"random place", MarkShape::kDisc, GoalColor(GoalKind::kRandomFreeSpace)},
                  {"unknown", MarkShape::kSwatch, kUnknownColor}};
  return panel;
}

}  // namespace

std::string CandidateLabel(std::size_t index) { return absl::StrCat(index + 1); }

std::string RejectionLabel(std::size_t index) {
  if (index >= kListedRejections) return "";
  return std::string(1, static_cast<char>('a' + static_cast<char>(index)));
}

Rgb GoalColor(GoalKind kind) {
  switch (kind) {
    case GoalKind::kOccupancyFrontier:
      return kOccupancyFrontierColor;
    case GoalKind::kGasFrontier:
      return kGasFrontierColor;
    case GoalKind::kInformation:
    case GoalKind::kSite:
    case GoalKind::kHome:
      return kStartColor;
    case GoalKind::kRandomFreeSpace:
      break;
  }
  return kRandomGoalColor;
}

std::vector<MapPanel> MakePlanPanels(const PlanPicture& picture) {
  const Region region = KnownRegion(picture.occupancy);
  return {TreePanel(picture, region), CandidatesPanel(picture, region)};
}

}  // namespace plumescout::lab
