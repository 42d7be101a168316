// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/xit_fig4.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/plan/cost/edge_cost.h"
#include "core/plan/paths/xit.h"
#include "core/types/rng.h"
#include "lab/about/about.h"
#include "lab/report/palette.h"
#include "lab/worlds/grid_oracle.h"
#include "lab/worlds/synthetic_scene.h"

namespace plumescout::lab {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr int kRuns = 10;
constexpr int kQuickRuns = 3;
constexpr int kShownSamples = 300;  // of the trajectories in the pictures, as in the paper
constexpr int kConnectivity = 32;
constexpr double kAlpha_per_m = 0.0;  // our default
constexpr SamplingKind kSamplings[] = {SamplingKind::kIid, SamplingKind::kSystematic};

const char* NameOf(SamplingKind sampling) {
  return sampling == SamplingKind::kIid ? "iid" : "systematic";
}

std::vector<int> SampleCounts(bool quick) {
  if (quick) return {50, kShownSamples, 1500};
  return {50, 75, 100, 150, 200, kShownSamples, 500, 750, 1000, 1500, 2000, 3000};
}

// Prices of one scene at one N, over the oracle's.
struct Spread {
  int samples = 0;
  SamplingKind sampling = SamplingKind::kIid;
  int runs = 0;
  std::vector<double> ratios;  // of the runs that found a path

  double mean() const {
    double sum = 0.0;
    for (const double ratio : ratios) sum += ratio;
    return ratios.empty() ? kNan : sum / static_cast<double>(ratios.size());
  }
  // Of the sample; not measured with fewer than two.
  double stddev() const {
    if (ratios.size() < 2) return kNan;
    double squares = 0.0;
    for (const double ratio : ratios) squares += (ratio - mean()) * (ratio - mean());
    return std::sqrt(squares / static_cast<double>(ratios.size() - 1));
  }
};

struct SceneStudy {
  SyntheticScene scene;
  std::vector<Spread> spreads;                    // by sampling, then N
  std::vector<std::vector<Point2>> trajectories;  // of kIid at kShownSamples
};

// One search; none if there was no path.
std::optional<FoundPath> Search(const SyntheticScene& scene, const Spread& spread,
                                std::uint64_t seed) {
  PlanningOptions options;
  options.sample_count = spread.samples;
  options.sampling = spread.sampling;
  const EdgeCost cost(scene.information, CostKind::kUcb, kAlpha_per_m);
  const std::vector<Goal> goals = {scene.goal};
  const StopFn stop = NeverStop();
  return XitPlanner(options)
      .FindPaths({cost, scene.reachable, scene.start, goals, seed, 0, stop})
      .paths.front();
}

double OracleCost(const SyntheticScene& scene) {
  const EdgeCost cost(scene.information, CostKind::kUcb, kAlpha_per_m);
  const Cell start = scene.occupancy.geometry().CellAt(scene.start);
  return OracleCosts(cost, start, kConnectivity)[scene.goal.cell];
}

// Counts searches by what they cost, which grows with N.
class Progress {
 public:
  Progress(const ExperimentOptions& options, std::size_t scenes) : tell_(options.progress) {
    for (const int samples : SampleCounts(options.quick)) total_ += samples;
    total_ *= static_cast<double>(scenes * std::size(kSamplings));
  }
  void Add(int samples) {
    done_ += samples;
    if (tell_) tell_(std::min(1.0, done_ / total_));
  }

