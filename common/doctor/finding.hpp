#pragma once

#include <string>
#include <vector>

#include "common/base/result.hpp"

namespace lifeline::doctor {

enum class Level {
  ok,
  warning,  ///< works, but worse than it could, or not for long
  fault,    ///< will not work
};

/// One thing that was looked at.
struct Finding {
  Level level = Level::ok;
  std::string check;   ///< which check: one word, the same in every version
  std::string where;   ///< file, device, interface, port
  std::string what;    ///< what is so
  std::string advice;  ///< what to do; empty where nothing is to be done
};
using Findings = std::vector<Finding>;

[[nodiscard]] Finding ok(std::string check, std::string where, std::string what);
[[nodiscard]] Finding warning(std::string check, std::string where, std::string what,
                              std::string advice);
[[nodiscard]] Finding fault(std::string check, std::string where, std::string what,
                            std::string advice);
/// A fault for each line of an error, whose text is "WHERE: what; advice".
[[nodiscard]] Findings faults(const std::string& check, const std::string& where,
                              const Error& error);
void append(Findings& all, Findings more);

/// Of a doctor's program: 0 nothing is wrong, 1 a fault, 3 warnings alone. 2 is wrong use, as
/// everywhere.
[[nodiscard]] int exit_status(const Findings& findings);
/// For people: a line each, advice on a line of its own, and how many faults and warnings there
/// are. `coloured` adds terminal colours, which repeat what the words say.
[[nodiscard]] std::string to_text(const Findings& findings, bool coloured);
/// {"outcome": "ok", "warnings" or "faults", "faults": n, "warnings": n, "findings": [{"level",
/// "check", "where", "what", "advice"}, ...]}
[[nodiscard]] std::string to_json(const Findings& findings);

}  // namespace lifeline::doctor
