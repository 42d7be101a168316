// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/export_command.h"

#include <iostream>
#include <memory>
#include <string>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "core/types/status_macros.h"
#include "formats/view/mission_view.h"
#include "lab/program/mcap_export.h"
#include "lab/program/progress_line.h"
#include "lab/program/recording.h"

namespace plumescout::lab {
namespace {

struct ExportArguments {
  std::string recording;
  std::string file;
  double map_period_s = 10.0;
  double map_share = MissionView::kMapShare;
};

absl::Status ExportRecording(const ExportArguments& arguments) {
  ProgressLine progress(absl::Seconds(2));
  PLUMESCOUT_ASSIGN_OR_RETURN(Recording recording, Recording::Open(arguments.recording));
  std::cerr << VersionRemark(recording.code_version());
  const absl::Time start = absl::Now();
  PLUMESCOUT_RETURN_IF_ERROR(ExportMcap(
      recording, arguments.file, arguments.map_period_s, arguments.map_share, [&](double share) {
        progress.Show(absl::StrCat(ProgressWithTimeLeft(share, absl::Now() - start), "  export"));
      }));
  std::cerr << EndRemark(recording);
  progress.Finish("Exported");
  std::cout << arguments.file << "\n";
  return absl::OkStatus();
}

}  // namespace

void AddExportCommand(CLI::App& app, absl::Status& status) {
  CLI::App* command = app.add_subcommand(
      "export", "Write a recorded mission as an MCAP file, to look at and to replay");
  const auto arguments = std::make_shared<ExportArguments>();
  command->add_option("recording", arguments->recording, "File, of robot --record or a server")
      ->required()
      ->check(CLI::ExistingFile);
  command->add_option("file", arguments->file, "The MCAP file")->required();
  command
      ->add_option("--map-period", arguments->map_period_s,
                   "Seconds of the mission between maps, at least; 0: a map after each event")
      ->check(CLI::Range(0.0, 1e9))
      ->capture_default_str();
  command
      ->add_option("--map-share", arguments->map_share,
                   "Of the journal's bytes that maps may take: a layer that is too large for that "
                   "is shown less often, but for the first and the last; inf: as often as "
                   "--map-period says")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command->callback([arguments, &status] { status = ExportRecording(*arguments); });
}

}  // namespace plumescout::lab
