#pragma once

#include <vector>

namespace lifeline::bench {

/// A helmet's pose as the fleet's watch heard it, by the wall clock.
struct HeardPose {
  double sent_at_s, heard_at_s;
};

/// How old each was when it arrived.
[[nodiscard]] std::vector<double> ages_on_arrival_s(const std::vector<HeardPose>& poses);
/// How old the newest one known was, every tenth of a second from the first arrival to `until_s`:
/// what did not arrive counts, too. `poses` in order of arrival.
[[nodiscard]] std::vector<double> ages_shown_s(const std::vector<HeardPose>& poses, double until_s);

}  // namespace lifeline::bench
