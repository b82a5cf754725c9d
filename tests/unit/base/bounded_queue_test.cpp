#include "common/base/bounded_queue.hpp"

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include <gmock/gmock.h>

namespace lifeline {
namespace {

using namespace std::chrono_literals;

constexpr Duration kDeadline = 20s;

TEST(BoundedQueue, GivesItemsInTheOrderTheyCame) {
  BoundedQueue<int> queue(3, Overflow::drop_oldest);
  for (int i = 1; i <= 3; ++i) EXPECT_TRUE(queue.push(i));
  EXPECT_EQ(queue.size(), 3U);
  for (int i = 1; i <= 3; ++i) EXPECT_EQ(queue.pop(0ns), i);
  EXPECT_EQ(queue.dropped(), 0U);
}

TEST(BoundedQueue, AFullOneDropsTheOldestAndCountsIt) {
  BoundedQueue<int> queue(2, Overflow::drop_oldest);
  for (int i = 1; i <= 5; ++i) EXPECT_TRUE(queue.push(i));
  EXPECT_EQ(queue.pop(0ns), 4);
  EXPECT_EQ(queue.pop(0ns), 5);
  EXPECT_EQ(queue.dropped(), 3U);
}

TEST(BoundedQueue, AnEmptyOneGivesNothingAfterItsTimeout) {
  BoundedQueue<int> queue(1, Overflow::wait);
  EXPECT_EQ(queue.pop(1ms), std::nullopt);
}

TEST(BoundedQueue, AClosedOneTakesNothingAndGivesTheRest) {
  BoundedQueue<int> queue(4, Overflow::drop_oldest);
  EXPECT_TRUE(queue.push(1));
  queue.close();
  EXPECT_FALSE(queue.push(2));
  EXPECT_FALSE(queue.finished());
  EXPECT_EQ(queue.pop(kDeadline), 1);
  EXPECT_TRUE(queue.finished());
  EXPECT_EQ(queue.pop(kDeadline), std::nullopt);
}

TEST(BoundedQueue, CarriesWhatCannotBeCopied) {
  BoundedQueue<std::unique_ptr<int>> queue(1, Overflow::drop_oldest);
  EXPECT_TRUE(queue.push(std::make_unique<int>(7)));
  EXPECT_EQ(**queue.pop(0ns), 7);
}

TEST(BoundedQueue, AWaitingProducerLosesNothing) {
  constexpr int kItems = 2000;
  BoundedQueue<int> queue(3, Overflow::wait);
  std::jthread producer([&] {
    for (int i = 0; i < kItems; ++i) EXPECT_TRUE(queue.push(i));
    queue.close();
  });
  int expected = 0;
  while (const auto item = queue.pop(kDeadline)) EXPECT_EQ(*item, expected++);
  EXPECT_EQ(expected, kItems);
  EXPECT_EQ(queue.dropped(), 0U);
}

TEST(BoundedQueue, ClosingWakesProducerAndConsumer) {
  BoundedQueue<int> full(1, Overflow::wait), empty(1, Overflow::wait);
  EXPECT_TRUE(full.push(1));
  std::atomic<bool> refused = false, nothing = false;
  {
    std::jthread producer([&] { refused = !full.push(2); });
    std::jthread consumer([&] { nothing = !empty.pop(kDeadline).has_value(); });
    full.close();
    empty.close();
  }
  EXPECT_TRUE(refused);
  EXPECT_TRUE(nothing);
}

TEST(BoundedQueue, SeveralProducersAndConsumersShareEveryItemOnce) {
  constexpr int kThreads = 3, kItems = 1000;
  BoundedQueue<int> queue(16, Overflow::wait);
  std::vector<std::atomic<int>> taken(kThreads * kItems);
  {
    std::vector<std::jthread> consumers, producers;
    for (int t = 0; t < kThreads; ++t) {
      consumers.emplace_back([&] {
        while (const auto item = queue.pop(kDeadline)) ++taken[static_cast<std::size_t>(*item)];
      });
      producers.emplace_back([&, t] {
        for (int i = 0; i < kItems; ++i) (void)queue.push(t * kItems + i);
      });
    }
    producers.clear();  // joins
    queue.close();
  }
  for (const auto& times : taken) EXPECT_EQ(times.load(), 1);
}

TEST(BoundedQueueDeath, WithoutRoomItIsABug) {
  EXPECT_DEATH(BoundedQueue<int>(0, Overflow::wait), "capacity > 0");
}

}  // namespace
}  // namespace lifeline
