// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/program/plan_json.h"

#include <nlohmann/json.hpp>

#include "lab/report/plan_names.h"

namespace plumescout::lab {
namespace {

using Json = nlohmann::ordered_json;

Json ToJson(Point2 point) { return Json::array({point.x_m, point.y_m}); }

Json ToJson(const Goal& goal) {
  return {{"kind", NameOf(goal.kind)},
          {"position_m", ToJson(goal.position)},
          {"frontier_centroid_m", ToJson(goal.centroid)},
          {"frontier_cells", goal.frontier_cells}};
}

Json ToJson(const Candidate& candidate) {
  Json json = {{"goal", ToJson(candidate.goal)},
               {"path_source", NameOf(candidate.path_source)},
               {"cost", candidate.cost},
               {"information_penalty", candidate.information_penalty},
               {"length_m", candidate.length_m},
               {"duration_s", candidate.duration_s},
               {"mean_ucb", candidate.mean_ucb},
               {"mean_concentration_ppm", candidate.mean_concentration_ppm}};
  if (candidate.expected_information_nats) {
    json["expected_information_nats"] = *candidate.expected_information_nats;
  }
  if (candidate.information_bound_nats) {
    json["information_bound_nats"] = *candidate.information_bound_nats;
  }
  json["path_m"] = Json::array();
  for (const Point2& vertex : candidate.path) json["path_m"].push_back(ToJson(vertex));
  return json;
}

Json ToJson(const RejectedGoal& rejected) {
  return {{"goal", ToJson(rejected.goal)},
          {"reason", NameOf(rejected.reason)},
          {"detail", rejected.detail}};
}

}  // namespace

std::string PlanToJson(const Plan& plan, std::size_t tree_edges) {
  Json json = {{"robot", plan.robot},
               {"strategy", plan.strategy},
               {"belief_revision", plan.belief_revision},
               {"seed", plan.seed},
               {"phase", NameOf(plan.phase)},
               {"end", NameOf(plan.end)},
               {"explanation", plan.explanation},
               {"chosen", plan.chosen},
               {"trajectory_length_m", plan.trajectory.length_m},
               {"trajectory_duration_s", plan.trajectory.duration_s},
               {"field_flat", plan.field_flat},
               {"goal_kept", plan.goal_kept},
               {"start_escaped", plan.start_escaped},
               {"replan_after_s", plan.replan_after_s},
               {"waits_for", plan.waits_for}};
  json["effort"] = {{"samples", plan.effort.samples},
                    {"vertices", plan.effort.vertices},
                    {"tree_edges", tree_edges},
                    {"edges_evaluated", plan.effort.edges_evaluated},
                    {"goals_by_guard", plan.effort.goals_by_guard},
                    {"batches", plan.effort.batches}};
  json["candidates"] = Json::array();
  for (const Candidate& candidate : plan.candidates) {
    json["candidates"].push_back(ToJson(candidate));
  }
  json["rejected"] = Json::array();
  for (const RejectedGoal& rejected : plan.rejected) json["rejected"].push_back(ToJson(rejected));
  constexpr int kIndent = 2;
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace plumescout::lab
