// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/xit_trial.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/plan/strategy.h"
#include "core/types/status_macros.h"
#include "lab/about/about.h"
#include "lab/report/figures.h"
#include "lab/report/palette.h"
#include "lab/sim/scene_maker.h"
#include "lab/trials/calibration_table.h"
#include "lab/trials/map_calibration.h"
#include "lab/trials/mission_moments.h"
#include "lab/worlds/bundled_layouts.h"

namespace plumescout::lab {
namespace {

// [XIT] section VII.
constexpr double kAmbient_ppm = 400.0;
constexpr double kGasThreshold_ppm = 600.0;
constexpr double kDwell_s = 5.0;
constexpr double kSpeed_mps = 0.15;
constexpr double kReleasedBefore_s = 30.0;
constexpr double kPaperMinutes = 11.0;
constexpr double kPaperHighest_ppm = 2000.0;

// Ours. The sensor's readings count from here on: the last second of a stop.
constexpr double kSettling_s = 4.0;
// The mission ends by itself; if not, here.
constexpr double kDuration_s = 1200.0;
constexpr double kQuickDuration_s = 240.0;
// A TurtleBot3's.
constexpr double kMaxSpeed_mps = 0.22;
constexpr double kMaxTurn_rad_per_s = 2.8;
// Around a source: what is near it.
constexpr double kNearSource_m = 1.0;
constexpr double kSceneShare = 0.3;  // of the time that the study takes, for the progress line

SceneMakerOptions SceneOptions(const ExperimentOptions& options) {
  SceneMakerOptions scene;
  scene.seed = options.seed;
  scene.warm_up_s = kReleasedBefore_s;
  const double duration_s = options.quick ? kQuickDuration_s : kDuration_s;
  scene.frame_period_s = options.quick ? 2.0 : 0.5;
  scene.frames = static_cast<int>(duration_s / scene.frame_period_s);
  return scene;
}

absl::StatusOr<MissionOptions> MakeMissionOptions(std::uint64_t seed) {
  MissionOptions mission;
  mission.seed = seed;
  mission.occupancy = PublishedOccupancyOptions();
  mission.gas = PublishedGasOptions();
  mission.gas.background_mean_ppm = kAmbient_ppm;
  mission.gas.estimate_noise = false;
  mission.frontier.fixed_gas_threshold_ppm = kGasThreshold_ppm;
  mission.planning.strategy = "xit_gff";
  PLUMESCOUT_RETURN_IF_ERROR(ApplyStrategyRow(mission.planning));
  mission.planning.speed_mps = kSpeed_mps;
  mission.planning.dwell_s = kDwell_s;
  // As the paper has it: up to five goals, stops at the vertices of the tree, fallback goals drawn
  // at random, and a connection radius that follows Eq. (7) alone.
  mission.planning.draw_goals = true;
  mission.planning.straighten = false;
  mission.planning.fallback_to_unobserved = false;
  mission.planning.max_connection_radius_m = 0.0;
  return mission;
}

absl::StatusOr<EpisodeOptions> MakeEpisodeOptions(const ExperimentOptions& options) {
  EpisodeOptions episode;
  episode.mission = "xit-trial";
  PLUMESCOUT_ASSIGN_OR_RETURN(episode.create, MakeMissionOptions(options.seed));
  episode.duration_s = options.quick ? kQuickDuration_s : kDuration_s;
  episode.following = client::Following::kProportional;
  episode.gas_settling_s = kSettling_s;
  episode.simulated.max_forward_mps = kMaxSpeed_mps;
  episode.simulated.max_turn_rad_per_s = kMaxTurn_rad_per_s;
  episode.simulated.gas_sensor = CarbonDioxideCell();
  episode.simulated.seed = options.seed;
  return episode;
}

// Index of the source that is nearest.
std::size_t NearestSource(const Scene& scene, Point2 place) {
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < scene.sources.size(); ++i) {
    const auto distance_m = [&](std::size_t source) {
      return Distance_m(place, {scene.sources[source].x_m, scene.sources[source].y_m});
    };
    if (distance_m(i) < distance_m(nearest)) nearest = i;
  }
  return nearest;
}

// What a trajectory drives through: ppm m above ambient air.
double GasOnTheWay(const MissionMoment& moment) {
  const Candidate& chosen = Chosen(moment);
  return (chosen.mean_concentration_ppm - kAmbient_ppm) * chosen.length_m;
}

// The rows of Fig. 11: the first trajectory, at a frontier; the first to a gas frontier at the
// source found second; from then on, the one that drives through most gas. Indices of moments.
std::vector<std::size_t> ChooseRows(const Scene& scene, const std::vector<MissionMoment>& moments) {
  if (moments.empty()) return {};
  std::vector<std::size_t> gas;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    if (Chosen(moments[i]).goal.kind == GoalKind::kGasFrontier) gas.push_back(i);
  }
  std::vector<std::size_t> rows = {0};
  if (gas.empty()) return rows;
  const auto source_of = [&](std::size_t i) {
    return NearestSource(scene, Chosen(moments[i]).goal.position);
  };
  const auto second = std::find_if(gas.begin(), gas.end(), [&](std::size_t i) {
    return source_of(i) != source_of(gas.front());
  });
  rows.push_back(second != gas.end() ? *second : gas.front());
  std::size_t most = rows.back();
  for (std::size_t i = rows.back() + 1; i < moments.size(); ++i) {
    if (most == rows.back() || GasOnTheWay(moments[i]) > GasOnTheWay(moments[most])) most = i;
  }
  if (most != rows.back()) rows.push_back(most);
  return rows;
}

