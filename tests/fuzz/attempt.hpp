// Reading what may be refused.
#pragma once

#include "io/file_error.hpp"

#include <set>
#include <string>

namespace fuzz {

/// The readers that took what they were given, since this was cleared: a replay asks.
inline std::set<std::string> accepted_by;

/// Reads; that it is refused is as good.
template <class Refusal = riesel::io::FileError, class Read>
void attempt(const char* reader, Read read) {
  try {
    read();
    accepted_by.insert(reader);
  } catch (const Refusal&) {
  }
}

}  // namespace fuzz
