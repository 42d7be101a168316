// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bench/bench_program.h"

#include "CLI/App.hpp"
#include "CLI/Config.hpp"
#include "CLI/Formatter.hpp"
#include "CLI/Validators.hpp"

namespace plumescout::lab {

BenchProgram::BenchProgram(const std::string& purpose)
    : app_(std::make_unique<CLI::App>(purpose)) {}

BenchProgram::~BenchProgram() = default;

BenchProgram& BenchProgram::AddCount(const std::string& flag, int& count, const std::string& help) {
  app_->add_option(flag, count, help)->check(CLI::PositiveNumber)->capture_default_str();
  return *this;
}

BenchProgram& BenchProgram::AddText(const std::string& flag, std::string& text,
                                    const std::string& help) {
  app_->add_option(flag, text, help);
  return *this;
}

BenchProgram& BenchProgram::AddSwitch(const std::string& flag, bool& on, const std::string& help) {
  app_->add_flag(flag, on, help);
  return *this;
}

int BenchProgram::Run(int argc, char** argv,
                      const std::function<absl::Status(BenchSummary&)>& body) {
  return RunBench(*app_, argc, argv, body);
}

}  // namespace plumescout::lab