// Air that is blown: from where, and which way.
struct Jet {
  Point2 from;
  double direction_rad = 0.0;
  double speed_mps = 0.0;
};

std::vector<Jet> JetsOf(const Layout& layout) {
  std::vector<Jet> jets;
  for (const Fan& fan : layout.fans) {
    jets.push_back({fan.position, fan.direction_rad, fan.speed_mps});
  }
  return jets;
}

void AddArrow(const Jet& jet, MapPanel& panel) {
  constexpr double kSecondsLong = 1.2;
  constexpr double kHead_m = 0.12;
  constexpr double kHeadAngle_rad = 2.6;
  const auto ahead = [](Point2 from, double angle_rad, double length_m) {
    return Point2{from.x_m + length_m * std::cos(angle_rad),
                  from.y_m + length_m * std::sin(angle_rad)};
  };
  const Point2 tip = ahead(jet.from, jet.direction_rad, kSecondsLong * jet.speed_mps);
  const Stroke stroke{kPaper, 2.5};
  panel.lines.push_back({{jet.from, tip}, stroke});
  panel.lines.push_back({{ahead(tip, jet.direction_rad + kHeadAngle_rad, kHead_m), tip,
                          ahead(tip, jet.direction_rad - kHeadAngle_rad, kHead_m)},
                         stroke});
}

// Fig. 12.
MapPanel FinalPanel(const RecordedMission& mission, const Scene& scene, const Layout& layout) {
  const MapSnapshot& map = mission.map;
  double highest_ppm = kGasThreshold_ppm;
  for (const float ppm : map.gas_mean_ppm.values()) {
    if (std::isfinite(ppm)) highest_ppm = std::fmax(highest_ppm, ppm);
  }
  const ColorScale scale{ColorMap::kGas, kAmbient_ppm, highest_ppm, false};
  MapPanel panel;
  panel.title = "Final mean, sources and air (Fig. 12)";
  panel.region = RegionOf(scene.geometry());
  panel.cells = PaintCells(map.occupancy.geometry(), panel.region, [&](Cell cell) {
    const bool shown = map.occupancy[cell] == CellState::kFree;
    const float ppm = map.gas_mean_ppm.At(cell, std::numeric_limits<float>::quiet_NaN());
    return shown && std::isfinite(ppm) ? scale(ppm) : StateColor(map.occupancy[cell]);
  });
  for (const Jet& jet : JetsOf(layout)) AddArrow(jet, panel);
  for (std::size_t i = 0; i < scene.sources.size(); ++i) {
    panel.marks.push_back({MarkShape::kDisc,
                           kSourceColor,
                           {scene.sources[i].x_m, scene.sources[i].y_m},
                           absl::StrCat(i + 1)});
  }
  panel.color_bar = ColorBar{scale, "ppm"};
  panel.legend = {{"source", MarkShape::kDisc, kSourceColor},
                  {"white: air blown", MarkShape::kSwatch, kPaper}};
  return panel;
}

Chart ReadingsChart(const RecordedMission& mission) {
  Curve readings{"readings", {kLineColors[0], 1.8}, {}};
  for (const MissionReading& reading : mission.readings) {
    readings.points.push_back({reading.time_s, reading.concentration_ppm});
  }
  const double end_s = mission.episode.simulated_s;
  const Curve threshold{"threshold",
                        {kLineColors[1], 1.5, 5.0},
                        {{0.0, kGasThreshold_ppm}, {end_s, kGasThreshold_ppm}}};
  return {"Readings at stops, ppm", "time, s", std::nullopt, {readings, threshold}};
}

