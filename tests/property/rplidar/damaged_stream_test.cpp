// Bytes that are lost, flipped or put in between: what comes out was sent, or does not come out.

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <gtest/gtest.h>

#include "agents/rplidar/sample_decoder.hpp"
#include "tests/support/rplidar/emulator.hpp"
#include "tests/support/rplidar/sent_samples.hpp"

namespace lifeline::rplidar {
namespace {

using test::EmulatedFrame;
using test::NoiseRates;
using Buffer = std::vector<std::uint8_t>;

enum class Damage { lost, flipped, inserted };

/// The frames of a scan in which each distance comes once (of 14 bits: every 16,000 samples).
std::vector<EmulatedFrame> frames_of(std::uint8_t type, std::size_t count, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto world = [random](double, double) mutable {
    return static_cast<std::uint16_t>(random() % 16'383 + 1);
  };
  test::FrameMaker maker({"m", type == 0x81 ? 252U << 8 : 125U << 7, 25 << 8, type}, 10.0, world);
  std::vector<EmulatedFrame> frames;
  for (std::size_t i = 0; i < count; ++i) frames.push_back(maker.next());
  return frames;
}

void damage(Buffer& bytes, std::size_t at, Damage how, std::mt19937& random) {
  const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
  switch (how) {
    case Damage::lost:
      bytes.erase(place);
      break;
    case Damage::flipped:
      *place ^= static_cast<std::uint8_t>(1U << random() % 8);
      break;
    case Damage::inserted:
      bytes.insert(place, static_cast<std::uint8_t>(random()));
  }
}

std::vector<Sample> decode(std::uint8_t type, const Buffer& bytes) {
  std::vector<Sample> samples;
  SampleDecoder decoder(static_cast<AnswerType>(type), type == 0x81 ? 252.0 : 62.5, 256'000);
  decoder.push(bytes, SteadyTime{}, samples);
  return samples;
}

/// How many of the sent frames came out whole, and how many came out that were not sent so.
struct Outcome {
  std::size_t whole = 0, wrong = 0;
};

Outcome compare(std::span<const Sample> samples, const std::vector<EmulatedFrame>& frames) {
  const std::size_t size = frames.front().quarters.size();
  const auto sent = test::sent_samples(frames);
  // By a frame's first two distances; nothing of it has to be true of the rest.
  std::multimap<std::pair<std::uint32_t, std::uint32_t>, std::size_t> starts;
  for (std::size_t i = 0; i + 1 < sent.size(); i += size) {
    starts.emplace(std::pair(sent[i].quarters, sent[i + 1].quarters), i);
  }
  const auto is_sent = [&](std::span<const Sample> got, std::size_t first) {
    for (std::size_t i = 0; i < size; ++i) {
      const double off_deg = got[i].reading.angle_q16 / 65536.0 - sent[first + i].angle_deg;
      if (got[i].reading.distance_quarters != sent[first + i].quarters ||
          std::abs(std::remainder(off_deg, 360.0)) > 1e-4) {
        return false;
      }
    }
    return true;
  };
  Outcome outcome;
  for (std::size_t i = 0; i + size <= samples.size(); i += size) {
    const auto got = samples.subspan(i, size);
    const auto [from, to] = starts.equal_range(
        std::pair(got[0].reading.distance_quarters, got[1].reading.distance_quarters));
    const bool found =
        std::any_of(from, to, [&](const auto& start) { return is_sent(got, start.second); });
    (found ? outcome.whole : outcome.wrong) += 1;
  }
  return outcome;
}

class Capsules : public testing::TestWithParam<std::uint8_t> {};

TEST_P(Capsules, a_damaged_byte_costs_two_at_most_and_never_a_wrong_range) {
  std::mt19937 random(11);
  constexpr std::size_t kFrames = 6000, kApart = 6;
  for (const Damage how : {Damage::lost, Damage::flipped, Damage::inserted}) {
    const auto frames = frames_of(GetParam(), kFrames, 3);
    Buffer bytes;
    std::size_t damages = 0;
    for (std::size_t i = 0; i < kFrames; ++i) {
      Buffer frame = frames[i].bytes;
      if (i % kApart == kApart / 2) {
        damage(frame, random() % frame.size(), how, random);
        ++damages;
      }
      bytes.insert(bytes.end(), frame.begin(), frame.end());
    }
    const Outcome outcome = compare(decode(GetParam(), bytes), frames);
    EXPECT_EQ(outcome.wrong, 0U);
    // The last frame has no next one.
    EXPECT_GE(outcome.whole + 2 * damages + 1, kFrames);
    EXPECT_LT(outcome.whole, kFrames - damages) << "nothing was damaged";
  }
}

TEST_P(Capsules, every_place_of_a_capsule_may_be_lost) {
  const auto frames = frames_of(GetParam(), 8, 4);
  for (std::size_t at = 0; at < frames[4].bytes.size(); ++at) {
    Buffer bytes;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      Buffer frame = frames[i].bytes;
      if (i == 4) frame.erase(frame.begin() + static_cast<std::ptrdiff_t>(at));
      bytes.insert(bytes.end(), frame.begin(), frame.end());
    }
    const Outcome outcome = compare(decode(GetParam(), bytes), frames);
    EXPECT_EQ(outcome.wrong, 0U) << at;
    EXPECT_GE(outcome.whole, 5U) << at;  // of 7 that have a next one
  }
}

/// A line so bad that capsules are damaged more than once. The checksum is 8 bits of exclusive or:
/// two damages of one capsule hide each other now and then, and nobody can see that.
TEST_P(Capsules, what_is_wrong_on_a_terrible_line_is_as_rare_as_its_checksum_says) {
  constexpr std::size_t kFrames = 40'000;
  struct Case {
    NoiseRates rates;
    double most_wrong;  ///< of the frames that were damaged twice or more
    const char* name;
  };
  // Flips: the second one hits the first one's column of bits once in 8 times, and only pairs hide
  // each other. Losses and insertions shift what lies between: right by chance once in 256 times.
  const Case cases[] = {{{.lost = 0.0, .flipped = 0.01, .inserted = 0.0}, 0.13, "flips"},
                        {{.lost = 0.01, .flipped = 0.0, .inserted = 0.01}, 1.0 / 256.0, "shifts"}};
  for (const Case& c : cases) {
    const auto frames = frames_of(GetParam(), kFrames, 5);
    test::LineNoise noise(17);
    Buffer bytes;
    std::size_t often_damaged = 0;
    for (const EmulatedFrame& frame : frames) {
      const auto before = noise.harmed();
      const Buffer damaged = noise.damage(frame.bytes, c.rates);
      bytes.insert(bytes.end(), damaged.begin(), damaged.end());
      often_damaged += noise.harmed() - before >= 2 ? 1 : 0;
    }
    const Outcome outcome = compare(decode(GetParam(), bytes), frames);
    EXPECT_GT(often_damaged, 3000U);
    EXPECT_GT(outcome.whole, 0U);
    EXPECT_LT(static_cast<double>(outcome.wrong),
              c.most_wrong * static_cast<double>(often_damaged));
    RecordProperty(c.name, std::to_string(outcome.wrong) + "/" + std::to_string(often_damaged));
  }
}

TEST_P(Capsules, random_bytes_give_next_to_nothing) {
  std::mt19937 random(23);
  Buffer bytes(20'000'000);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
  EXPECT_TRUE(decode(GetParam(), bytes).empty());  // two marks and checksums: once in 2^32 bytes
}

INSTANTIATE_TEST_SUITE_P(DamagedStream, Capsules, testing::Values(0x82, 0x85));

/// Nodes have no checksum: what holds for capsules holds here nearly always.
TEST(StandardNodes, a_lost_or_added_byte_hardly_ever_gives_a_reading_that_was_not_sent) {
  constexpr std::size_t kFrames = 200'000;
  for (const NoiseRates& rates : {NoiseRates{.lost = 0.002}, NoiseRates{.inserted = 0.002}}) {
    const auto frames = frames_of(0x81, kFrames, 7);
    std::map<std::pair<int, std::uint32_t>, int> sent;
    for (const EmulatedFrame& frame : frames) ++sent[{frame.start_q6, frame.quarters[0]}];
    test::LineNoise noise(19);
    Buffer bytes;
    for (const EmulatedFrame& frame : frames) {
      const Buffer damaged = noise.damage(frame.bytes, rates);
      bytes.insert(bytes.end(), damaged.begin(), damaged.end());
    }
    const auto samples = decode(0x81, bytes);
    std::size_t wrong = 0;
    for (const Sample& sample : samples) {
      const std::pair key{sample.reading.angle_q16 >> 10, sample.reading.distance_quarters};
      wrong += sent.contains(key) ? 0 : 1;
    }
    EXPECT_LE(wrong * 500, noise.harmed());
    // A damage costs its node, the ones that had to be followed by it, and few more.
    EXPECT_GT(samples.size() + 8 * noise.harmed(), kFrames);
  }
}

}  // namespace
}  // namespace lifeline::rplidar
