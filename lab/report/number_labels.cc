// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/report/number_labels.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"

namespace plumescout::lab {
namespace {

struct FigureLabel {
  const char* figure;
  const char* label;
  const char* unit = "";
  double per_unit = 1.0;  // of the figure
  bool yes_or_no = false;
};

constexpr FigureLabel kFigures[] = {
    {"completeness", "Map complete", " %", 100.0},
    {"rmse_ppm", "Gas map, RMSE", " ppm"},
    {"rmse_zero_ppm", "RMSE of a map of zeros", " ppm"},
    {"entropy_nats", "Entropy of the gas map", " nats"},
    {"nlpd_nats", "NLPD of critical cells", " nats"},
    {"within_1_sigma", "Critical cells within 1 σ (ideal: 68 %)", " %", 100.0},
    {"within_2_sigma", "Critical cells within 2 σ (ideal: 95 %)", " %", 100.0},
    {"rms_z", "Error over σ, rms (ideal: 1)"},
    {"plans", "Plans"},
    {"plan_cpu_ms_p50", "Plan, CPU, median", " ms"},
    {"plan_rpc_wall_ms_p99", "Plan, call, 99 of 100 within", " ms"},
    {"simulated_s", "Time in the building", " s"},
    {"wall_s", "Time to simulate it", " s"},
    {"readings_sent", "Gas readings sent"},
    {"readings_applied", "Gas readings in the map"},
    {"distance_m", "Driven", " m"},
    {"collisions", "Collisions"},
    {"mission_complete", "Mission complete", "", 1.0, true},
    {"robots", "Robots"},
    {"closest_m", "Two robots came as near as", " m"},
    {"contacts", "Robots ran into each other", " times"},
    {"legs", "Legs driven"},
    {"blocked_legs", "Legs ended by something in the way"},
    {"server_killed_at_s", "Server killed, and started again, at", " s"},
};

constexpr const char* kAbout[][2] = {{"machine", "Processor"}, {"load", "Load of the machine"},
                                     {"build_type", "Build"},  {"seed", "Seed"},
                                     {"version", "Version"},   {"scene", "Scene"},
                                     {"strategy", "Strategy"}};

std::string ValueText(double value, const FigureLabel& label) {
  if (label.yes_or_no) return value > 0.0 ? "yes" : "no";
  constexpr double kThreeDigits = 100.0;
  const double shown = label.per_unit * value;
  const std::string number = std::abs(shown) >= kThreeDigits ? absl::StrFormat("%.0f", shown)
                                                             : absl::StrFormat("%.3g", shown);
  return absl::StrCat(number, label.unit);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> LabelledNumbers(const Summary& summary) {
  std::vector<std::pair<std::string, std::string>> numbers;
  for (const auto& [name, value] : summary.figures) {
    if (!std::isfinite(value)) continue;
    const auto* const known = std::find_if(std::begin(kFigures), std::end(kFigures),
                                           [&](const auto& label) { return name == label.figure; });
    const FigureLabel label =
        known != std::end(kFigures) ? *known : FigureLabel{name.c_str(), name.c_str()};
    numbers.emplace_back(label.label, ValueText(value, label));
  }
  for (const auto& [name, text] : summary.about) {
    const auto* const known = std::find_if(std::begin(kAbout), std::end(kAbout),
                                           [&](const auto& label) { return name == label[0]; });
    numbers.emplace_back(known != std::end(kAbout) ? (*known)[1] : name, text);
  }
  return numbers;
}

}  // namespace plumescout::lab
