#include "agents/ahrs/line_splitter.hpp"

namespace lifeline::ahrs {

void LineSplitter::add(char c) {
  if (line_.size() == kMostBytes) {
    lost_bytes_ += line_.size();
    line_.clear();
  }
  line_.push_back(c);
}

std::string_view LineSplitter::last_start() {
  std::size_t start = 0;
  for (const std::string_view begins : {"$", "P:"}) {
    const std::size_t found = line_.rfind(begins);
    if (found != std::string::npos && found > start) start = found;
  }
  lost_bytes_ += start;
  return std::string_view(line_).substr(start);
}

}  // namespace lifeline::ahrs
