#include "agents/sources/simulator/load_plan.hpp"

#include <filesystem>

#include "agents/sources/simulator/houseexpo.hpp"

namespace lifeline::sources {

Result<FloorPlan> load_plan(const std::string& target, const OfficeOptions& office) {
  if (target == "office") return generate_office(office);
  const std::filesystem::path path(target);
  if (path.extension() == ".json") return read_houseexpo(path);
  if (path.extension() == ".png" || path.extension() == ".pgm") {
    return fail(ErrorCode::unsupported,
                "{}: plans from pictures are not supported; give a HouseExpo .json or 'office'",
                target);
  }
  return fail(ErrorCode::wrong_use,
              "sim: there is no plan '{}'; give 'office' or the path of a HouseExpo .json", target);
}

}  // namespace lifeline::sources
