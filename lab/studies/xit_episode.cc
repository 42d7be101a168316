// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/xit_episode.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/grid/flood.h"
#include "core/plan/cost/edge_cost.h"
#include "core/plan/paths/path_planners.h"
#include "core/plan/strategy.h"
#include "core/types/status_macros.h"
#include "lab/about/about.h"
#include "lab/report/figures.h"
#include "lab/report/palette.h"
#include "lab/sim/scene_maker.h"
#include "lab/trials/calibration_table.h"
#include "lab/trials/map_calibration.h"
#include "lab/worlds/bundled_layouts.h"
#include "lab/worlds/synthetic_scene.h"

namespace plumescout::lab {
namespace {

constexpr double kDuration_s = 300.0;
constexpr double kQuickDuration_s = 60.0;
constexpr double kSceneShare = 0.6;  // of the time that the study takes, for the progress line
// A detour by less than this, or shorter than that, shows nothing.
constexpr double kLeastDetour = 1.1;
constexpr double kLeastLength_m = 3.0;
constexpr Rgb kShortestColor{240, 130, 30};

SceneMakerOptions SceneOptions(const ExperimentOptions& options) {
  SceneMakerOptions scene;
  scene.seed = options.seed;
  if (options.quick) {
    scene.wind.flow_s = 5.0;
    scene.warm_up_s = 30.0;
    scene.frame_period_s = 2.0;
    scene.frames = static_cast<int>(kQuickDuration_s / scene.frame_period_s);
  }
  return scene;
}

absl::StatusOr<EpisodeOptions> MakeEpisodeOptions(const ExperimentOptions& options) {
  EpisodeOptions episode;
  episode.mission = "xit-episode";
  episode.create.emplace();
  episode.create->seed = options.seed;
  episode.create->occupancy = PublishedOccupancyOptions();
  episode.create->gas = PublishedGasOptions();
  episode.create->planning.strategy = "xit_gff";
  PLUMESCOUT_RETURN_IF_ERROR(ApplyStrategyRow(episode.create->planning));
  episode.duration_s = options.quick ? kQuickDuration_s : kDuration_s;
  episode.simulated.seed = options.seed;
  return episode;
}

double MeanUcb(const InformationMap& information, const std::vector<Point2>& path) {
  double integral_cells = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    integral_cells += SegmentIntegral_cells(information.value, path[i], path[i + 1]);
  }
  return integral_cells * information.value.geometry().resolution_m / PathLength_m(path);
}

// Of the moment's trajectory; no detour if there is nothing to compare it with.
Detour FindDetour(const MissionMoment& moment) {
  const Candidate& chosen = Chosen(moment);
  const InformationMap information = InformationOf(moment);
  const GridGeometry& geometry = moment.belief->geometry();
  Detour detour;
  detour.mean_ucb = detour.shortest_mean_ucb = chosen.mean_ucb;
  const Cell start = geometry.CellAt(chosen.path.front());
  if ((*moment.belief->traversable).At(start, 0) == 0) return detour;  // it had to escape first
  PlanningOptions exact;
  exact.paths = PathKind::kGridExact;
  const auto planner = MakePathPlanner(exact, nullptr);
  if (!planner.ok()) return detour;
  const EdgeCost length(information, CostKind::kEuclidean, 0.0);
  const Grid<std::uint8_t> reachable = ReachableCells(*moment.belief->traversable, {start});
  const std::vector<Goal> goals = {chosen.goal};
  const StopFn stop = NeverStop();
  const PathResult found = (*planner)->FindPaths(
      {length, reachable, chosen.path.front(), goals, moment.plan.seed, 0, stop});
  if (!found.paths.front()) return detour;
  detour.shortest = found.paths.front()->vertices;
  if (!(PathLength_m(detour.shortest) > 0.0) || !(PathLength_m(chosen.path) > 0.0)) return {};
  detour.length_ratio = PathLength_m(chosen.path) / PathLength_m(detour.shortest);
  detour.mean_ucb = MeanUcb(information, chosen.path);
  detour.shortest_mean_ucb = MeanUcb(information, detour.shortest);
  return detour;
}

bool IsTo(const MissionMoment& moment, GoalKind kind) { return Chosen(moment).goal.kind == kind; }

std::optional<std::size_t> FirstTo(const std::vector<MissionMoment>& moments, GoalKind kind) {
  for (std::size_t i = 0; i < moments.size(); ++i) {
    if (IsTo(moments[i], kind)) return i;
  }
  return std::nullopt;
}

// Moments between two that turn from one kind of frontier to the other.
std::vector<std::size_t> Turns(const std::vector<MissionMoment>& moments, std::size_t first,
                               std::size_t last) {
  std::vector<std::size_t> turns;
  for (std::size_t i = first + 1; i < last; ++i) {
    for (const GoalKind kind : {GoalKind::kOccupancyFrontier, GoalKind::kGasFrontier}) {
      if (IsTo(moments[i], kind) && !IsTo(moments[i - 1], kind)) turns.push_back(i);
    }
  }
  return turns;
}

// Up to three turns, evenly over the time of all; back to exploring and to gas in turn, if there
// are such turns.
std::vector<std::size_t> SpreadTurns(const std::vector<MissionMoment>& moments, std::size_t first,
                                     std::size_t last) {
  constexpr std::size_t kMost = 3;
  const std::vector<std::size_t> turns = Turns(moments, first, last);
  const std::size_t count = std::min(kMost, turns.size());
  const double begin_s = moments[first].time_s;
  const double end_s = moments[std::min(last, moments.size() - 1)].time_s;
  std::vector<std::size_t> spread;
  auto from = turns.begin();
  for (std::size_t i = 0; i < count; ++i) {
    const auto left = static_cast<std::ptrdiff_t>(count - 1 - i);  // to be chosen after this one
    const GoalKind wanted = i % 2 == 0 ? GoalKind::kOccupancyFrontier : GoalKind::kGasFrontier;
    const double share = static_cast<double>(i + 1) / static_cast<double>(count + 1);
    const double aim_s = begin_s + (end_s - begin_s) * share;
    from = std::min_element(from, turns.end() - left, [&](std::size_t a, std::size_t b) {
      const auto rank = [&](std::size_t turn) {
        return std::pair(!IsTo(moments[turn], wanted), std::abs(moments[turn].time_s - aim_s));
      };
      return rank(a) < rank(b);
    });
    spread.push_back(*from++);
  }
  return spread;
}

std::optional<std::size_t> BestDetour(const std::vector<MissionMoment>& moments,
                                      const std::vector<Detour>& detours) {
  std::optional<std::size_t> best;
  double most = 0.0;
  const double half_s = moments.empty() ? 0.0 : moments.back().time_s / 2.0;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const bool counts = moments[i].time_s >= half_s && detours[i].length_ratio >= kLeastDetour &&
                        Chosen(moments[i]).length_m >= kLeastLength_m;
    const double gain = detours[i].mean_ucb - detours[i].shortest_mean_ucb;
    if (!counts || gain <= most) continue;
    best = i;
    most = gain;
  }
  return best;
}

