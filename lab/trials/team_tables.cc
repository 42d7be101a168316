// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/trials/team_tables.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "lab/trials/row_figures.h"
#include "lab/trials/team_figures.h"

namespace plumescout::lab {
namespace {

// What is told of one team beside what it is compared with.
struct RowFigures {
  Speedup speedup;
  Traffic traffic;
  double plan_wall_ratio = 1.0;  // over one robot's
};

RowFigures FiguresOf(const SizeResult& result, std::size_t row) {
  const Traffic traffic = TrafficOf(result.records, row);
  constexpr double kLeast_s = 1e-6;
  const double alone_s = std::max(kLeast_s, TrafficOf(result.records, 0).plan_wall_s);
  return {SpeedupOf(result.records, row, 0), traffic, traffic.plan_wall_s / alone_s};
}

}  // namespace

std::string Percent(double share) { return absl::StrFormat("%.1f %%", 100.0 * share); }

TextTable SpeedTable(const SizeResult& result) {
  TextTable table;
  table.title = absl::StrFormat("%d buildings: %s", result.plan.scenes.size(), result.size->label);
  table.columns = {"team",
                   "sooner at 80 % of one robot's gain in entropy",
                   "… in RMSE",
                   "… at 95 % of the map",
                   "runs that did not get there",
                   "promised already",
                   "bought twice",
                   "edges of the unseen in sight of others' ways",
                   "bought twice, edges included",
                   "planned waits, share of time",
                   "plan, ms",
                   "… over one robot's"};
  for (std::size_t row = 0; row < result.teams.size(); ++row) {
    const RowFigures figures = FiguresOf(result, row);
    const Speedup& speedup = figures.speedup;
    constexpr double kMillisecondsPerSecond = 1e3;
    table.rows.push_back(
        {result.teams[row].label, absl::StrFormat("%.2f", speedup.entropy),
         absl::StrFormat("%.2f", speedup.rmse), absl::StrFormat("%.2f", speedup.map),
         absl::StrCat(speedup.censored), Percent(figures.traffic.promised_share()),
         Percent(figures.traffic.bought_twice_share()),
         Percent(figures.traffic.unseen_twice_share()),
         Percent(figures.traffic.all_bought_twice_share()),
         Percent(figures.traffic.waiting_share()),
         absl::StrFormat("%.0f", kMillisecondsPerSecond * figures.traffic.plan_wall_s),
         absl::StrFormat("%.2f", figures.plan_wall_ratio)});
  }
  return table;
}

TextTable TrafficTable(const SizeResult& result) {
  TextTable table;
  table.title = absl::StrFormat("In each other's way: %s, %.0f s", result.size->label,
                                result.plan.duration_s);
  table.columns = {"team",
                   "missions",
                   "contacts",
                   "nearest centres, m",
                   "encounters per robot and minute",
                   "legs blocked",
                   "… by a robot",
                   "goals set aside for that",
                   "rings that lasted 10 s",
                   "… missions with one",
                   "robots without a way past others for 10 s"};
  for (std::size_t row = 0; row < result.teams.size(); ++row) {
    if (result.teams[row].robots == 1) continue;
    const Traffic traffic = TrafficOf(result.records, row);
    const TeamFindings& findings = traffic.sums.findings;
    table.rows.push_back(
        {result.teams[row].label, absl::StrCat(traffic.missions),
         absl::StrCat(traffic.sums.contacts),
         traffic.sums.closest_m ? absl::StrFormat("%.2f", *traffic.sums.closest_m) : "–",
         absl::StrFormat("%.2f", traffic.encounters_per_robot_minute()),
         Percent(traffic.blocked_share()), Percent(traffic.blocked_by_robot_share()),
         absl::StrCat(findings.set_aside_for_robot), absl::StrCat(findings.deadlocks),
         absl::StrCat(traffic.deadlocked_missions), absl::StrCat(findings.held_up)});
  }
  return table;
}

void AddTrafficNumbers(const SizeResult& result, std::size_t row, Study& study) {
  const Traffic traffic = TrafficOf(result.records, row);
  const TeamFindings& findings = traffic.sums.findings;
  const auto add = [&](const char* name, double value) {
    study.summary.figures.emplace_back(
        absl::StrCat(result.size->name, "_", result.teams[row].name, "_", name), value);
  };
  add("missions", traffic.missions);
  add("contacts", traffic.sums.contacts);
  if (traffic.sums.closest_m) add("min_separation_m", *traffic.sums.closest_m);
  add("encounters_per_robot_minute", traffic.encounters_per_robot_minute());
  add("blocked_share", traffic.blocked_share());
  add("blocked_by_robot_share", traffic.blocked_by_robot_share());
  add("set_aside_by_robot", findings.set_aside_for_robot);
  add("deadlocks_unresolved", findings.deadlocks);
  add("deadlocked_missions", traffic.deadlocked_missions);
  add("held_up", findings.held_up);
  add("waiting_share", traffic.waiting_share());
}

void AddNumbers(const SizeResult& result, Study& study) {
  for (std::size_t row = 0; row < result.teams.size(); ++row) {
    const TeamRow& team = result.teams[row];
    const RowFigures figures = FiguresOf(result, row);
    const Speedup& speedup = figures.speedup;
    const auto add = [&](const char* name, double value) {
      study.summary.figures.emplace_back(absl::StrCat(result.size->name, "_", team.name, "_", name),
                                         value);
    };
    add("speedup_entropy80", speedup.entropy);
    add("speedup_rmse80", speedup.rmse);
    add("speedup_complete95", speedup.map);
    add("censored", speedup.censored);
    add("promised_share", figures.traffic.promised_share());
    add("bought_twice_share", figures.traffic.bought_twice_share());
    add("unseen_twice_share", figures.traffic.unseen_twice_share());
    add("all_bought_twice_share", figures.traffic.all_bought_twice_share());
    add("plan_wall_s", figures.traffic.plan_wall_s);
    add("plan_wall_ratio", figures.plan_wall_ratio);
    AddTrafficNumbers(result, row, study);
    if (row == 0 || !team.yields) continue;
    study.figures.key_numbers.emplace_back(
        absl::StrFormat("%s, %s: sooner by", team.label, result.size->label),
        absl::StrFormat("%.1f (entropy), %.1f (map)", speedup.entropy, speedup.map));
  }
}

void AddCalibration(const SizeResult& result, Study& study) {
  AddCalibration(FinalMaps(result.plan, result.records, absl::StrCat(result.size->name, "_")),
                 study);
}

void AddRows(const SizeResult& result, CsvTable& table) {
  CsvTable part = MakeTrialTable(result.plan, result.records);
  table.label_columns = part.label_columns;
  table.columns = part.columns;
  std::move(part.labels.begin(), part.labels.end(), std::back_inserter(table.labels));
  std::move(part.rows.begin(), part.rows.end(), std::back_inserter(table.rows));
}

}  // namespace plumescout::lab
