#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace lifeline::wire {

/// How likely a bit is 1 in one context, learnt from the bits seen there. Integers only: the same
/// on every machine. idl/tile.proto holds the arithmetic.
struct BitEstimate {
  static constexpr unsigned kOne = 65536;
  static constexpr unsigned kMaxSeen = 60;

  std::uint16_t probability = kOne / 2;  ///< of a 1, in 1 / kOne
  std::uint16_t seen = 0;                ///< bits, at most kMaxSeen

  /// How much it counts among others: more where it saw more and where it is surer. Below 2^15.
  [[nodiscard]] std::uint32_t trust() const {
    const std::uint32_t p = probability;
    return (10U * seen + 3) * kOne / (p * (kOne - p) / kOne + 1311);
  }
  /// Goes towards the bit by 10 / (10 seen + 16) of the way.
  void learn(bool bit) {
    const std::uint64_t way = bit ? kOne - 1U - probability : probability;
    const auto step = static_cast<std::uint16_t>(way * 10 * kReciprocals[seen] >> 32);
    probability = static_cast<std::uint16_t>(bit ? probability + step : probability - step);
    if (seen < kMaxSeen) ++seen;
  }

 private:
  /// n / (10 seen + 16) is n * kReciprocals[seen] >> 32 for every n below 2^20: a tile takes a
  /// hundred thousand of these, and divisions were most of its time.
  static constexpr std::array<std::uint32_t, kMaxSeen + 1> kReciprocals = [] {
    std::array<std::uint32_t, kMaxSeen + 1> reciprocals{};
    for (std::uint32_t bits = 0; bits <= kMaxSeen; ++bits)
      reciprocals[bits] =
          static_cast<std::uint32_t>((std::uint64_t{1} << 32) / (10 * bits + 16)) + 1;
    return reciprocals;
  }();
};

/// The probability of a 1 by several contexts together, in [16, 65520] / 65536.
[[nodiscard]] inline std::uint32_t mean_probability(std::span<BitEstimate* const> estimates) {
  std::uint64_t sum = 0, all = 0;
  for (const BitEstimate* estimate : estimates) {
    const std::uint64_t trust = estimate->trust();
    sum += trust * estimate->probability;
    all += trust;
  }
  const std::uint64_t mean = sum / all;
  return static_cast<std::uint32_t>(mean < 16 ? 16 : mean > 65520 ? 65520 : mean);
}

/// The interval of an arithmetic coder, [low, high], cut at each bit in proportion to its
/// probability.
struct CoderInterval {
  std::uint32_t low = 0, high = 0xFFFFFFFFU;

  /// The last number of a 1's part.
  [[nodiscard]] std::uint32_t cut(std::uint32_t probability) const {
    return low + static_cast<std::uint32_t>((std::uint64_t{high} - low) * probability >> 16);
  }
  /// True while both ends agree in their first octet, which then is settled.
  [[nodiscard]] bool settled() const { return (low ^ high) >> 24 == 0; }
  void take(bool bit, std::uint32_t cut_at) { (bit ? high : low) = bit ? cut_at : cut_at + 1; }
  void shift() {
    low <<= 8;
    high = high << 8 | 0xFFU;
  }
};

class BitEncoder {
 public:
  /// Writes `bit`, and answers it.
  bool code(std::uint32_t probability, bool bit) {
    interval_.take(bit, interval_.cut(probability));
    for (; interval_.settled(); interval_.shift())
      octets_.push_back(static_cast<std::uint8_t>(interval_.high >> 24));
    return bit;
  }
  /// The fewest octets that name the interval when zeros follow them.
  [[nodiscard]] std::vector<std::uint8_t> finish() && {
    if (interval_.low > 0) octets_.push_back(static_cast<std::uint8_t>((interval_.low >> 24) + 1));
    while (!octets_.empty() && octets_.back() == 0) octets_.pop_back();
    return std::move(octets_);
  }

 private:
  CoderInterval interval_;
  std::vector<std::uint8_t> octets_;
};

/// Reads zeros behind the end: any octets stand for some bits.
class BitDecoder {
 public:
  explicit BitDecoder(std::span<const std::uint8_t> octets) : octets_(octets) {
    for (int i = 0; i < 4; ++i) value_ = value_ << 8 | next();
  }
  bool code(std::uint32_t probability, bool) {
    const std::uint32_t cut = interval_.cut(probability);
    const bool bit = value_ <= cut;
    interval_.take(bit, cut);
    for (; interval_.settled(); interval_.shift()) value_ = value_ << 8 | next();
    return bit;
  }

 private:
  std::uint32_t next() { return at_ < octets_.size() ? octets_[at_++] : 0U; }

  CoderInterval interval_;
  std::span<const std::uint8_t> octets_;
  std::size_t at_ = 0;
  std::uint32_t value_ = 0;
};

}  // namespace lifeline::wire
