// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
//
// plumescout-lab: what researchers use and robots never need.
#include <cstdlib>
#include <iostream>

#include "CLI/CLI.hpp"
#include "absl/status/status.h"
#include "lab/program/experiment_command.h"
#include "lab/program/export_command.h"
#include "lab/program/ingest_command.h"
#include "lab/program/plan_command.h"
#include "lab/program/replay_command.h"
#include "lab/program/robot_command.h"
#include "lab/program/scene_command.h"

int main(int argc, char** argv) {
  // One thread for BLAS: its own threads give sparse factorisation nothing.
  setenv("OPENBLAS_NUM_THREADS", "1", 0);
  CLI::App app{"Simulated robots, gas scenes and studies for PlumeScout."};
  app.require_subcommand(1);
  absl::Status status;
  plumescout::lab::AddExperimentCommand(app, status);
  plumescout::lab::AddExportCommand(app, status);
  plumescout::lab::AddIngestCommand(app, status);
  plumescout::lab::AddPlanCommand(app, status);
  plumescout::lab::AddReplayCommand(app, status);
  plumescout::lab::AddRobotCommand(app, status);
  plumescout::lab::AddSceneCommand(app, status);
  CLI11_PARSE(app, argc, argv);
  if (status.ok()) return EXIT_SUCCESS;
  std::cerr << "plumescout-lab: " << status.message() << "\n";
  return EXIT_FAILURE;
}
