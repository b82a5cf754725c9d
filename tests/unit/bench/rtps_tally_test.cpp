#include "tests/bench/radio/rtps_tally.hpp"

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lifeline::bench {
namespace {

using testing::ElementsAre;
using testing::Pair;
using Octets = std::vector<std::uint8_t>;

constexpr std::size_t kHeaders = 14 + 20 + 8 + 20;  // Ethernet, IPv4, UDP, RTPS
const Octets kWriter{0, 0, 1, 2}, kReader{0, 0, 2, 7};

Octets joined(std::initializer_list<Octets> parts) {
  Octets all;
  for (const Octets& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

Octets submessage(std::uint8_t kind, const Octets& body) {
  return joined({{kind, 1, static_cast<std::uint8_t>(body.size()), 0}, body});
}

// From a participant whose prefix is twelve times 5.
Octets frame(const Octets& submessages) {
  Octets ethernet(14, 0), ip(20, 0), udp(8, 0);
  ethernet[12] = 8;
  ip[0] = 0x45;
  ip[16] = 10;
  return joined({ethernet, ip, udp, {'R', 'T', 'P', 'S', 2, 2, 1, 15}, Octets(12, 5), submessages});
}

Octets data(const Octets& writer, std::uint8_t sequence, const Octets& payload) {
  return submessage(0x15, joined({{0, 0, 16, 0},
                                  kReader,
                                  writer,
                                  {0, 0, 0, 0, sequence, 0, 0, 0},
                                  {0, 3, 0, 0},
                                  payload}));
}

// Discovery's word on which topic kWriter belongs to.
Octets announcement(const std::string& topic) {
  Octets name(topic.begin(), topic.end());
  name.push_back(0);
  const Octets guid = joined({Octets(12, 5), kWriter});
  return data({0, 0, 3, 0xc2}, 1,
              joined({{0x05, 0, static_cast<std::uint8_t>(4 + name.size()), 0},
                      {static_cast<std::uint8_t>(name.size()), 0, 0, 0},
                      name,
                      {0x5a, 0, 16, 0},
                      guid,
                      {1, 0, 0, 0}}));
}

TEST(RtpsTally, CountsDataOfATopicAndWhatWasSentBefore) {
  RtpsTally tally;
  tally.take(frame(announcement("lifeline/pose")), false);
  const Octets sample = frame(data(kWriter, 7, Octets(40, 1)));
  tally.take(sample, true);
  tally.take(sample, true);
  EXPECT_THAT(tally.octets(), ElementsAre(Pair("lifeline/pose, data", sample.size()),
                                          Pair("lifeline/pose, data again", sample.size())));
}

TEST(RtpsTally, HeadersCountToTheFirstSubmessage) {
  RtpsTally tally;
  const Octets heartbeat = submessage(0x07, joined({kReader, kWriter, Octets(20, 0)}));
  const Octets gap = submessage(0x08, joined({kReader, kWriter, Octets(20, 0)}));
  tally.take(frame(announcement("lifeline/pose")), false);
  tally.take(frame(joined({heartbeat, gap})), true);
  EXPECT_THAT(tally.octets(),
              ElementsAre(Pair("lifeline/pose, gap", gap.size()),
                          Pair("lifeline/pose, heartbeat", kHeaders + heartbeat.size())));
}

TEST(RtpsTally, AnAnswerCountsToTheTopicOfWhomItIsFor) {
  RtpsTally tally;
  tally.take(frame(announcement("lifeline/pose")), false);
  const Octets destination = submessage(0x0e, Octets(12, 5));
  const Octets acknack = submessage(0x06, joined({kReader, kWriter, Octets(16, 0)}));
  const Octets whole = frame(joined({destination, acknack}));
  tally.take(whole, true);
  EXPECT_THAT(tally.octets(), ElementsAre(Pair("lifeline/pose, acknack", whole.size())));
}

TEST(RtpsTally, WhatCannotBeReadIsOtherAndDoesNoHarm) {
  RtpsTally tally;
  const Octets whole = frame(data(kWriter, 7, Octets(40, 1)));
  std::size_t octets = 0;
  for (std::size_t length = 0; length < kHeaders; ++length) {
    tally.take(std::span(whole).first(length), true);
    octets += length;
  }
  EXPECT_THAT(tally.octets(), ElementsAre(Pair("other", octets)));
  for (std::size_t length = kHeaders; length < whole.size(); ++length)
    tally.take(std::span(whole).first(length), true);
}

}  // namespace
}  // namespace lifeline::bench
