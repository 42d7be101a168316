// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/bench_summary.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>

#include "CLI/App.hpp"
#include "CLI/Config.hpp"
#include "CLI/Formatter.hpp"
#include "lab/about/about.h"

namespace plumescout::lab {

BenchSummary::BenchSummary(std::uint64_t seed) : seed_(seed) {
  summary_.about = AboutThisRun(seed);
}

void BenchSummary::Set(const std::string& name, double value) {
  if (!std::isfinite(value)) return;
  std::cout << name << " = " << value << std::endl;
  auto& figures = summary_.figures;
  const auto same = std::find_if(figures.begin(), figures.end(),
                                 [&name](const auto& figure) { return figure.first == name; });
  if (same != figures.end()) {
    same->second = value;
  } else {
    figures.emplace_back(name, value);
  }
}

int RunBench(CLI::App& app, int argc, char** argv,
             const std::function<absl::Status(BenchSummary&)>& body) {
  std::string path;
  std::uint64_t seed = 1;
  app.add_option("--summary", path, "Write the figures to this JSON file");
  app.add_option("--seed", seed, "Seed of everything drawn at random")
      ->check(CLI::Range(0, std::numeric_limits<int>::max()))
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  }
  BenchSummary summary(seed);
  absl::Status status = body(summary);
  // What was measured counts even if a bar was missed.
  if (!path.empty()) status.Update(WriteSummary(summary.summary(), path));
  if (status.ok()) return EXIT_SUCCESS;
  std::cerr << status << std::endl;
  return EXIT_FAILURE;
}

}  // namespace plumescout::lab
