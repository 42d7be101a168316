// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Loads servers over the loopback interface as robots and watchers do, in real time, and compares
// with what a server owes them.

#include <iostream>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "CLI/App.hpp"
#include "CLI/Config.hpp"
#include "CLI/Formatter.hpp"
#include "core/types/status_macros.h"
#include "lab/bench/bars.h"
#include "lab/bench/bench_summary.h"
#include "lab/bench/load/rows.h"
#include "lab/bench/load/server_process.h"
#include "lab/bench/load/team_row.h"

namespace plumescout::lab {
namespace {

const std::map<std::string, Row*>& Rows() {
  static const std::map<std::string, Row*> rows = {
      {"plans", &PlanRow},      {"ingest", &IngestRow},    {"watchers", &WatcherRow},
      {"flood", &FloodRow},     {"memory", &MemoryRow},    {"drain", &DrainRow},
      {"durable", &DurableRow}, {"recovery", &RecoveryRow}};
  return rows;
}

struct LoadFlags {
  std::vector<std::string> rows = {"plans",  "ingest", "watchers", "flood",
                                   "memory", "drain",  "durable",  "recovery"};
  TeamFlags team;
  bool quick = false;
  bool strict = false;
  std::string server_program = SiblingProgram("plumescout-server");
};

absl::Status RunRow(const std::string& name, const LoadFlags& flags, Bystander& bystander,
                    BenchSummary& summary) {
  if (name == "team") return RunTeam(flags.team, flags.server_program, summary);
  constexpr double kQuick = 0.2;
  RowSettings settings{flags.server_program, &bystander, absl::Seconds(flags.team.seconds),
                       summary.seed()};
  if (flags.quick) settings.time *= kQuick;
  PLUMESCOUT_ASSIGN_OR_RETURN(const std::vector<Bar> bars, Rows().at(name)(settings));
  for (const Bar& bar : bars) {
    summary.Set(bar.name, bar.value);
    if (bar.limit.has_value()) std::cout << "  " << ToString(bar) << std::endl;
  }
  if (flags.strict && !AllMet(bars)) {
    return absl::FailedPreconditionError("row " + name + " misses a bar");
  }
  return absl::OkStatus();
}

// A row that fails does not keep the others from being measured.
absl::Status RunRows(const LoadFlags& flags, Bystander& bystander, BenchSummary& summary) {
  absl::Status first;
  for (const std::string& name : flags.rows) {
    const absl::Status status = RunRow(name, flags, bystander, summary);
    if (!status.ok()) std::cerr << name << ": " << status << std::endl;
    first.Update(status);
  }
  return first;
}

}  // namespace
}  // namespace plumescout::lab

int main(int argc, char** argv) {
  plumescout::lab::LoadFlags flags;
  CLI::App app("Loads servers over loopback and compares with what they owe to robots.");
  std::vector<std::string> names = {"team"};
  for (const auto& [name, row] : plumescout::lab::Rows()) names.push_back(name);
  app.add_option("--row", flags.rows, "which to measure: all but team if none is named")
      ->check(CLI::IsMember(names));
  app.add_option("--robots", flags.team.robots, "of row team: how many")->check(CLI::Range(1, 32));
  app.add_option("--seconds", flags.team.seconds, "how long each measurement takes")
      ->check(CLI::Range(1.0, 86'400.0));
  app.add_option("--scan-hz", flags.team.scan_hz, "of row team: scans a second")
      ->check(CLI::Range(0.1, 100.0));
  app.add_option("--server-program", flags.server_program, "plumescout-server to load");
  app.add_flag("--quick", flags.quick, "a fifth of the time");
  app.add_flag("--strict", flags.strict, "fail if a bar is missed");
  const auto bystander = plumescout::lab::Bystander::Fork();  // before there are threads
  if (!bystander.ok()) {
    std::cerr << bystander.status() << std::endl;
    return 1;
  }
  return plumescout::lab::RunBench(app, argc, argv, [&](plumescout::lab::BenchSummary& summary) {
    return plumescout::lab::RunRows(flags, **bystander, summary);
  });
}
