// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/mission_moments.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include "absl/time/time.h"
#include "core/types/status_macros.h"
#include "lab/local/local_planner_client.h"
#include "lab/report/figures.h"
#include "lab/report/palette.h"
#include "lab/trials/study.h"
#include "ompl_planners/ompl_planner.h"

namespace plumescout::lab {
namespace {

constexpr Rgb kTrajectoryColor{142, 68, 173};
constexpr Rgb kTooNearColor{150, 156, 168};
constexpr Stroke kTrajectory{kTrajectoryColor, 4.5};
constexpr Stroke kCandidate{kPaper, 1.5};
constexpr Stroke kDriven{kPaper, 1.2, 3.0};
constexpr double kRim_px = 2.5;

// A line with a white rim, which sets it off any ground.
void AddRimmed(const std::vector<Point2>& points, const Stroke& stroke, MapPanel& panel) {
  panel.lines.push_back({points, {kPaper, stroke.width_px + kRim_px}});
  panel.lines.push_back({points, stroke});
}

void AddTrajectory(const MissionMoment& moment, MapPanel& panel) {
  const std::vector<Point2>& path = Chosen(moment).path;
  AddRimmed(path, kTrajectory, panel);
  panel.marks.push_back({MarkShape::kDisc, kStartColor, path.front()});
}

// Greatest estimate above clean air, no less than what counts as gas at all: [XIT] Eq. (9).
double Span_ppm(const Belief& belief, double clean_air_ppm) {
  const FrontierOptions& frontier = belief.options->frontier;
  double span_ppm = frontier.min_gas_threshold_ppm;
  if (frontier.fixed_gas_threshold_ppm)
    span_ppm = *frontier.fixed_gas_threshold_ppm - clean_air_ppm;
  for (const float mean_ppm : belief.gas_mean_ppm->values()) {
    if (std::isfinite(mean_ppm)) span_ppm = std::max(span_ppm, double{mean_ppm} - clean_air_ppm);
  }
  return span_ppm;
}

Grid<Rgb> PaintMean(const Belief& belief, const ColorScale& scale) {
  Grid<Rgb> colors(belief.geometry());
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const float mean_ppm = (*belief.gas_mean_ppm)[i];
    const bool shown = (*belief.occupancy)[i] == CellState::kFree && std::isfinite(mean_ppm);
    colors[i] = shown ? scale(mean_ppm) : StateColor((*belief.occupancy)[i]);
  }
  for (const Frontier& frontier : MakeMapSnapshot(belief).frontiers) {
    const bool gas = frontier.kind == FrontierKind::kGas;
    for (const Cell cell : frontier.cells) {
      if (!belief.geometry().Contains(cell)) continue;
      colors[cell] = gas ? kGasFrontierColor : kOccupancyFrontierColor;
    }
  }
  return colors;
}

std::optional<MissionReading> ReadingOf(const Event& event, std::int64_t start_ns) {
  const auto* received = std::get_if<ObservationReceived>(&event.body);
  if (received == nullptr) return std::nullopt;
  const Observation& observation = received->observation;
  const auto* reading = std::get_if<GasReading>(&observation.payload);
  if (reading == nullptr) return std::nullopt;
  constexpr double kNanosecondsPerSecond = 1e9;
  return MissionReading{
      static_cast<double>(observation.sample_time_ns - start_ns) / kNanosecondsPerSecond,
      observation.pose.position(), reading->concentration_ppm};
}

}  // namespace

absl::StatusOr<RecordedMission> RecordMission(const SceneWorld& world, EpisodeOptions options,
                                              const std::function<void(double)>& progress) {
  RecordedMission mission;
  LocalOptions local;
  local.path_planners = MakeOmplPlanner;
  const std::int64_t start_ns = options.simulated.start_time_ns;
  local.on_event = [&mission, start_ns](const Event& event) {
    if (const auto reading = ReadingOf(event, start_ns)) mission.readings.push_back(*reading);
  };
  LocalPlannerClient planner(local);
  options.plan_budget = absl::InfiniteDuration();
  options.end_margin_m = kStudiedEndMargin_m;
  options.on_plan = [&](const IssuedPlan& issued) {
    const auto belief = planner.GetBelief(options.mission);
    if (!belief.ok() || issued.plan.chosen < 0) return;
    mission.moments.push_back({issued.time_s, issued.plan, *belief});
  };
  options.on_sample = [&](const MetricSample& sample, const MapSnapshot&) {
    if (progress) progress(std::min(1.0, sample.time_s / options.duration_s));
  };
  PLUMESCOUT_ASSIGN_OR_RETURN(mission.episode, RunEpisode(planner, world, options));
  PLUMESCOUT_ASSIGN_OR_RETURN(mission.map, planner.GetMap(options.mission));
  return mission;
}

const Candidate& Chosen(const MissionMoment& moment) {
  return moment.plan.candidates[static_cast<std::size_t>(moment.plan.chosen)];
}

