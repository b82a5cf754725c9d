#include "agents/rplidar/line_watch.hpp"

#include <algorithm>

namespace lifeline::rplidar {

void LineWatch::start(SteadyTime now) {
  bytes_until_ = samples_until_ = now + kSpinUp;
  turns_until_ = now + kSpinUp + kSlowestTurn;
}

void LineWatch::note(SteadyTime now, bool samples, bool turned) {
  bytes_until_ = now + kSilence;
  if (samples) samples_until_ = now + kSilence;
  // The spin-up's patience stays until the first turn.
  if (turned) turns_until_ = now + kSlowestTurn;
}

void LineWatch::excuse(Duration away) {
  bytes_until_ += away;
  samples_until_ += away;
  turns_until_ += away;
}

LineFault LineWatch::fault(SteadyTime now) const {
  if (now >= samples_until_) {
    return now >= bytes_until_ ? LineFault::silent : LineFault::garbage;
  }
  return now >= turns_until_ ? LineFault::stalled : LineFault::none;
}

SteadyTime LineWatch::deadline() const {
  return std::min(samples_until_, turns_until_);
}

}  // namespace lifeline::rplidar
