// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/observe/mission_metrics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <prometheus/text_serializer.h>

#include <string>

namespace plumescout::server {
namespace mission_metrics_test {

using ::testing::HasSubstr;
using ::testing::Not;

class MissionMetricsTest : public testing::Test {
 protected:
  std::string Text() const { return prometheus::TextSerializer().Serialize(registry_.Collect()); }

  prometheus::Registry registry_;
  MissionMetrics metrics_{registry_};
};

TEST_F(MissionMetricsTest, CountsAndTimesWhatItIsTold) {
  metrics_.NoteObservation(true);
  metrics_.NoteObservation(true);
  metrics_.NoteObservation(false);
  metrics_.NoteIngest(absl::Milliseconds(20));
  metrics_.NoteRefresh(absl::Milliseconds(2));
  metrics_.NoteAdoption(absl::Milliseconds(2));
  metrics_.NoteEpoch(absl::Milliseconds(2));
  metrics_.NoteGasFailure();
  metrics_.NoteRecordedBytes(500);
  metrics_.NoteRecordingDrop();
  metrics_.NoteRecordingFailure();
  metrics_.NoteStaleness(absl::Milliseconds(60));
  metrics_.NotePlan(absl::Milliseconds(7));
  const std::string text = Text();
  for (const char* line :
       {"plumescout_observations_total{outcome=\"applied\"} 2\n",
        "plumescout_observations_total{outcome=\"rejected\"} 1\n",
        "plumescout_ingest_lag_seconds_bucket{le=\"0.01\"} 0\n",
        "plumescout_ingest_lag_seconds_bucket{le=\"0.025\"} 1\n",
        "plumescout_gas_refresh_duration_seconds_count 1\n",
        "plumescout_gas_adoption_duration_seconds_count 1\n",
        "plumescout_gas_epoch_duration_seconds_count 1\n", "plumescout_gas_failures_total 1\n",
        "plumescout_recorded_bytes_total 500\n", "plumescout_recording_dropped_events_total 1\n",
        "plumescout_recording_failures_total 1\n", "plumescout_belief_staleness_seconds_count 1\n",
        "plumescout_plan_cpu_seconds_count 1\n"}) {
    EXPECT_THAT(text, HasSubstr(line));
  }
}

TEST_F(MissionMetricsTest, StagesOfPlansAreApart) {
  metrics_.NotePlanStage(Stage::kQueue, absl::Milliseconds(3));
  metrics_.NotePlanStage(Stage::kRead, absl::Milliseconds(3));  // of no plan
  const std::string text = Text();
  const std::string count = "plumescout_plan_stage_duration_seconds_count{stage=";
  EXPECT_THAT(text, HasSubstr(count + "\"queue\"} 1\n"));
  EXPECT_THAT(text, HasSubstr(count + "\"search\"} 0\n"));
}

TEST_F(MissionMetricsTest, AuditsAreCountedAndTheLastOnesDifferencesKept) {
  metrics_.NoteAudit(AuditFinding{0.5, 0.25, false});
  metrics_.NoteAudit(AuditFinding{0.125, 0.0625, true});
  metrics_.NoteAudit(absl::InternalError("x"));
  const std::string text = Text();
  for (const char* outcome : {"certified", "alarm", "failed"}) {
    EXPECT_THAT(text, HasSubstr("plumescout_gas_audits_total{outcome=\"" + std::string(outcome) +
                                "\"} 1\n"));
  }
  EXPECT_THAT(text, HasSubstr("plumescout_gas_audit_mean_difference_ppm{species=\"0\"} 0.125\n"));
  EXPECT_THAT(text,
              HasSubstr("plumescout_gas_audit_variance_difference_ratio{species=\"0\"} 0.0625\n"));
}

TEST_F(MissionMetricsTest, AuditsOfSeveralGasesAreApart) {
  EXPECT_THAT(Text(), HasSubstr("plumescout_gas_audit_mean_difference_ppm{species=\"0\"} 0\n"));
  EXPECT_THAT(Text(), Not(HasSubstr("species=\"1\"")));
  metrics_.NoteAudit(AuditFinding{0.5, 0.25, false, 0});
  metrics_.NoteAudit(AuditFinding{0.125, 0.0625, true, 1});
  const std::string text = Text();
  for (const char* line :
       {"mean_difference_ppm{species=\"0\"} 0.5\n", "mean_difference_ppm{species=\"1\"} 0.125\n",
        "variance_difference_ratio{species=\"0\"} 0.25\n",
        "variance_difference_ratio{species=\"1\"} 0.0625\n"}) {
    EXPECT_THAT(text, HasSubstr("plumescout_gas_audit_" + std::string(line)));
  }
}

TEST(UnreadMissionMetricsTest, AreThereForWhoHasNone) {
  MissionMetrics::Unread().NoteGasFailure();
  EXPECT_EQ(&MissionMetrics::Unread(), &MissionMetrics::Unread());
}

}  // namespace mission_metrics_test
}  // namespace plumescout::server