 private:
  std::function<void(double)> tell_;
  double total_ = 0.0;
  double done_ = 0.0;
};

SceneStudy StudyScene(const SceneSpec& spec, const ExperimentOptions& options, Progress& progress) {
  SceneStudy study{BuildScene(spec), {}, {}};
  const double oracle = OracleCost(study.scene);
  const int runs = options.quick ? kQuickRuns : kRuns;
  for (const SamplingKind sampling : kSamplings) {
    Rng seeds(options.seed);  // both kinds of sampling get the same
    for (const int samples : SampleCounts(options.quick)) {
      Spread spread{samples, sampling, runs, {}};
      for (int run = 0; run < runs; ++run) {
        const std::optional<FoundPath> path = Search(study.scene, spread, seeds.Next());
        if (!path) continue;
        spread.ratios.push_back(path->cost / oracle);
        if (samples == kShownSamples && sampling == SamplingKind::kIid) {
          study.trajectories.push_back(path->vertices);
        }
      }
      study.spreads.push_back(std::move(spread));
      progress.Add(samples);
    }
  }
  return study;
}

// All runs thin, the first thick.
MapPanel MakePanel(const SceneStudy& study) {
  MapPanel panel = MakeScenePanel(study.scene);
  panel.title = absl::StrCat(study.scene.name, ": XIT at N = ", kShownSamples);
  for (const std::vector<Point2>& path : study.trajectories) {
    panel.lines.push_back({path, {kPaper, 1.0}});
  }
  if (!study.trajectories.empty()) {
    AddPath(study.trajectories.front(), {kSourceColor, 3.5}, panel);
    panel.legend.push_back({"one run, others white", MarkShape::kLine, kSourceColor});
  }
  return panel;
}

Chart MakeChart(const SceneStudy& study) {
  const Stroke band{kLineColors[0], 1.0, 3.0};
  Curve mean{"iid ± sd", {kLineColors[0], 2.2}, {}};
  Curve low{"", band, {}};
  Curve high{"", band, {}};
  Curve systematic{"systematic", {kLineColors[1], 1.8}, {}};
  for (const Spread& spread : study.spreads) {
    const double n = spread.samples;
    if (spread.sampling == SamplingKind::kSystematic) {
      systematic.points.push_back({n, spread.mean()});
      continue;
    }
    mean.points.push_back({n, spread.mean()});
    low.points.push_back({n, spread.mean() - spread.stddev()});
    high.points.push_back({n, spread.mean() + spread.stddev()});
  }
  const double last = study.spreads.back().samples;
  const Curve oracle{"", {kFaintInk, 1.0}, {{0.0, 1.0}, {last, 1.0}}};
  return {study.scene.name + ": price / oracle",
          "samples N",
          std::nullopt,
          {oracle, low, high, mean, systematic}};
}

void AddRows(double scene_number, const SceneStudy& study, CsvTable& table) {
  for (const Spread& spread : study.spreads) {
    const auto [least, greatest] = std::minmax_element(spread.ratios.begin(), spread.ratios.end());
    const bool any = !spread.ratios.empty();
    table.rows.push_back({scene_number, spread.sampling == SamplingKind::kIid ? 0.0 : 1.0,
                          static_cast<double>(spread.samples), static_cast<double>(spread.runs),
                          static_cast<double>(spread.ratios.size()), spread.mean(), spread.stddev(),
                          any ? *least : kNan, any ? *greatest : kNan});
  }
}

void AddFigures(const SceneStudy& study, Summary& summary) {
  for (const Spread& spread : study.spreads) {
    const std::string name =
        absl::StrFormat("%s_%s_n%d", study.scene.name, NameOf(spread.sampling), spread.samples);
    summary.figures.emplace_back(name + "_mean_over_oracle", spread.mean());
    summary.figures.emplace_back(name + "_stddev_over_oracle", spread.stddev());
    summary.figures.emplace_back(name + "_found", static_cast<double>(spread.ratios.size()));
  }
}

std::string Text(const Spread& spread) {
  if (spread.ratios.empty()) return "no path";
  if (spread.ratios.size() == 1) return absl::StrFormat("%.3f, one path", spread.mean());
  return absl::StrFormat("%.3f ± %.3f", spread.mean(), spread.stddev());
}

// The means at the samples of the pictures and at the most of one kind of sampling.
void AddMeans(const SceneStudy& study, SamplingKind sampling, ReportFigures& figures) {
  const int most = study.spreads.back().samples;
  for (const Spread& spread : study.spreads) {
    const bool shown = spread.samples == kShownSamples || spread.samples == most;
    if (!shown || spread.sampling != sampling) continue;
    figures.key_numbers.emplace_back(
        absl::StrFormat("%s, %s, N = %d", study.scene.name, NameOf(sampling), spread.samples),
        Text(spread));
  }
}

// How many searches found a path at the samples of the pictures.
void AddFound(const SceneStudy& study, ReportFigures& figures) {
  for (const Spread& spread : study.spreads) {
    if (spread.samples != kShownSamples) continue;
    figures.key_numbers.emplace_back(
        absl::StrFormat("%s, %s, N = %d: paths found", study.scene.name, NameOf(spread.sampling),
                        spread.samples),
        absl::StrFormat("%d of %d", spread.ratios.size(), spread.runs));
  }
}

// Least and greatest mean over the scenes at the most samples.
Range LastMeans(const std::vector<SceneStudy>& studies, SamplingKind sampling) {
  Range means{std::numeric_limits<double>::infinity(), 0.0};
  for (const SceneStudy& study : studies) {
    for (const Spread& spread : study.spreads) {
      if (spread.sampling != sampling || spread.samples != study.spreads.back().samples) continue;
      means = {std::min(means.low, spread.mean()), std::max(means.high, spread.mean())};
    }
  }
  return means;
}

// Searches that found a path at the samples of the pictures.
int Found(const std::vector<SceneStudy>& studies, SamplingKind sampling) {
  std::size_t found = 0;
  for (const SceneStudy& study : studies) {
    for (const Spread& spread : study.spreads) {
      const bool shown = spread.samples == kShownSamples && spread.sampling == sampling;
      if (shown) found += spread.ratios.size();
    }
  }
  return static_cast<int>(found);
}

std::vector<std::string> MakeNotes(const std::vector<SceneStudy>& studies) {
  const Spread& last = studies.front().spreads.back();
  const Range iid = LastMeans(studies, SamplingKind::kIid);
  const Range systematic = LastMeans(studies, SamplingKind::kSystematic);
  const int runs = last.runs * static_cast<int>(studies.size());
  return {
      "The paper (Fig. 4) shows trajectories at N = 300 in three synthetic scenes and how the "
      "cost converges with the number of samples N, averaged over ten runs. Scenes and costs "
      "are printed as pictures only, without a reference to compare the limit with.",
      absl::StrFormat(
          "Ours: three other scenes, %d runs for each N, the bare tree of XIT (no "
          "straightening, no grid guard), alpha = 0. Prices are divided by that of Dijkstra's "
          "search in 32 directions between the centres of all cells, the grey line at 1; edges "
          "of XIT have any direction, so less than 1 is possible. iid: samples drawn one by "
          "one, as in the paper, dashed: one standard deviation; systematic: ours, spread "
          "evenly over the same density.",
          last.runs),
      absl::StrFormat(
          "It converges here too: at N = %d the means of the scenes are %.3f to %.3f with iid "
          "and %.3f to %.3f with systematic samples. But at N = %d only %d of %d iid searches "
          "and %d of %d systematic ones found a path at all, for most samples lie where the gas "
          "is; that is what the grid guard of our planner is for. Curves are means of the runs "
          "that found one, so they need not begin at their highest.",
          last.samples, iid.low, iid.high, systematic.low, systematic.high, kShownSamples,
          Found(studies, SamplingKind::kIid), runs, Found(studies, SamplingKind::kSystematic),
          runs)};
}

}  // namespace