// Mean of the final estimate around every source, ppm.
std::vector<double> NearSources_ppm(const RecordedMission& mission, const Scene& scene) {
  const Grid<float>& mean = mission.map.gas_mean_ppm;
  std::vector<double> means;
  for (const GasSource& source : scene.sources) {
    double sum = 0.0;
    int cells = 0;
    for (std::size_t i = 0; i < mean.size(); ++i) {
      const Point2 center = mean.geometry().Center(mean.geometry().CellAtIndex(i));
      const bool near = Distance_m(center, {source.x_m, source.y_m}) <= kNearSource_m;
      if (!near || !std::isfinite(mean[i])) continue;
      sum += mean[i];
      ++cells;
    }
    means.push_back(cells > 0 ? sum / cells : std::numeric_limits<double>::quiet_NaN());
  }
  return means;
}

// Finite values of a raster.
double Highest(const Grid<float>& field) {
  double highest = 0.0;
  for (const float value : field.values()) {
    if (std::isfinite(value)) highest = std::fmax(highest, value);
  }
  return highest;
}

int StopsOf(const std::vector<MissionReading>& readings) {
  int stops = 0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (i == 0 || readings[i].time_s - readings[i - 1].time_s > kSettling_s) ++stops;
  }
  return stops;
}

double CountTo(const std::vector<MissionMoment>& moments, GoalKind kind) {
  const auto count = std::count_if(moments.begin(), moments.end(), [kind](const auto& moment) {
    return Chosen(moment).goal.kind == kind;
  });
  return static_cast<double>(count);
}

// What is not in large print.
void AddDetails(const RecordedMission& mission, const MapMetrics& end, Study& study) {
  auto& numbers = study.figures.key_numbers;
  const auto trajectories = [&](GoalKind kind) {
    return absl::StrFormat("%.0f", CountTo(mission.moments, kind));
  };
  numbers.emplace_back("RMSE (of clean air)",
                       absl::StrFormat("%.0f (%.0f) ppm", end.rmse_ppm, end.rmse_zero_ppm));
  numbers.emplace_back("trajectories to frontiers", trajectories(GoalKind::kOccupancyFrontier));
  numbers.emplace_back("trajectories to gas frontiers", trajectories(GoalKind::kGasFrontier));
  numbers.emplace_back("trajectories of the fallback", trajectories(GoalKind::kRandomFreeSpace));
  numbers.emplace_back("stops with readings", absl::StrCat(StopsOf(mission.readings)));
  numbers.emplace_back("readings", absl::StrCat(mission.readings.size()));
  numbers.emplace_back("driven", absl::StrFormat("%.1f m", mission.episode.distance_m));
  numbers.emplace_back("collisions", absl::StrCat(mission.episode.collisions));
  numbers.emplace_back("map complete", absl::StrFormat("%.1f %%", 100.0 * end.completeness));
  numbers.emplace_back("entropy", absl::StrFormat("%.0f nats", end.entropy_nats));
}

void AddNumbers(const RecordedMission& mission, const SceneWorld& world, Study& study) {
  constexpr double kSecondsPerMinute = 60.0;
  const EpisodeResult& episode = mission.episode;
  const MapMetrics& end = episode.samples.back().metrics;
  const std::vector<double> near_ppm = NearSources_ppm(mission, world.scene());
  const double minutes = episode.simulated_s / kSecondsPerMinute;
  const double highest_ppm = Highest(mission.map.gas_mean_ppm);
  study.figures.key_numbers = {
      {"duration (paper: about 11 min)", absl::StrFormat("%.1f min", minutes)},
      {"ended by itself (paper: yes)", episode.completed ? "yes" : "no"},
      {"greatest estimate (paper: > 2000)", absl::StrFormat("%.0f ppm", highest_ppm)},
      {"near source 1, left (within 1 m)", absl::StrFormat("%.0f ppm", near_ppm.front())},
      {"near source 2, right (paper: more)", absl::StrFormat("%.0f ppm", near_ppm.back())}};
  study.summary.figures = {
      {"duration_min", minutes},
      {"paper_duration_min", kPaperMinutes},
      {"mission_complete", episode.completed ? 1.0 : 0.0},
      {"highest_estimate_ppm", highest_ppm},
      {"paper_highest_estimate_above_ppm", kPaperHighest_ppm},
      {"near_source_1_ppm", near_ppm.front()},
      {"near_source_2_ppm", near_ppm.back()},
      {"trajectories_exploring", CountTo(mission.moments, GoalKind::kOccupancyFrontier)},
      {"trajectories_gas", CountTo(mission.moments, GoalKind::kGasFrontier)},
      {"trajectories_fallback", CountTo(mission.moments, GoalKind::kRandomFreeSpace)},
      {"stops", static_cast<double>(StopsOf(mission.readings))},
      {"readings", static_cast<double>(mission.readings.size())},
      {"distance_m", episode.distance_m},
      {"collisions", static_cast<double>(episode.collisions)},
      {"completeness", end.completeness},
      {"rmse_ppm", end.rmse_ppm},
      {"rmse_clean_air_ppm", end.rmse_zero_ppm},
      {"entropy_nats", end.entropy_nats}};
  AddDetails(mission, end, study);
}

