// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Does to a server over the loopback interface what clients should not do, and tells what honest
// callers notice. Fails if an attack breaks more than it may.

#include <algorithm>
#include <functional>
#include <iostream>
#include <limits>
#include <string>
#include <vector>

#include "CLI/App.hpp"
#include "CLI/Config.hpp"
#include "CLI/Formatter.hpp"
#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "lab/bench/attacks/attack.h"
#include "lab/bench/bars.h"
#include "lab/bench/bench_summary.h"
#include "lab/bench/load/server_process.h"

namespace plumescout::lab {
namespace {

std::vector<Attack> AllAttacks() {
  return {WaitersAttack(),     KnownMapAttack(),          FarScansAttack(),
          NarrowBeamsAttack(), SilentConnectionsAttack(), RapidResetAttack(),
          LongPlansAttack(),   WatchersAttack(),          KnownMapReadersAttack(),
          DeleteBusyAttack(),  StopInRefreshAttack(),     LogUnreadAttack(),
          ManyStreamsAttack(), ScatteredReadingsAttack(), HalfRequestsAttack()};
}

struct AttackFlags {
  std::vector<std::string> names;  // empty: all
  double seconds = 6.0;
  bool quick = false;
  bool facts = false;
  AttackSettings settings;
};

// The shortest that shows what does not depend on time.
AttackSettings ForFacts(AttackSettings settings) {
  settings.time = absl::Milliseconds(500);
  settings.warm_up = absl::Milliseconds(200);
  settings.patience = absl::Seconds(60);
  settings.beside_others = true;
  return settings;
}

void JudgeNoTimes(std::vector<Bar>& bars) {
  for (Bar& bar : bars) {
    if (absl::EndsWith(bar.name, ", ms") || absl::EndsWith(bar.name, ", s")) bar.limit.reset();
  }
}

// "plan p99, ms" as a key: "plan_p99_ms".
std::string Key(const std::string& attack, const std::string& bar) {
  std::string key = absl::StrCat(attack, "_");
  for (const char c : bar) {
    const bool plain = absl::ascii_isalnum(static_cast<unsigned char>(c)) != 0;
    if (plain) {
      key.push_back(c);
    } else if (key.back() != '_') {
      key.push_back('_');
    }
  }
  return key;
}

void PrintRow(const Attack& attack, const std::vector<Bar>& bars) {
  std::vector<std::string> asked;
  std::vector<std::string> seen;
  for (const Bar& bar : bars) {
    if (bar.limit.has_value()) asked.push_back(absl::StrCat(bar.name, " <= ", *bar.limit));
    seen.push_back(ToString(bar));
  }
  std::cout << "| " << attack.name << ": " << attack.what << " | " << attack.before << " | "
            << absl::StrJoin(asked, "; ") << " | " << absl::StrJoin(seen, "; ") << " |"
            << std::endl;
}

bool IsWanted(const AttackFlags& flags, const std::string& name) {
  return flags.names.empty() ||
         std::find(flags.names.begin(), flags.names.end(), name) != flags.names.end();
}

absl::Status RunAttacks(AttackFlags flags, BenchSummary& summary) {
  constexpr double kQuick_s = 2.0;
  flags.settings.seed = summary.seed();
  flags.settings.time = absl::Seconds(flags.quick ? kQuick_s : flags.seconds);
  if (flags.facts) flags.settings = ForFacts(std::move(flags.settings));
  std::vector<std::string> broken;
  std::vector<std::function<void()>> rows;
  for (const Attack& attack : AllAttacks()) {
    if (!IsWanted(flags, attack.name)) continue;
    std::cout << "\n# " << attack.name << std::endl;
    absl::StatusOr<std::vector<Bar>> bars = attack.run(flags.settings);
    if (!bars.ok()) {
      std::cerr << attack.name << ": " << bars.status() << std::endl;
      broken.push_back(attack.name);
      continue;
    }
    if (flags.facts) JudgeNoTimes(*bars);
    for (const Bar& bar : *bars) summary.Set(Key(attack.name, bar.name), bar.value);
    if (!AllMet(*bars)) broken.push_back(attack.name);
    rows.push_back([attack, bars = *bars] { PrintRow(attack, bars); });
  }
  std::cout << "\n| attack | before there were limits | asked | seen |\n|---|---|---|---|\n";
  for (const auto& print : rows) print();
  if (broken.empty()) return absl::OkStatus();
  return absl::FailedPreconditionError(absl::StrCat("broken by: ", absl::StrJoin(broken, ", ")));
}

}  // namespace
}  // namespace plumescout::lab

int main(int argc, char** argv) {
  plumescout::lab::AttackFlags flags;
  flags.settings.server_program = plumescout::lab::SiblingProgram("plumescout-server");
  CLI::App app("Attacks servers over loopback, each attack a server of its own.");
  std::vector<std::string> names;
  for (const auto& attack : plumescout::lab::AllAttacks()) names.push_back(attack.name);
  app.add_option("--attack", flags.names, "which; all if none is named")
      ->check(CLI::IsMember(names));
  app.add_option("--seconds", flags.seconds, "how long an attack goes on")
      ->check(CLI::Range(1.0, 3600.0));
  app.add_flag("--quick", flags.quick, "two seconds each");
  app.add_flag("--facts", flags.facts,
               "half a second each, maybe beside other work, and judge no times: whether the "
               "server lives, within its memory, "
               "and answers honest calls");
  app.add_option("--server-program", flags.settings.server_program, "plumescout-server to attack");
  app.add_option("--front-config", flags.settings.front_config,
                 "of HAProxy, such as deploy/haproxy/haproxy.cfg: what a front is to stop goes "
                 "through it, without TLS, and is judged")
      ->check(CLI::ExistingFile);
  return plumescout::lab::RunBench(app, argc, argv,
                                   [&flags](plumescout::lab::BenchSummary& summary) {
                                     return plumescout::lab::RunAttacks(flags, summary);
                                   });
}
