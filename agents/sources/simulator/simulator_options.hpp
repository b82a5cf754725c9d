#pragma once

#include <optional>

#include "agents/sources/simulator/doors.hpp"
#include "agents/sources/simulator/finds.hpp"
#include "agents/sources/simulator/make_hard.hpp"
#include "agents/sources/simulator/office.hpp"
#include "agents/sources/simulator/sensors.hpp"
#include "agents/sources/simulator/tour.hpp"
#include "agents/sources/simulator/walk.hpp"
#include "agents/sources/source_spec.hpp"
#include "common/base/result.hpp"

namespace lifeline::sources {

/// What the options of `sim:TARGET?options` say.
struct SimulatorOptions {
  OfficeOptions office;  ///< seed, width, depth
  WalkerNumber walker;   ///< walk_seed (seed where it is not given), walker, walkers
  LidarOptions lidar;    ///< beams, hz, noise, dropout, sweep, ceiling, smoke
  Hardships hardships;   ///< glass, black, ceiling_spread
  int people = 0;
  Walk::Head head = Walk::Head::still;
  Doors::When doors = Doors::When::never;
  FindsWanted victims;
  FindsWanted tags;
  bool ahrs = true;                  ///< prior=ahrs|none
  double from_s = 0.0;               ///< from: the walk goes on from here
  std::optional<double> duration_s;  ///< duration; without it, the walk's first round
};

/// Reads them. wrong_use with one line for an unknown option, a value outside of its range, and a
/// walker that is not one of `walkers`.
[[nodiscard]] Result<SimulatorOptions> read_simulator_options(const SourceSpec& spec);

}  // namespace lifeline::sources
