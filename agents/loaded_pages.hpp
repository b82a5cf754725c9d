#pragma once

namespace lifeline {

/// Gives back the memory of what loading this program and its libraries has read, symbol tables
/// above all: of the read-only segments, what is needed again comes again from the page cache.
/// Nothing is lost, whatever other threads do.
void give_back_loaded_pages();

}  // namespace lifeline
