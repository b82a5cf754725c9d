// Any bytes as a CARMEN log, plain or compressed: scans as promised, then an end or an error.

#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "agents/sources/carmen_source.hpp"
#include "tests/support/memory_file.hpp"

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const lifeline::test::MemoryFile log({data, size});
  const auto source =
      lifeline::sources::open_carmen_source({"carmen", log.path(), {{"prior", "ahrs"}}});
  require(source.has_value());
  for (;;) {
    const auto scan = (*source)->next();
    if (!scan || !*scan) break;
    const std::size_t beams = (*scan)->ranges_m.size();
    require(beams == 180 || beams == 181 || beams == 360 || beams == 361);
    for (const float range_m : (*scan)->ranges_m) require(range_m >= 0.0F);
    require((*scan)->T_world_head_truth->is_finite());
    require(std::abs((*scan)->attitude->yaw_rad) <= 3.1416);
  }
  require((*source)->next().has_value());  // at its end, also after an error
  return 0;
}
