// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/team_arguments.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "core/types/status_macros.h"

namespace plumescout::lab {
namespace {

// A text of numbers with colons between them, the first of which is a robot's.
struct OfRobot {
  std::size_t robot = 0;        // from 0
  std::vector<double> numbers;  // the others
};

absl::Status Wrong(const char* option, const std::string& text, const std::string& rule) {
  return absl::InvalidArgumentError(absl::StrCat(option, " ", text, " ", rule));
}

// `form` says what there is to be, its last part in brackets if that may be left out.
absl::StatusOr<OfRobot> ParseOfRobot(const char* option, const std::string& text,
                                     const std::string& form, int robots) {
  const std::vector<std::string> parts = absl::StrSplit(text, ':');
  const auto most = static_cast<std::size_t>(1 + std::count(form.begin(), form.end(), ':'));
  const std::size_t least = form.back() == ']' ? most - 1 : most;
  OfRobot parsed;
  int who = 0;
  bool is_ok = parts.size() >= least && parts.size() <= most && absl::SimpleAtoi(parts[0], &who);
  for (std::size_t i = 1; is_ok && i < parts.size(); ++i) {
    is_ok = absl::SimpleAtod(parts[i], &parsed.numbers.emplace_back()) &&
            std::isfinite(parsed.numbers.back());
  }
  if (!is_ok) return Wrong(option, text, absl::StrCat("must be ", form));
  if (who < 1 || who > robots) {
    return Wrong(option, text, absl::StrCat("is of robot ", who, ", of ", robots));
  }
  parsed.robot = static_cast<std::size_t>(who - 1);
  return parsed;
}

absl::Status CheckCount(const char* option, const std::vector<double>& values, int robots) {
  if (static_cast<int>(values.size()) <= robots) return absl::OkStatus();
  return absl::InvalidArgumentError(
      absl::StrCat(option, " has ", values.size(), " values for --robots ", robots));
}

absl::Status AddOutages(const char* option, OutageKind kind, const std::vector<std::string>& texts,
                        std::vector<RobotTraits>& traits) {
  const char* const form = kind == OutageKind::kLinkLost ? "WHO:AT:FOR" : "WHO:AT[:FOR]";
  for (const std::string& text : texts) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const OfRobot parsed,
                                ParseOfRobot(option, text, form, static_cast<int>(traits.size())));
    Outage outage{kind, parsed.numbers[0]};
    if (parsed.numbers.size() > 1) outage.for_s = parsed.numbers[1];
    if (const absl::Status status = Validate({outage}); !status.ok()) {
      return Wrong(option, text, absl::StrCat("is wrong: ", status.message()));
    }
    traits[parsed.robot].outages.push_back(outage);
  }
  return absl::OkStatus();
}

absl::Status AddJumps(const std::vector<std::string>& texts, std::vector<RobotTraits>& traits) {
  constexpr char kOption[] = "--pose-jump";
  constexpr double kRadiansPerDegree = M_PI / 180.0;
  for (const std::string& text : texts) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const OfRobot parsed,
                                ParseOfRobot(kOption, text, "WHO:AT:METRES:DEGREES[:AFTER]",
                                             static_cast<int>(traits.size())));
    const std::vector<double>& numbers = parsed.numbers;
    PoseJumpOptions jump{
        .at_s = numbers[0], .east_m = numbers[1], .turn_rad = numbers[2] * kRadiansPerDegree};
    if (numbers.size() > 3) jump.corrected_after_s = numbers[3];
    if (const absl::Status status = Validate(jump); !status.ok()) {
      return Wrong(kOption, text, absl::StrCat("is wrong: ", status.message()));
    }
    if (traits[parsed.robot].jump) return Wrong(kOption, text, "is that robot's second jump");
    traits[parsed.robot].jump = jump;
  }
  return absl::OkStatus();
}

double Of(const std::vector<double>& values, std::size_t robot) {
  return values.empty() ? 0.0 : values[robot % values.size()];
}

}  // namespace

