// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "client/ros2/dds_node.h"

#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>

#include <array>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "absl/strings/strip.h"
#include "client/ros2/opaque_type.h"
#include "core/types/status_macros.h"

namespace plumescout::client {
namespace {

// ROS 2 announces in which enclave a node is; without it some tools do not list it.
constexpr char kUserData[] = "enclave=/;";
constexpr std::size_t kTakenAtOnce = 32;
constexpr std::size_t kAlignment_bytes = 4;

absl::Status Failed(const char* what, dds_return_t code) {
  return absl::UnavailableError(absl::StrCat(what, ": ", dds_strretcode(code)));
}

struct QosDeleter {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, QosDeleter>;

Qos MakeQos(const TopicQos& wanted) {
  Qos qos(dds_create_qos());
  const bool is_reliable = wanted.delivery != Delivery::kSensor;
  dds_qset_reliability(qos.get(),
                       is_reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                       DDS_MSECS(100));
  dds_qset_durability(qos.get(), wanted.delivery == Delivery::kLatched
                                     ? DDS_DURABILITY_TRANSIENT_LOCAL
                                     : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, wanted.depth);
  const dds_data_representation_id_t plain = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(qos.get(), 1, &plain);
  return qos;
}

// What does not fit, by the policy that DDS names last, and what to do about it.
std::string Explain(const std::string& topic, bool we_read, std::uint32_t policy) {
  const char* const other = we_read ? "publisher" : "subscriber";
  switch (policy) {
    case DDS_RELIABILITY_QOS_POLICY_ID:
      return absl::StrCat(topic, ": a ", other, " is incompatible in reliability; ",
                          we_read ? "have it publish RELIABLE" : "have it subscribe BEST_EFFORT");
    case DDS_DURABILITY_QOS_POLICY_ID:
      return absl::StrCat(
          topic, ": a ", other, " is incompatible in durability; ",
          we_read ? "have it publish TRANSIENT_LOCAL" : "have it subscribe VOLATILE");
    default:
      return absl::StrCat(topic, ": a ", other, " is incompatible in policy ", policy,
                          " of its quality of service; give it the default one");
  }
}

}  // namespace

std::string FullTopic(const std::string& ros_namespace, const std::string& topic) {
  if (!topic.empty() && topic.front() == '/') return topic;
  const auto space = absl::StripSuffix(absl::StripPrefix(ros_namespace, "/"), "/");
  return space.empty() ? absl::StrCat("/", topic) : absl::StrCat("/", space, "/", topic);
}

std::string DdsTopic(const std::string& full_topic) { return absl::StrCat("rt", full_topic); }

std::string DdsType(const std::string& ros_type) {
  const std::size_t name = ros_type.rfind('/') + 1;
  return absl::StrCat(absl::StrReplaceAll(ros_type.substr(0, name), {{"/", "::"}}),
                      "dds_::", ros_type.substr(name), "_");
}

absl::StatusOr<std::unique_ptr<DdsNode>> DdsNode::Open(int domain) {
  std::unique_ptr<DdsNode> node(new DdsNode);
  const Qos qos(dds_create_qos());
  dds_qset_userdata(qos.get(), kUserData, sizeof(kUserData) - 1);
  node->participant_ =
      dds_create_participant(static_cast<dds_domainid_t>(domain), qos.get(), nullptr);
  if (node->participant_ < 0) return Failed("DDS does not start", node->participant_);
  node->waitset_ = dds_create_waitset(node->participant_);
  if (node->waitset_ < 0) return Failed("DDS makes no wait set", node->waitset_);
  return node;
}

DdsNode::~DdsNode() {
  if (participant_ > 0) dds_delete(participant_);
}

absl::StatusOr<std::int32_t> DdsNode::OpenTopic(const std::string& full_topic,
                                                const std::string& ros_type) const {
  ddsi_sertype* type = NewOpaqueType(DdsType(ros_type));
  const dds_entity_t topic = dds_create_topic_sertype(participant_, DdsTopic(full_topic).c_str(),
                                                      &type, nullptr, nullptr, nullptr);
  if (topic < 0) return Failed(full_topic.c_str(), topic);
  return topic;
}

absl::Status DdsNode::Subscribe(const std::string& full_topic, const std::string& ros_type,
                                const TopicQos& qos, Hear hear) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const dds_entity_t topic, OpenTopic(full_topic, ros_type));
  const dds_entity_t reader = dds_create_reader(participant_, topic, MakeQos(qos).get(), nullptr);
  if (reader < 0) return Failed(full_topic.c_str(), reader);
  dds_set_status_mask(reader, DDS_DATA_AVAILABLE_STATUS);
  const auto place = static_cast<dds_attach_t>(readers_.size());
  if (const auto code = dds_waitset_attach(waitset_, reader, place); code < 0) {
    return Failed(full_topic.c_str(), code);
  }
  readers_.push_back(std::make_unique<Reader>(
      Reader{.topic = full_topic, .entity = reader, .hear = std::move(hear)}));
  return absl::OkStatus();
}

