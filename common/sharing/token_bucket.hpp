#pragma once

#include <algorithm>

#include "common/base/time.hpp"

namespace lifeline::sharing {

/// Holds an average rate: allowance gathers for at most one second. It may go into debt by one
/// sample and then waits. One owner, not thread-safe.
class TokenBucket {
 public:
  explicit TokenBucket(double rate_bit_s) : rate_bit_s_(rate_bit_s), allowance_bits_(rate_bit_s) {}

  void refill(SteadyTime now) {
    if (refilled_at_ != SteadyTime{}) {
      allowance_bits_ =
          std::min(allowance_bits_ + to_seconds(now - refilled_at_) * rate_bit_s_, rate_bit_s_);
    }
    refilled_at_ = now;
  }

  void spend_octets(std::size_t octets) { allowance_bits_ -= 8.0 * static_cast<double>(octets); }
  [[nodiscard]] bool allows() const { return allowance_bits_ > 0.0; }

 private:
  double rate_bit_s_;
  double allowance_bits_;
  SteadyTime refilled_at_{};
};

}  // namespace lifeline::sharing
