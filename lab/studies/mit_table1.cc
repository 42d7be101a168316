// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/mit_table1.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "lab/about/about.h"
#include "lab/report/bar_chart.h"
#include "lab/report/palette.h"
#include "lab/trials/mit_pictures.h"
#include "lab/trials/mit_runs.h"
#include "lab/trials/statistics.h"
#include "lab/worlds/mit_scene.h"

namespace plumescout::lab {
namespace {

constexpr int kRuns = 250;  // [MIT] section IV
constexpr int kQuickRuns = 40;
constexpr int kQuickVariantRuns = 10;
constexpr std::size_t kInformative = 2;  // trajectory 3
constexpr double kPercent = 100.0;
// Places in the list of rivals.
constexpr std::size_t kMit = 0;
constexpr std::size_t kRrt = 1;
constexpr std::size_t kRrtStar = 2;
constexpr std::size_t kEvenMit = 3;
constexpr std::size_t kNormalisedMit = 4;
constexpr double kRivals = 5.0;

// What became of one scene.
struct SceneResult {
  MitScene scene;
  std::vector<std::vector<MitRun>> runs;  // by rival
  std::vector<MitSummary> summaries;      // likewise
};

struct TableStudy {
  std::vector<MitRival> rivals;
  std::vector<SceneResult> scenes;  // that of the table first, the narrow passage last