absl::StatusOr<Study> RunXitFig4(const ExperimentOptions& options) {
  const std::vector<SceneSpec> specs = ConvergenceScenes();
  Progress progress(options, specs.size());
  std::vector<SceneStudy> studies;
  for (const SceneSpec& spec : specs) studies.push_back(StudyScene(spec, options, progress));

  Study result;
  result.figures.title = "Convergence with the number of samples ([XIT] Fig. 4)";
  result.figures.notes = MakeNotes(studies);
  result.table.columns = {"scene",
                          "systematic",
                          "samples",
                          "runs",
                          "found",
                          "mean_over_oracle",
                          "stddev_over_oracle",
                          "least_over_oracle",
                          "greatest_over_oracle"};
  for (std::size_t i = 0; i < studies.size(); ++i) {
    result.figures.panels.push_back(MakePanel(studies[i]));
    result.figures.charts.push_back(MakeChart(studies[i]));
    AddRows(static_cast<double>(i + 1), studies[i], result.table);
    AddFigures(studies[i], result.summary);
  }
  for (const SamplingKind sampling : kSamplings) {
    for (const SceneStudy& study : studies) AddMeans(study, sampling, result.figures);
  }
  for (const SceneStudy& study : studies) AddFound(study, result.figures);
  result.summary.about = AboutThisRun(options.seed);
  return result;
}

}  // namespace plumescout::lab
