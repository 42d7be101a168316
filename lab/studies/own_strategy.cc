// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/own_strategy.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/types/status_macros.h"
#include "lab/about/about.h"
#include "lab/report/palette.h"
#include "lab/trials/row_figures.h"
#include "lab/trials/statistics.h"
#include "lab/trials/study_scenes.h"
#include "lab/trials/trial_study.h"

namespace plumescout::lab {
namespace {

// Not looked at before strategy and default field were settled (docs/provenance.md).
constexpr std::uint64_t kFirstBuilding = 984;
constexpr std::uint64_t kFirstQuickBuilding = 1;  // a first look leaves the others unseen
constexpr int kBuildings = 30;
constexpr int kQuickBuildings = 2;
constexpr int kTrials = 2;
constexpr double kDuration_s = 300.0;
constexpr double kQuickDuration_s = 60.0;

struct Contestant {
  const char* name;
  const char* label;
  const char* strategy;
  bool of_the_paper;  // goals at random, and random places once no frontier is left
  bool default_field = false;
};

constexpr std::size_t kBaseline = 0;
constexpr std::size_t kGff = 2;
constexpr std::size_t kGffOurs = 3;
constexpr std::size_t kOwnInTheirField = 4;
constexpr std::size_t kOwn = 5;
constexpr Contestant kContestants[] = {
    {"rrt_star_frontier", "RRT* frontier", "rrt_star_frontier", true},
    {"rrt_star_frontier_ours", "RRT* frontier, our fallback", "rrt_star_frontier", false},
    {"xit_gff", "XIT-GFF, paper", "xit_gff", true},
    {"xit_gff_ours", "XIT-GFF, our options", "xit_gff", false},
    {"plumescout", "plumescout, field of [XIT]", "plumescout", false},
    {"plumescout_default", "plumescout, as missions have it", "plumescout", false, true},
};
constexpr Rgb kColors[] = {{36, 99, 201},   {130, 170, 225}, {206, 30, 60},
                           {225, 140, 150}, {20, 130, 90},   {120, 60, 160}};

absl::StatusOr<TrialPlan> MakePlan(const ExperimentOptions& options,
                                   std::vector<std::string> scenes) {
  TrialPlan plan;
  for (const Contestant& contestant : kContestants) {
    PLUMESCOUT_ASSIGN_OR_RETURN(
        StudyRow row, MakeStudyRow(contestant.name, contestant.strategy, contestant.of_the_paper));
    if (contestant.default_field) {
      const GasOptions published = row.mission.gas;
      row = AsMissionsAre(std::move(row));
      row.second_field = published;
    }
    plan.rows.push_back(std::move(row));
  }
  plan.scenes = std::move(scenes);
  plan.trials = options.trials.value_or(options.quick ? 1 : kTrials);
  plan.first_seed = options.seed;
  plan.duration_s = options.quick ? kQuickDuration_s : kDuration_s;
  plan.folder = absl::StrCat(options.folder, "/trials");
  plan.jobs = options.jobs;
  return plan;
}

// What one strategy, or the oracle, reached in one building: means over trials.
struct Reached {
  double rmse_ppm = 0.0;
  double entropy_nats = 0.0;  // per critical cell, in the field of [XIT]
  double completeness = 0.0;
  double worst_rmse_ppm = 0.0;  // of the trials
};

struct Building {
  std::string name;
  std::vector<Reached> rows;
  Reached oracle;
  double rmse_zero_ppm = 0.0;
};

Reached MeanOf(const std::vector<TrialRecord>& trials) {
  Reached mean;
  const auto n = static_cast<double>(trials.size());
  for (const TrialRecord& trial : trials) {
    const MapMetrics& m = trial.curve.back().metrics;
    mean.rmse_ppm += Rmse_ppm(m) / n;
    mean.entropy_nats += EntropyPerCell_nats(trial.second_field.value_or(m)) / n;
    mean.worst_rmse_ppm = std::max(mean.worst_rmse_ppm, Rmse_ppm(m));
    mean.completeness += Completeness(m) / n;
  }
  return mean;
}

// The oracle has as many readings as the baseline's robots took.
absl::StatusOr<std::vector<Building>> Judge(const TrialPlan& plan,
                                            const std::vector<SceneRecords>& records,
                                            const std::function<void(double)>& progress) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<MapMetrics> oracles,
                              OracleMetrics(plan, records, kBaseline, progress));
  std::vector<Building> buildings(records.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    Building& building = buildings[i];
    building.name = SceneName(plan.scenes[i]);
    for (const std::vector<TrialRecord>& trials : records[i]) {
      building.rows.push_back(MeanOf(trials));
    }
    building.oracle = {Rmse_ppm(oracles[i]), EntropyPerCell_nats(oracles[i]), 1.0,
                       Rmse_ppm(oracles[i])};
    building.rmse_zero_ppm = oracles[i].rmse_zero_ppm;
  }
  return buildings;
}