  const MitSummary& table(std::size_t rival) const { return scenes.front().summaries[rival]; }
  const SceneResult& passage() const { return scenes.back(); }
};

TableStudy RunAll(const ExperimentOptions& options) {
  TableStudy study;
  std::vector<MitSceneSpec> specs = MitSceneVariants();
  specs.insert(specs.begin(), MitTableScene());
  specs.push_back(MitPassageScene());
  const int variant_runs = options.quick ? kQuickVariantRuns : kRuns;
  const int table_runs = options.quick ? kQuickRuns : kRuns;
  const double total =
      kRivals * (2.0 * table_runs + variant_runs * static_cast<double>(specs.size() - 2));
  int finished = 0;
  const auto done = [&] {
    ++finished;
    if (options.progress) options.progress(finished / total);
  };
  for (const MitSceneSpec& spec : specs) {
    SceneResult result{*BuildMitScene(spec), {}, {}};  // ours, all of which can be built
    const bool is_variant = !study.scenes.empty() && &spec != &specs.back();
    const int runs = is_variant ? variant_runs : table_runs;
    study.rivals = MitRivals(result.scene);
    for (const MitRival& rival : study.rivals) {
      result.runs.push_back(RunMitRival(rival, result.scene, runs, options.seed, done));
      result.summaries.push_back(Summarise(result.runs.back()));
    }
    study.scenes.push_back(std::move(result));
  }
  return study;
}

Rgb RivalColor(std::size_t rival) { return kLineColors[rival]; }

// Fig. 2c: mean UCB by trajectory, with twice its standard error.
BarChart PsiChart(const TableStudy& study) {
  BarChart chart{"Mean UCB of a path (Fig. 2c)", "trajectory", {"1", "2", "3"}, {}, ""};
  for (std::size_t r = 0; r < study.rivals.size(); ++r) {
    BarSeries series{study.rivals[r].name, RivalColor(r), {}};
    for (std::size_t t = 0; t < kTrajectories; ++t) {
      const MitSummary& summary = study.table(r);
      std::vector<double> psi;
      for (const MitRun& run : study.scenes.front().runs[r]) {
        if (!run.paths[t].empty()) psi.push_back(run.psi[t]);
      }
      const double error = 2.0 * SpreadOf(psi).stddev /
                           std::sqrt(static_cast<double>(std::max<std::size_t>(1, psi.size())));
      series.bars.push_back({summary.psi[t], summary.psi[t] - error, summary.psi[t] + error});
    }
    chart.series.push_back(std::move(series));
  }
  return chart;
}

// Table I.
BarChart ShareChart(const TableStudy& study) {
  BarChart chart{
      "Share of runs, % (Table I)", "most informative trajectory", {"1", "2", "3"}, {}, "paper"};
  for (std::size_t r = 0; r < study.rivals.size(); ++r) {
    BarSeries series{study.rivals[r].name, RivalColor(r), {}};
    for (std::size_t t = 0; t < kTrajectories; ++t) {
      const MitSummary& summary = study.table(r);
      const ShareInterval interval = WilsonInterval(summary.best[t], summary.runs);
      series.bars.push_back({kPercent * summary.share(t), kPercent * interval.low,
                             kPercent * interval.high, study.rivals[r].paper_shares_percent[t]});
    }
    chart.series.push_back(std::move(series));
  }
  return chart;
}

BarChart VariantChart(const TableStudy& study) {
  BarChart chart{"Share that finds 3 best, by scene, %", "scene (see key numbers)", {}, {}, ""};
  for (std::size_t i = 0; i < study.scenes.size(); ++i) chart.groups.push_back(absl::StrCat(i));
  for (std::size_t r = 0; r < study.rivals.size(); ++r) {
    BarSeries series{study.rivals[r].name, RivalColor(r), {}};
    for (const SceneResult& scene : study.scenes) {
      series.bars.push_back({kPercent * scene.summaries[r].share(kInformative)});
    }
    chart.series.push_back(std::move(series));
  }
  return chart;
}

// In how many scenes the first rival is ahead of the second by `value`.
template <typename Value>
int ScenesAhead(const TableStudy& study, std::size_t first, std::size_t second, Value&& value) {
  return static_cast<int>(
      std::count_if(study.scenes.begin(), study.scenes.end(), [&](const SceneResult& scene) {
        return value(scene.summaries[first]) > value(scene.summaries[second]);
      }));
}

double InformativeShare(const MitSummary& summary) { return summary.share(kInformative); }
double ChosenPsi(const MitSummary& summary) { return summary.chosen_psi; }

// The bar that the table is to reach.
int ScenesOverBar(const TableStudy& study) {
  constexpr double kLeastShare = 0.55;
  constexpr double kLeastLead = 0.15;
  return static_cast<int>(
      std::count_if(study.scenes.begin(), study.scenes.end(), [&](const SceneResult& scene) {
        const double mit = InformativeShare(scene.summaries[kMit]);
        return mit >= kLeastShare &&
               mit - InformativeShare(scene.summaries[kRrtStar]) >= kLeastLead;
      }));
}

std::string ShareText(const MitRival& rival, const MitSummary& summary, std::size_t trajectory) {
  const ShareInterval interval = WilsonInterval(summary.best[trajectory], summary.runs);
  std::string text = absl::StrFormat("%.1f %% (%.1f to %.1f)", kPercent * summary.share(trajectory),
                                     kPercent * interval.low, kPercent * interval.high);
  const double paper = rival.paper_shares_percent[trajectory];
  if (std::isfinite(paper)) absl::StrAppend(&text, absl::StrFormat(", paper %.1f", paper));
  return text;
}

void AddHeadline(const TableStudy& study, ReportFigures& figures) {
  for (std::size_t r = 0; r <= kRrtStar; ++r) {
    figures.key_numbers.emplace_back(
        absl::StrFormat("%s: 3 is best, %% (paper %.1f)", study.rivals[r].name,
                        study.rivals[r].paper_shares_percent[kInformative]),
        absl::StrFormat("%.1f", kPercent * InformativeShare(study.table(r))));
  }
  figures.key_numbers.emplace_back(
      "MIT over RRT*, points (paper 29.2)",
      absl::StrFormat("%+.1f", kPercent * (InformativeShare(study.table(kMit)) -
                                           InformativeShare(study.table(kRrtStar)))));
  figures.key_numbers.emplace_back(
      "scenes with MIT ahead of RRT*",
      absl::StrFormat("%d of %d", ScenesAhead(study, kMit, kRrtStar, InformativeShare),
                      study.scenes.size()));
  figures.key_numbers.emplace_back(
      "narrow passage: UCB of the path chosen, MIT, even draw, RRT*",
      absl::StrFormat("%.2f, %.2f, %.2f", ChosenPsi(study.passage().summaries[kMit]),
                      ChosenPsi(study.passage().summaries[kEvenMit]),
                      ChosenPsi(study.passage().summaries[kRrtStar])));
  figures.key_numbers.emplace_back(
      "UCB of the path chosen, MIT / RRT*",
      absl::StrFormat("%.3f", ChosenPsi(study.table(kMit)) / ChosenPsi(study.table(kRrtStar))));
}

void AddTable(const TableStudy& study, ReportFigures& figures) {
  for (std::size_t r = 0; r < study.rivals.size(); ++r) {
    for (std::size_t t = 0; t < kTrajectories; ++t) {
      figures.key_numbers.emplace_back(absl::StrCat(study.rivals[r].name, ": ", t + 1, " is best"),
                                       ShareText(study.rivals[r], study.table(r), t));
    }
  }
  for (std::size_t r = 0; r < study.rivals.size(); ++r) {
    const MitSummary& s = study.table(r);
    figures.key_numbers.emplace_back(study.rivals[r].name + ": samples, lengths of 1, 2, 3",
                                     absl::StrFormat("%.0f; %.1f, %.1f, %.1f m", s.samples,
                                                     s.length_m[0], s.length_m[1], s.length_m[2]));
  }
  for (std::size_t i = 0; i < study.scenes.size(); ++i) {
    const SceneResult& scene = study.scenes[i];
    std::string shares;
    for (const MitSummary& summary : scene.summaries) {
      absl::StrAppend(&shares, shares.empty() ? "" : ", ",
                      absl::StrFormat("%.0f", kPercent * InformativeShare(summary)));
    }
    figures.key_numbers.emplace_back(absl::StrCat("scene ", i, ", ", scene.scene.name),
                                     shares + " %");
  }
}

std::string SensitivityNote(const TableStudy& study) {
  return absl::StrFormat(
      "Is it the algorithm or the scene? In %d variants (other boxes, plume moved or turned, one "
      "goal moved, the variance in ppm\u00B2 as Eq. (2) is printed) the shares differ widely; of "
      "all %d scenes MIT finds trajectory 3 best more often than RRT* in %d, the path that it "
      "chooses has more UCB in %d, and %d reach both 55 %% and 15 points over RRT*. What the "
      "informed draw adds is another matter: in the scene of the table samples spread evenly over "
      "the free space give %.1f %%, and draws from Eq. (2) %.1f %%, so there informed samples "
      "bring nothing. A likely reason: paths through %d samples that see far are shorter and "
      "straighter than those of a tree that stops at its first success.",
      study.scenes.size() - 2, study.scenes.size(),
      ScenesAhead(study, kMit, kRrtStar, InformativeShare),
      ScenesAhead(study, kMit, kRrtStar, ChosenPsi), ScenesOverBar(study),
      kPercent * InformativeShare(study.table(kEvenMit)),
      kPercent * InformativeShare(study.table(kMit)), kMitSamples);
}

// Share of the runs whose way to frontier 3 goes through the passage, which is all that is free
// between the walls there.
double PassageShare(const SceneResult& passage, std::size_t rival) {
  const std::vector<MitRun>& runs = passage.runs[rival];
  const auto goes_through = [](const MitRun& run) {
    const std::vector<Point2>& path = run.paths[kInformative];
    return std::any_of(path.begin(), path.end(),
                       [](Point2 at) { return at.x_m > 6.0 && at.x_m < 16.0 && at.y_m < 4.0; });
  };
  const auto count = std::count_if(runs.begin(), runs.end(), goes_through);
  return static_cast<double>(count) / static_cast<double>(runs.size());
}

std::string PassageNote(const TableStudy& study) {
  const auto found = [&](std::size_t rival) -> const MitSummary& {
    return study.passage().summaries[rival];
  };
  std::string shares;
  std::string through;
  std::string chosen;
  for (const std::size_t rival : {kMit, kEvenMit, kNormalisedMit, kRrt, kRrtStar}) {
    const char* comma = shares.empty() ? "" : ", ";
    absl::StrAppend(&shares, comma, study.rivals[rival].name,
                    absl::StrFormat(" %.1f %%", kPercent * InformativeShare(found(rival))));
    absl::StrAppend(&through, comma,
                    absl::StrFormat("%.1f", kPercent * PassageShare(study.passage(), rival)));
    absl::StrAppend(&chosen, comma, absl::StrFormat("%.3f", ChosenPsi(found(rival))));
  }
  return absl::StrFormat(
      "The second scene was chosen before any planner was run in it, to need informed samples: 20 "
      "m "
      "x 12 m, Eq. (2) as printed, and the way with gas to frontier 3 is a bent passage 0.8 m "
      "wide, "
      "shorter than the way round through the open. Trajectory 3 is best in %s of the runs: the "
      "trees go on until all frontiers are reached (%.0f samples) and nearly always take the way "
      "round, which is the best of three as well. So the share does not tell what was found. "
      "Through "
      "the passage go, in this order, %s %% of the runs, and the mean UCB of the path that is "
      "chosen "
      "is %s.",
      shares, found(kRrtStar).samples, through, chosen);
}

std::vector<std::string> MakeNotes(const TableStudy& study) {
  return {
      "The paper lets each planner search paths to three frontiers and notes which of the three "
      "has the greatest mean UCB, Eq. (3). Known of its scene: cluttered, one plume, a robot with "
      "a gas map of known mean and uncertainty, three frontiers, of which the third has the most "
      "informative path; N = 270, lambda = 1, k_n = 3; RRT finds trajectories 2 and 3 best in 94 % "
      "of its runs. Not known: sizes, places, the gas map and its precisions.",
      "Chosen by us: 12 m x 9 m with random boxes, a Gaussian plume in even wind along the south, "
      "a robot that has read it on the way (dashed) and stands in the west, the posterior of our "
      "gas map after that drive. Frontier 1 is the nearest; 2 and 3 lie at the far side, where "
      "nothing was read, 3 downwind of the plume, so that 2 and 3 compete as they do in the "
      "paper; with frontier 2 near every planner finds 3 best. UCB is Eq. (2) with the variance as "
      "share of the prior's, shown from 0 to 1, which changes no comparison.",
      absl::StrFormat(
          "MIT is the search of the strategy \"mit\", bare. The paper draws its samples from the "
          "\"UCB distribution\", Eq. (2) itself, which is nowhere 0; [XIT] draws from I-hat, "
          "scaled "
          "to 0 at its least: both are here, and even draws. RRT and RRT* are those of OMPL: one "
          "tree, uniform samples, bias 5 %% towards frontiers not yet reached, grown until it has "
          "a vertex within %.1f m of each (green), where MIT's paths end too: as far as the third "
          "nearest of 270 even samples. Their step, 0.8 m, was set so that they draw as many "
          "samples as MIT on average: %.0f and %.0f here. All search for short paths, from the "
          "same seeds; lines 20 and 21 rewire at less, not at equal cost, which would never end. "
          "Intervals are 95 %%, of Wilson.",
          kGoalRadius_m, study.table(1).samples, study.table(kRrtStar).samples),
      SensitivityNote(study), PassageNote(study)};
}

CsvTable MakeTable(const TableStudy& study) {
  CsvTable table;
  table.columns = {"scene", "planner",    "run",        "best",       "psi_1",  "psi_2",
                   "psi_3", "length_1_m", "length_2_m", "length_3_m", "samples"};
  for (std::size_t s = 0; s < study.scenes.size(); ++s) {
    for (std::size_t r = 0; r < study.rivals.size(); ++r) {
      const std::vector<MitRun>& runs = study.scenes[s].runs[r];
      for (std::size_t i = 0; i < runs.size(); ++i) {
        const MitRun& run = runs[i];
        table.rows.push_back({static_cast<double>(s), static_cast<double>(r),
                              static_cast<double>(i), run.best + 1.0, run.psi[0], run.psi[1],
                              run.psi[2], run.length_m[0], run.length_m[1], run.length_m[2],
                              static_cast<double>(run.samples)});
      }
    }
  }
  return table;
}

// "RRT*" -> "rrt_star".
std::string Slug(const MitRival& rival) {
  static constexpr const char* kSlugs[][2] = {{"MIT", "mit"},
                                              {"RRT", "rrt"},
                                              {"RRT*", "rrt_star"},
                                              {"MIT, even draw", "mit_even"},
                                              {"MIT, by I-hat", "mit_normalised"}};
  for (const auto& [name, slug] : kSlugs) {
    if (rival.name == name) return slug;
  }
  return rival.name;
}

void AddFigures(const TableStudy& study, Summary& summary) {
  for (std::size_t s = 0; s < study.scenes.size(); ++s) {
    for (std::size_t r = 0; r < study.rivals.size(); ++r) {
      const MitSummary& found = study.scenes[s].summaries[r];
      const std::string prefix = absl::StrFormat("scene_%d_%s_", s, Slug(study.rivals[r]));
      for (std::size_t t = 0; t < kTrajectories; ++t) {
        const std::string trajectory = absl::StrCat("_", t + 1);
        summary.figures.emplace_back(prefix + "share" + trajectory, found.share(t));
        if (s == 0) {  // of the table
          summary.figures.emplace_back(
              absl::StrFormat("%s_t%d_percent", Slug(study.rivals[r]), t + 1),
              kPercent * found.share(t));
        }
        summary.figures.emplace_back(prefix + "mean_psi" + trajectory, found.psi[t]);
        summary.figures.emplace_back(prefix + "found" + trajectory, found.found[t]);
      }
      summary.figures.emplace_back(prefix + "chosen_psi", found.chosen_psi);
      summary.figures.emplace_back(prefix + "samples", found.samples);
    }
  }
  for (std::size_t r = 0; r < study.rivals.size(); ++r) {
    summary.figures.emplace_back(absl::StrFormat("passage_%s_t3_percent", Slug(study.rivals[r])),
                                 kPercent * InformativeShare(study.passage().summaries[r]));
    summary.figures.emplace_back(
        absl::StrFormat("passage_%s_through_percent", Slug(study.rivals[r])),
        kPercent * PassageShare(study.passage(), r));
  }
  summary.figures.emplace_back("trials", study.table(kMit).runs);
  summary.figures.emplace_back("scenes", static_cast<double>(study.scenes.size()));
  summary.figures.emplace_back("scenes_mit_ahead_of_rrt_star",
                               ScenesAhead(study, kMit, kRrtStar, InformativeShare));
  summary.figures.emplace_back("scenes_over_bar", ScenesOverBar(study));
}

}  // namespace

absl::StatusOr<Study> RunMitTable1(const ExperimentOptions& options) {
  const TableStudy found = RunAll(options);
  const SceneResult& scene = found.scenes.front();
  Study study;
  study.figures.title = "Which trajectory is the most informative ([MIT] Table I, Fig. 2)";
  study.figures.notes = MakeNotes(found);
  const SceneResult& passage = found.passage();
  study.figures.panels = {
      MitScenePanel(scene.scene, "The scene (Fig. 1)"),
      MitRunsPanel(scene.scene, scene.runs[kMit], "(a) MIT", false),
      MitRunsPanel(scene.scene, scene.runs[1], "(b) RRT", true),
      MitRunsPanel(scene.scene, scene.runs[kRrtStar], "RRT*", true),
      MitScenePanel(passage.scene, "The second scene: a narrow passage"),
      MitRunsPanel(passage.scene, passage.runs[kMit], "MIT", false),
      MitRunsPanel(passage.scene, passage.runs[kEvenMit], "MIT, even draw", false),
      MitRunsPanel(passage.scene, passage.runs[kRrtStar], "RRT*", true)};
  study.figures.panels_per_row = 4;
  study.figures.bar_charts = {PsiChart(found), ShareChart(found), VariantChart(found)};
  AddHeadline(found, study.figures);
  AddTable(found, study.figures);
  study.table = MakeTable(found);
  AddFigures(found, study.summary);
  study.summary.about = AboutThisRun(options.seed);
  for (std::size_t s = 0; s < found.scenes.size(); ++s) {
    study.summary.about.emplace_back(absl::StrCat("scene_", s), found.scenes[s].scene.name);
  }
  return study;
}

}  // namespace plumescout::lab
