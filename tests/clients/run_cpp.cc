// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
// Runs the scenario with the C++ client: run_cpp TARGET SCENARIO; see README.md.

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <utility>

#include "absl/time/clock.h"
#include "client/error_reason.h"
#include "proto/convert/status.h"
#include "tests/clients/cpp_steps.h"

namespace plumescout::client {
namespace {

// Prints what a step brought. False if that is no answer of a server.
bool Print(const std::string& kind, const Answer& answer) {
  Json line = {{"do", kind}};
  if (answer.ok()) {
    line["result"] = *answer;
  } else if (Reason(answer.status()).empty()) {
    std::cerr << kind << ": " << answer.status() << "\n";
    return false;
  } else {
    line["error"] = {{"code", absl::StatusCodeToString(answer.status().code())},
                     {"reason", Reason(answer.status())},
                     {"fields", RefusedFields(answer.status())}};
  }
  std::cout << line.dump() << std::endl;
  return true;
}

// A server that takes a mission over is asked again, as robots do (RobotLoop).
Answer RunPatiently(const Steps& run, const std::string& kind, const Json& with) {
  constexpr absl::Duration kPatience = absl::Seconds(30);
  constexpr absl::Duration kPause = absl::Milliseconds(100);
  const absl::Time give_up = absl::Now() + kPatience;
  Answer answer = run(kind, with);
  while (absl::IsUnavailable(answer.status()) && absl::Now() < give_up) {
    absl::SleepFor(kPause);
    answer = run(kind, with);
  }
  return answer;
}

int Run(const std::string& target, const std::string& path) {
  Json scenario = Json::parse(std::ifstream(path));
  const Json steps = scenario["steps"];
  const Steps run = MakeSteps(target, std::move(scenario));
  for (const Json& step : steps) {
    const std::string kind = step["do"];
    const bool is_restart = kind == "restart";
    const Answer answer = is_restart ? Answer(Json::object())
                                     : RunPatiently(run, kind, step.value("with", Json::object()));
    if (!Print(kind, answer)) return EXIT_FAILURE;
    std::string restarted;
    if (is_restart) std::getline(std::cin, restarted);
  }
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace plumescout::client

int main(int argc, char** argv) {
  if (argc == 3) return plumescout::client::Run(argv[1], argv[2]);
  std::cerr << "usage: run_cpp TARGET SCENARIO\n";
  return EXIT_FAILURE;
}