const char* NameOf(MomentKind kind) {
  switch (kind) {
    case MomentKind::kFirstFrontier:
      return "first occupancy frontier";
    case MomentKind::kFirstGasFrontier:
      return "first gas frontier";
    case MomentKind::kAlternation:
      break;
    case MomentKind::kExploitation:
      return "through the gas";
  }
  return "";
}

std::string TitleOf(char letter, const ChosenMoment& chosen, const MissionMoment& moment) {
  std::string what = NameOf(chosen.kind);
  if (what.empty()) {
    what = IsTo(moment, GoalKind::kGasFrontier) ? "to a gas frontier" : "back to exploring";
  }
  return absl::StrFormat("(%c) %.0f s: %s", letter, moment.time_s, what);
}

MapPanel PanelOf(const RecordedMission& mission, const ChosenMoment& chosen, char letter,
                 const Detour& detour, const Rectangle& region) {
  const MissionMoment& moment = mission.moments[chosen.index];
  MapPanel panel =
      MomentPanel(mission, moment, TitleOf(letter, chosen, moment), {.region = region});
  if (chosen.kind == MomentKind::kExploitation) {
    panel.lines.push_back({detour.shortest, {kShortestColor, 2.5, 5.0}});
    panel.legend.back() = {"shortest way", MarkShape::kLine, kShortestColor};
  }
  return panel;
}