void AddTeamOptions(CLI::App& app, TeamArguments& arguments) {
  app.option_defaults()->group(
      "Team (lists have a value for each robot and begin again; WHO counts "
      "from 1; times in seconds)");
  app.add_option("--speeds", arguments.speeds_mps,
                 "Top speeds, metres a second, as 1.25,0.5. Plans are timed for the greatest, or "
                 "for --speed: slower robots fall behind them. A leg is given up after 3 times "
                 "its planned time and 10 s, so robots of less than a third give up long ones")
      ->delimiter(',')
      ->check(CLI::PositiveNumber)
      ->default_str("");
  app.add_option("--clock-offset", arguments.clock_offsets_s,
                 "By how many seconds clocks are ahead, as 0,3600,-5; with --record or --realtime")
      ->delimiter(',')
      ->default_str("");
  app.add_option("--clock-drift", arguments.clock_drifts_ppm,
                 "By how many parts per million clocks are too fast, as 0,100; likewise")
      ->delimiter(',')
      ->default_str("");
  app.add_option("--dropout", arguments.dropouts,
                 "WHO:AT[:FOR] falls silent where it stands, for so long or for good, and then "
                 "registers again; may be given several times, as the next three")
      ->default_str("");
  app.add_option("--leave", arguments.leaves,
                 "WHO:AT[:FOR] takes leave of the mission, for so long or for good")
      ->default_str("");
  app.add_option(
         "--link-loss", arguments.link_losses,
         "WHO:AT:FOR has no link for so long: it follows its path to the end, keeps what it "
         "senses, and sends it afterwards")
      ->default_str("");
  app.add_option("--pose-jump", arguments.pose_jumps,
                 "WHO:AT:METRES:DEGREES[:AFTER] holds itself to be so far east of where it is, and "
                 "turned; it finds out, and corrects its poses, so long AFTER, or never")
      ->default_str("");
}

bool HasWrongClocks(const TeamArguments& arguments) {
  const auto is_off = [](double value) { return value != 0.0; };
  return std::any_of(arguments.clock_offsets_s.begin(), arguments.clock_offsets_s.end(), is_off) ||
         std::any_of(arguments.clock_drifts_ppm.begin(), arguments.clock_drifts_ppm.end(), is_off);
}

absl::StatusOr<std::vector<RobotTraits>> MakeTraits(const TeamArguments& arguments, int robots) {
  PLUMESCOUT_RETURN_IF_ERROR(CheckCount("--speeds", arguments.speeds_mps, robots));
  PLUMESCOUT_RETURN_IF_ERROR(CheckCount("--clock-offset", arguments.clock_offsets_s, robots));
  PLUMESCOUT_RETURN_IF_ERROR(CheckCount("--clock-drift", arguments.clock_drifts_ppm, robots));
  std::vector<RobotTraits> traits(static_cast<std::size_t>(robots));
  for (std::size_t i = 0; i < traits.size(); ++i) {
    if (!arguments.speeds_mps.empty()) traits[i].top_speed_mps = Of(arguments.speeds_mps, i);
    traits[i].clock = {Of(arguments.clock_offsets_s, i), Of(arguments.clock_drifts_ppm, i)};
  }
  PLUMESCOUT_RETURN_IF_ERROR(
      AddOutages("--dropout", OutageKind::kSilent, arguments.dropouts, traits));
  PLUMESCOUT_RETURN_IF_ERROR(AddOutages("--leave", OutageKind::kLeaves, arguments.leaves, traits));
  PLUMESCOUT_RETURN_IF_ERROR(
      AddOutages("--link-loss", OutageKind::kLinkLost, arguments.link_losses, traits));
  PLUMESCOUT_RETURN_IF_ERROR(AddJumps(arguments.pose_jumps, traits));
  for (std::size_t i = 0; i < traits.size(); ++i) {
    std::vector<Outage>& outages = traits[i].outages;
    std::stable_sort(outages.begin(), outages.end(),
                     [](const Outage& a, const Outage& b) { return a.at_s < b.at_s; });
    if (const absl::Status status = Validate(outages); !status.ok()) {
      return absl::InvalidArgumentError(
          absl::StrCat("--dropout, --leave, --link-loss of robot ", i + 1, ": ", status.message()));
    }
  }
  return traits;
}

}  // namespace plumescout::lab
