// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "server/history/mission_history.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

#include "tests/server/history/past_run.h"
#include "tests/server/service_clients.h"
#include "tests/server/store/store_work.h"
#include "tests/support/memory_store.h"

namespace plumescout::server {
namespace mission_history_test {

class MissionHistoryTest : public testing::Test {
 protected:
  absl::StatusOr<v1::GetMissionHistoryResponse> Read(v1::GetMissionHistoryRequest request,
                                                     const StopFn& stop = NeverStop()) {
    const auto page = HistoryPageFromProto(request);
    if (!page.ok()) return page.status();
    return ReadHistory(store_, "hall", "hall", *page, stop);
  }

  MemoryStore store_;
  const PastRun run_ = StoreRun(store_);
};

TEST_F(MissionHistoryTest, PagesHoldEveryEventOnce) {
  v1::GetMissionHistoryRequest request;
  request.set_page_size(100);
  std::vector<v1::MissionEvent> events;
  do {
    const auto page = Read(request);
    ASSERT_TRUE(page.ok()) << page.status();
    EXPECT_LE(page->events_size(), 100);
    EXPECT_EQ(page->head_revision(), run_.revision());
    events.insert(events.end(), page->events().begin(), page->events().end());
    request.set_page_token(page->next_page_token());
  } while (!request.page_token().empty());
  ASSERT_EQ(static_cast<std::int64_t>(events.size()), run_.revision());
  for (std::int64_t i = 0; i < run_.revision(); ++i) {
    EXPECT_EQ(events[static_cast<std::size_t>(i)].number(), i + 1);
  }
  EXPECT_EQ(events.front().kind(), v1::MISSION_EVENT_KIND_ROBOT_REGISTERED);
  EXPECT_EQ(events.back().summary(), "gas field refreshed");
}

TEST_F(MissionHistoryTest, OnlyTheKindsAskedForAreTold) {
  v1::GetMissionHistoryRequest request;
  request.add_kinds(v1::MISSION_EVENT_KIND_GAS_READING);
  request.set_page_size(1000);
  const auto page = Read(request);
  ASSERT_TRUE(page.ok()) << page.status();
  EXPECT_EQ(page->events_size(), 67);
  for (const v1::MissionEvent& event : page->events()) {
    EXPECT_EQ(event.kind(), v1::MISSION_EVENT_KIND_GAS_READING);
  }
  EXPECT_EQ(page->next_page_token(), "");
}

TEST_F(MissionHistoryTest, BeginsWhereItIsAskedTo) {
  v1::GetMissionHistoryRequest request;
  request.set_first_number(run_.revision());
  const auto last = Read(request);
  ASSERT_TRUE(last.ok()) << last.status();
  ASSERT_EQ(last->events_size(), 1);
  request.set_first_number(run_.revision() + 5);
  const auto beyond = Read(request);
  ASSERT_TRUE(beyond.ok()) << beyond.status();
  EXPECT_EQ(beyond->events_size(), 0);
  EXPECT_EQ(beyond->next_page_token(), "");
}

TEST_F(MissionHistoryTest, WhatIsWrongIsNamed) {
  v1::GetMissionHistoryRequest request;
  request.set_page_size(-1);
  EXPECT_TRUE(absl::IsInvalidArgument(Read(request).status()));
  request.set_page_size(0);
  for (const char* token : {"x", "!", "MQ==", "Iy0x"}) {
    request.set_page_token(token);
    EXPECT_TRUE(absl::IsInvalidArgument(Read(request).status())) << token;
  }
  request.clear_page_token();
  request.add_kinds(v1::MISSION_EVENT_KIND_UNSPECIFIED);
  EXPECT_TRUE(absl::IsInvalidArgument(Read(request).status()));
}

TEST_F(MissionHistoryTest, EndsWithItsCall) {
  EXPECT_TRUE(absl::IsCancelled(Read({}, [] { return true; }).status()));
}

TEST_F(MissionHistoryTest, BeginsWithTheFirstEventThatIsKept) {
  for (const std::int64_t revision : {10, 20}) {
    ASSERT_TRUE(PutSnapshotNow(store_, "hall", 1, {revision, 0, ""}).ok());
  }
  ASSERT_TRUE(TrimNow(store_, "hall", 1).ok());
  const auto page = Read({});
  ASSERT_TRUE(page.ok()) << page.status();
  EXPECT_EQ(page->first_number(), 11);
  EXPECT_EQ(page->events(0).number(), 11);
}

}  // namespace mission_history_test
}  // namespace plumescout::server
