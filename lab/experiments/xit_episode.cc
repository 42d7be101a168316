// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/experiments/xit_episode.h"

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
#include "core/plan/edge_cost.h"
#include "core/plan/paths/path_planners.h"
#include "core/plan/strategy.h"
#include "core/types/status_macros.h"
#include "lab/bench/about.h"
#include "lab/experiments/bundled_layouts.h"
#include "lab/experiments/synthetic_scene.h"
#include "lab/report/figures.h"
#include "lab/report/palette.h"
#include "lab/sim/scene_maker.h"

namespace plumescout::lab {
namespace {

constexpr double kDuration_s = 300.0;
constexpr double kQuickDuration_s = 90.0;
constexpr double kSceneShare = 0.6;  // of the time that the study takes, for the progress line
// A detour by less than this, or shorter than that, shows nothing.
constexpr double kLeastDetour = 1.1;
constexpr double kLeastLength_m = 3.0;

SceneMakerOptions SceneOptions(const ExperimentOptions& options) {
  SceneMakerOptions scene;
  scene.seed = options.seed;
  if (options.quick) {
    scene.wind.flow_s = 5.0;
    scene.warm_up_s = 60.0;
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
  episode.create->planning.strategy = "xit_gff";
  PLUMESCOUT_RETURN_IF_ERROR(ApplyStrategyRow(episode.create->planning));
  episode.duration_s = options.quick ? kQuickDuration_s : kDuration_s;
  episode.simulated.seed = options.seed;
  return episode;
}

double MeanUcb(const InformationField& field, const std::vector<Point2>& path) {
  double integral_cells = 0.0;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    integral_cells += SegmentIntegral_cells(field.information, path[i], path[i + 1]);
  }
  return integral_cells * field.information.geometry().resolution_m / PathLength_m(path);
}

// Of the moment's trajectory; no detour if there is nothing to compare it with.
Detour FindDetour(const MissionMoment& moment) {
  const Candidate& chosen = Chosen(moment);
  const InformationField field = FieldOf(moment);
  const GridGeometry& geometry = moment.belief->geometry();
  Detour detour;
  detour.mean_ucb = detour.shortest_mean_ucb = chosen.mean_ucb;
  const Cell start = geometry.CellAt(chosen.path.front());
  if ((*moment.belief->traversable).At(start, 0) == 0) return detour;  // it had to escape first
  PlanningOptions exact;
  exact.paths = PathKind::kGridExact;
  const auto planner = MakePathPlanner(exact, nullptr);
  if (!planner.ok()) return detour;
  const EdgeCost length(field, CostKind::kEuclidean, 0.0);
  const Grid<std::uint8_t> reachable = ReachableCells(*moment.belief->traversable, {start});
  const std::vector<Goal> goals = {chosen.goal};
  const StopFn stop = NeverStop();
  const PathResult found = (*planner)->FindPaths(
      {length, reachable, chosen.path.front(), goals, moment.plan.seed, 0, stop});
  if (!found.paths.front()) return detour;
  detour.shortest = found.paths.front()->vertices;
  if (!(PathLength_m(detour.shortest) > 0.0) || !(PathLength_m(chosen.path) > 0.0)) return {};
  detour.length_ratio = PathLength_m(chosen.path) / PathLength_m(detour.shortest);
  detour.mean_ucb = MeanUcb(field, chosen.path);
  detour.shortest_mean_ucb = MeanUcb(field, detour.shortest);
  return detour;
}

bool IsTo(const MissionMoment& moment, GoalKind kind) { return Chosen(moment).goal.kind == kind; }

std::optional<std::size_t> FirstTo(const std::vector<MissionMoment>& moments, GoalKind kind) {
  for (std::size_t i = 0; i < moments.size(); ++i) {
    if (IsTo(moments[i], kind)) return i;
  }
  return std::nullopt;
}

// Moments after `first` that turn from one kind of frontier to the other, without those to gas
// frontiers or without the others.
std::vector<std::size_t> TurnsTo(const std::vector<MissionMoment>& moments, GoalKind kind,
                                 std::size_t first) {
  std::vector<std::size_t> turns;
  for (std::size_t i = first + 1; i < moments.size(); ++i) {
    if (IsTo(moments[i], kind) && !IsTo(moments[i - 1], kind)) turns.push_back(i);
  }
  return turns;
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
                 const Detour& detour, const Region& region) {
  const MissionMoment& moment = mission.moments[chosen.index];
  MapPanel panel =
      MomentPanel(mission, moment, TitleOf(letter, chosen, moment), {.region = region});
  if (chosen.kind == MomentKind::kExploitation) {
    panel.lines.push_back({detour.shortest, {kInk, 1.8, 5.0}});
    panel.legend.back() = {"shortest way", MarkShape::kLine, kInk};
  }
  return panel;
}

int TurnCount(const std::vector<MissionMoment>& moments) {
  return static_cast<int>(TurnsTo(moments, GoalKind::kGasFrontier, 0).size() +
                          TurnsTo(moments, GoalKind::kOccupancyFrontier, 0).size());
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
  for (const auto& [name, value] : study.summary.figures) {
    if (std::isfinite(value)) {
      study.figures.key_numbers.emplace_back(name, absl::StrFormat("%.4g", value));
    }
  }
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
    const double begin_s = moments[*first_gas].time_s;
    const double end_s = exploitation ? moments[*exploitation].time_s : moments.back().time_s;
    std::size_t after = *first_gas;
    constexpr int kAlternations = 3;
    for (int i = 1; i <= kAlternations; ++i) {
      const GoalKind kind = i % 2 == 1 ? GoalKind::kOccupancyFrontier : GoalKind::kGasFrontier;
      const double aim_s = begin_s + (end_s - begin_s) * i / (kAlternations + 1.0);
      std::vector<std::size_t> turns = TurnsTo(moments, kind, after);
      std::erase_if(turns, [&](std::size_t turn) { return exploitation && turn >= *exploitation; });
      if (turns.empty()) break;
      after = *std::min_element(turns.begin(), turns.end(), [&](std::size_t a, std::size_t b) {
        return std::abs(moments[a].time_s - aim_s) < std::abs(moments[b].time_s - aim_s);
      });
      chosen.push_back({MomentKind::kAlternation, after});
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
  const Region region = RegionOf(world.scene().geometry());
  Study study;
  const Detour* exploitation = nullptr;
  char letter = 'a';
  for (const ChosenMoment& chosen : ChooseMoments(mission.moments, detours)) {
    const Detour& detour = detours[chosen.index];
    if (chosen.kind == MomentKind::kExploitation) exploitation = &detour;
    study.figures.panels.push_back(PanelOf(mission, chosen, letter++, detour, region));
  }
  study.figures.panels.push_back(TrueMeanPanel(world, "True mean"));
  study.figures.title = "One mission of XIT-GFF with UCB cost ([XIT] Fig. 7)";
  study.figures.notes = MakeNotes(mission, exploitation);
  study.figures.charts = MetricCharts(mission.episode);
  study.table = {{"time_s", "completeness", "rmse_ppm", "rmse_zero_ppm", "entropy_nats"},
                 MetricRows(mission.episode)};
  AddNumbers(mission, exploitation, study);
  study.summary.about = AboutThisRun(options.seed);
  return study;
}

}  // namespace plumescout::lab
