// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "absl/strings/str_format.h"
#include "core/plan/sampling/sampling_rule.h"
#include "core/plan/sampling/survey.h"
#include "core/plan/sampling/ways.h"
#include "core/tour/subset_tour.h"
#include "core/types/rng.h"
#include "core/types/status_macros.h"

namespace plumescout {
namespace {

// Draws of rewards must not follow those of anything else.
constexpr std::uint64_t kRewardStream = 0x726577617264ULL;
constexpr double kNoWay_m = std::numeric_limits<double>::infinity();

std::vector<double> LengthsFrom(const Grid<std::uint8_t>& reachable, Point2 from,
                                const std::vector<Point2>& places) {
  std::vector<double> lengths_m;
  for (const Way& way : WaysFrom(reachable, from, places)) {
    lengths_m.push_back(way.vertices.empty() ? kNoWay_m : way.length_m);
  }
  return lengths_m;
}

// (P2) over the candidates, each of one stop.
absl::StatusOr<SubsetTour> BestCycle(const SamplingQuery& query,
                                     const std::vector<Errand>& candidates) {
  const PlanningOptions& options = query.robot.options;
  std::vector<Point2> places;
  std::vector<double> rewards;
  for (const Errand& candidate : candidates) {
    places.push_back(candidate.stops[0].place);
    rewards.push_back(candidate.reward);
  }
  const std::vector<double> from_start_m = LengthsFrom(query.robot.reachable, query.start, places);
  std::vector<double> between_m;
  for (const Point2 place : places) {
    const std::vector<double> row_m = LengthsFrom(query.robot.reachable, place, places);
    between_m.insert(between_m.end(), row_m.begin(), row_m.end());
  }
  SubsetTourProblem problem{from_start_m, between_m, rewards};
  problem.wanted = std::min(options.sites.cycle_sample_count, static_cast<int>(candidates.size()));
  problem.cycle_s = options.sites.update_period_s;
  problem.sampling_s = options.dwell_s;
  problem.speed_mps = options.speed_mps;
  return BestSubsetTour(problem);
}

class LowToHighRule : public SamplingRule {
 public:
  explicit LowToHighRule(bool at_random) : at_random_(at_random) {}

  absl::StatusOr<SamplingChoice> Choose(const SamplingQuery& query) const override {
    if (query.robot.options.sites.survey) {
      PLUMESCOUT_ASSIGN_OR_RETURN(std::vector<Site> stops, RestOfSurvey(query));
      if (!stops.empty()) {
        const std::string merit = absl::StrFormat(
            "the rest of the survey, %d sites, in the order of the shortest tour", stops.size());
        return SamplingChoice{MissionPhase::kSurvey, {{std::move(stops), 0.0}}, merit};
      }
    }
    return NextCycle(query);
  }

 private:
  absl::StatusOr<SamplingChoice> NextCycle(const SamplingQuery& query) const {
    // The first M of the sorted rewards, Algorithm 1 line 4.
    const std::vector<Errand> candidates =
        BestFirst(Unsampled(query), query.robot.options.sites.candidate_count);
    if (candidates.empty()) return SamplingChoice{};
    PLUMESCOUT_ASSIGN_OR_RETURN(const SubsetTour tour, BestCycle(query, candidates));
    SamplingChoice choice;
    Errand& errand = choice.errands.emplace_back();
    if (tour.order.empty()) {
      // Not even one can be reached in a cycle: the robot takes longer rather than none (ours).
      errand = *std::min_element(candidates.begin(), candidates.end(),
                                 [](const Errand& a, const Errand& b) {
                                   return a.stops[0].travel_m < b.stops[0].travel_m;
                                 });
      choice.merit = absl::StrFormat("no candidate is near enough for one update cycle of %.0f s",
                                     query.robot.options.sites.update_period_s);
      return choice;
    }
    for (const int i : tour.order) {
      errand.stops.push_back(candidates[static_cast<std::size_t>(i)].stops[0]);
    }
    errand.reward = tour.reward;
    choice.merit = absl::StrFormat(
        "greatest %s, %.4g, of %d sets of the best %d that fit into "
        "an update cycle of %.0f s",
        at_random_ ? "random reward" : "reward", errand.reward, tour.feasible_subsets,
        candidates.size(), query.robot.options.sites.update_period_s);
    return choice;
  }

  // Q_u of [LHR], every site by itself, with its reward.
  std::vector<Errand> Unsampled(const SamplingQuery& query) const {
    const RewardTerms terms = TermsOf(query);
    Rng rng(query.seed ^ kRewardStream);
    std::vector<Errand> errands;
    for (const Site& site : query.sites.offered) {
      if (site.sampled) continue;
      errands.push_back({{site}, at_random_ ? rng.Uniform01() : RewardOf(site, terms)});
    }
    return errands;
  }

  bool at_random_;
};

}  // namespace

std::unique_ptr<const SamplingRule> MakeLowToHighRule(bool at_random) {
  return std::make_unique<LowToHighRule>(at_random);
}

}  // namespace plumescout