std::vector<std::string> MakeNotes() {
  return {
      "The paper (section VII, Fig. 11 and 12) tells of one run of a TurtleBot3 in an arena of 5.0 "
      "m "
      "x 3.7 m with two sources of carbon dioxide and three fans: stops of 5 s at every vertex, "
      "0.15 m/s, gas from 600 ppm on, ambient 400 ppm, about eleven minutes until two trajectories "
      "in a row had revealed nothing. It explored first, probed the gas around one source, then "
      "around the other, and drove through both in the end; the final map exceeded 2000 ppm and "
      "was "
      "higher on the right, towards which the stronger fans blow.",
      "Ours: the same arena, speed, stops, threshold and policy in simulation. Positions, rates, "
      "air speeds and the barriers inside are not in the paper and are ours; so is the sensor (lag "
      "4 s, noise 10 ppm and 1 %, steps of 10 ppm): its readings count after 4 s of standing, the "
      "lag undone from the beginning of the stop. Critical cells, on which RMSE and entropy are "
      "taken, are those above 600 ppm on average.",
      "The rule that ends it is the paper's, and it is a gamble: a robot whose fallback "
      "trajectories "
      "twice in a row meet nothing new is done, whether or not it came upon the gas of both "
      "sources. That depends on the seed.",
      "Rows of Fig. 11 from left to right, each as map and UCB field: exploring; probing gas at "
      "the second "
      "source; late, through most gas. Red: frontiers, yellow: gas frontiers, purple: the "
      "trajectory, green: the robot; dotted: the way so far."};
}

std::vector<MapPanel> MakePanels(const RecordedMission& mission, const SceneWorld& world,
                                 const Layout& layout) {
  const MomentStyle style{RegionOf(world.scene().geometry()), kAmbient_ppm};
  std::vector<MapPanel> panels;
  for (const std::size_t row : ChooseRows(world.scene(), mission.moments)) {
    const MissionMoment& moment = mission.moments[row];
    panels.push_back(MomentPanel(
        mission, moment, absl::StrFormat("%.0f s: mean and frontiers", moment.time_s), style));
    panels.push_back(MomentFieldPanel(
        moment, absl::StrFormat("%.0f s: UCB field and paths", moment.time_s), style));
  }
  panels.push_back(FinalPanel(mission, world.scene(), layout));
  panels.push_back(TrueMeanPanel(world, "True mean"));
  return panels;
}

}  // namespace

absl::StatusOr<Study> RunXitTrial(const ExperimentOptions& options) {
  const auto report = [&](double share) {
    if (options.progress) options.progress(share);
  };
  PLUMESCOUT_ASSIGN_OR_RETURN(const Layout layout, BundledLayout("co2_trial"));
  PLUMESCOUT_ASSIGN_OR_RETURN(
      Scene scene, MakeScene(layout, SceneOptions(options), [&](absl::string_view, double share) {
        report(kSceneShare * share);
      }));
  const SceneWorld world(std::move(scene), {.ambient_ppm = kAmbient_ppm});
  PLUMESCOUT_ASSIGN_OR_RETURN(const EpisodeOptions episode, MakeEpisodeOptions(options));
  PLUMESCOUT_ASSIGN_OR_RETURN(const RecordedMission mission,
                              RecordMission(world, episode, [&](double share) {
                                report(kSceneShare + (1.0 - kSceneShare) * share);
                              }));

  Study study;
  study.figures.title = "The trial with carbon dioxide ([XIT] section VII, Fig. 11 and 12)";
  study.figures.notes = MakeNotes();
  study.figures.panels = MakePanels(mission, world, layout);
  study.figures.charts = MetricCharts(mission.episode);
  study.figures.charts.back() = ReadingsChart(mission);  // entropy is in the table
  study.table = {{"time_s", "completeness", "rmse_ppm", "rmse_clean_air_ppm", "entropy_nats"},
                 MetricRows(mission.episode)};
  AddNumbers(mission, world, study);
  AddCalibration(Calibrate(world.scene(), mission.map.gas_mean_ppm, mission.map.gas_variance_ppm2,
                           world.ambient_ppm()),
                 study);
  study.summary.about = AboutThisRun(options.seed);
  return study;
}

}  // namespace plumescout::lab
