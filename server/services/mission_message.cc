// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/services/mission_message.h"

#include "core/types/error_reason.h"
#include "core/types/objective.h"
#include "proto/convert/enums.h"
#include "proto/convert/keep_out.h"
#include "proto/convert/names.h"
#include "proto/convert/objective.h"
#include "proto/convert/options.h"
#include "server/services/mission_update.h"

namespace plumescout::server {
namespace {

using plumescout::ToProto;  // the one below overloads these rather than hide them

v1::Latency ToProto(const LatencyFigures& figures) {
  v1::Latency proto;
  proto.set_sample_count(figures.samples);
  proto.set_median_s(absl::ToDoubleSeconds(figures.median));
  proto.set_p99_s(absl::ToDoubleSeconds(figures.p99));
  proto.set_max_s(absl::ToDoubleSeconds(figures.max));
  return proto;
}

v1::MissionState ToProto(MissionState state) {
  switch (state) {
    case MissionState::kRunning:
      return v1::MISSION_STATE_RUNNING;
    case MissionState::kPaused:
      return v1::MISSION_STATE_PAUSED;
    case MissionState::kFinished:
      return v1::MISSION_STATE_FINISHED;
  }
  return v1::MISSION_STATE_UNSPECIFIED;
}

}  // namespace

MissionOptions WithoutPriorMap(MissionOptions options) {
  options.prior_map = nullptr;
  return options;
}

v1::Mission DescribeMission(MissionHost& host, const MissionOptions& options,
                            const std::string& node) {
  const MissionSummary summary = host.summary();
  v1::Mission proto;
  proto.set_name(MissionResource(host.id()));
  *proto.mutable_options() = ToProto(options);
  *proto.mutable_options()->mutable_keep_out() = ToProto(summary.options->keep_out);
  proto.mutable_options()->mutable_gas()->set_lattice_factor(summary.lattice_factor);
  proto.mutable_memory()->set_used_bytes(summary.memory_bytes);
  proto.mutable_memory()->set_budget_bytes(options.memory_budget_bytes);
  proto.set_owner(host.owner());
  proto.set_node(node);
  proto.set_state(ToProto(host.standing().state()));
  SetIdleTimeToLive(host.standing().idle_time_to_live(), proto);
  proto.set_event_retention(server::EventRetentionToProto(host.standing().event_retention()));
  proto.set_revision(summary.revision);
  proto.set_phase(ToProto(summary.phase));
  if (summary.next_map_update_ns) proto.set_next_map_update_ns(*summary.next_map_update_ns);
  if (summary.objective) {
    *proto.mutable_objective() = ToProto(*summary.objective);
    proto.mutable_objective()->set_explanation(
        Describe(*summary.objective, summary.options->objective));
  }
  proto.set_robot_count(host.leases().robot_count());
  const GasTimings timings = host.gas_timings();
  *proto.mutable_gas_timings()->mutable_update() = ToProto(timings.update);
  *proto.mutable_gas_timings()->mutable_staleness() = ToProto(timings.staleness);
  return proto;
}

v1::Mission DescribeMission(const OwnedMission& owned) {
  v1::Mission proto;
  proto.set_name(MissionResource(MissionIdOf(owned.key)));
  proto.set_node(owned.node);
  proto.set_state(!owned.damage.empty() ? v1::MISSION_STATE_DAMAGED
                  : owned.node.empty()  ? v1::MISSION_STATE_SLEEPING
                                        : v1::MISSION_STATE_ELSEWHERE);
  proto.set_damage(owned.damage);
  return proto;
}

v1::Mission DescribeMission(const AbsentMission& absent, const std::string& node) {
  v1::Mission proto;
  proto.set_node(node);
  proto.set_name(MissionResource(MissionIdOf(absent.key)));
  if (absent.is_asleep) {
    proto.set_state(v1::MISSION_STATE_SLEEPING);
  } else if (ErrorReason(absent.status) == reason::kRecovering) {
    proto.set_state(v1::MISSION_STATE_RECOVERING);
  } else {
    proto.set_state(v1::MISSION_STATE_DAMAGED);
    proto.set_damage(std::string(absent.status.message()));
  }
  return proto;
}

}  // namespace plumescout::server
