// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "lab/bags/mcap_bag.h"

#include <utility>

#include "core/types/status_macros.h"
#include "formats/mcap/mcap_reader.h"

namespace plumescout::lab {
namespace {

class McapBag final : public BagReader {
 public:
  McapBag(McapReader reader, std::set<std::string> wanted)
      : reader_(std::move(reader)), wanted_(std::move(wanted)) {}

  absl::StatusOr<std::optional<BagMessage>> Next() override {
    while (true) {
      PLUMESCOUT_ASSIGN_OR_RETURN(std::optional<McapMessage> message, reader_.Next());
      if (!message) return std::optional<BagMessage>();
      const McapChannel& channel = reader_.channels().at(message->channel);
      const auto schema = reader_.schemas().find(channel.schema);
      const std::string type = schema == reader_.schemas().end() ? "" : schema->second.name;
      topics_[channel.topic] = type;
      if (wanted_.count(channel.topic) == 0) continue;
      if (channel.message_encoding != "cdr") {
        ++unknown_encodings_[channel.message_encoding];
        continue;
      }
      return BagMessage{channel.topic, type, static_cast<std::int64_t>(message->log_time_ns),
                        std::move(message->data)};
    }
  }
  const std::string& torn_end() const override { return reader_.torn_end(); }
  double share_read() const override { return reader_.share_read(); }

 private:
  McapReader reader_;
  const std::set<std::string> wanted_;
};

}  // namespace

absl::StatusOr<std::unique_ptr<BagReader>> OpenMcapBag(const std::string& path,
                                                       const std::set<std::string>& wanted_topics) {
  PLUMESCOUT_ASSIGN_OR_RETURN(McapReader reader, McapReader::Open(path));
  return std::make_unique<McapBag>(std::move(reader), wanted_topics);
}

}  // namespace plumescout::lab