// The last estimate, in the colours of the truth.
MapPanel FinalMeanPanel(const RecordedMission& mission, const MapPanel& truth) {
  const ColorScale& scale = truth.color_bar->scale;
  const MapSnapshot& map = mission.map;
  MapPanel panel = truth;
  panel.title = absl::StrFormat("Estimate at %.0f s", mission.episode.simulated_s);
  panel.cells = PaintCells(map.occupancy.geometry(), panel.region, [&](Cell cell) {
    const bool shown = map.occupancy[cell] == CellState::kFree;
    const float ppm = map.gas_mean_ppm.At(cell, std::numeric_limits<float>::quiet_NaN());
    return shown && std::isfinite(ppm) ? scale(ppm) : StateColor(map.occupancy[cell]);
  });
  return panel;
}

int TurnCount(const std::vector<MissionMoment>& moments) {
  return static_cast<int>(Turns(moments, 0, moments.size()).size());
}

void AddNumbers(const RecordedMission& mission, const Detour* detour, Study& study) {
  const MapMetrics& end = mission.episode.samples.back().metrics;
  const auto count = [&](GoalKind kind) {
    return static_cast<double>(
        std::count_if(mission.moments.begin(), mission.moments.end(),
                      [&](const MissionMoment& moment) { return IsTo(moment, kind); }));
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  study.summary.figures = {
      {"simulated_s", mission.episode.simulated_s},
      {"completeness", end.completeness},
      {"rmse_ppm", end.rmse_ppm},
      {"rmse_zero_ppm", end.rmse_zero_ppm},
      {"entropy_nats", end.entropy_nats},
      {"trajectories_to_occupancy_frontiers", count(GoalKind::kOccupancyFrontier)},
      {"trajectories_to_gas_frontiers", count(GoalKind::kGasFrontier)},
      {"turns_between_kinds", static_cast<double>(TurnCount(mission.moments))},
      {"distance_m", mission.episode.distance_m},
      {"exploitative_length_over_shortest", detour != nullptr ? detour->length_ratio : kNan},
      {"exploitative_mean_ucb", detour != nullptr ? detour->mean_ucb : kNan},
      {"shortest_mean_ucb", detour != nullptr ? detour->shortest_mean_ucb : kNan}};
  study.figures.key_numbers = {
      {"simulated", absl::StrFormat("%.0f s", mission.episode.simulated_s)},
      {"map complete", absl::StrFormat("%.1f %%", 100.0 * end.completeness)},
      {"RMSE", absl::StrFormat("%.2f ppm", end.rmse_ppm)},
      {"RMSE of an all-zero map", absl::StrFormat("%.2f ppm", end.rmse_zero_ppm)},
      {"entropy", absl::StrFormat("%.0f nats", end.entropy_nats)},
      {"turns between the kinds of goals", absl::StrCat(TurnCount(mission.moments))},
      {"trajectories to occupancy frontiers",
       absl::StrFormat("%.0f", count(GoalKind::kOccupancyFrontier))},
      {"trajectories to gas frontiers", absl::StrFormat("%.0f", count(GoalKind::kGasFrontier))},
      {"driven", absl::StrFormat("%.0f m", mission.episode.distance_m)}};
  if (detour == nullptr) return;
  study.figures.key_numbers.emplace_back("late path: length / shortest",
                                         absl::StrFormat("%.2f", detour->length_ratio));
  study.figures.key_numbers.emplace_back(
      "late path: mean UCB (of the shortest)",
      absl::StrFormat("%.2f (%.2f)", detour->mean_ucb, detour->shortest_mean_ucb));
}

std::vector<std::string> MakeNotes(const RecordedMission& mission, const Detour* detour) {
  std::vector<std::string> notes = {
      "The paper (Fig. 7) shows six moments of one mission in its hall of 16 m x 20 m, the "
      "posterior "
      "mean of the gas in colours: occupancy frontiers first; then a gas frontier, which is "
      "probed; "
      "then both in turn; at last a path through the gas in place of the shortest one. The plan of "
      "the hall is printed as a picture only. Ours: a hall of the same size and leaks of the same "
      "rates, the same strategy (gas frontiers first, UCB cost, alpha = 0).",
      absl::StrFormat("It is the same picture here: the mission turned %d times from one kind of "
                      "frontier to the other. Colours run from 0 to the greatest estimate of each "
                      "moment; dotted: the way so far; green: the robot.",
                      TurnCount(mission.moments))};
  if (detour != nullptr) {
    notes.push_back(
        absl::StrFormat("The last path is %.2f times as long as the shortest one to its goal "
                        "(dashed), and its mean "
                        "UCB is %.2f in place of %.2f.",
                        detour->length_ratio, detour->mean_ucb, detour->shortest_mean_ucb));
  }
  return notes;
}

}  // namespace

