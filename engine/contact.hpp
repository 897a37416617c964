// A contact and its life: what is recorded of two bodies from the step in which they begin to
// overlap to the step in which they no longer do.
#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace riesel {

/// Identifies a contact independently of where its grains are stored.
struct ContactName {
  std::int32_t wall;   ///< index of the wall, or -1 for a contact between free grains
  std::int32_t grain;  ///< id of the (first) free grain
  std::int32_t
      partner;  ///< id of the second grain (larger than `grain`), or index of the wall grain

  auto operator<=>(const ContactName&) const = default;
};

inline constexpr std::int32_t no_wall = -1;

/// "grain 3 and grain 4", "grain 3 and grain 7 of wall 0"
std::string bodies_of(const ContactName& name);

/// Step and name of a contact whose force is not finite, or too large.
struct Trouble {
  std::int64_t step;
  ContactName contact;

  auto operator<=>(const Trouble&) const = default;
};

/// The smaller of two reports, of which either may be missing: so the one that is told of does not
/// depend on which thread found which.
template <class T>
std::optional<T> first_of(const std::optional<T>& a,
                          const std::type_identity_t<std::optional<T>>& b) {
  return a && b ? std::min(*a, *b) : a ? a : b;
}

/// The life of a contact, in SI units. `begin` and `end` are resolved within a step: extrapolating
/// the relative path of the two bodies tells when they met and when they will part. s is the
/// direction from the first body to the second turned by 90 degrees.
struct Contact {
  ContactName name{};
  double begin = 0.0;           ///< s, since step 0
  double end = 0.0;             ///< s, when the bodies part, or a step from now if that is later
  double entry_rate = 0.0;      ///< m/s, normal approach velocity at the beginning
  double entry_slip = 0.0;      ///< m/s, slip velocity of the centres at the beginning
  double overlap = 0.0;         ///< m, now
  double max_overlap = 0.0;     ///< m
  double slip_path = 0.0;       ///< m, integral of |slip velocity| of the surfaces
  double elastic_energy = 0.0;  ///< J, stored now, in the tangential spring too
  double normal_loss = 0.0;     ///< J, dissipated by the normal damping so far
  double friction_loss = 0.0;   ///< J, dissipated by friction before this step
  double impulse_x = 0.0;       ///< kg m/s, given to `grain` by a wall, across the tube, so far
  double impulse_y = 0.0;       ///< kg m/s, the same along y
  double impulse_y_times_time = 0.0;  ///< kg m, sum of each step's part of impulse_y times the time
  double friction_x = 0.0;            ///< N, friction on `grain` in this step, across the tube
  double friction_y = 0.0;            ///< N, the same along y
  double spring = 0.0;                ///< m, elongation of the tangential spring, along s
  double torque = 0.0;          ///< N m, of the friction in this step, on both grains together
  double rolling_torque = 0.0;  ///< N m, of the resistance to rolling in this step, on `grain`

  double duration() const { return end - begin; }  ///< s
};

/// Sorts into the order in which a State has its contacts.
inline void sort_by_name(std::vector<Contact>& contacts) {
  std::sort(contacts.begin(), contacts.end(),
            [](const Contact& a, const Contact& b) { return a.name < b.name; });
}

}  // namespace riesel
