// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "google/protobuf/descriptor.h"
#include "plumescout/v1/ingest_service.pb.h"
#include "plumescout/v1/map_service.pb.h"
#include "plumescout/v1/mission_service.pb.h"
#include "plumescout/v1/planning_service.pb.h"
#include "plumescout/v1/robot_service.pb.h"
#include "plumescout/v1/snapshot_service.pb.h"
#include "plumescout/v1/system_service.pb.h"

namespace plumescout::server {

// Every method of every service of package plumescout.v1, by its .proto files. Tests run at the
// root.
inline std::vector<const google::protobuf::MethodDescriptor*> WireMethods() {
  // Files are known once something of theirs is used.
  EXPECT_NE(v1::OpenIngest::descriptor(), nullptr);
  EXPECT_NE(v1::GetMapRequest::descriptor(), nullptr);
  EXPECT_NE(v1::Mission::descriptor(), nullptr);
  EXPECT_NE(v1::Plan::descriptor(), nullptr);
  EXPECT_NE(v1::RegisterRobotRequest::descriptor(), nullptr);
  EXPECT_NE(v1::MissionEvent::descriptor(), nullptr);
  EXPECT_NE(v1::GetServerInfoRequest::descriptor(), nullptr);
  std::vector<const google::protobuf::MethodDescriptor*> methods;
  for (const auto& entry : std::filesystem::directory_iterator("proto/plumescout/v1")) {
    const std::string name = absl::StrCat("plumescout/v1/", entry.path().filename().string());
    const auto* file = google::protobuf::DescriptorPool::generated_pool()->FindFileByName(name);
    EXPECT_NE(file, nullptr) << name << ": this header has to include it";
    if (file == nullptr) continue;
    for (int s = 0; s < file->service_count(); ++s) {
      for (int m = 0; m < file->service(s)->method_count(); ++m) {
        methods.push_back(file->service(s)->method(m));
      }
    }
  }
  EXPECT_GE(methods.size(), 29u);
  return methods;
}

// "MissionService.GetMission"
inline std::string ShortName(const google::protobuf::MethodDescriptor& method) {
  return absl::StrCat(method.service()->name(), ".", method.name());
}

}  // namespace plumescout::server
