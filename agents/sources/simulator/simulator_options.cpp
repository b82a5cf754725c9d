#include "agents/sources/simulator/simulator_options.hpp"

#include <cstdint>
#include <limits>
#include <string>

#include "agents/sources/simulator/paper_buildings.hpp"
#include "agents/sources/simulator/passers_by.hpp"

namespace lifeline::sources {
namespace {

/// Of a lidar on the head of someone on hands and knees.
constexpr double kCrawlingHeightM = 0.6;

/// Reads options one after the other and keeps the first error.
class Reader {
 public:
  explicit Reader(const SourceSpec& spec) : spec_(spec) {}

  template <typename Integer>
  void integer(const char* name, Integer& value, std::int64_t lowest, std::int64_t highest) {
    const auto read = spec_.integer(name, static_cast<std::int64_t>(value), lowest, highest);
    if (keep(read)) value = static_cast<Integer>(*read);
  }
  void number(const char* name, double& value, double lowest, double highest) {
    const auto read = spec_.number(name, value, lowest, highest);
    if (keep(read)) value = *read;
  }
  /// True for the second of two choices.
  void either(const char* name, bool& value, const char* no, const char* yes) {
    const auto read = spec_.choice(name, value ? yes : no, {no, yes});
    if (keep(read)) value = *read == yes;
  }
  template <typename T>
  bool keep(const Result<T>& read) {
    if (!read && status_) status_ = forward_error(read);
    return read.has_value();
  }
  [[nodiscard]] const Result<void>& status() const { return status_; }

 private:
  const SourceSpec& spec_;
  Result<void> status_;
};

void read_doors(const SourceSpec& spec, Reader& reader, Doors::When& doors) {
  const auto when = spec.choice("doors", "off", {"off", "timetable", "beside"});
  if (!reader.keep(when)) return;
  if (*when == "timetable") doors = Doors::When::timetable;
  if (*when == "beside") doors = Doors::When::beside;
}

void read_head(const SourceSpec& spec, Reader& reader, Walk::Head& head) {
  const auto how = spec.choice("head", "still", {"still", "natural", "nodding", "crawling"});
  if (!reader.keep(how)) return;
  if (*how == "natural") head = Walk::Head::natural;
  if (*how == "nodding") head = Walk::Head::nodding;
  if (*how == "crawling") head = Walk::Head::crawling;
}

/// What makes it hard for the lidar to see the building.
void read_hardships(const SourceSpec& spec, Reader& reader, SimulatorOptions& options) {
  reader.number("glass", options.hardships.glass_share, 0.0, 1.0);
  reader.number("black", options.hardships.black_share, 0.0, 1.0);
  reader.number("ceiling_spread", options.hardships.ceiling_spread_m, 0.0, 10.0);
  reader.integer("people", options.people, 0, PassersBy::kMost);
  if (spec.options.contains("smoke")) {
    reader.number("smoke", options.lidar.smoke_sight_m, 0.1, 100.0);
  }
}

void read_finds(const SourceSpec& spec, Reader& reader, const char* name, FindsWanted& wanted) {
  const auto read = read_finds(spec, name);
  if (reader.keep(read)) wanted = *read;
}

}  // namespace

Result<SimulatorOptions> read_simulator_options(const SourceSpec& spec) {
  constexpr std::int64_t kMostSeed = std::numeric_limits<std::int64_t>::max();
  constexpr double kLeastDurationS = 0.001, kDayS = 86'400.0;
  SimulatorOptions options;
  Reader reader(spec);
  reader.keep(spec.allow_options(
      {"seed",  "width",   "depth", "walk_seed", "walker", "walkers",        "beams",  "hz",
       "noise", "dropout", "sweep", "prior",     "from",   "duration",       "head",   "ceiling",
       "doors", "victims", "tags",  "glass",     "black",  "ceiling_spread", "people", "smoke"}));
  reader.integer("seed", options.office.seed, 0, kMostSeed);
  reader.number("width", options.office.width_m, OfficeOptions::kLeastSideM,
                OfficeOptions::kLargestSideM);
  reader.number("depth", options.office.depth_m, OfficeOptions::kLeastSideM,
                OfficeOptions::kLargestSideM);
  options.walker.seed = options.office.seed;
  reader.integer("walk_seed", options.walker.seed, 0, kMostSeed);
  reader.integer("walkers", options.walker.walkers, 1, WalkerNumber::kMost);
  const int last = options.walker.walkers == 1 ? WalkerNumber::kMost : options.walker.walkers;
  reader.integer("walker", options.walker.walker, 0, last - 1);
  reader.integer("beams", options.lidar.beams, 4, 20'000);
  reader.number("hz", options.lidar.turns_per_s, 0.1, 100.0);
  reader.number("noise", options.lidar.noise_m, 0.0, 1.0);
  reader.number("dropout", options.lidar.dropout_share, 0.0, 1.0);
  reader.either("sweep", options.lidar.takes_time, "off", "on");
  reader.either("prior", options.ahrs, "none", "ahrs");
  read_head(spec, reader, options.head);
  reader.number("ceiling", options.lidar.ceiling_m, 2.0, 50.0);
  if (options.head == Walk::Head::crawling) options.lidar.height_m = kCrawlingHeightM;
  read_doors(spec, reader, options.doors);
  read_hardships(spec, reader, options);
  reader.number("from", options.from_s, 0.0, kDayS);
  read_finds(spec, reader, "victims", options.victims);
  read_finds(spec, reader, "tags", options.tags);
  if (spec.options.contains("duration")) {
    double duration_s = kDayS;
    reader.number("duration", duration_s, kLeastDurationS, kDayS);
    options.duration_s = duration_s;
  }
  if (!reader.status()) return forward_error(reader.status());
  const bool sized = spec.options.contains("width") || spec.options.contains("depth");
  if (sized && find_paper_building(spec.target)) {
    return fail(ErrorCode::wrong_use, "sim:{} has a size of its own: leave out width and depth",
                spec.target);
  }
  return options;
}

}  // namespace lifeline::sources
