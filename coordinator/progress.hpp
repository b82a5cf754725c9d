#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

#include "coordinator/coordinator.hpp"

namespace lifeline {

/// Prints what a coordinator sees as plain lines: each helmet once a second, matches as they
/// happen.
class ProgressPrinter {
 public:
  ProgressPrinter(std::FILE* out, SteadyTime started) : out_(out), started_(started) {}

  void step(const Coordinator& coordinator, SteadyTime now);

 private:
  void print_matches(const Coordinator& coordinator);
  void print_helmets(const Coordinator& coordinator, SteadyTime now);

  std::FILE* out_;
  SteadyTime started_;
  SteadyTime helmets_due_{};
  std::map<merging::LayerPair, Duration> printed_;
};

/// "tracking", "lost its place", ...
[[nodiscard]] const char* describe(wire::AgentState state);

/// One helmet in a few words: "alpha 120 scans 85 m2 at (1.2, 3.4) trust good".
[[nodiscard]] std::string describe(const sharing::Roster::Entry& helmet,
                                   const Coordinator& coordinator, SteadyTime now);

}  // namespace lifeline
