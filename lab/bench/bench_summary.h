// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "lab/formats/summary.h"

namespace CLI {
class App;
}

namespace plumescout::lab {

// Figures of one run, and what they were measured on; see lab/formats/summary.h for the file.
class BenchSummary {
 public:
  explicit BenchSummary(std::uint64_t seed);

  std::uint64_t seed() const { return seed_; }

  // Adds a figure and prints it. A value that is not finite was not measured and is left out.
  // Setting a name again replaces its value.
  void Set(const std::string& name, double value);

  const Summary& summary() const { return summary_; }

 private:
  std::uint64_t seed_;
  Summary summary_;
};

// The main function of a bench: adds the flags `--summary FILE` and `--seed N` to those that `app`
// has already, runs `body`, writes the summary, also of what was measured before `body` failed.
// Returns the exit code.
int RunBench(CLI::App& app, int argc, char** argv,
             const std::function<absl::Status(BenchSummary&)>& body);

}  // namespace plumescout::lab
