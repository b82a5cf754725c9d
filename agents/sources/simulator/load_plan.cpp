#include "agents/sources/simulator/load_plan.hpp"

#include <filesystem>

#include "agents/sources/simulator/houseexpo.hpp"
#include "agents/sources/simulator/paper_buildings.hpp"
#include "agents/sources/simulator/picture_plan.hpp"

namespace lifeline::sources {

Result<FloorPlan> load_plan(const std::string& target, const OfficeOptions& office) {
  if (target == "office") return generate_office(office);
  if (const auto known = find_paper_building(target)) {
    return generate_paper_building(*known, office.seed);
  }
  const std::filesystem::path path(target);
  if (path.extension() == ".json") return read_houseexpo(path);
  if (path.extension() == ".png") return read_picture_plan(path);
  return fail(ErrorCode::wrong_use,
              "sim: there is no plan '{}'; give office, testbed, rearranged, meeting, karaoke, or "
              "the path of a "
              "HouseExpo .json or a .png",
              target);
}

}  // namespace lifeline::sources
