// Counts what the program takes from the heap by operator new, which its source file replaces: only
// in programs that it is compiled into.
#pragma once

#include <cstdint>

namespace arcstart::extraction {

std::int64_t counted_allocations();  // since the program began, all threads

}  // namespace arcstart::extraction
