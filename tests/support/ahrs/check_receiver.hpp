#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string_view>
#include <vector>

#include "agents/ahrs/line_receiver.hpp"

namespace lifeline::ahrs {

inline void require(bool condition) {
  if (!condition) std::abort();
}

/// Any bytes from a sensor of this kind: cut into pieces as the first byte says, readings are
/// finite rotations, never measured after they came, and the same however the bytes were cut,
/// times aside.
inline void check_receiver(std::string_view kind, std::span<const std::uint8_t> data) {
  if (data.empty()) return;
  const std::size_t piece = 1 + data[0];
  data = data.subspan(1);
  std::vector<LineReceiver::Reading> cut, whole;
  SteadyTime now{std::chrono::hours(1)};
  LineReceiver receiver(make_decoder(kind), 115200);
  receiver.start(now);
  for (std::size_t i = 0; i < data.size(); i += piece) {
    now += std::chrono::milliseconds(5);
    const std::size_t before = cut.size();
    receiver.push(data.subspan(i, std::min(piece, data.size() - i)), now, cut);
    for (std::size_t k = before; k < cut.size(); ++k) {
      require(cut[k].stamp <= now);
      require(std::abs(cut[k].reading.R_world_body.norm() - 1.0) < 1e-6);
      require(!cut[k].reading.rate_rad_s || cut[k].reading.rate_rad_s->allFinite());
    }
  }
  (void)receiver.watch().fault(now);
  LineReceiver at_once(make_decoder(kind), 115200);
  at_once.start(SteadyTime{});
  at_once.push(data, now, whole);
  require(receiver.watch().counts().readings == at_once.watch().counts().readings);
  require(receiver.watch().counts().damaged == at_once.watch().counts().damaged);
}

}  // namespace lifeline::ahrs
