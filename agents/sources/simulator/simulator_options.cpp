#include "agents/sources/simulator/simulator_options.hpp"

#include <cstdint>
#include <limits>
#include <string>

namespace lifeline::sources {
namespace {

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
  const auto how = spec.choice("head", "still", {"still", "natural", "nodding"});
  if (!reader.keep(how)) return;
  if (*how == "natural") head = Walk::Head::natural;
  if (*how == "nodding") head = Walk::Head::nodding;
}

}  // namespace

Result<SimulatorOptions> read_simulator_options(const SourceSpec& spec) {
  constexpr std::int64_t kMostSeed = std::numeric_limits<std::int64_t>::max();
  constexpr double kLeastDurationS = 0.001, kDayS = 86'400.0;
  SimulatorOptions options;
  Reader reader(spec);
  reader.keep(spec.allow_options({"seed", "width", "depth", "walk_seed", "walker", "walkers",
                                  "beams", "hz", "noise", "dropout", "sweep", "prior", "duration",
                                  "head", "ceiling", "doors"}));
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
  read_doors(spec, reader, options.doors);
  if (spec.options.contains("duration")) {
    double duration_s = kDayS;
    reader.number("duration", duration_s, kLeastDurationS, kDayS);
    options.duration_s = duration_s;
  }
  if (!reader.status()) return forward_error(reader.status());
  return options;
}

}  // namespace lifeline::sources
