#include "engine/contact.hpp"

namespace riesel {

std::string bodies_of(const ContactName& name) {
  const std::string both =
      "grain " + std::to_string(name.grain) + " and grain " + std::to_string(name.partner);
  return name.wall == no_wall ? both : both + " of wall " + std::to_string(name.wall);
}

}  // namespace riesel
