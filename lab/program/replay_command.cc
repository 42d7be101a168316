// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/replay_command.h"

#include <cstdint>
#include <iostream>
#include <memory>
#include <string>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "core/belief/belief.h"
#include "core/types/status_macros.h"
#include "lab/program/progress_line.h"
#include "lab/program/recording.h"
#include "lab/program/run_folder.h"

namespace plumescout::lab {
namespace {

struct ReplayArguments {
  std::string recording;
  std::string out = "out/replay";
  std::int64_t revision = 0;
};

absl::Status ReplayRecording(const ReplayArguments& arguments) {
  ProgressLine progress(absl::Seconds(2));
  PLUMESCOUT_ASSIGN_OR_RETURN(Recording recording, Recording::Open(arguments.recording));
  std::cerr << VersionRemark(recording.code_version());
  const absl::Time start = absl::Now();
  PLUMESCOUT_ASSIGN_OR_RETURN(
      const std::unique_ptr<Mission> mission,
      Replay(recording, arguments.revision, [&](double share) {
        progress.Show(absl::StrCat(ProgressWithTimeLeft(share, absl::Now() - start), "  replay"));
      }));
  std::cerr << EndRemark(recording);
  const MapSnapshot map = MakeMapSnapshot(*mission->Snapshot());
  PLUMESCOUT_RETURN_IF_ERROR(WriteMapFiles(map, arguments.out));
  progress.Finish(absl::StrCat("Replayed ", map.revision, " events of ", map.robots.size(),
                               map.robots.size() == 1 ? " robot" : " robots"));
  std::cout << arguments.out << "/map.yaml\n";
  return absl::OkStatus();
}

}  // namespace

void AddReplayCommand(CLI::App& app, absl::Status& status) {
  CLI::App* replay =
      app.add_subcommand("replay", "Make the map of a recorded mission again, bit for bit");
  const auto arguments = std::make_shared<ReplayArguments>();
  replay->add_option("recording", arguments->recording, "File, of robot --record")
      ->required()
      ->check(CLI::ExistingFile);
  replay->add_option("--out", arguments->out, "Folder for map and gas fields")
      ->capture_default_str();
  replay
      ->add_option("--revision", arguments->revision,
                   "Number of the event after which to stop; 0: the last")
      ->capture_default_str();
  replay->callback([arguments, &status] { status = ReplayRecording(*arguments); });
}

}  // namespace plumescout::lab
