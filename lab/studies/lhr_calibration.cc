// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/lhr_calibration.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/types/status_macros.h"
#include "lab/about/about.h"
#include "lab/studies/lhr_rows.h"
#include "lab/trials/sampling_pictures.h"
#include "lab/trials/sampling_study.h"
#include "lab/trials/statistics.h"
#include "lab/worlds/lhr_scene.h"

namespace plumescout::lab {
namespace {

constexpr double kPriors[] = {3.0, 4.0, 5.0, 6.0, 8.0};  // [XIT] Table I has 3
constexpr double kBetas[] = {1.0, 2.0, 4.0};
constexpr double kQuickPriors[] = {5.0};
constexpr double kQuickBetas[] = {1.0, 2.0};
constexpr std::uint64_t kSeedsApart = 1000;  // from those of Table II
constexpr int kWorlds = 4;

// All rows of one pair, as places in the plan: those by the mean are the same for every beta.
struct Pair {
  LhrUnstated unstated;
  std::vector<std::pair<const LhrRow*, std::size_t>> rows;
};

// The rows of the plan, and which of them belong to which pair.
absl::StatusOr<std::vector<Pair>> AddPairs(bool quick, SamplingPlan& plan) {
  using Values = std::span<const double>;
  const Values priors = quick ? Values(kQuickPriors) : Values(kPriors);
  const Values betas = quick ? Values(kQuickBetas) : Values(kBetas);
  const auto add = [&plan](const LhrRow& row, const LhrUnstated& unstated) -> absl::Status {
    PLUMESCOUT_ASSIGN_OR_RETURN(StudyRow made,
                                MakeLhrStudyRow(row, unstated, plan.worlds.front().geometry()));
    made.name = absl::StrFormat("%s_%g_%g", row.name, unstated.prior_precision_per_ppm2,
                                row.reward == SamplingReward::kUcb ? unstated.beta : 0.0);
    plan.rows.push_back(std::move(made));
    return absl::OkStatus();
  };
  std::vector<Pair> pairs;
  for (const double prior : priors) {
    const std::size_t first = pairs.size();
    for (const double beta : betas) pairs.push_back({{prior, beta}, {}});
    for (const LhrRow& row : kLhrRows) {
      if (std::string(row.strategy) != "lhr") continue;
      const bool by_beta = row.reward == SamplingReward::kUcb;
      for (std::size_t i = first; i < pairs.size(); ++i) {
        if (by_beta || i == first) PLUMESCOUT_RETURN_IF_ERROR(add(row, pairs[i].unstated));
        pairs[i].rows.emplace_back(&row, plan.rows.size() - 1);
      }
    }
  }
  return pairs;
}

double Squared(double ours, double paper) {
  const double logarithm = std::log(ours / paper);
  return logarithm * logarithm;
}

TextTable MakeTable(const std::vector<Pair>& pairs) {
  TextTable table;
  table.title = "Ours over the paper's: distance; convergence time";
  table.columns = {"λ_p, 1 / ppm²", "β"};
  for (const auto& [row, place] : pairs.front().rows) table.columns.emplace_back(row->label);
  table.columns.emplace_back("sum of squared logarithms");
  return table;
}

// Tells the sum of squared logarithms.
double AddPair(const Pair& pair, const SamplingPlan& plan,
               const std::vector<std::vector<SamplingDrive>>& drives, TextTable& table,
               Summary& summary) {
  const LhrUnstated& unstated = pair.unstated;
  std::vector<std::string>& cells = table.rows.emplace_back();
  cells = {absl::StrFormat("%g", unstated.prior_precision_per_ppm2),
           absl::StrFormat("%g", unstated.beta)};
  double sum = 0.0;
  for (const auto& [row, place] : pair.rows) {
    const auto mean = [&plan, &of_row = drives[place]](double (*figure)(const SamplingDrive&)) {
      return SpreadOf(MeansByWorld(plan, of_row, figure)).mean;
    };
    const double distance_m = mean(LhrDriven_m);
    const double convergence_min = mean(LhrConvergence_min);
    sum += Squared(distance_m, row->paper_distance_m) +
           Squared(convergence_min, row->paper_convergence_min);
    cells.push_back(absl::StrFormat("%.2f; %.2f", distance_m / row->paper_distance_m,
                                    convergence_min / row->paper_convergence_min));
  }
  cells.push_back(absl::StrFormat("%.4f", sum));
  summary.figures.emplace_back(
      absl::StrFormat("prior_%g_beta_%g_sum", unstated.prior_precision_per_ppm2, unstated.beta),
      sum);
  return sum;
}

std::string Told(const LhrUnstated& unstated, double sum) {
  return absl::StrFormat("λ_p = %g, β = %g: %.3f", unstated.prior_precision_per_ppm2, unstated.beta,
                         sum);
}

}  // namespace

absl::StatusOr<Study> RunLhrCalibration(const ExperimentOptions& options) {
  const int count = options.trials.value_or(options.quick ? 1 : kWorlds);
  std::vector<Scene> worlds;
  for (int i = 0; i < count; ++i) {
    worlds.push_back(MakeLhrScene(LhrScenarioSources(options.seed + kSeedsApart, i)));
  }
  SamplingPlan plan =
      MakeLhrDrives(options, std::move(worlds), options.quick ? 1 : LhrStarts().size());
  plan.progress = options.progress;
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<Pair> pairs, AddPairs(options.quick, plan));
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto drives, RunSamplingStudy(plan));
  Study study;
  study.figures.title = "[LHR] Table II by what the paper does not state";
  study.figures.notes = {absl::StrFormat(
      "The paper prints neither λ_p of its field nor β of its reward μ + βσ². Here: its four rows "
      "by rewards with several of both, %d drives of each in %d worlds that the table does not "
      "use. The rule: the pair with the least sum of squared logarithms of ours over theirs, of "
      "distances and of times. Table II is then made with it in other worlds.",
      plan.cases.size(), plan.worlds.size())};
  TextTable table = MakeTable(pairs);
  std::vector<double> sums;
  for (const Pair& pair : pairs) {
    sums.push_back(AddPair(pair, plan, drives, table, study.summary));
  }
  const auto nearest = std::min_element(sums.begin(), sums.end());
  const LhrUnstated& chosen = pairs[static_cast<std::size_t>(nearest - sums.begin())].unstated;
  study.figures.key_numbers = {{"Nearest to the paper", Told(chosen, *nearest)},
                               {"Pairs tried", absl::StrCat(pairs.size())}};
  study.figures.tables = {std::move(table)};
  AddCalibration(FinalMaps(plan, drives), study);
  study.table = MakeDriveTable(plan, drives);
  study.summary.about = AboutThisRun(options.seed);
  study.summary.about.emplace_back("drives", absl::StrCat(plan.cases.size()));
  return study;
}

}  // namespace plumescout::lab
