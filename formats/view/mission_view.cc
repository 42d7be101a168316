// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/view/mission_view.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <variant>

#include "absl/strings/str_cat.h"
#include "core/mission/observation_check.h"
#include "core/types/status_macros.h"
#include "formats/mcap/mcap_journal.h"
#include "formats/zstd_codec.h"
#include "proto/convert/event_line.h"
#include "proto/convert/foxglove.h"

namespace plumescout {
namespace {

std::string WriterName(const JournalStart& start) {
  return absl::StrCat("plumescout ", start.code_version);
}

std::int64_t Nanoseconds(double seconds) {
  constexpr double kSecond_ns = 1e9;
  constexpr double kMost_s = 1e9;
  return std::llround(kSecond_ns * std::clamp(seconds, 0.0, kMost_s));
}

Grid<float> StandardDeviation(const Grid<float>& variance) {
  Grid<float> stddev = variance;
  for (float& value : stddev.values()) value = std::sqrt(value);
  return stddev;
}

// Whether histories in words are the clearer for it.
bool IsNews(v1::MissionEventKind kind) {
  switch (kind) {
    case v1::MISSION_EVENT_KIND_SCAN:
    case v1::MISSION_EVENT_KIND_GAS_READING:
    case v1::MISSION_EVENT_KIND_REFRESH:
    case v1::MISSION_EVENT_KIND_EPOCH_BEGUN:
    case v1::MISSION_EVENT_KIND_EPOCH_ADOPTED:
    case v1::MISSION_EVENT_KIND_ROBOT_STATUS:
      return false;
    default:
      return true;
  }
}

}  // namespace

MapTimer::MapTimer(double period_s) : period_ns_(Nanoseconds(period_s)) {}

bool MapTimer::IsDue(const Event& event, std::int64_t sample_time_ns) {
  has_seen_ = has_seen_ || std::holds_alternative<ObservationReceived>(event.body);
  return has_seen_ && plumescout::IsDue(sample_time_ns, period_ns_, shown_ns_);
}

MissionMoment MomentAfter(Event event, const Applied& applied, const Mission& mission,
                          MapTimer& timer) {
  MissionMoment moment{.event = std::move(event),
                       .record = {},
                       .applied = applied,
                       .sample_time_ns = mission.sample_time_ns()};
  if (const auto* received = std::get_if<ObservationReceived>(&moment.event.body)) {
    const auto robot = mission.StateOf(received->robot);
    if (robot.ok()) moment.robot = *robot;
  }
  if (timer.IsDue(moment.event, moment.sample_time_ns)) moment.belief = mission.Snapshot();
  return moment;
}

MissionView::MissionView(const JournalStart& start, double map_share)
    : mission_id_(start.mission.empty() ? "recording" : start.mission),
      start_(EncodeStart(start)),
      encoder_(WriterName(start)),
      ration_(map_share),
      journal_(encoder_.AddChannel(kMcapJournalTopic, kMcapJournalEncoding, 0)) {}

absl::Status MissionView::Add(MissionMoment moment) {
  if (!has_begun_ && !moment.robot && moment.sample_time_ns == 0) {
    early_bytes_ += sizeof(MissionMoment) + moment.record.size();
    early_.push_back(std::move(moment));
    return early_bytes_ < kMostEarlyBytes ? absl::OkStatus() : Begin();
  }
  now_ns_ = std::max(now_ns_, moment.sample_time_ns);
  if (!has_begun_) PLUMESCOUT_RETURN_IF_ERROR(Begin());
  return AddShown(moment);
}

absl::Status MissionView::AddShown(const MissionMoment& moment) {
  McapTimes times{now_ns_, now_ns_};
  const auto* received = std::get_if<ObservationReceived>(&moment.event.body);
  if (received != nullptr && moment.robot) {
    times.publish_ns = std::max(
        std::int64_t{0}, MissionTime_ns(received->observation, moment.robot->clock_offset_ns));
  }
  PLUMESCOUT_RETURN_IF_ERROR(AddRecord(moment.event.number, moment.record, times));
  return Show(moment, times);
}

// Now there is a time, or none is waited for any more.
absl::Status MissionView::Begin() {
  has_begun_ = true;
  PLUMESCOUT_RETURN_IF_ERROR(AddRecord(0, start_, {now_ns_, now_ns_}));
  for (const MissionMoment& early : std::exchange(early_, {})) {
    PLUMESCOUT_RETURN_IF_ERROR(AddShown(early));
  }
  return absl::OkStatus();
}

absl::Status MissionView::NoteGap(std::int64_t missing_events, std::int64_t event) {
  if (!has_begun_) PLUMESCOUT_RETURN_IF_ERROR(Begin());
  const std::string line =
      absl::StrCat("recording: ", missing_events, " events are missing before event ", event);
  return drawing_.DrawLine(/*is_warning=*/true, "", line, {now_ns_, now_ns_});
}

absl::Status MissionView::EndChunk() { return encoder_.EndChunk(); }

absl::Status MissionView::Finish(const std::shared_ptr<const Belief>& belief) {
  if (!has_begun_) PLUMESCOUT_RETURN_IF_ERROR(Begin());
  if (belief != nullptr) PLUMESCOUT_RETURN_IF_ERROR(ShowMap(*belief, /*is_last=*/true));
  return encoder_.Finish();
}

absl::Status MissionView::AddRecord(std::int64_t number, absl::string_view record,
                                    McapTimes times) {
  ration_.NoteRecord(record.size());
  return encoder_.Add({journal_, static_cast<std::uint32_t>(number),
                       static_cast<std::uint64_t>(times.log_ns),
                       static_cast<std::uint64_t>(times.publish_ns), std::string(record)});
}

absl::Status MissionView::Show(const MissionMoment& moment, McapTimes times) {
  const Event& event = moment.event;
  const Applied& applied = moment.applied;
  if (const auto* received = std::get_if<ObservationReceived>(&event.body)) {
    if (applied.observation.ok() && moment.robot) {
      PLUMESCOUT_RETURN_IF_ERROR(drawing_.DrawObservation(received->robot, moment.robot->frame,
                                                          received->observation, times));
    }
  } else if (const auto* issued = std::get_if<PlanIssued>(&event.body)) {
    PLUMESCOUT_RETURN_IF_ERROR(ShowPlan(issued->plan, applied.plan_id, times));
  } else if (const auto* report = std::get_if<ProgressReported>(&event.body)) {
    PLUMESCOUT_RETURN_IF_ERROR(drawing_.DrawEndOfPlan(report->robot, times));
  } else if (const auto* removed = std::get_if<RobotRemoved>(&event.body)) {
    PLUMESCOUT_RETURN_IF_ERROR(drawing_.DrawEndOfPlan(removed->robot, times));
  }
  PLUMESCOUT_RETURN_IF_ERROR(ShowLog(event, applied, times));
  return moment.belief == nullptr ? absl::OkStatus() : ShowMap(*moment.belief, /*is_last=*/false);
}

absl::Status MissionView::ShowPlan(const Plan& issued, PlanId id, McapTimes times) {
  Plan plan = issued;
  plan.id = id;
  if (plan.chosen >= static_cast<int>(plan.candidates.size())) plan.chosen = -1;  // not kept
  return drawing_.DrawPlan(mission_id_, plan, times);
}

absl::Status MissionView::ShowLog(const Event& event, const Applied& applied, McapTimes times) {
  const v1::MissionEvent told = ToProto(event, mission_id_);
  absl::Status refused = applied.observation;
  refused.Update(applied.posterior);
  refused.Update(applied.map);
  if (refused.ok() && !IsNews(told.kind())) return absl::OkStatus();
  const std::string line =
      refused.ok() ? told.summary() : absl::StrCat(told.summary(), ": ", refused.message());
  return drawing_.DrawLine(!refused.ok(), told.robot(), line, times);
}

absl::Status MissionView::ShowMap(const Belief& belief, bool is_last) {
  if (belief.geometry().size() == 0) return absl::OkStatus();
  const auto show = [&](const std::string& topic, const google::protobuf::Message& layer) {
    return ShowLayer(topic, layer, belief.revision, is_last);
  };
  PLUMESCOUT_RETURN_IF_ERROR(show("/map/occupancy", FoxgloveGrid(*belief.occupancy, now_ns_)));
  const std::vector<GasSpecies>& species = belief.options->gas_species;
  for (std::size_t i = 0; i <= belief.further_gases.size(); ++i) {
    const GasField gas = belief.Gas(i);
    const std::string topic =
        species.size() < 2 ? "/map/gas" : absl::StrCat("/map/gas/", species[i].name);
    PLUMESCOUT_RETURN_IF_ERROR(
        show(topic + "/mean", FoxgloveGrid(*gas.mean_ppm, "mean_ppm", now_ns_)));
    PLUMESCOUT_RETURN_IF_ERROR(show(
        topic + "/stddev",
        FoxgloveGrid(StandardDeviation(*gas.published_variance_ppm2()), "stddev_ppm", now_ns_)));
  }
  return show("/scene/frontiers",
              FoxgloveFrontiers(MakeMapStatus(belief).frontiers, belief.geometry(), now_ns_));
}

absl::Status MissionView::ShowLayer(const std::string& topic,
                                    const google::protobuf::Message& layer, std::int64_t revision,
                                    bool is_last) {
  const auto shown = shown_revisions_.find(topic);
  if (shown != shown_revisions_.end() && shown->second == revision) return absl::OkStatus();
  if (!is_last) {
    PLUMESCOUT_ASSIGN_OR_RETURN(const std::string packed, CompressZstd(layer.SerializeAsString()));
    if (!ration_.Allows(topic, packed.size(), now_ns_)) return absl::OkStatus();
  }
  shown_revisions_[topic] = revision;
  return channels_.Add(topic, layer, {now_ns_, now_ns_});
}

}  // namespace plumescout