// A figure of one row in all buildings. RMSE as share of that of an all-zero map, so that buildings
// with much gas do not count for more.
using FigureFn = double (*)(const Building&, const Reached&);
double RmseShare(const Building& building, const Reached& reached) {
  return reached.rmse_ppm / building.rmse_zero_ppm;
}
double WorstShare(const Building& building, const Reached& reached) {
  return reached.worst_rmse_ppm / building.rmse_zero_ppm;
}
double Entropy(const Building&, const Reached& reached) { return reached.entropy_nats; }
double Complete(const Building&, const Reached& reached) { return reached.completeness; }

std::vector<double> Of(const std::vector<Building>& buildings, std::size_t row, FigureFn figure) {
  std::vector<double> values;
  for (const Building& building : buildings) {
    values.push_back(figure(building, building.rows[row]));
  }
  return values;
}

double MeanOfOracle(const std::vector<Building>& buildings, FigureFn figure) {
  std::vector<double> values;
  for (const Building& building : buildings) {
    values.push_back(figure(building, building.oracle));
  }
  return SpreadOf(values).mean;
}

// Share of the oracle's gain over row `from`, of the means over buildings.
double OracleShare(const std::vector<Building>& buildings, std::size_t row, std::size_t from,
                   FigureFn figure) {
  const double base = SpreadOf(Of(buildings, from, figure)).mean;
  const double gain = base - SpreadOf(Of(buildings, row, figure)).mean;
  return gain / (base - MeanOfOracle(buildings, figure));
}

// Its 95 % interval over buildings.
Interval OracleShareInterval(const std::vector<Building>& buildings, std::size_t row,
                             std::size_t from, FigureFn figure) {
  return BootstrapInterval(buildings.size(), [&](std::span<const std::size_t> drawn) {
    std::vector<Building> some;
    for (const std::size_t i : drawn) some.push_back(buildings[i]);
    return OracleShare(some, row, from, figure);
  });
}

std::string OracleShareText(const std::vector<Building>& buildings, std::size_t row,
                            FigureFn figure) {
  if (row == kBaseline) return "0";
  const Interval interval = OracleShareInterval(buildings, row, kBaseline, figure);
  return absl::StrFormat("%.2f [%.2f, %.2f]", OracleShare(buildings, row, kBaseline, figure),
                         interval.low, interval.high);
}

TextTable MakeTextTable(const std::vector<Building>& buildings) {
  TextTable table;
  table.title = "Means over buildings [95 % interval]; p: paired permutations over buildings";
  table.columns = {"strategy",
                   "RMSE / that of an all-zero map",
                   "share of the oracle's gain",
                   "entropy, nats per critical cell",
                   "share of the oracle's gain",
                   "map complete",
                   "p: the last of ours against it, RMSE",
                   "entropy",
                   "completeness"};
  const auto mean = [&](std::size_t row, FigureFn figure) {
    const Spread spread = SpreadOf(Of(buildings, row, figure));
    return absl::StrFormat("%.3f [± %.3f]", spread.mean, spread.half_95);
  };
  const auto p = [&](std::size_t row, FigureFn figure) {
    if (row == kOwn) return std::string("–");
    return absl::StrFormat("%.2g",
                           PairedPValue(Of(buildings, kOwn, figure), Of(buildings, row, figure)));
  };
  for (std::size_t row = 0; row < std::size(kContestants); ++row) {
    table.rows.push_back({kContestants[row].label, mean(row, RmseShare),
                          OracleShareText(buildings, row, RmseShare), mean(row, Entropy),
                          OracleShareText(buildings, row, Entropy), mean(row, Complete),
                          p(row, RmseShare), p(row, Entropy), p(row, Complete)});
  }
  table.rows.push_back({"oracle", absl::StrFormat("%.3f", MeanOfOracle(buildings, RmseShare)), "1",
                        absl::StrFormat("%.3f", MeanOfOracle(buildings, Entropy)), "1", "", "", "",
                        ""});
  return table;
}

