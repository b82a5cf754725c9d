#include "common/wire/limits.hpp"

#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include "common/dds/type_support.hpp"

namespace lifeline::wire {
namespace {

/// Every bounded sequence and text of one IDL file: field -> bound.
std::multimap<std::string, std::size_t> bounds_in(const std::string& name) {
  std::ifstream file(LIFELINE_SOURCE_DIR "/idl/" + name);
  std::stringstream text;
  text << file.rdbuf();
  const std::string idl = text.str();
  static const std::regex kBounded(
      R"((?:sequence<\s*\w+\s*,\s*(\d+)\s*>|string<(\d+)>)\s+(\w+)\s*;)");
  std::multimap<std::string, std::size_t> bounds;
  for (std::sregex_iterator it(idl.begin(), idl.end(), kBounded), end; it != end; ++it) {
    const auto& match = *it;
    bounds.emplace(match[3], std::stoul(match[1].matched ? match[1] : match[2]));
  }
  return bounds;
}

using Bounds = std::multimap<std::string, std::size_t>;

TEST(Limits, are_the_bounds_of_the_idl) {
  ASSERT_EQ(kMaxMissionIdLength, kMaxIdLength);  // one type, Name, serves both
  EXPECT_EQ(bounds_in("envelope.idl"),
            (Bounds{{"Name", kMaxIdLength}, {"signature", kMaxSignature}}));
  EXPECT_EQ(bounds_in("map.idl"), (Bounds{{"ranges_cm", kMaxScanBeams},
                                          {"payload", kMaxTilePart},
                                          {"payload", kMaxTilePart},  // of copies
                                          {"held", kMaxTilesPerRequest}}));
  EXPECT_EQ(
      bounds_in("merge.idl"),
      (Bounds{{"members", kMaxMembers}, {"reason", kMaxReason}, {"candidates", kMaxCandidates}}));
  EXPECT_EQ(bounds_in("status.idl"), (Bounds{{"layers", kMaxLayers},
                                             {"peers_heard", kMaxPeers},
                                             {"peers_echo_ms", kMaxPeers},
                                             {"text", kMaxAlertText},
                                             {"acknowledged_by", kMaxPeers}}));
}

TEST(Limits, nothing_in_the_idl_is_unbounded) {
  // A sequence of texts is as bad: the generated code allocates what the sender claims.
  static const std::regex kUnbounded(
      R"(sequence<\s*\w+\s*>|\bstring\s+\w+\s*;|sequence<\s*(?:Name|string))");
  for (const auto* name : {"envelope.idl", "map.idl", "merge.idl", "status.idl"}) {
    std::ifstream file(std::string(LIFELINE_SOURCE_DIR "/idl/") + name);
    ASSERT_TRUE(file) << name;
    for (std::string line; std::getline(file, line);) {
      line = line.substr(0, line.find("//"));
      EXPECT_FALSE(std::regex_search(line, kUnbounded)) << name << ": " << line;
    }
  }
}

TEST(Limits, tiles_and_requests_fit_into_one_message_of_the_radio) {
  // What Fast DDS 2.9 leaves of 1,400 octets: less its header (20), the destination (16), time
  // (12), the submessage with its inline QoS (36 + 28) and a heartbeat (32).
  constexpr std::uint32_t kRoom = 1400 - 20 - 16 - 12 - 36 - 28 - 32;
  EXPECT_LE(dds::TypeSupportOf<TsdTile>().m_typeSize, kRoom);
  EXPECT_LE(dds::TypeSupportOf<TileCopy>().m_typeSize, kRoom);
  EXPECT_LE(dds::TypeSupportOf<TileRequest>().m_typeSize, kRoom);
}

}  // namespace
}  // namespace lifeline::wire
