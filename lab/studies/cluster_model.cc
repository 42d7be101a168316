// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/studies/cluster_model.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/types/quantile.h"
#include "lab/about/about.h"
#include "lab/report/palette.h"
#include "lab/trials/cluster_simulation.h"

namespace plumescout::lab {
namespace {

constexpr double kLineWidth_px = 2.0;
constexpr double kStorm = 0.0;
constexpr double kHot = 1.0;
constexpr double kTail = 2.0;
constexpr double kRecovery = 3.0;
constexpr int kFailovers = 40;  // of each point
constexpr int kQuickFailovers = 4;
constexpr double kHotSeconds = 300.0;
constexpr double kQuickHotSeconds = 20.0;
constexpr double kFar = 0.99;
constexpr double kLate_s = 0.1;  // of an observation that is to be in the next plan
constexpr int kMissionsOfANode[] = {10, 25, 50, 100, 200, 400, 800};
constexpr int kNodes[] = {3, 10, 100};
constexpr int kRobots[] = {1, 2, 4, 8, 16, 32, 48, 64, 80, 96, 100, 104, 108, 112, 128};
constexpr double kTails_s[] = {0.1, 0.2, 0.5, 1.0, 1.5, 2.0};
constexpr double kCores[] = {2.0, 4.0, 16.0};
constexpr int kRecoveries[] = {1, 2, 4, 8};
constexpr double kLeases_s[] = {1.0, 2.0, 5.0};

struct Waits {
  double median_s = 0.0;
  double far_s = 0.0;
  double longest_s = 0.0;
};

Waits WaitsOf(std::vector<double> waits_s) {
  Waits waits;
  waits.median_s = Median(waits_s);
  waits.longest_s = *std::max_element(waits_s.begin(), waits_s.end());
  waits.far_s = Quantile(std::move(waits_s), kFar);
  return waits;
}

std::vector<double> ManyFailovers(const ClusterModel& model, const ExperimentOptions& options) {
  const int count = options.trials.value_or(options.quick ? kQuickFailovers : kFailovers);
  std::vector<double> all_s;
  for (int i = 0; i < count; ++i) {
    const std::uint64_t seed = options.seed * 1'000'003 + static_cast<std::uint64_t>(i);
    const std::vector<double> waits_s = FailoverWaits_s(model, seed);
    all_s.insert(all_s.end(), waits_s.begin(), waits_s.end());
  }
  return all_s;
}

Curve Line(std::string name, std::size_t number) {
  return {.name = std::move(name),
          .stroke = {kLineColors[number % kLineColors.size()], kLineWidth_px},
          .points = {}};
}

void AddStorms(const ExperimentOptions& options, Study& study) {
  Chart longest{.title = "Longest wait of a robot, s",
                .x_label = "missions of the node that died",
                .y_range = {},
                .curves = {}};
  Chart median = longest;
  median.title = "Median wait of its robots, s";
  for (std::size_t i = 0; i < std::size(kNodes); ++i) {
    longest.curves.push_back(Line(absl::StrCat(kNodes[i], " nodes"), i));
    median.curves.push_back(Line(absl::StrCat(kNodes[i], " nodes"), i));
    for (const int missions : kMissionsOfANode) {
      ClusterModel model;
      model.nodes = kNodes[i];
      model.missions = missions;
      const Waits waits = WaitsOf(ManyFailovers(model, options));
      longest.curves.back().points.push_back({static_cast<double>(missions), waits.longest_s});
      median.curves.back().points.push_back({static_cast<double>(missions), waits.median_s});
      study.table.rows.push_back({kStorm, static_cast<double>(kNodes[i]),
                                  static_cast<double>(missions), model.lease_s, waits.median_s,
                                  waits.far_s, waits.longest_s});
      const std::string name = absl::StrCat("storm_n", kNodes[i], "_m", missions);
      study.summary.figures.emplace_back(name + "_median_s", waits.median_s);
      study.summary.figures.emplace_back(name + "_longest_s", waits.longest_s);
    }
  }
  study.figures.charts.push_back(std::move(median));
  study.figures.charts.push_back(std::move(longest));
}

void AddLeases(const ExperimentOptions& options, Study& study) {
  constexpr int kSteps = 100;
  Chart chart{.title = "Share of robots that are served again",
              .x_label = "after the end of their node, s",
              .y_range = Range{0.0, 1.0},
              .curves = {}};
  for (std::size_t i = 0; i < std::size(kLeases_s); ++i) {
    ClusterModel model;
    model.lease_s = kLeases_s[i];
    std::vector<double> waits_s = ManyFailovers(model, options);
    std::sort(waits_s.begin(), waits_s.end());
    chart.curves.push_back(Line(absl::StrFormat("lease %.0f s", model.lease_s), i));
    for (int step = 0; step <= kSteps; ++step) {
      const double share = static_cast<double>(step) / kSteps;
      chart.curves.back().points.push_back({Quantile(waits_s, share), share});
    }
    const Waits waits = WaitsOf(std::move(waits_s));
    const std::string name = absl::StrFormat("lease_%.0f_s", model.lease_s);
    study.summary.figures.emplace_back(name + "_median_s", waits.median_s);
    study.summary.figures.emplace_back(name + "_longest_s", waits.longest_s);
    study.figures.key_numbers.emplace_back(
        absl::StrFormat("3 nodes, %d missions each, lease %.0f s: wait, median and longest",
                        model.missions, model.lease_s),
        absl::StrFormat("%.1f / %.1f s", waits.median_s, waits.longest_s));
  }
  study.figures.charts.push_back(std::move(chart));
}

// What snapshots leave to be replayed is what a storm is made of.
void AddTails(const ExperimentOptions& options, Study& study) {
  Chart chart{.title = "Longest wait by what snapshots leave, s",
              .x_label = "longest tail of a mission, s of CPU",
              .y_range = {},
              .curves = {}};
  for (std::size_t i = 0; i < std::size(kNodes); ++i) {
    chart.curves.push_back(Line(absl::StrCat(kNodes[i], " nodes"), i));
    for (const double tail_s : kTails_s) {
      ClusterModel model;
      model.nodes = kNodes[i];
      model.largest_tail = tail_s / model.replay_s;
      const Waits waits = WaitsOf(ManyFailovers(model, options));
      chart.curves.back().points.push_back({tail_s, waits.longest_s});
      study.table.rows.push_back({kTail, static_cast<double>(kNodes[i]), tail_s, model.lease_s,
                                  waits.median_s, waits.far_s, waits.longest_s});
      study.summary.figures.emplace_back(
          absl::StrFormat("tail_n%d_%.1f_s_longest_s", kNodes[i], tail_s), waits.longest_s);
    }
  }
  study.figures.charts.push_back(std::move(chart));
}

// How many are recovered at a time, by the cores that nodes have.
void AddRecoveries(const ExperimentOptions& options, Study& study) {
  Chart chart{.title = "Longest wait by recoveries at a time, s",
              .x_label = "recoveries of a node at a time",
              .y_range = {},
              .curves = {}};
  for (std::size_t i = 0; i < std::size(kCores); ++i) {
    chart.curves.push_back(Line(absl::StrFormat("%.0f cores", kCores[i]), i));
    for (const int recoveries : kRecoveries) {
      ClusterModel model;
      model.cores = kCores[i];
      model.recoveries = recoveries;
      const Waits waits = WaitsOf(ManyFailovers(model, options));
      chart.curves.back().points.push_back({static_cast<double>(recoveries), waits.longest_s});
      study.table.rows.push_back({kRecovery, static_cast<double>(model.nodes),
                                  static_cast<double>(recoveries), model.lease_s, waits.median_s,
                                  waits.far_s, waits.longest_s});
      const std::string name = absl::StrFormat("recoveries_c%.0f_k%d", kCores[i], recoveries);
      study.summary.figures.emplace_back(name + "_median_s", waits.median_s);
      study.summary.figures.emplace_back(name + "_longest_s", waits.longest_s);
    }
  }
  study.figures.charts.push_back(std::move(chart));
}

void AddHotMission(const ExperimentOptions& options, Study& study) {
  Chart chart{.title = "Observation sent until applied, 99 of 100, ms",
              .x_label = "robots of one mission",
              .y_range = Range{0.0, 100.0},
              .curves = {Line("", 0)}};
  int most = 0;
  for (const int robots : kRobots) {
    HotMission mission;
    mission.robots = robots;
    mission.duration_s = options.quick ? kQuickHotSeconds : kHotSeconds;
    const Waits waits = WaitsOf(WriterWaits_s(mission, options.seed));
    chart.curves.front().points.push_back({static_cast<double>(robots), 1e3 * waits.far_s});
    study.table.rows.push_back({kHot, 1.0, static_cast<double>(robots), 0.0, waits.median_s,
                                waits.far_s, waits.longest_s});
    study.summary.figures.emplace_back(absl::StrCat("hot_r", robots, "_p99_s"), waits.far_s);
    if (waits.far_s <= kLate_s) most = std::max(most, robots);
  }
  study.summary.figures.emplace_back("hot_most_robots", most);
  study.figures.key_numbers.emplace_back("robots of one mission, applied within 0.1 s (99 of 100)",
                                         absl::StrCat(most));
  study.figures.charts.push_back(std::move(chart));
}

std::vector<std::string> MakeNotes() {
  return {
      "One of several servers that share a store dies. Its robots try again, after waits that "
      "grow; "
      "the router sends each mission to one of the nodes that are left; that asks the store whose "
      "the mission is, which holds for half a second; once the lease has run out it takes the "
      "mission over and recovers it, two missions at a time, while the missions that it has "
      "already "
      "take half of its two cores. Leases are renewed four times in their time; callers of a "
      "mission "
      "that is recovered ask every 0.5 s. All of these are constants of the code.",
      "Costs are measured (docs/scale.md): 12 ms to read a mission and 0.55 ms of CPU for an event "
      "of its tail; snapshots keep that below some 2 s of CPU, so that each mission has between "
      "none "
      "and that. 50 missions of 4 robots a node, unless the chart says otherwise; 0.78 ms of CPU "
      "an "
      "observation of a mission that runs. What is not in the model: a store that is slow under "
      "the "
      "storm, and what robots send at once when they are served again.",
      "A mission has one writer, and so one core at most. Robots send 10 scans and 2 readings a "
      "second, at random times."};
}

}  // namespace

absl::StatusOr<Study> RunClusterModel(const ExperimentOptions& options) {
  Study study;
  study.figures.title = "When one of many servers dies";
  study.figures.notes = MakeNotes();
  study.table.columns = {"kind",     "nodes",    "missions_tail_s_recoveries_or_robots",
                         "lease_s",  "median_s", "p99_s",
                         "longest_s"};
  AddLeases(options, study);
  AddStorms(options, study);
  AddTails(options, study);
  AddRecoveries(options, study);
  AddHotMission(options, study);
  study.summary.about = AboutThisRun(options.seed);
  return study;
}

}  // namespace plumescout::lab
