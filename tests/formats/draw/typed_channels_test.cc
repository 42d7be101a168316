// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "formats/draw/typed_channels.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/dynamic_message.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "foxglove/schemas.pb.h"
#include "plumescout/v1/planning_service.pb.h"
#include "plumescout/v1/robot_service.pb.h"
#include "tests/formats/mcap/mcap_files.h"

namespace plumescout {
namespace typed_channels_test {

// The type of a schema, as a reader has it who knows the schema alone.
const google::protobuf::Descriptor* TypeOf(const McapSchema& schema,
                                           google::protobuf::DescriptorPool& pool) {
  google::protobuf::FileDescriptorSet files;
  EXPECT_TRUE(files.ParseFromString(schema.data));
  for (const auto& file : files.file()) EXPECT_NE(pool.BuildFile(file), nullptr) << file.name();
  const google::protobuf::Descriptor* type = pool.FindMessageTypeByName(schema.name);
  EXPECT_NE(type, nullptr);
  return type;
}

TEST(TypedChannelsTest, ASchemaIsEnoughToReadMessages) {
  McapEncoder encoder("a test");
  TypedChannels channels(&encoder);
  foxglove::Log log;
  log.set_message("one");
  ASSERT_TRUE(channels.Add("/a", log, {5, 4}).ok());
  ASSERT_TRUE(channels.Add("/b", log, {6, 6}).ok());
  log.set_message("two");
  ASSERT_TRUE(channels.Add("/a", log, {7, 7}).ok());
  ASSERT_TRUE(encoder.Finish().ok());

  const TempFolder folder;
  ASSERT_TRUE(WriteFile(folder.File("f.mcap"), encoder.Take()).ok());
  auto reader = McapReader::Open(folder.File("f.mcap"));
  ASSERT_TRUE(reader.ok()) << reader.status();
  std::vector<McapMessage> messages;
  for (auto message = reader->Next(); message.ok() && *message; message = reader->Next()) {
    messages.push_back(**message);
  }
  ASSERT_EQ(messages.size(), 3u);
  EXPECT_EQ(messages[0].log_time_ns, 5u);
  EXPECT_EQ(messages[0].publish_time_ns, 4u);
  EXPECT_EQ(messages[2].sequence, 2u);  // the second of its channel
  ASSERT_EQ(reader->channels().size(), 2u);
  ASSERT_EQ(reader->schemas().size(), 1u);  // of both
  const McapSchema& schema = reader->schemas().begin()->second;
  EXPECT_EQ(schema.name, "foxglove.Log");
  EXPECT_EQ(schema.encoding, "protobuf");

  google::protobuf::DescriptorPool pool;
  const google::protobuf::Descriptor* type = TypeOf(schema, pool);
  ASSERT_NE(type, nullptr);
  google::protobuf::DynamicMessageFactory factory;
  const std::unique_ptr<google::protobuf::Message> read(factory.GetPrototype(type)->New());
  ASSERT_TRUE(read->ParseFromString(messages[2].data));
  EXPECT_EQ(read->GetReflection()->GetString(*read, type->FindFieldByName("message")), "two");
}

TEST(TypedChannelsTest, ASchemaHasWhatItsMessageIsMadeOfAlone) {
  McapEncoder encoder("a test");
  TypedChannels channels(&encoder);
  ASSERT_TRUE(channels.Add("/plans", v1::Plan(), {1, 1}).ok());
  ASSERT_TRUE(channels.Add("/robot", v1::RegisterRobotRequest(), {1, 1}).ok());
  ASSERT_TRUE(encoder.Finish().ok());
  const TempFolder folder;
  ASSERT_TRUE(WriteFile(folder.File("f.mcap"), encoder.Take()).ok());
  auto reader = McapReader::Open(folder.File("f.mcap"));
  ASSERT_TRUE(reader.ok()) << reader.status();
  for (auto message = reader->Next(); message.ok() && *message;) message = reader->Next();
  ASSERT_EQ(reader->schemas().size(), 2u);
  for (const auto& [id, schema] : reader->schemas()) {
    google::protobuf::DescriptorPool pool;
    const google::protobuf::Descriptor* type = TypeOf(schema, pool);
    ASSERT_NE(type, nullptr);
    const google::protobuf::Descriptor& whole =
        *google::protobuf::DescriptorPool::generated_pool()->FindMessageTypeByName(schema.name);
    ASSERT_EQ(type->field_count(), whole.field_count());
    for (int i = 0; i < whole.field_count(); ++i) {
      EXPECT_EQ(type->field(i)->DebugString(), whole.field(i)->DebugString());
    }
    EXPECT_EQ(pool.FindMessageTypeByName("plumescout.v1.MissionOptions"), nullptr);
    EXPECT_EQ(type->file()->service_count(), 0);
  }
}

}  // namespace typed_channels_test
}  // namespace plumescout