TextTable MakeBuildingTable(const std::vector<Building>& buildings) {
  TextTable table;
  table.title = "By building: RMSE, ppm / entropy, nats per critical cell";
  table.columns = {"building", "all-zero map"};
  for (const Contestant& contestant : kContestants) table.columns.emplace_back(contestant.label);
  table.columns.emplace_back("oracle");
  const auto text = [](const Reached& r) {
    return absl::StrFormat("%.2f / %.3f", r.rmse_ppm, r.entropy_nats);
  };
  for (const Building& building : buildings) {
    std::vector<std::string>& row = table.rows.emplace_back();
    row = {building.name, absl::StrFormat("%.2f", building.rmse_zero_ppm)};
    for (const Reached& reached : building.rows) row.push_back(text(reached));
    row.push_back(text(building.oracle));
  }
  return table;
}

// Figures of one row, and of ours in either field beside it.
void AddRowNumbers(const std::vector<Building>& buildings, const char* name, FigureFn figure,
                   std::size_t row, Summary& summary) {
  const std::string prefix = absl::StrCat(kContestants[row].name, "_", name);
  summary.figures.emplace_back(prefix + "_mean", SpreadOf(Of(buildings, row, figure)).mean);
  if (figure != Complete) {
    summary.figures.emplace_back(prefix + "_oracle_share",
                                 OracleShare(buildings, row, kBaseline, figure));
  }
  if (figure != Complete && row != kBaseline) {
    const Interval interval = OracleShareInterval(buildings, row, kBaseline, figure);
    summary.figures.emplace_back(prefix + "_oracle_share_low", interval.low);
    summary.figures.emplace_back(prefix + "_oracle_share_high", interval.high);
  }
  for (const std::size_t own : {kOwnInTheirField, kOwn}) {
    if (row >= own) continue;
    summary.figures.emplace_back(
        absl::StrCat(kContestants[own].name, "_against_", prefix, "_p"),
        PairedPValue(Of(buildings, own, figure), Of(buildings, row, figure)));
  }
}

// In how many buildings ours, as missions have it, has the least of the first `rows` rows.
int BuildingsWhereBest(const std::vector<Building>& buildings, std::size_t rows, FigureFn figure) {
  return static_cast<int>(
      std::count_if(buildings.begin(), buildings.end(), [&](const Building& building) {
        const double value = figure(building, building.rows[kOwn]);
        return std::all_of(building.rows.begin(), building.rows.begin() + static_cast<int>(rows),
                           [&](const Reached& other) { return figure(building, other) >= value; });
      }));
}

void AddNumbers(const std::vector<Building>& buildings, Study& study) {
  const std::pair<const char*, FigureFn> figures[] = {
      {"rmse", RmseShare}, {"entropy", Entropy}, {"completeness", Complete}};
  Summary& summary = study.summary;
  auto& key_numbers = study.figures.key_numbers;
  for (const auto& [name, figure] : figures) {
    for (std::size_t row = 0; row < std::size(kContestants); ++row) {
      AddRowNumbers(buildings, name, figure, row, summary);
    }
  }
  const auto count = static_cast<double>(buildings.size());
  for (const auto& [name, figure] : {figures[0], figures[1]}) {
    const char* const label = figure == RmseShare ? "RMSE" : "entropy";
    key_numbers.emplace_back(absl::StrCat("Share of the oracle's gain, ", label),
                             OracleShareText(buildings, kOwn, figure));
    key_numbers.emplace_back(
        absl::StrCat("XIT-GFF's, ", label),
        absl::StrFormat("%.2f paper, %.2f ours", OracleShare(buildings, kGff, kBaseline, figure),
                        OracleShare(buildings, kGffOurs, kBaseline, figure)));
    const int best = BuildingsWhereBest(buildings, kOwn + 1, figure);
    // Rows before ours in either field are of other strategies.
    const int best_strategy = BuildingsWhereBest(buildings, kOwnInTheirField, figure);
    key_numbers.emplace_back(
        absl::StrCat("Best of all rows; of other strategies', ", label),
        absl::StrFormat("%d; %d of %d buildings", best, best_strategy, buildings.size()));
    const std::string prefix = absl::StrCat(kContestants[kOwn].name, "_", name);
    summary.figures.emplace_back(prefix + "_best_share", best / count);
    summary.figures.emplace_back(prefix + "_best_strategy_share", best_strategy / count);
  }
  const std::vector<double> worst = Of(buildings, kOwn, WorstShare);
  summary.figures.emplace_back(absl::StrCat(kContestants[kOwn].name, "_worst_rmse_share"),
                               *std::max_element(worst.begin(), worst.end()));
}

