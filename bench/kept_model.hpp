// The contact model of a kept state.
#pragma once

#include "io/checkpoint.hpp"
#include "io/settings.hpp"
#include "scenarios/scenario.hpp"

namespace riesel::bench {

/// From the settings in the checkpoint. Throws SettingsError for such as are not known any more.
inline ContactModel model_of(const io::Checkpoint& checkpoint) {
  return scenarios::contact_model(
      io::Settings::from_text(checkpoint.settings, "checkpoint", scenarios::settings_tables()));
}

}  // namespace riesel::bench
