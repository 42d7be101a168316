// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <grpcpp/grpcpp.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "google/protobuf/dynamic_message.h"
#include "server/server.h"
#include "tests/server/any_call.h"
#include "tests/server/token_line.h"
#include "tests/server/wire_methods.h"
#include "tests/support/temp_folder.h"

namespace plumescout::server {

// Whom a request is about.
struct Subject {
  std::string mission;  // an id, or what is sent in place of one
  std::string robot = "scout";
};

// Says in a request whom it is about, by every field that names a resource. A text that it does not
// know fails the test, so that no name is left out.
class Naming {
 public:
  Naming(const google::protobuf::MethodDescriptor& method, const Subject& subject)
      : about_robot_(method.service()->name() == "RobotService"), subject_(subject) {}

  void Fill(google::protobuf::Message& message) const {
    using google::protobuf::FieldDescriptor;
    const auto& reflection = *message.GetReflection();
    for (int i = 0; i < message.GetDescriptor()->field_count(); ++i) {
      const FieldDescriptor& field = *message.GetDescriptor()->field(i);
      if (field.name() == "observations") {  // one at least, with a number
        google::protobuf::Message& first = *reflection.AddMessage(&message, &field);
        first.GetReflection()->SetInt64(&first, first.GetDescriptor()->FindFieldByName("sequence"),
                                        1);
      }
      if (field.name() == "update_mask") {  // what may be changed
        google::protobuf::Message& mask = *reflection.MutableMessage(&message, &field);
        mask.GetReflection()->AddString(&mask, mask.GetDescriptor()->FindFieldByName("paths"),
                                        "idle_time_to_live");
      }
      const auto* oneof = field.containing_oneof();
      const bool is_chosen = oneof != nullptr && reflection.HasOneof(message, oneof);
      if (field.is_repeated() || is_chosen) continue;
      if (field.cpp_type() == FieldDescriptor::CPPTYPE_STRING &&
          field.type() == FieldDescriptor::TYPE_STRING) {
        reflection.SetString(&message, &field, ValueOf(field));
      } else if (field.cpp_type() == FieldDescriptor::CPPTYPE_ENUM) {
        reflection.SetEnumValue(&message, &field, 1);  // something that may be asked for
      } else if (field.name() == "radius_m") {
        reflection.SetDouble(&message, &field, 0.2);  // has to be more than nothing
      } else if (field.name() == "open" || field.name() == "batch" || field.name() == "mission") {
        Fill(*reflection.MutableMessage(&message, &field));
      }
    }
  }

 private:
  std::string ValueOf(const google::protobuf::FieldDescriptor& field) const {
    const std::string mission = absl::StrCat("missions/", subject_.mission);
    const std::string robot = absl::StrCat(mission, "/robots/", subject_.robot);
    const std::string& name = field.name();
    if (name == "mission_id") return subject_.mission;
    if (name == "robot_id") return subject_.robot;
    if (name == "mission") return mission;
    if (name == "robot") return robot;
    if (name == "plan") return absl::StrCat(mission, "/plans/1");
    if (name == "name") return about_robot_ ? robot : mission;
    const bool names_nothing = name == "page_token" || name == "part_token" ||
                               name == "request_id" || name == "owner" || name == "species" ||
                               name == "node" || name == "damage";
    EXPECT_TRUE(names_nothing) << field.full_name() << ": say here what it names";
    return "";
  }

  const bool about_robot_;
  const Subject subject_;
};

// A server that knows its callers by tokens.
class AccessTest : public testing::Test {
 protected:
  using Method = google::protobuf::MethodDescriptor;

  static constexpr char kAlice[] = "token-of-alice";  // operator of tenant acme
  static constexpr char kBob[] = "token-of-bob";      // operator of tenant other
  static constexpr char kEve[] = "token-of-eve";      // viewer of tenant acme
  static constexpr char kScout[] = "token-of-scout";  // robot of tenant acme
  static constexpr char kRoot[] = "token-of-root";    // admin

  void SetUp() override {
    WriteTokens(TokenLine(kEve, "eve viewer acme never"));
    ServerConfig config;
    config.listen = "127.0.0.1:0";
    config.access.tokens_file = tokens_path_;
    auto server = Server::Start(config);
    ASSERT_TRUE(server.ok()) << server.status();
    server_ = *std::move(server);
    channel_ = grpc::CreateChannel(absl::StrCat("127.0.0.1:", server_->port()),
                                   grpc::InsecureChannelCredentials());
  }

  // The file of tokens, with the line of eve as given.
  void WriteTokens(const std::string& eve) {
    const std::string written = folder_.File("tokens.new");
    std::ofstream(written) << TokenLine(kAlice, "alice operator acme never")
                           << TokenLine(kBob, "bob operator other never") << eve
                           << TokenLine(kScout, "scout robot acme never")
                           << TokenLine(kRoot, "root admin - never");
    std::filesystem::rename(written, tokens_path_);  // the server never sees half of it
  }

  // The answer to `token` asking about that subject.
  Answer Ask(const Method& method, const Subject& subject, const std::string& token) {
    const std::unique_ptr<google::protobuf::Message> request(
        messages_.GetPrototype(method.input_type())->New());
    Naming(method, subject).Fill(*request);
    return AnyCall(channel_, method, token).Make(*request);
  }
  Answer AskFor(const std::string& short_name, const Subject& subject, const std::string& token) {
    for (const Method* method : methods_) {
      if (ShortName(*method) == short_name) return Ask(*method, subject, token);
    }
    ADD_FAILURE() << "there is no " << short_name;
    return {};
  }

  const std::vector<const Method*> methods_ = WireMethods();
  google::protobuf::DynamicMessageFactory messages_;
  TempFolder folder_;
  const std::string tokens_path_ = folder_.File("tokens");
  std::unique_ptr<Server> server_;
  std::shared_ptr<grpc::Channel> channel_;
};

}  // namespace plumescout::server