std::vector<std::string> MakeNotes(const TrialPlan& plan) {
  return {
      absl::StrFormat("%d buildings, %d trials of %.0f s with each strategy, all from the same "
                      "pose with the same sensors and seeds, and the same grid guard. None of the "
                      "buildings 984 to 1013 was looked at before strategy and field were settled.",
                      plan.scenes.size(), plan.trials, plan.duration_s),
      "The oracle knows building and gas, does not drive, and places as many readings as a robot "
      "takes one by one where each lowers the entropy of the critical cells most. Shares are of "
      "its gain over RRT* frontier exploration, from the means over buildings; their intervals are "
      "of 2,000 draws of buildings.",
      "Paper: up to five goals at random within a kind, and random free places once no frontier "
      "is left. Our options: all goals, and then places whose gas is unobserved.",
      "As missions have it: in the default field, with the sensor's lag undone along the way. Its "
      "entropy, as that of all rows, is of the field of [XIT], made of the same readings with the "
      "lag undone at points; that of the table of trials is of the mission's own. Best of all "
      "rows: of those driven, without the oracle.",
  };
}

}  // namespace

absl::StatusOr<Study> RunOwnStrategy(const ExperimentOptions& options) {
  constexpr double kScenesShare = 0.2;  // of the time, for the progress line
  constexpr double kOracleShare = 0.25;
  ExperimentOptions making = options;
  making.progress = PartOfProgress(options, 0.0, kScenesShare);
  const double duration_s = options.quick ? kQuickDuration_s : kDuration_s;
  PLUMESCOUT_ASSIGN_OR_RETURN(std::vector<std::string> scenes,
                              GeneratedScenes(making,
                                              {options.quick ? kFirstQuickBuilding : kFirstBuilding,
                                               options.quick ? kQuickBuildings : kBuildings},
                                              duration_s));
  PLUMESCOUT_ASSIGN_OR_RETURN(TrialPlan plan, MakePlan(options, std::move(scenes)));
  plan.progress = PartOfProgress(options, kScenesShare, 1.0 - kOracleShare);
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<SceneRecords> records, RunTrials(plan));
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const std::vector<Building> buildings,
      Judge(plan, records, PartOfProgress(options, 1.0 - kOracleShare, 1.0)));
  Study study;
  study.figures.title = "Our own strategy in buildings it does not know";
  study.figures.notes = MakeNotes(plan);
  study.figures.tables = {MakeTextTable(buildings), MakeBuildingTable(buildings)};
  std::vector<RowStyle> styles;
  for (std::size_t row = 0; row < std::size(kContestants); ++row) {
    styles.push_back({kContestants[row].label, kColors[row], row == kBaseline || row == kOwn});
  }
  const std::vector<RowStyle> in_one_unit(styles.begin(), styles.begin() + kOwn);
  study.figures.charts = {
      MakeMetricChart(records, styles, "RMSE, critical cells, ppm", Rmse_ppm),
      MakeMetricChart(records, in_one_unit, "Entropy, nats per critical cell", EntropyPerCell_nats),
      MakeMetricChart(records, styles, "Completeness", Completeness)};
  AddNumbers(buildings, study);
  AddCalibration(FinalMaps(plan, records), study);
  study.table = MakeTrialTable(plan, records);
  study.summary.about = AboutThisRun(options.seed);
  return study;
}

}  // namespace plumescout::lab
