#include "common/dds/first_acknacks.hpp"

#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace lifeline::dds {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

/// As Fast DDS 2.9 writes it: header, INFO_DST, ACKNACK with an empty set. `reader` is the last
/// octet of the reader's id, `base` of the set's first number.
std::vector<std::uint8_t> acknack(std::uint8_t peer, std::uint8_t reader, std::uint8_t base = 0) {
  std::vector<std::uint8_t> message{'R', 'T', 'P', 'S', 2, 2, 1, 15, 9, 9,
                                    9,   9,   9,   9,   9, 9, 9, 9,  9, 9};
  message.insert(message.end(), {0x0e, 1, 12, 0, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, 7, peer});
  message.insert(message.end(), {0x06, 1, 24, 0, 0, 0, 1, reader, 0, 0, 1, 2});
  message.insert(message.end(), {0, 0, 0, 0, base, 0, 0, 0, 0, 0, 0, 0});
  message.insert(message.end(), {5, 0, 0, 0});
  return message;
}

/// How many of the tries in that time go, one each 70 ms.
int sent_within(FirstAckNacks& acknacks, const std::vector<std::uint8_t>& message, SteadyTime from,
                Duration time) {
  int sent = 0;
  for (SteadyTime now = from; now < from + time; now += milliseconds(70))
    sent += acknacks.may_send(message, now) ? 1 : 0;
  return sent;
}

constexpr SteadyTime kStart{seconds(100)};

TEST(FirstAckNacksTest, AskAsTheyComeAtFirstAndThenEveryHalfSecond) {
  FirstAckNacks acknacks;
  const auto message = acknack(1, 4);
  EXPECT_EQ(sent_within(acknacks, message, kStart, milliseconds(1960)), 28);
  const int next_s = sent_within(acknacks, message, kStart + seconds(2), seconds(1));
  EXPECT_GE(next_s, 2);
  EXPECT_LE(next_s, 5);
  (void)sent_within(acknacks, message, kStart + seconds(3), seconds(12));
  const int later = sent_within(acknacks, message, kStart + seconds(15), seconds(20));
  EXPECT_GE(later, 34);  // the first that comes after each pause
  EXPECT_LE(later, 40);
}

/// Lets the first seconds of a question pass; true while it is held back afterwards.
bool is_held_back(FirstAckNacks& acknacks, const std::vector<std::uint8_t>& message) {
  (void)sent_within(acknacks, message, kStart, milliseconds(2100));
  return !acknacks.may_send(message, kStart + milliseconds(2110));
}

TEST(FirstAckNacksTest, StatisticsBehindThemChangeNothing) {
  FirstAckNacks acknacks;
  auto message = acknack(1, 4);
  message.insert(message.end(), {0x80, 1, 56, 0});
  message.resize(message.size() + 56);
  EXPECT_TRUE(is_held_back(acknacks, message));
  message.back() = 3;
  EXPECT_FALSE(acknacks.may_send(message, kStart + milliseconds(2120)));
}

TEST(FirstAckNacksTest, BigEndianOnesAreReadAlike) {
  FirstAckNacks acknacks;
  auto message = acknack(1, 4);
  for (const std::size_t submessage : {20U, 36U}) {
    message[submessage + 1] = 0;
    std::swap(message[submessage + 2], message[submessage + 3]);
  }
  EXPECT_TRUE(is_held_back(acknacks, message));
  EXPECT_FALSE(acknacks.may_send(acknack(1, 4), kStart + milliseconds(2120)));
}

TEST(FirstAckNacksTest, EachReaderAsksEachPeerForItself) {
  FirstAckNacks acknacks;
  EXPECT_TRUE(is_held_back(acknacks, acknack(1, 4)));
  EXPECT_TRUE(acknacks.may_send(acknack(2, 4), kStart + milliseconds(2120)));
  EXPECT_TRUE(acknacks.may_send(acknack(1, 7), kStart + milliseconds(2120)));
  EXPECT_FALSE(acknacks.may_send(acknack(1, 4), kStart + milliseconds(2130)));
}

TEST(FirstAckNacksTest, WhoAsksAgainLaterBeginsAnew) {
  FirstAckNacks acknacks;
  const auto message = acknack(1, 4);
  (void)sent_within(acknacks, message, kStart, seconds(20));
  const SteadyTime later = kStart + seconds(22);
  EXPECT_TRUE(acknacks.may_send(message, later));
  EXPECT_TRUE(acknacks.may_send(message, later + milliseconds(140)));
}

TEST(FirstAckNacksTest, AnswersToHeartbeatsAlwaysGo) {
  FirstAckNacks acknacks;
  for (int i = 0; i < 10; ++i) {
    EXPECT_TRUE(acknacks.may_send(acknack(1, 4, 1), kStart));
    auto with_bits = acknack(1, 4);
    with_bits[56] = 3;  // how many bits follow
    EXPECT_TRUE(acknacks.may_send(with_bits, kStart));
  }
}

TEST(FirstAckNacksTest, WhateverElseIsSentGoes) {
  FirstAckNacks acknacks;
  const auto message = acknack(1, 4);
  EXPECT_TRUE(is_held_back(acknacks, message));
  const SteadyTime now = kStart + milliseconds(2120);
  auto heartbeat = message;
  heartbeat[36] = 0x07;
  auto longer = message;
  longer.insert(longer.end(), {0x06, 1, 24, 0});
  for (std::size_t size = 0; size < message.size(); ++size)
    EXPECT_TRUE(acknacks.may_send(std::span(message).first(size), now));
  EXPECT_TRUE(acknacks.may_send(heartbeat, now));
  EXPECT_TRUE(acknacks.may_send(longer, now));
  EXPECT_FALSE(acknacks.may_send(message, now));
}

TEST(FirstAckNacksTest, AFloodOfNamesIsLetThroughAndForgotten) {
  FirstAckNacks acknacks;
  auto message = acknack(1, 4);
  for (int name = 0; name < 20'000; ++name) {
    message[24] = static_cast<std::uint8_t>(name);
    message[25] = static_cast<std::uint8_t>(name >> 8);
    EXPECT_TRUE(acknacks.may_send(message, kStart));
  }
  const auto ours = acknack(1, 9);
  (void)sent_within(acknacks, ours, kStart + seconds(5), milliseconds(2100));
  EXPECT_FALSE(acknacks.may_send(ours, kStart + milliseconds(7110)));
}

}  // namespace
}  // namespace lifeline::dds
