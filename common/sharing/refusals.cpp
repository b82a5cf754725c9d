#include "common/sharing/refusals.hpp"

#include "common/base/log.hpp"

namespace lifeline::sharing {

void Refusals::note(std::string_view topic, const Error& error) {
  ++count_;
  if (count_ % 1000 == 1)
    spdlog::warn("{}: refused a sample ({} so far): {}", topic, count_, error.text);
}

}  // namespace lifeline::sharing
