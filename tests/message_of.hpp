// What a call complains of.
#pragma once

#include <string>

namespace riesel {

/// The message of the Error that action() throws; empty if it throws none.
template <class Error, class Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace riesel
