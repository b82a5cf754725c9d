// What the shipped profiles must keep whatever else is tuned: docs/topics.md says why.

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tinyxml2.h>

#include "common/dds/topics.hpp"

namespace lifeline::dds {
namespace {

/// Every leaf element below `element`: path -> text.
void flatten(const tinyxml2::XMLElement* element, const std::string& path,
             std::multimap<std::string, std::string>& leaves) {
  for (; element != nullptr; element = element->NextSiblingElement()) {
    const std::string here = path + "/" + element->Name();
    if (const auto* text = element->GetText(); text != nullptr) leaves.emplace(here, text);
    flatten(element->FirstChildElement(), here, leaves);
  }
}

using Leaves = std::multimap<std::string, std::string>;

class ShippedQos : public ::testing::TestWithParam<const char*> {
 protected:
  ShippedQos() {
    const std::string file = LIFELINE_SOURCE_DIR "/config/qos/" + std::string(GetParam());
    EXPECT_EQ(document_.LoadFile(file.c_str()), tinyxml2::XML_SUCCESS);
    profiles_ = document_.FirstChildElement("dds")->FirstChildElement("profiles");
  }

  /// The leaves of one profile.
  [[nodiscard]] Leaves profile(std::string_view name) const {
    Leaves leaves;
    for (auto* p = profiles_->FirstChildElement(); p != nullptr; p = p->NextSiblingElement()) {
      const auto* called = p->Attribute("profile_name");
      if (called != nullptr && called == name) flatten(p->FirstChildElement(), "", leaves);
    }
    return leaves;
  }

  [[nodiscard]] std::vector<std::string> all(const std::string& path, const Leaves& leaves) const {
    std::vector<std::string> values;
    const auto [begin, end] = leaves.equal_range(path);
    for (auto it = begin; it != end; ++it) values.push_back(it->second);
    return values;
  }

