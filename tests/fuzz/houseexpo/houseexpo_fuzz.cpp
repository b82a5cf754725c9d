// Any bytes as a HouseExpo plan: a plan within its limits, or an error of one line.

#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "agents/sources/simulator/houseexpo.hpp"

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lifeline::sources;
  const std::string_view json(reinterpret_cast<const char*>(data), size);
  const auto plan = parse_houseexpo(json, "plan");
  if (!plan) {
    require(plan.error().code == lifeline::ErrorCode::bad_data);
    require(plan.error().text.size() < 200);
    require(plan.error().text.find('\n') == std::string::npos);
    return 0;
  }
  require(plan->walls.size() >= 3 && plan->walls.size() <= kMaxHouseExpoVertices);
  for (const WallSegment& wall : plan->walls) require(wall.a.allFinite() && wall.b.allFinite());
  require(plan->bounds().sizes().maxCoeff() <= kMaxPlanSideM);
  return 0;
}
