// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/store_command.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/types/status_macros.h"
#include "server/base/clock.h"
#include "server/config/config.h"
#include "server/store/store_list.h"
#include "server/store/verify.h"

namespace plumescout::server {
namespace {

constexpr int kExitDamaged = 1;
constexpr int kExitWrongUsage = 2;
// Who waits longer is told what for.
constexpr absl::Duration kSilence = absl::Seconds(2);

struct StoreArguments {
  std::string folder;
  bool json = false;
};

std::string Size(std::int64_t bytes) {
  if (bytes < 1'000'000) return absl::StrFormat("%.1f kB", 1e-3 * static_cast<double>(bytes));
  return absl::StrFormat("%.1f MB", 1e-6 * static_cast<double>(bytes));
}

// A line each, in columns of text that are as wide as they need to be.
void PrintTable(const std::vector<std::vector<std::string>>& lines, std::ostream& out) {
  std::vector<std::size_t> widths;
  for (const auto& line : lines) {
    widths.resize(std::max(widths.size(), line.size()));
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());
  }
  for (const auto& line : lines) {
    for (std::size_t i = 0; i < line.size(); ++i) {
      const bool last = i + 1 == line.size();
      out << line[i] << (last ? "\n" : std::string(widths[i] - line[i].size() + 2, ' '));
    }
  }
}

// Keys of damaged rows may be anything.
void PrintJson(const nlohmann::json& value, std::ostream& out) {
  out << value.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
}

// Says what goes on, but only to who has waited for some time, and not more often than that.
class Patience {
 public:
  explicit Patience(std::ostream& err) : err_(err) {}

  void Note(absl::string_view what, std::int64_t done, std::int64_t of) {
    if (SteadyNow() < next_) return;
    next_ = After(SteadyNow(), kSilence);
    err_ << absl::StrCat(what, ", ", done, " of ", of, " missions done") << std::endl;
  }

 private:
  std::ostream& err_;
  SteadyTime next_ = After(SteadyNow(), kSilence);
};

absl::Status List(const StoreArguments& arguments, std::ostream& out) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const auto missions, ListStore(arguments.folder));
  if (arguments.json) {
    nlohmann::json list = nlohmann::json::array();
    for (const StoredMission& mission : missions) {
      list.push_back({{"mission", mission.key},
                      {"events", mission.head},
                      {"bytes", mission.bytes},
                      {"epoch", mission.epoch}});
    }
    PrintJson(list, out);
    return absl::OkStatus();
  }
  std::vector<std::vector<std::string>> lines = {{"MISSION", "EVENTS", "SIZE", "TAKEN OVER"}};
  for (const StoredMission& mission : missions) {
    lines.push_back({absl::CHexEscape(mission.key), absl::StrCat(mission.head), Size(mission.bytes),
                     absl::StrCat(mission.epoch)});
  }
  PrintTable(lines, out);
  return absl::OkStatus();
}

std::string VerdictOn(const MissionReport& mission) {
  if (!mission.status.ok()) return std::string(mission.status.message());
  if (mission.damaged_snapshots == 0) return "whole";
  return absl::StrCat(mission.damaged_snapshots,
                      " snapshots damaged: it is recovered from an older one, or its events");
}

nlohmann::json ToJson(const StoreReport& report) {
  nlohmann::json missions = nlohmann::json::array();
  for (const MissionReport& mission : report.missions) {
    missions.push_back({{"mission", mission.key},
                        {"whole", mission.is_whole()},
                        {"events", mission.head},
                        {"events_read", mission.records},
                        {"snapshots", mission.snapshots},
                        {"damaged_snapshots", mission.damaged_snapshots},
                        {"bytes", mission.bytes},
                        {"verdict", VerdictOn(mission)}});
  }
  return {{"file", report.file},
          {"whole", report.is_whole()},
          {"faults", report.faults},
          {"missions", missions}};
}

// Whether all is whole.
absl::StatusOr<bool> Verify(const StoreArguments& arguments, std::ostream& out, std::ostream& err) {
  Patience patience(err);
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const StoreReport report,
      VerifyStore(arguments.folder, [&](absl::string_view what, std::int64_t done,
                                        std::int64_t of) { patience.Note(what, done, of); }));
  if (arguments.json) {
    PrintJson(ToJson(report), out);
    return report.is_whole();
  }
  std::vector<std::vector<std::string>> lines = {
      {"MISSION", "EVENTS", "SNAPSHOTS", "SIZE", "VERDICT"}};
  for (const MissionReport& mission : report.missions) {
    lines.push_back({absl::CHexEscape(mission.key),
                     absl::StrCat(mission.records, " of ", mission.head),
                     absl::StrCat(mission.snapshots), Size(mission.bytes), VerdictOn(mission)});
  }
  PrintTable(lines, out);
  for (const std::string& fault : report.faults) out << fault << "\n";
  out << report.file << (report.is_whole() ? " is whole\n" : " is damaged\n");
  return report.is_whole();
}

int Fail(const absl::Status& status, std::ostream& err) {
  err << "plumescout-server store: " << status.message() << "\n";
  return kExitDamaged;
}

}  // namespace

int RunStoreCommand(int argc, const char* const* argv, std::ostream& out, std::ostream& err) {
  CLI::App app("Looks at what a server has kept, while none runs on it.",
               "plumescout-server store");
  app.require_subcommand(1);
  StoreArguments arguments;
  std::string output = "table";
  const auto add = [&](const char* name, const char* what) {
    CLI::App* command = app.add_subcommand(name, what);
    command->add_option("--data", arguments.folder, "the folder; default: the server's")
        ->type_name("DIR");
    command->add_option("--output", output)->check(CLI::IsMember({"table", "json"}));
    return command;
  };
  const CLI::App* list = add("list", "which missions there are");
  add("verify", "read everything, and say what is damaged");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error, out, err) == 0 ? EXIT_SUCCESS : kExitWrongUsage;
  }
  arguments.json = output == "json";
  const auto folder = StoreFolder(StoreConfig{.folder = arguments.folder});
  if (!folder.ok()) return Fail(folder.status(), err);
  arguments.folder = *folder;
  if (list->parsed()) {
    const absl::Status listed = List(arguments, out);
    return listed.ok() ? EXIT_SUCCESS : Fail(listed, err);
  }
  const auto whole = Verify(arguments, out, err);
  if (!whole.ok()) return Fail(whole.status(), err);
  return *whole ? EXIT_SUCCESS : kExitDamaged;
}

}  // namespace plumescout::server