  tinyxml2::XMLDocument document_;
  const tinyxml2::XMLElement* profiles_ = nullptr;
};

using Values = std::vector<std::string>;

TEST_P(ShippedQos, history_keeps_the_newest_of_unlimited_keys) {
  const auto check = [&](std::string_view name, const char* policy) {
    const auto leaves = profile(name);
    EXPECT_EQ(all("/topic/historyQos/kind", leaves), Values{"KEEP_LAST"}) << name;
    EXPECT_EQ(all("/topic/historyQos/depth", leaves), Values{"1"}) << name;
    for (const auto* limit : {"max_samples", "max_instances", "max_samples_per_instance"}) {
      EXPECT_EQ(all(std::string("/topic/resourceLimitsQos/") + limit, leaves), Values{"0"})
          << name << " " << limit;
    }
    EXPECT_EQ(all("/historyMemoryPolicy", leaves), Values{policy}) << name;
    EXPECT_EQ(all("/qos/data_sharing/kind", leaves), Values{"OFF"}) << name;
  };
  const auto check_topic = [&](const auto& topic) {
    check(topic.writer_profile, "DYNAMIC_REUSABLE");
    check(topic.reader_profile, "PREALLOCATED");
    if (!topic.standby_profile.empty()) check(topic.standby_profile, "DYNAMIC_REUSABLE");
  };
  std::apply([&](const auto&... topics) { (check_topic(topics), ...); }, kTopics);
}

TEST_P(ShippedQos, writers_offer_what_readers_ask_for) {
  const auto check_topic = [&](const auto& topic) {
    const auto reader = profile(topic.reader_profile);
    for (const auto name : {topic.writer_profile, topic.standby_profile}) {
      if (name.empty()) continue;
      const auto writer = profile(name);
      for (const auto* path :
           {"/qos/reliability/kind", "/qos/durability/kind", "/qos/deadline/period/nanosec",
            "/qos/liveliness/kind", "/qos/liveliness/lease_duration/sec", "/qos/ownership/kind"}) {
        EXPECT_EQ(all(path, writer), all(path, reader)) << name << " " << path;
      }
    }
  };
  std::apply([&](const auto&... topics) { (check_topic(topics), ...); }, kTopics);
}

// On the radio, samples of tiles and status are always under way: their heartbeats cost most.
TEST_P(ShippedQos, reliable_writers_repair_soon) {
  const bool radio = std::string(GetParam()) == "wifi.xml";
  const auto check_topic = [&](const auto& topic) {
    const auto writer = profile(topic.writer_profile);
    if (all("/qos/reliability/kind", writer) != Values{"RELIABLE"}) return;
    const auto whole_s = all("/times/heartbeatPeriod/sec", writer);
    const auto rest_ns = all("/times/heartbeatPeriod/nanosec", writer);
    ASSERT_EQ(whole_s.size() + rest_ns.size(), 1U) << topic.writer_profile;
    const auto period_ns =
        whole_s.empty() ? std::stoull(rest_ns[0]) : 1'000'000'000U * std::stoull(whole_s[0]);
    std::uint64_t longest_ns = 100'000'000;
    if (radio && topic.writer_profile == topic_of<wire::TsdTile>().writer_profile)
      longest_ns = 250'000'000;
    if (radio && topic.writer_profile == topic_of<wire::AgentStatus>().writer_profile)
      longest_ns = 1'000'000'000;  // its samples' own interval
    EXPECT_GE(period_ns, 20'000'000U) << topic.writer_profile;
    EXPECT_LE(period_ns, longest_ns) << topic.writer_profile;
  };
  std::apply([&](const auto&... topics) { (check_topic(topics), ...); }, kTopics);
}

// Whoever asked and got no answer asks again: repeating took more than the samples themselves.
TEST_P(ShippedQos, what_is_asked_for_again_is_not_repeated) {
  for (const auto name :
       {topic_of<wire::TileRequest>().writer_profile, topic_of<wire::TileCopy>().writer_profile,
        topic_of<wire::DirectiveCopy>().writer_profile}) {
    EXPECT_EQ(all("/qos/reliability/kind", profile(name)), Values{"BEST_EFFORT"}) << name;
  }
  EXPECT_EQ(all("/qos/reliability/kind", profile(topic_of<wire::TsdTile>().writer_profile)),
            Values{"RELIABLE"});
}

TEST_P(ShippedQos, liveliness_is_never_automatic) {
  for (auto* p = profiles_->FirstChildElement(); p != nullptr; p = p->NextSiblingElement()) {
    Leaves leaves;
    flatten(p->FirstChildElement(), "", leaves);
    for (const auto& kind : all("/qos/liveliness/kind", leaves)) EXPECT_EQ(kind, "MANUAL_BY_TOPIC");
  }
}

TEST_P(ShippedQos, the_standby_is_weaker_than_the_primary) {
  const auto& topic = topic_of<wire::MergeDirective>();
  const auto strength = [&](std::string_view name) {
    return std::stoi(all("/qos/ownershipStrength/value", profile(name)).at(0));
  };
  EXPECT_LT(strength(topic.standby_profile), strength(topic.writer_profile));
}

// On the radio a message is a packet; on loopback no sample of a large team may need fragments.
TEST_P(ShippedQos, everything_goes_by_udp_messages_that_arrive_whole) {
  const std::string size = std::string(GetParam()) == "wifi.xml" ? "1400" : "16000";
  Leaves transports;
  flatten(profiles_->FirstChildElement("transport_descriptors"), "", transports);
  const std::string root = "/transport_descriptors/transport_descriptor/";
  EXPECT_EQ(all(root + "type", transports), Values{"UDPv4"});
  EXPECT_EQ(all(root + "maxMessageSize", transports), Values{size});
  EXPECT_EQ(all("/rtps/useBuiltinTransports", profile(kParticipantProfile)), Values{"false"});
}

INSTANTIATE_TEST_SUITE_P(Files, ShippedQos, ::testing::Values("loopback.xml", "wifi.xml"));

class Ros2Qos : public ShippedQos {};

// Heard from a driver that offers reliable and from one that does not, and nobody outside decides
// how much memory is taken.
TEST_P(Ros2Qos, readers_ask_for_nothing_that_a_driver_could_lack) {
  for (const char* name : {"ros2_scan_reader", "ros2_imu_reader"}) {
    const auto leaves = profile(name);
    EXPECT_EQ(all("/qos/reliability/kind", leaves), Values{"BEST_EFFORT"}) << name;
    EXPECT_EQ(all("/qos/durability/kind", leaves), Values{"VOLATILE"}) << name;
    EXPECT_EQ(all("/qos/data_sharing/kind", leaves), Values{"OFF"}) << name;
    EXPECT_EQ(all("/topic/historyQos/kind", leaves), Values{"KEEP_LAST"}) << name;
    EXPECT_EQ(all("/historyMemoryPolicy", leaves), Values{"PREALLOCATED"}) << name;
    EXPECT_TRUE(all("/qos/deadline/period/nanosec", leaves).empty()) << name;
  }
}

// As ROS 2's tools ask for it: a map that is there for who comes late, and all else for either kind
// of reader.
TEST_P(Ros2Qos, writers_offer_what_the_tools_ask_for) {
  for (const auto& [name, durability] : {std::pair("ros2_map_writer", "TRANSIENT_LOCAL"),
                                         std::pair("ros2_stream_writer", "VOLATILE")}) {
    const auto leaves = profile(name);
    EXPECT_EQ(all("/qos/reliability/kind", leaves), Values{"RELIABLE"}) << name;
    EXPECT_EQ(all("/qos/durability/kind", leaves), Values{durability}) << name;
    EXPECT_EQ(all("/qos/publishMode/kind", leaves), Values{"ASYNCHRONOUS"}) << name;
    EXPECT_EQ(all("/topic/historyQos/kind", leaves), Values{"KEEP_LAST"}) << name;
  }
}

TEST_P(Ros2Qos, the_receive_buffer_holds_the_largest_datagram_of_a_driver) {
  Leaves transports;
  flatten(profiles_->FirstChildElement("transport_descriptors"), "", transports);
  EXPECT_EQ(all("/transport_descriptors/transport_descriptor/maxMessageSize", transports),
            Values{"65500"});
}

INSTANTIATE_TEST_SUITE_P(Files, Ros2Qos, ::testing::Values("ros2.xml", "ros2-loopback.xml"));

class LoopbackQos : public ShippedQos {};

TEST_P(LoopbackQos, names_no_address_but_loopback) {
  Leaves leaves;
  flatten(profiles_->FirstChildElement(), "", leaves);
  std::size_t addresses = 0;
  for (const auto& [path, text] : leaves) {
    if (!path.ends_with("/address")) continue;
    ++addresses;
    EXPECT_EQ(text, "127.0.0.1") << path;
  }
  EXPECT_EQ(addresses, 4U);  // white list, data, metatraffic, peers
}

INSTANTIATE_TEST_SUITE_P(Files, LoopbackQos,
                         ::testing::Values("loopback.xml", "ros2-loopback.xml"));

}  // namespace
}  // namespace lifeline::dds
