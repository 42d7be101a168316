// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "absl/status/status.h"
#include "lab/bench/bench_summary.h"

namespace CLI {
class App;
}

namespace plumescout::lab {

// The command line of a bench that asks for little. CLI11 stays out of the benches' sources: its
// headers take longer to compile than a bench.
class BenchProgram {
 public:
  explicit BenchProgram(const std::string& purpose);
  ~BenchProgram();
  BenchProgram(const BenchProgram&) = delete;
  BenchProgram& operator=(const BenchProgram&) = delete;

  // Flags such as "--worlds". What they are read into outlives Run.
  BenchProgram& AddCount(const std::string& flag, int& count, const std::string& help);  // >= 1
  BenchProgram& AddText(const std::string& flag, std::string& text, const std::string& help);
  BenchProgram& AddSwitch(const std::string& flag, bool& on, const std::string& help);

  // As RunBench.
  int Run(int argc, char** argv, const std::function<absl::Status(BenchSummary&)>& body);

 private:
  const std::unique_ptr<CLI::App> app_;
};

}  // namespace plumescout::lab