std::vector<Point2> DrivenUntil(const RecordedMission& mission, double time_s) {
  std::vector<Point2> driven;
  for (const DrivenPose& at : mission.episode.path) {
    if (at.time_s > time_s) break;
    driven.push_back(at.pose.position());
  }
  return driven;
}

InformationMap InformationOf(const MissionMoment& moment) {
  const Belief& belief = *moment.belief;
  const MissionOptions& options = *belief.options;
  return MakeInformationMap({*belief.traversable, *belief.gas_mean_ppm, *belief.gas_variance_ppm2,
                             options.gas, options.frontier},
                            options.planning);
}

MapPanel MomentPanel(const RecordedMission& mission, const MissionMoment& moment,
                     const std::string& title, const MomentStyle& style) {
  const Belief& belief = *moment.belief;
  const ColorScale scale{ColorMap::kGas, style.clean_air_ppm,
                         style.clean_air_ppm + Span_ppm(belief, style.clean_air_ppm), false};
  const Grid<Rgb> colors = PaintMean(belief, scale);
  MapPanel panel;
  panel.title = title;
  panel.region = style.region;
  panel.cells =
      PaintCells(belief.geometry(), style.region, [&](Cell cell) { return colors[cell]; });
  panel.lines.push_back({DrivenUntil(mission, moment.time_s), kDriven});
  AddTrajectory(moment, panel);
  panel.color_bar = ColorBar{scale, "ppm"};
  panel.legend = {{"trajectory", MarkShape::kLine, kTrajectoryColor},
                  {"frontier", MarkShape::kSwatch, kOccupancyFrontierColor},
                  {"gas frontier", MarkShape::kSwatch, kGasFrontierColor}};
  return panel;
}

MapPanel MomentFieldPanel(const MissionMoment& moment, const std::string& title,
                          const MomentStyle& style) {
  const ColorScale scale{ColorMap::kGas, 0.0, 1.0, false};
  const Belief& belief = *moment.belief;
  const InformationMap information = InformationOf(moment);
  MapPanel panel;
  panel.title = title;
  panel.region = style.region;
  panel.cells = PaintCells(belief.geometry(), style.region, [&](Cell cell) {
    const CellState state = (*belief.occupancy)[cell];
    if (state != CellState::kFree) return StateColor(state);
    return (*belief.traversable)[cell] != 0 ? scale(information.value[cell]) : kTooNearColor;
  });
  for (const Candidate& candidate : moment.plan.candidates) {
    panel.lines.push_back({candidate.path, kCandidate});
  }
  AddTrajectory(moment, panel);
  panel.color_bar = ColorBar{scale, "UCB"};
  panel.legend = {{"trajectory", MarkShape::kLine, kTrajectoryColor},
                  {"white: others", MarkShape::kSwatch, kPaper},
                  {"too near to drive", MarkShape::kSwatch, kTooNearColor}};
  return panel;
}

MapPanel TrueMeanPanel(const SceneWorld& world, const std::string& title) {
  const Scene& scene = world.scene();
  constexpr double kDecades = 1e-3;  // of the greatest concentration: where its colours begin
  double highest_ppm = scene.critical_threshold_ppm;
  for (const float ppm : scene.conc_mean_ppm.values()) highest_ppm = std::fmax(highest_ppm, ppm);
  const double clean_ppm = world.ambient_ppm();
  const ColorScale scale =
      clean_ppm > 0.0 ? ColorScale{ColorMap::kGas, clean_ppm, clean_ppm + highest_ppm, false}
                      : ColorScale{ColorMap::kGas, kDecades * highest_ppm, highest_ppm, true};
  MapPanel panel;
  panel.title = title;
  panel.region = RegionOf(scene.geometry());
  panel.cells = PaintCells(scene.geometry(), panel.region, [&](Cell cell) {
    const bool free = scene.occupancy[cell] == CellState::kFree;
    return free ? scale(clean_ppm + scene.conc_mean_ppm[cell]) : kWallColor;
  });
  for (const GasSource& source : scene.sources) {
    panel.marks.push_back({MarkShape::kCross, kSourceColor, {source.x_m, source.y_m}});
  }
  panel.color_bar = ColorBar{scale, "ppm"};
  panel.legend = {{"source", MarkShape::kCross, kSourceColor}};
  return panel;
}

std::vector<Chart> MetricCharts(const EpisodeResult& episode) {
  ReportData data;
  for (const MetricSample& sample : episode.samples) {
    const MapMetrics& m = sample.metrics;
    data.metrics.push_back(
        {sample.time_s, m.completeness, m.rmse_ppm, m.rmse_zero_ppm, m.entropy_nats});
  }
  return MakeCharts(data);
}

std::vector<std::vector<double>> MetricRows(const EpisodeResult& episode) {
  std::vector<std::vector<double>> rows;
  for (const MetricSample& sample : episode.samples) {
    const MapMetrics& m = sample.metrics;
    rows.push_back({sample.time_s, m.completeness, m.rmse_ppm, m.rmse_zero_ppm, m.entropy_nats});
  }
  return rows;
}

}  // namespace plumescout::lab
