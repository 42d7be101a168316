// SPDX-FileCopyrightText: PlumeScout contributors
// SPDX-License-Identifier: Apache-2.0
#include "tests/ros2_peer/fast_dds_node.h"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <utility>
#include <vector>

namespace plumescout::ros2_peer {
namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

constexpr char kLoopback[] = "127.0.0.1";
constexpr int kDepth = 100;

// A type of which Fast DDS knows the name only: a sample is a std::string with its encapsulation.
class BytesType final : public dds::TopicDataType {
 public:
  explicit BytesType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = 1 << 16;  // to begin with
    m_isGetKeyDefined = false;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }

  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    const auto& bytes = *static_cast<std::string*>(data);
    payload->encapsulation = CDR_LE;
    payload->length = static_cast<std::uint32_t>(bytes.size());
    std::memcpy(payload->data, bytes.data(), bytes.size());
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    static_cast<std::string*>(data)->assign(reinterpret_cast<const char*>(payload->data),
                                            payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<std::string*>(data)->size()); };
  }
  void* createData() override { return new std::string; }
  void deleteData(void* data) override { delete static_cast<std::string*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

class Listener final : public dds::DataReaderListener {
 public:
  explicit Listener(FastDdsNode::Hear hear) : hear_(std::move(hear)) {}

  void on_data_available(dds::DataReader* reader) override {
    std::string bytes;
    dds::SampleInfo info;
    while (reader->take_next_sample(&bytes, &info) == ReturnCode_t::RETCODE_OK) {
      if (info.valid_data) hear_(bytes);
    }
  }

 private:
  const FastDdsNode::Hear hear_;
};

template <typename T>
T& Checked(T* made, const std::string& what) {
  if (made != nullptr) return *made;
  std::fprintf(stderr, "Fast DDS makes no %s\n", what.c_str());
  std::abort();
}

template <typename Policies>
void Apply(Service service, Policies& reliability, auto& durability, auto& history) {
  reliability.kind = service == Service::kBestEffort ? dds::BEST_EFFORT_RELIABILITY_QOS
                                                     : dds::RELIABLE_RELIABILITY_QOS;
  durability.kind = service == Service::kLatched ? dds::TRANSIENT_LOCAL_DURABILITY_QOS
                                                 : dds::VOLATILE_DURABILITY_QOS;
  history.kind = dds::KEEP_LAST_HISTORY_QOS;
  history.depth = service == Service::kLatched ? 1 : kDepth;
}

}  // namespace

class FastDdsNode::Writer {
 public:
  dds::DataWriter* writer = nullptr;
};

struct FastDdsNode::Parts {
  dds::Topic& TopicOf(const std::string& topic, const std::string& type) {
    dds::TypeSupport support(new BytesType(type));
    support.register_type(participant);
    dds::Topic*& made = topics[topic];
    if (made == nullptr) made = participant->create_topic(topic, type, dds::TOPIC_QOS_DEFAULT);
    return Checked(made, topic);
  }

  dds::DomainParticipant* participant = nullptr;
  dds::Publisher* publisher = nullptr;
  dds::Subscriber* subscriber = nullptr;
  std::map<std::string, dds::Topic*> topics;
  std::vector<std::unique_ptr<Writer>> writers;
  std::vector<std::unique_ptr<Listener>> listeners;
};

FastDdsNode::FastDdsNode(int domain) : parts_(std::make_unique<Parts>()) {
  dds::DomainParticipantQos qos;
  const auto transport = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  transport->interfaceWhiteList = {kLoopback};
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(transport);
  // Nobody is looked for by multicast.
  rtps::Locator_t peer;
  eprosima::fastrtps::rtps::IPLocator::setIPv4(peer, kLoopback);
  qos.wire_protocol().builtin.initialPeersList.push_back(peer);
  rtps::Locator_t own;
  eprosima::fastrtps::rtps::IPLocator::setIPv4(own, kLoopback);
  qos.wire_protocol().builtin.metatrafficUnicastLocatorList.push_back(own);
  auto* const factory = dds::DomainParticipantFactory::get_instance();
  parts_->participant = factory->create_participant(static_cast<dds::DomainId_t>(domain), qos);
  dds::DomainParticipant& participant = Checked(parts_->participant, "participant");
  parts_->publisher = participant.create_publisher(dds::PUBLISHER_QOS_DEFAULT);
  parts_->subscriber = participant.create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
}

FastDdsNode::~FastDdsNode() {
  parts_->participant->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(parts_->participant);
}

FastDdsNode::Writer& FastDdsNode::Advertise(const std::string& topic, const std::string& type,
                                            Service service) {
  dds::DataWriterQos qos;
  Apply(service, qos.reliability(), qos.durability(), qos.history());
  qos.endpoint().history_memory_policy = rtps::DYNAMIC_RESERVE_MEMORY_MODE;
  dds::DataWriter& made =
      Checked(parts_->publisher->create_datawriter(&parts_->TopicOf(topic, type), qos), topic);
  parts_->writers.push_back(std::make_unique<Writer>());
  parts_->writers.back()->writer = &made;
  return *parts_->writers.back();
}

void FastDdsNode::Subscribe(const std::string& topic, const std::string& type, Service service,
                            Hear hear) {
  dds::DataReaderQos qos;
  Apply(service, qos.reliability(), qos.durability(), qos.history());
  qos.endpoint().history_memory_policy = rtps::DYNAMIC_RESERVE_MEMORY_MODE;
  parts_->listeners.push_back(std::make_unique<Listener>(std::move(hear)));
  Checked(parts_->subscriber->create_datareader(&parts_->TopicOf(topic, type), qos,
                                                parts_->listeners.back().get()),
          topic);
}

void FastDdsNode::PublishBytes(Writer& writer, std::string cdr) { writer.writer->write(&cdr); }

}  // namespace plumescout::ros2_peer