absl::StatusOr<int> DdsNode::Advertise(const std::string& full_topic, const std::string& ros_type,
                                       const TopicQos& qos) {
  PLUMESCOUT_ASSIGN_OR_RETURN(const dds_entity_t topic, OpenTopic(full_topic, ros_type));
  const dds_entity_t writer = dds_create_writer(participant_, topic, MakeQos(qos).get(), nullptr);
  if (writer < 0) return Failed(full_topic.c_str(), writer);
  writers_.push_back({.topic = full_topic, .entity = writer});
  return static_cast<int>(writers_.size()) - 1;
}

void DdsNode::Poll(absl::Duration timeout) {
  const std::int64_t timeout_ns = absl::ToInt64Nanoseconds(timeout);
  if (dds_waitset_wait(waitset_, nullptr, 0, timeout_ns) <= 0) return;
  for (const auto& reader : readers_) Take(*reader);
}

void DdsNode::Take(Reader& reader) {
  std::array<ddsi_serdata*, kTakenAtOnce> samples{};
  std::array<dds_sample_info_t, kTakenAtOnce> infos{};
  dds_return_t count = 0;
  do {
    count = dds_takecdr(reader.entity, samples.data(), kTakenAtOnce, infos.data(), DDS_ANY_STATE);
    for (std::size_t i = 0; i < static_cast<std::size_t>(std::max(count, 0)); ++i) {
      if (infos[i].valid_data) {
        ++reader.heard;
        reader.hear(BytesOf(*samples[i]));
      }
      ddsi_serdata_unref(samples[i]);
    }
  } while (count == static_cast<dds_return_t>(kTakenAtOnce));
}

absl::Status DdsNode::PublishBytes(int writer, std::string cdr) {
  // RTPS sends whole words, and reads them from here.
  cdr.append((kAlignment_bytes - cdr.size() % kAlignment_bytes) % kAlignment_bytes, '\0');
  const Writer& to = writers_[static_cast<std::size_t>(writer)];
  const dds_return_t code = dds_write(to.entity, &cdr);
  return code < 0 ? Failed(to.topic.c_str(), code) : absl::OkStatus();
}

void DdsNode::AwaitHeard(absl::Duration timeout) {
  for (const Writer& writer : writers_) {
    dds_wait_for_acks(writer.entity, absl::ToInt64Nanoseconds(timeout));
  }
}

std::vector<DdsNode::Source> DdsNode::Sources() const {
  std::vector<Source> sources;
  for (const auto& reader : readers_) {
    const int publishers = dds_get_matched_publications(reader->entity, nullptr, 0);
    sources.push_back({.topic = reader->topic, .publishers = publishers, .heard = reader->heard});
  }
  return sources;
}

std::vector<std::string> DdsNode::TakeMisfits() {
  std::vector<std::string> misfits;
  for (const auto& reader : readers_) {
    dds_requested_incompatible_qos_status_t status{};
    dds_get_requested_incompatible_qos_status(reader->entity, &status);
    if (std::exchange(reader->misfits, status.total_count) == status.total_count) continue;
    misfits.push_back(Explain(reader->topic, /*we_read=*/true, status.last_policy_id));
  }
  for (Writer& writer : writers_) {
    dds_offered_incompatible_qos_status_t status{};
    dds_get_offered_incompatible_qos_status(writer.entity, &status);
    if (std::exchange(writer.misfits, status.total_count) == status.total_count) continue;
    misfits.push_back(Explain(writer.topic, /*we_read=*/false, status.last_policy_id));
  }
  return misfits;
}

}  // namespace plumescout::client
