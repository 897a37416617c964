// The contacts that last: stepped from beginning to end in place, side by side, by vector
// instructions.
//
// Whoever steps the grains finds out which contacts begin; from then on nobody looks for them. A
// contact costs its force and the book-keeping of its life, both in one loop over arrays, and its
// end is noticed there.
#pragma once

#include "engine/aligned.hpp"
#include "engine/contact.hpp"
#include "engine/contact_law.hpp"
#include "engine/lane_flags.hpp"
#include "engine/meeting.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace riesel {

/// For a contact that no step of LiveContacts sees the end of: what friction took in its last step,
/// and what is left in its spring. The meeting is that of name.grain and its partner, as
/// meeting_of() has it.
void add_last_loss(Contact& contact, const Meeting& meeting, const Bodies& bodies,
                   const SlipLaw& slip, const StepUnits& units);

class LiveContacts {
public:
  enum class Partner { grain, wall };

  explicit LiveContacts(Partner partner) : partner_(partner) {
    found_of_few_.resize(LaneFlags<std::int64_t>::lanes);
    pad();
  }

  /// Vectors are filled up with lanes that are no contacts. These look at the body in this place
  /// instead of the first of all, which others may be changing.
  void pad_with(std::int64_t place);

  std::size_t size() const { return meetings_.size(); }
  const Meeting& meeting(std::size_t i) const { return meetings_[i]; }
  Contact contact(std::size_t i) const;
  std::int64_t first(std::size_t i) const { return body_[0][i]; }
  std::int64_t second(std::size_t i) const { return body_[1][i]; }
  /// What the last step() gives to the bodies.
  BodyKick kick_of_first(std::size_t i) const {
    return {kick_[0][i], kick_[1][i], rich_ ? spin_kick_[0][i] : 0};
  }
  BodyKick kick_of_second(std::size_t i) const {
    return {kick_[2][i], kick_[3][i], rich_ ? spin_kick_[1][i] : 0};
  }

  void clear();
  /// A contact that lasts already.
  void add(const Meeting& meeting, const Contact& contact);
  /// A contact that begins in the step that is done next.
  void begin(const Meeting& meeting) {
    add(meeting, {.name = meeting.name});
    ++beginning_;
  }
  /// Its bodies stand elsewhere now.
  void move(std::size_t i, std::int64_t first, std::int64_t second) {
    body_[0][i] = first;
    body_[1][i] = second;
  }

  /// Computes the kicks of this step and carries the lives on. `bodies` are at the step of `units`.
  /// What has ended then stands in ended() and gives no kick.
  void step(const Bodies& bodies, const StepUnits& units, const ContactModel& model);

  /// Indices of the contacts that the last step() found apart, decreasing; to be removed in this
  /// order before the next.
  const std::vector<std::size_t>& ended() const { return ended_; }
  /// The last contact takes the place of contact `i`.
  void remove(std::size_t i);

  /// The first by name of the contacts whose kick in the last step() was no usable number, so that
  /// it gave none.
  const std::optional<ContactName>& trouble() const { return trouble_; }

private:
  /// The life of a contact without its name: one array for each member of Contact.
  static constexpr std::size_t life_members =
      (sizeof(Contact) - offsetof(Contact, begin)) / sizeof(double);
  /// Those from here on are of springs and torques.
  static constexpr std::size_t poor_life_members =
      (offsetof(Contact, spring) - offsetof(Contact, begin)) / sizeof(double);

  struct Columns;  // pointers to the arrays, for the loop
  Columns columns();
  template <Partner partner, class Turn, class Normal, class Slip>
  void step(const Bodies& bodies, const StepUnits& units, const ContactModel& model,
            const Normal& normal, const Slip& slip);
  template <Partner partner>
  void step(const Bodies& bodies, const StepUnits& units, const ContactModel& model);
  /// Calls use(found_of_few_) or use(found_of_many_).
  template <class Use>
  void with_found(Use use) {
    if (size() <= LaneFlags<std::int64_t>::lanes)
      use(found_of_few_);
    else
      use(found_of_many_);
  }
  std::size_t members() const { return rich_ ? life_members : poor_life_members; }
  void become_rich();
  void make_harmless(std::size_t i);
  void follow_walls(const Bodies& bodies, const StepUnits& units);
  void follow_bodies(const Columns& columns, const Bodies& bodies) const;
  void pad();
  template <class Visit>
  void for_each_array(Visit visit);

  Partner partner_;
  std::size_t beginning_ = 0;  // contacts at the end of the arrays that begin in the next step
  std::size_t followed_ = 0;   // so many have been stepped; the others have been added since
  std::vector<Meeting> meetings_;
  // The arrays are padded with lanes of zero reach, which never touch, to whole blocks.
  std::int64_t padding_body_ = 0;
  std::array<AlignedVector<std::int64_t>, 2> body_;  // first and second
  // Members of a BodyMotion: of the point of a wall, or of the second grain as seen from the first,
  // which kicks alone change from step to step.
  std::array<AlignedVector<Fixed>, 6> partner_motion_;
  AlignedVector<double> reach_, reduced_mass_;
  std::array<AlignedVector<double>, 2> per_mass_;  // 1/kg, of first and second
  std::array<AlignedVector<double>, life_members> life_;
  std::array<AlignedVector<Fixed>, 4> kick_;
  bool any_level_ = false;  // with smooth walls
  bool rich_ = false;       // there are springs or torques; else the arrays for them are empty
  std::array<AlignedVector<double>, 2> radius_;    // m, of first and second
  std::array<AlignedVector<Fixed>, 2> spin_kick_;  // likewise
  // What the last step found of each contact: of so few that they are one vector, or of more.
  LaneFlags<std::int64_t> found_of_few_;
  LaneFlags<std::int32_t> found_of_many_;
  std::vector<std::size_t> ended_;
  std::optional<ContactName> trouble_;
};

}  // namespace riesel
