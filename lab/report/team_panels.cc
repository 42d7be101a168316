// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/team_panels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "lab/report/figures.h"
#include "lab/report/palette.h"

namespace plumescout::lab {
namespace {

constexpr double kStep_s = 0.1;      // between discs of a tube
constexpr double kHorizon_s = 30.0;  // tubes are palest from here on
constexpr double kPalest = 0.75;     // share of paper
constexpr int kFiner = 2;            // pixels of a cell, each way

// A robot's disc at one time.
struct Disc {
  double order = 0.0;  // greater: on top
  std::size_t member = 0;
  Point2 center;
  double pale = 0.0;  // share of paper, [0, 1]
};

Rgb ColorOf(std::size_t member) { return kTeamColors[member % kTeamColors.size()]; }

Rgb Paler(const Rgb& color, double share) {
  const auto mix = [share](std::uint8_t from, std::uint8_t to) {
    return static_cast<std::uint8_t>(std::lround(std::lerp(from, to, share)));
  };
  return {mix(color.red, kPaper.red), mix(color.green, kPaper.green), mix(color.blue, kPaper.blue)};
}

GridGeometry Finer(GridGeometry geometry) {
  geometry.resolution_m /= kFiner;
  geometry.width *= kFiner;
  geometry.height *= kFiner;
  return geometry;
}

void Stamp(const Disc& disc, double radius_m, Grid<Rgb>& colors) {
  const GridGeometry& geometry = colors.geometry();
  const Cell low = geometry.CellAt({disc.center.x_m - radius_m, disc.center.y_m - radius_m});
  const Cell high = geometry.CellAt({disc.center.x_m + radius_m, disc.center.y_m + radius_m});
  const Rgb color = Paler(ColorOf(disc.member), disc.pale);
  for (int y = std::max(0, low.y); y <= std::min(geometry.height - 1, high.y); ++y) {
    for (int x = std::max(0, low.x); x <= std::min(geometry.width - 1, high.x); ++x) {
      const Cell cell{x, y};
      if (Distance_m(geometry.Center(cell), disc.center) <= radius_m) colors[cell] = color;
    }
  }
}

// The discs on the map, whose walls stay visible.
CellPicture Paint(std::vector<Disc> discs, double radius_m, const Grid<CellState>& map,
                  const Rectangle& region) {
  std::stable_sort(discs.begin(), discs.end(),
                   [](const Disc& a, const Disc& b) { return a.order < b.order; });
  const GridGeometry geometry = Finer(map.geometry());
  Grid<Rgb> colors(geometry);
  const auto state_at = [&](Cell cell) { return map[Cell{cell.x / kFiner, cell.y / kFiner}]; };
  for (std::size_t i = 0; i < colors.size(); ++i) {
    colors[i] = StateColor(state_at(geometry.CellAtIndex(i)));
  }
  for (const Disc& disc : discs) Stamp(disc, radius_m, colors);
  return PaintCells(geometry, region, [&](Cell cell) {
    return state_at(cell) == CellState::kOccupied ? kOccupiedColor : colors[cell];
  });
}

// The way that is live at that time; null if there is none.
const TimedWay* LiveWay(const TeamMember& member, double time_s) {
  for (const TimedWay& way : member.ways) {
    if (way.begin_s <= time_s && time_s < way.end_s) return &way;
  }
  return nullptr;
}

double Ahead_s(const TimedWay& way, double time_s) {
  return std::max(0.0, way.trajectory.duration_s - (time_s - way.begin_s));
}

MapPanel PanelOf(const TeamPicture& team, std::string title, const Rectangle& region,
                 CellPicture cells) {
  MapPanel panel;
  panel.title = std::move(title);
  panel.region = region;
  panel.cells = std::move(cells);
  for (std::size_t i = 0; i < team.members.size(); ++i) {
    panel.legend.push_back({team.members[i].name, MarkShape::kSwatch, ColorOf(i)});
  }
  return panel;
}

}  // namespace

double BusiestMoment_s(const TeamPicture& team) {
  std::pair<int, double> most{0, 0.0};
  double moment_s = 0.0;
  for (const TeamMember& asked : team.members) {
    for (const TimedWay& begun : asked.ways) {
      std::pair<int, double> busy{0, 0.0};
      for (const TeamMember& member : team.members) {
        const TimedWay* way = LiveWay(member, begun.begin_s);
        if (way == nullptr) continue;
        ++busy.first;
        busy.second += Ahead_s(*way, begun.begin_s);
      }
      if (busy <= most) continue;
      most = busy;
      moment_s = begun.begin_s;
    }
  }
  return moment_s;
}

MapPanel TubesPanel(const TeamPicture& team, const Grid<CellState>& map, const Rectangle& region,
                    double time_s) {
  std::vector<Disc> discs;
  std::vector<MapMark> marks;
  for (std::size_t i = 0; i < team.members.size(); ++i) {
    const TimedWay* way = LiveWay(team.members[i], time_s);
    if (way == nullptr) continue;
    const auto at = [&](double ahead_s) {
      return PoseAt(way->trajectory, time_s - way->begin_s + ahead_s).position();
    };
    const int steps = static_cast<int>(Ahead_s(*way, time_s) / kStep_s);
    for (int step = 0; step <= steps; ++step) {
      const double ahead_s = step * kStep_s;
      discs.push_back({-ahead_s, i, at(ahead_s), kPalest * std::min(1.0, ahead_s / kHorizon_s)});
    }
    marks.push_back({MarkShape::kDisc, ColorOf(i), at(0.0), absl::StrCat(i + 1)});
  }
  MapPanel panel = PanelOf(team, absl::StrFormat("Live plans as tubes, %.0f s", time_s), region,
                           Paint(std::move(discs), team.reach_m, map, region));
  panel.marks = std::move(marks);
  return panel;
}

MapPanel DrivenPanel(const TeamPicture& team, const Grid<CellState>& map, const Rectangle& region) {
  double end_s = 0.0;
  for (const TeamMember& member : team.members) {
    if (!member.driven.empty()) end_s = std::max(end_s, member.driven.back().time_s);
  }
  std::vector<Disc> discs;
  for (std::size_t i = 0; i < team.members.size(); ++i) {
    for (const TimedPlace& at : team.members[i].driven) {
      const double left = end_s > 0.0 ? 1.0 - at.time_s / end_s : 0.0;
      discs.push_back({at.time_s, i, at.place, kPalest * left});
    }
  }
  return PanelOf(team, "Driven, paler: earlier", region,
                 Paint(std::move(discs), team.reach_m, map, region));
}

BarChart ShareChart(const TeamPicture& team) {
  constexpr double kPercent = 100.0;
  BarChart chart{"Shares of the robots, %", "robot", {}, {}, ""};
  chart.series = {{"area seen first", kLineColors[0], {}},
                  {"readings", kLineColors[1], {}},
                  {"way driven", kLineColors[2], {}}};
  for (const TeamMember& member : team.members) {
    chart.groups.push_back(member.name);
    chart.series[0].bars.push_back({.value = kPercent * member.area_share});
    chart.series[1].bars.push_back({.value = kPercent * member.readings_share});
    chart.series[2].bars.push_back({.value = kPercent * member.way_share});
  }
  return chart;
}

}  // namespace plumescout::lab