std::vector<ChosenMoment> ChooseMoments(const std::vector<MissionMoment>& moments,
                                        const std::vector<Detour>& detours) {
  std::vector<ChosenMoment> chosen;
  if (const auto first = FirstTo(moments, GoalKind::kOccupancyFrontier)) {
    chosen.push_back({MomentKind::kFirstFrontier, *first});
  }
  const auto first_gas = FirstTo(moments, GoalKind::kGasFrontier);
  const auto exploitation = BestDetour(moments, detours);
  if (first_gas) {
    chosen.push_back({MomentKind::kFirstGasFrontier, *first_gas});
    const std::size_t last = exploitation.value_or(moments.size());
    for (const std::size_t turn : SpreadTurns(moments, *first_gas, last)) {
      chosen.push_back({MomentKind::kAlternation, turn});
    }
  }
  if (exploitation) chosen.push_back({MomentKind::kExploitation, *exploitation});
  std::stable_sort(chosen.begin(), chosen.end(),
                   [](const auto& a, const auto& b) { return a.index < b.index; });
  return chosen;
}

absl::StatusOr<Study> RunXitEpisode(const ExperimentOptions& options) {
  const auto report = [&](double share) {
    if (options.progress) options.progress(share);
  };
  PLUMESCOUT_ASSIGN_OR_RETURN(const Layout layout, BundledLayout("industrial_16x20"));
  PLUMESCOUT_ASSIGN_OR_RETURN(
      Scene scene, MakeScene(layout, SceneOptions(options), [&](absl::string_view, double share) {
        report(kSceneShare * share);
      }));
  const SceneWorld world(std::move(scene));
  PLUMESCOUT_ASSIGN_OR_RETURN(const EpisodeOptions episode, MakeEpisodeOptions(options));
  PLUMESCOUT_ASSIGN_OR_RETURN(const RecordedMission mission,
                              RecordMission(world, episode, [&](double share) {
                                report(kSceneShare + (1.0 - kSceneShare) * share);
                              }));

  std::vector<Detour> detours;
  for (const MissionMoment& moment : mission.moments) detours.push_back(FindDetour(moment));
  const Rectangle region = RegionOf(world.scene().geometry());
  Study study;
  const Detour* exploitation = nullptr;
  char letter = 'a';
  for (const ChosenMoment& chosen : ChooseMoments(mission.moments, detours)) {
    const Detour& detour = detours[chosen.index];
    if (chosen.kind == MomentKind::kExploitation) exploitation = &detour;
    study.figures.panels.push_back(PanelOf(mission, chosen, letter++, detour, region));
  }
  study.figures.panels.push_back(TrueMeanPanel(world, "True mean"));
  study.figures.panels.push_back(FinalMeanPanel(mission, study.figures.panels.back()));
  study.figures.title = "One mission of XIT-GFF with UCB cost ([XIT] Fig. 7)";
  study.figures.notes = MakeNotes(mission, exploitation);
  study.figures.charts = MetricCharts(mission.episode);
  study.table = {{"time_s", "completeness", "rmse_ppm", "rmse_zero_ppm", "entropy_nats"},
                 MetricRows(mission.episode)};
  AddNumbers(mission, exploitation, study);
  AddCalibration(Calibrate(world.scene(), mission.map.gas_mean_ppm, mission.map.gas_variance_ppm2,
                           world.ambient_ppm()),
                 study);
  study.summary.about = AboutThisRun(options.seed);
  return study;
}

}  // namespace plumescout::lab
