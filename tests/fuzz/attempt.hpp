// Reading what may be refused.
#pragma once

#include "io/file_error.hpp"

namespace fuzz {

/// Reads; that the file is refused is as good.
template <class Read>
void attempt(Read read) {
  try {
    read();
  } catch (const riesel::io::FileError&) {
  }
}

}  // namespace fuzz
